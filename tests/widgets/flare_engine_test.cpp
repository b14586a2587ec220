// Which engine draws the window's flare, and what happens where there is no OpenGL.

#include <gtest/gtest.h>

#include <QProcess>
#include <QSignalSpy>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "core/error.h"
#include "core/flare/planned_flare.h"
#include "tests/widgets/window_kit.h"
#include "widgets/flare_view.h"
#include "widgets/panels/flare_panel.h"
#include "widgets/panels/layout_panel.h"
#include "widgets/panels/status_line.h"
#include "widgets/settings.h"

namespace ghostlight {
namespace {

using test::OpenWindow;

/// An OpenGL that counts its pictures and fails from one of them on, as a lost context does.
struct MadeUpGl {
    std::shared_ptr<int> drawn = std::make_shared<int>(0);
    int good = 1'000'000;

    GlEngine operator()() const {
        return {"made-up card",
                [drawn = drawn, good = good](const FlareScene& scene, const FlareRequest& request,
                                             std::stop_token stop) {
                    if (++*drawn > good) {
                        throw Error("the context was lost");
                    }
                    return render_planned(scene, request, stop);
                }};
    }
};

bool says(const StatusLine& status, const char* words) {
    return status.engine_text().contains(words);
}

void move_light(MainWindow& window, double field_deg) {
    Scene scene = window.document().scene();
    scene.light().direction.field_deg = field_deg;
    window.document().edit_scene(scene, "move the light", "light");
}

TEST(WindowEngine, OpenGlIsUsedWhenItIsAskedForAndNamed) {
    const MadeUpGl gl;
    OpenWindow shown(test::tessar(), gl);
    shown.window.actions()["engine.opengl"].trigger();
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return says(shown.window.status_line(), "made-up card"); }, 20'000));
    ASSERT_TRUE(shown.settle());
    const int before = *gl.drawn;
    move_light(shown.window, 4.0);
    ASSERT_TRUE(shown.settle());
    EXPECT_GT(*gl.drawn, before);
    EXPECT_EQ(settings::flare_engine(), FlareEngine::gl);
    shown.window.actions()["engine.cpu"].trigger();
    EXPECT_TRUE(QTest::qWaitFor([&] { return says(shown.window.status_line(), "CPU"); }, 20'000));
    EXPECT_EQ(settings::flare_engine(), FlareEngine::cpu);
}

TEST(WindowEngine, ALostContextLeavesThePictureToTheCpuAndIsSaid) {
    const MadeUpGl gl{.good = 1};
    OpenWindow shown(test::tessar(), gl);
    shown.window.set_engine(FlareEngine::gl);
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return says(shown.window.status_line(), "made-up card"); }, 20'000));
    move_light(shown.window, 5.0);  // the picture that fails is drawn all the same
    ASSERT_TRUE(shown.settle());
    ASSERT_TRUE(QTest::qWaitFor([&] { return says(shown.window.status_line(), "CPU"); }, 20'000));
    ASSERT_TRUE(shown.window.picture());
    EXPECT_EQ(shown.window.picture()->revision, shown.window.document().revision());
    EXPECT_TRUE(shown.window.picture()->is_final);
    EXPECT_TRUE(shown.window.status_line().message_text().contains("context was lost"))
        << qPrintable(shown.window.status_line().message_text());
}

TEST(WindowEngine, WithoutOpenGlTheCpuServesAndItIsSaidWhy) {
    OpenWindow shown(test::tessar(),
                     []() -> GlEngine { throw Error("OpenGL is too old to draw flares"); });
    QSignalSpy changed(&shown.window.jobs(), &Jobs::engine_changed);
    shown.window.set_engine(FlareEngine::automatic);
    ASSERT_TRUE(shown.settle());
    ASSERT_TRUE(QTest::qWaitFor([&] { return !changed.isEmpty(); }, 20'000));
    const auto state = changed.back().front().value<EngineState>();
    EXPECT_EQ(state.choice.engine, FlareEngine::cpu);
    EXPECT_TRUE(state.is_settled);
    EXPECT_NE(state.choice.reason.find("too old"), std::string::npos) << state.choice.reason;
    EXPECT_TRUE(says(shown.window.status_line(), "CPU"));
}

TEST(WindowEngine, TheTrialWaitsForThePicture) {
    const MadeUpGl gl;
    std::atomic<int> pictures = 0, made = 0;
    std::atomic<bool> was_shown = false;
    OpenWindow shown({}, [&] {
        // On the flare's own thread. Were the picture still to come, this would hold it up.
        constexpr int patience = 500;
        for (int k = 0; k < patience && pictures == 0; ++k) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        was_shown = pictures > 0;
        ++made;
        return gl();
    });
    QObject::connect(&shown.window.jobs(), &Jobs::flare_ready, &shown.window.jobs(),
                     [&](const FlarePicture& picture) { pictures += picture.is_final ? 1 : 0; });
    shown.window.set_engine(FlareEngine::automatic);
    ASSERT_TRUE(shown.window.open(test::tessar()));
    ASSERT_TRUE(shown.settle());
    ASSERT_TRUE(QTest::qWaitFor([&] { return *gl.drawn > 0; }, 20'000));
    EXPECT_EQ(made, 1);
    EXPECT_TRUE(was_shown);
}

/// What this platform really gives: llvmpipe or a card.
TEST(WindowEngine, TheMachinesOwnOpenGlDrawsOrSaysWhy) {
    OpenWindow shown(test::tessar());
    QSignalSpy changed(&shown.window.jobs(), &Jobs::engine_changed);
    shown.window.set_engine(FlareEngine::gl);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            return !changed.isEmpty() && changed.back().front().value<EngineState>().is_settled;
        },
        60'000));
    const auto state = changed.back().front().value<EngineState>();
    EXPECT_FALSE(state.choice.reason.empty());
    if (state.choice.engine == FlareEngine::gl) {
        EXPECT_FALSE(state.gl_renderer.empty());
        move_light(shown.window, 6.0);
        ASSERT_TRUE(shown.settle());
        EXPECT_EQ(shown.window.picture()->revision, shown.window.document().revision());
        EXPECT_GT(shown.window.picture()->image->flux_on_sensor_mm2, 0.0);
    }
}

/// Run by the next test in a process of its own, under a Qt that has no OpenGL.
TEST(WindowEngine, DISABLED_AWindowWithoutAnyOpenGl) {
    OpenWindow shown(test::tessar());
    ASSERT_TRUE(shown.settle());
    EXPECT_FALSE(shown.window.flare_panel().view()->has_gl());
    const QImage flare = shown.window.flare_panel().grab_view();
    int lit = 0;
    for (int y = 0; y < flare.height(); y += 2) {
        for (int x = 0; x < flare.width(); x += 2) {
            lit += qGray(flare.pixel(x, y)) > 100 ? 1 : 0;
        }
    }
    EXPECT_GT(lit, 100) << "the CPU's picture in a plain widget";
    EXPECT_FALSE(shown.window.layout_panel().grab().isNull());
}

TEST(WindowEngine, AQtWithoutOpenGlShowsThePictureInAPlainWidget) {
    for (const auto& [name, value] : {std::pair{"QT_XCB_GL_INTEGRATION", "none"},
                                      std::pair{"MESA_GL_VERSION_OVERRIDE", "2.1"}}) {
        QProcess other;
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert(name, value);
        other.setProcessEnvironment(environment);
        other.setProcessChannelMode(QProcess::MergedChannels);
        other.start(QCoreApplication::applicationFilePath(),
                    {"--gtest_filter=*DISABLED_AWindowWithoutAnyOpenGl",
                     "--gtest_also_run_disabled_tests"});
        ASSERT_TRUE(other.waitForFinished(test::patience_ms));
        EXPECT_EQ(other.exitStatus(), QProcess::NormalExit) << name;
        EXPECT_EQ(other.exitCode(), 0) << name << "=" << value << "\n"
                                       << other.readAll().toStdString();
    }
}

}  // namespace
}  // namespace ghostlight
