#include "widgets/blocking_trace.h"

#include <gtest/gtest.h>

#include <QDockWidget>
#include <QEvent>
#include <QEventLoop>
#include <QMouseEvent>
#include <QTemporaryDir>
#include <QTimer>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <vector>

#include "tests/widgets/window_kit.h"
#include "widgets/file_actions.h"
#include "widgets/flare_view.h"
#include "widgets/models/ghost_table_model.h"
#include "widgets/models/prescription_model.h"
#include "widgets/panels/flare_panel.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/prescription_panel.h"
#include "widgets/prescription_edits.h"

namespace ghostlight {
namespace {

TracedApplication& application() { return *static_cast<TracedApplication*>(qApp); }

/// Collects what blocks, instead of what GHOSTLIGHT_TRACE_BLOCKING asks for, while it lives.
struct Watching {
    explicit Watching(double least_ms) {
        application().trace(least_ms, [this](const BlockedFor& each) { found.push_back(each); });
    }
    ~Watching() { application().trace_as_asked(); }
    std::vector<BlockedFor> found;
};

void work_for(std::chrono::milliseconds duration) {
    const auto end = std::chrono::steady_clock::now() + duration;
    while (std::chrono::steady_clock::now() < end) {
    }
}

/// Does something when an event comes.
struct Handler : QObject {
    explicit Handler(std::function<void()> what) : act(std::move(what)) {}
    bool event(QEvent*) override {
        act();
        return true;
    }
    std::function<void()> act;
};

constexpr double least_ms = 20.0;
constexpr std::chrono::milliseconds longer{30};

TEST(BlockingTrace, TellsTheEventThatTookLongAndItsReceiver) {
    Handler slow([] { work_for(longer); });
    slow.setObjectName("slow");
    QEvent event(QEvent::MouseButtonPress);
    Watching watching(least_ms);
    QCoreApplication::sendEvent(&slow, &event);
    ASSERT_EQ(watching.found.size(), 1U);
    EXPECT_TRUE(watching.found[0].event.contains("MouseButtonPress"))
        << qPrintable(watching.found[0].event);
    EXPECT_TRUE(watching.found[0].event.contains("'slow'")) << qPrintable(watching.found[0].event);
    EXPECT_GE(watching.found[0].wall_ms, 30.0);
}

TEST(BlockingTrace, CountsEventsSentByAHandlerAsPartOfIt) {
    Handler inner([] { work_for(longer); });
    Handler outer([&] {
        QEvent event(QEvent::User);
        QCoreApplication::sendEvent(&inner, &event);
    });
    outer.setObjectName("outer");
    QEvent event(QEvent::KeyPress);
    Watching watching(least_ms);
    QCoreApplication::sendEvent(&outer, &event);
    ASSERT_EQ(watching.found.size(), 1U);
    EXPECT_TRUE(watching.found[0].event.contains("'outer'"));
}

TEST(BlockingTrace, LeavesOutHandlersThatRunALoopButNotWhatIsSlowInIt) {
    Handler inner([] { work_for(longer); });
    inner.setObjectName("inner");
    Handler opens_menu([&] {
        QEventLoop loop;
        QCoreApplication::postEvent(&inner, new QEvent(QEvent::User));
        QTimer::singleShot(std::chrono::milliseconds(60), &loop, &QEventLoop::quit);
        loop.exec();
    });
    opens_menu.setObjectName("menu");
    QEvent event(QEvent::KeyPress);
    Watching watching(least_ms);
    QCoreApplication::sendEvent(&opens_menu, &event);
    EXPECT_TRUE(std::ranges::any_of(
        watching.found, [](const BlockedFor& each) { return each.event.contains("'inner'"); }));
    EXPECT_TRUE(std::ranges::none_of(
        watching.found, [](const BlockedFor& each) { return each.event.contains("'menu'"); }));
}

/// Not a test of times, which are the machine's: a walk through the window that tells what blocks
/// it in every step. It takes minutes, alone on a machine at rest, and is run where
/// GHOSTLIGHT_TRACE_BLOCKING asks for it.
struct BlockingSlow : testing::Test {
    void SetUp() override {
        if (!qEnvironmentVariableIsSet("GHOSTLIGHT_TRACE_BLOCKING"))
            GTEST_SKIP() << "GHOSTLIGHT_TRACE_BLOCKING is not set";
    }

    void step(const char* name, const std::function<void()>& act) {
        Handler by_hand(act);  // what the window does at once counts as well
        by_hand.setObjectName(name);
        QEvent event(QEvent::User);
        QCoreApplication::sendEvent(&by_hand, &event);
        EXPECT_TRUE(shown.settle()) << name;
        constexpr double busy_ms = 20.0;  // less was waiting, for other programs or the graphics
        std::size_t waits = 0;
        for (const BlockedFor& each : watching.found) {
            if (each.processor_ms < busy_ms) {
                ++waits;
                continue;
            }
            std::printf("%-24s %5.0f ms (%.0f of processor time)  %s\n", name, each.wall_ms,
                        each.processor_ms, qPrintable(each.event));
        }
        if (waits > 0) {
            std::printf("%-24s %zu that only waited\n", name, waits);
        }
        std::fflush(stdout);
        watching.found.clear();
        ++steps;
    }
    void set_cell(int row, int column, const char* text) {
        auto& model = shown.window.prescription_panel().model();
        EXPECT_TRUE(model.setData(model.index(row, column), QString(text), Qt::EditRole)) << text;
    }
    void edit_scene(const std::function<void(Scene&)>& change) {
        Scene scene = shown.window.document().scene();
        change(scene);
        shown.window.document().edit_scene(scene, "look otherwise");
    }

    Watching watching{TracedApplication::default_least_ms};
    test::OpenWindow shown;
    int steps = 0;
};

TEST_F(BlockingSlow, AWalkThroughTheWindow) {
    MainWindow& window = shown.window;
    step("start", [] {});
    step("open", [&] {
        ASSERT_TRUE(window.open(test::bundled("canon_zoom_70_200_f2.8.json")));
        shown.loosen();
    });
    step("radius", [&] { set_cell(0, PrescriptionModel::radius, "110"); });
    step("coating", [&] { set_cell(3, PrescriptionModel::coating, "none"); });
    step("undo", [&] { window.actions()["edit.undo"].trigger(); });
    step("redo", [&] { window.actions()["edit.redo"].trigger(); });
    const auto& configurations = window.document().lens().configurations;
    ASSERT_FALSE(configurations.empty());
    const std::string last = configurations.back().name;
    step("configuration", [&] { edit_scene([&](Scene& s) { s.configuration = last; }); });
    step("field", [&] { edit_scene([](Scene& s) { s.light().direction.field_deg = 6.0; }); });
    step("azimuth", [&] { edit_scene([](Scene& s) { s.light().direction.azimuth_deg = 30.0; }); });
    step("f-number", [&] {
        Document& document = window.document();
        document.edit_lens(with_f_number(document.lens(), document.scene().configuration, 8.0),
                           "close the stop");
    });
    step("one ghost", [&] { window.selection().set_ghosts({GhostPath{{4, 2}}}); });
    step("24 ghosts", [&] {
        const auto table = window.ghost_panel().model().table();
        ASSERT_NE(table, nullptr);
        std::vector<GhostPath> some;
        for (std::size_t k = 0; k < 24; ++k) {
            some.push_back(table->ghosts[k].path);
        }
        window.selection().set_ghosts(some);
    });
    step("drag of the light", [&] {
        QWidget& view = *window.flare_panel().view();
        const QPoint middle = view.rect().center();
        const auto send = [&](QEvent::Type type, QPoint at, Qt::MouseButton button,
                              Qt::MouseButtons buttons) {
            QMouseEvent event(type, at, view.mapToGlobal(at), button, buttons, Qt::NoModifier);
            QApplication::sendEvent(&view, &event);
        };
        send(QEvent::MouseButtonPress, middle, Qt::LeftButton, Qt::LeftButton);
        for (int k = 1; k <= 10; ++k) {
            send(QEvent::MouseMove, middle + QPoint(6 * k, 3 * k), Qt::NoButton, Qt::LeftButton);
        }
        send(QEvent::MouseButtonRelease, middle + QPoint(60, 30), Qt::LeftButton, Qt::NoButton);
    });
    for (const char* action :
         {"ghosts.as_matrix", "ghosts.as_surfaces", "ghosts.as_table", "layout.fields",
          "layout.marks", "layout.stopped", "flare.false_color", "compare.pin", "check.show",
          "help.guide", "help.commands", "help.shortcuts", "help.about"}) {
        step(action, [&] { window.actions()[action].trigger(); });
    }
    for (QDockWidget* dock : window.findChildren<QDockWidget*>()) {
        step(qPrintable(dock->objectName()), [&] {
            dock->show();
            dock->raise();
        });
    }
    step("radius, all panels", [&] { set_cell(0, PrescriptionModel::radius, "111"); });
    const QTemporaryDir folder;
    const auto file = [&](const char* name) {
        return std::filesystem::path(folder.filePath(name).toStdString());
    };
    step("save", [&] { EXPECT_TRUE(window.files().save_as(file("lens.json"))); });
    step("export CSV", [&] { EXPECT_TRUE(window.files().export_table(file("ghosts.csv"))); });
    step("export EXR", [&] { EXPECT_TRUE(window.files().export_exr(file("flare.exr"))); });
    step("export PNG", [&] { EXPECT_TRUE(window.files().export_png(file("flare.png"))); });
    step("export ZMX", [&] { EXPECT_TRUE(window.files().export_lens(file("lens.zmx"))); });
    EXPECT_GT(steps, 40);
}

}  // namespace
}  // namespace ghostlight
