#pragma once

#include <xcb/xcb.h>

#include <QProcess>
#include <QString>
#include <QTemporaryDir>

#include <functional>
#include <utility>
#include <vector>

namespace ghostlight::test {

/// The built program in a process of its own, with a home of its own, and the keys of a person at
/// it, sent through X11.
class RunningProgram {
   public:
    /// `settings` is the text of its settings file, `home` where it keeps them.
    RunningProgram(const QTemporaryDir& home, const QStringList& arguments,
                   const std::vector<std::pair<QString, QString>>& environment = {});
    ~RunningProgram();

    /// Until its window can be seen and takes keys.
    bool wait_for_window();
    bool wait_until(const std::function<bool()>& holds, int timeout_ms);
    /// One key with modifiers of X11 (XCB_MOD_MASK_CONTROL, …), by its key symbol.
    void press(xcb_keysym_t symbol, unsigned modifiers = 0);
    QString title();
    /// kill -9.
    void kill();
    QProcess& process() { return process_; }
    QByteArray output() { return process_.readAll(); }

   private:
    xcb_window_t find_window(xcb_window_t below);
    xcb_keycode_t code_of(xcb_keysym_t symbol);

    QProcess process_;
    xcb_connection_t* display_ = nullptr;
    xcb_window_t root_ = 0, window_ = 0;
    xcb_atom_t pid_atom_ = 0;
};

}  // namespace ghostlight::test
