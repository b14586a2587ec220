#include "tests/widgets/program_kit.h"

#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QTest>

#include <cstdlib>
#include <memory>

#include "tests/support/test_paths.h"
#include "tests/widgets/window_kit.h"

namespace ghostlight::test {

namespace {

struct Free {
    void operator()(void* reply) const { std::free(reply); }
};
template <class Reply>
using Owned = std::unique_ptr<Reply, Free>;

}  // namespace

RunningProgram::RunningProgram(const QTemporaryDir& home, const QStringList& arguments,
                               const std::vector<std::pair<QString, QString>>& environment) {
    QProcessEnvironment variables = QProcessEnvironment::systemEnvironment();
    variables.insert("HOME", home.path());
    for (const char* name : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME"}) {
        variables.insert(name, home.filePath(name));
        QDir(home.path()).mkpath(name);
    }
    for (const auto& [name, value] : environment) {
        variables.insert(name, value);
    }
    process_.setProcessEnvironment(variables);
    process_.setProcessChannelMode(QProcess::MergedChannels);
    display_ = xcb_connect(nullptr, nullptr);
    root_ = xcb_setup_roots_iterator(xcb_get_setup(display_)).data->root;
    const char name[] = "_NET_WM_PID";
    const Owned<xcb_intern_atom_reply_t> atom(xcb_intern_atom_reply(
        display_, xcb_intern_atom(display_, 0, sizeof name - 1, name), nullptr));
    pid_atom_ = atom->atom;
    process_.start(QString::fromStdString(gui_program().string()), arguments);
}

RunningProgram::~RunningProgram() {
    if (process_.state() != QProcess::NotRunning) {
        kill();
    }
    xcb_disconnect(display_);
}

bool RunningProgram::wait_until(const std::function<bool()>& holds, int timeout_ms) {
    return QTest::qWaitFor([&] { return process_.state() == QProcess::NotRunning || holds(); },
                           timeout_ms) &&
           process_.state() != QProcess::NotRunning;
}

xcb_window_t RunningProgram::find_window(xcb_window_t below) {
    const Owned<xcb_query_tree_reply_t> tree(
        xcb_query_tree_reply(display_, xcb_query_tree(display_, below), nullptr));
    if (tree == nullptr) {
        return 0;  // it went meanwhile
    }
    const xcb_window_t* children = xcb_query_tree_children(tree.get());
    for (int k = 0; k < xcb_query_tree_children_length(tree.get()); ++k) {
        const Owned<xcb_get_property_reply_t> pid(xcb_get_property_reply(
            display_,
            xcb_get_property(display_, 0, children[k], pid_atom_, XCB_ATOM_CARDINAL, 0, 1),
            nullptr));
        const Owned<xcb_get_window_attributes_reply_t> look(xcb_get_window_attributes_reply(
            display_, xcb_get_window_attributes(display_, children[k]), nullptr));
        const bool is_ours = pid != nullptr && xcb_get_property_value_length(pid.get()) == 4 &&
                             *static_cast<quint32*>(xcb_get_property_value(pid.get())) ==
                                 static_cast<quint32>(process_.processId());
        if (is_ours && look != nullptr && look->map_state == XCB_MAP_STATE_VIEWABLE) {
            return children[k];
        }
    }
    return 0;
}

bool RunningProgram::wait_for_window() {
    if (!wait_until([this] { return (window_ = find_window(root_)) != 0; }, patience_ms)) {
        return false;
    }
    xcb_set_input_focus(display_, XCB_INPUT_FOCUS_PARENT, window_, XCB_CURRENT_TIME);
    xcb_flush(display_);
    return wait_until([this] { return title().contains("Ghostlight"); }, patience_ms);
}

QString RunningProgram::title() {
    const Owned<xcb_get_property_reply_t> name(xcb_get_property_reply(
        display_,
        xcb_get_property(display_, 0, window_, XCB_ATOM_WM_NAME, XCB_GET_PROPERTY_TYPE_ANY, 0, 256),
        nullptr));
    return name == nullptr
               ? QString()
               : QString::fromUtf8(static_cast<char*>(xcb_get_property_value(name.get())),
                                   xcb_get_property_value_length(name.get()));
}

xcb_keycode_t RunningProgram::code_of(xcb_keysym_t symbol) {
    const xcb_setup_t* setup = xcb_get_setup(display_);
    const auto count = static_cast<quint8>(setup->max_keycode - setup->min_keycode + 1);
    const Owned<xcb_get_keyboard_mapping_reply_t> map(xcb_get_keyboard_mapping_reply(
        display_, xcb_get_keyboard_mapping(display_, setup->min_keycode, count), nullptr));
    const xcb_keysym_t* symbols = xcb_get_keyboard_mapping_keysyms(map.get());
    for (int k = 0; k < count; ++k) {
        if (symbols[k * map->keysyms_per_keycode] == symbol) {
            return static_cast<xcb_keycode_t>(setup->min_keycode + k);
        }
    }
    ADD_FAILURE() << "no key for symbol " << symbol;
    return 0;
}

void RunningProgram::press(xcb_keysym_t symbol, unsigned modifiers) {
    xcb_key_press_event_t event{};
    event.detail = code_of(symbol);
    event.root = root_;
    event.event = window_;
    event.same_screen = 1;
    event.state = static_cast<quint16>(modifiers);
    for (const auto& [type, mask] : {std::pair{XCB_KEY_PRESS, XCB_EVENT_MASK_KEY_PRESS},
                                     std::pair{XCB_KEY_RELEASE, XCB_EVENT_MASK_KEY_RELEASE}}) {
        event.response_type = static_cast<quint8>(type);
        xcb_send_event(display_, 0, window_, mask, reinterpret_cast<const char*>(&event));
    }
    xcb_flush(display_);
}

void RunningProgram::kill() {
    process_.kill();  // SIGKILL: nothing of the program runs any more
    process_.waitForFinished();
}

}  // namespace ghostlight::test
