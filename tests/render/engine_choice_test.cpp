#include "render/gl_flare/engine_choice.h"

#include <gtest/gtest.h>

#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

TEST(EngineChoice, TakesTheClearlyFasterOne) {
    EXPECT_EQ(choose_engine(FlareEngine::automatic, {20.0, 5.0, {}}).engine, FlareEngine::gl);
    EXPECT_EQ(choose_engine(FlareEngine::automatic, {20.0, 200.0, {}}).engine, FlareEngine::cpu);
    EXPECT_EQ(choose_engine(FlareEngine::automatic, {20.0, 19.0, {}}).engine, FlareEngine::cpu)
        << "next to no gain";
    const std::string reason = choose_engine(FlareEngine::automatic, {20.0, 5.0, {}}).reason;
    EXPECT_NE(reason.find("20 ms"), std::string::npos) << reason;
    EXPECT_NE(reason.find("5 ms"), std::string::npos) << reason;
}

TEST(EngineChoice, DoesAsAsked) {
    EXPECT_EQ(choose_engine(FlareEngine::cpu, {20.0, 5.0, {}}).engine, FlareEngine::cpu);
    EXPECT_EQ(choose_engine(FlareEngine::gl, {20.0, 200.0, {}}).engine, FlareEngine::gl);
}

TEST(EngineChoice, FallsBackToTheCpuAndSaysWhy) {
    for (const FlareEngine wish : {FlareEngine::automatic, FlareEngine::gl}) {
        const FlareEngineChoice choice =
            choose_engine(wish, {20.0, {}, "OpenGL is too old to draw flares"});
        EXPECT_EQ(choice.engine, FlareEngine::cpu);
        EXPECT_NE(choice.reason.find("too old"), std::string::npos) << choice.reason;
    }
}

TEST(EngineChoice, TimesBothOnTheScene) {
    FlareRequest request;
    request.light.field_deg = 9.0;
    const FlareScene scene = flare_scene(bundled("heliar_tronnier_100"), request.spectrum);
    const GlEngine gl = offscreen_gl_engine();
    const EngineTimes times = time_engines(scene, request, gl.draw).value();
    ASSERT_TRUE(times.cpu_ms && times.gl_ms);
    EXPECT_GT(*times.cpu_ms, 0.0);
    EXPECT_GT(*times.gl_ms, 0.0);

    const EngineTimes without = time_engines(scene, request, {}, "no OpenGL here").value();
    EXPECT_TRUE(without.cpu_ms.has_value());
    EXPECT_FALSE(without.gl_ms.has_value());
    EXPECT_EQ(without.gl_refusal, "no OpenGL here");
}

TEST(EngineChoice, AnEngineThatFailsInItsTrialIsNotTaken) {
    FlareScene scene = flare_scene(bundled("heliar_tronnier_100"), Monochromatic{});
    scene.ghosts = {{{5, 3, 4, 2}}};  // more reflections than it can follow
    FlareRequest request;
    request.light.field_deg = 1.0;
    const GlEngine gl = offscreen_gl_engine();
    const EngineTimes times = time_engines(scene, request, gl.draw).value();
    EXPECT_FALSE(times.gl_ms.has_value());
    EXPECT_NE(times.gl_refusal.find("reflections"), std::string::npos) << times.gl_refusal;
    EXPECT_EQ(choose_engine(FlareEngine::automatic, times).engine, FlareEngine::cpu);
}

}  // namespace
}  // namespace ghostlight
