#include "core/io/scene_json.h"

#include <gtest/gtest.h>

#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

Prescription zoom() { return bundled("canon_zoom_70_200_f2.8"); }

TEST(SceneJson, ReadsWhatItWrote) {
    const Prescription lens = zoom();
    Scene scene;
    scene.configuration = lens.configurations.at(0).name;
    scene.lights = {Light{.name = "sun",
                          .direction = {-7.25, 123.456},
                          .spectrum = Blackbody{3200.0},
                          .size = DiscSize{},
                          .intensity_ev = -2.5,
                          .on = false},
                    Light{.name = {},
                          .direction = {3.0, -20.0},
                          .spectrum = tabulated_light("lamp.csv", {{400, 0.5}, {500, 1}, {700, 0}}),
                          .size = PictureSize{"lamp.exr", 3.0},
                          .intensity_ev = 0.0,
                          .on = true}};
    scene.active_light = 1;
    scene.layers.of(LayerKind::veil) = {.on = true, .gain_ev = -1.5};
    scene.layers.alone = LayerKind::veil;
    scene.veil = {.folded_share = 0.1,
                  .kernel = VeilKernel::gaussian,
                  .spread = {.share = 0.02, .exponent = 3.0, .core_deg = 0.5}};
    scene.backdrop.file = "street.exr";
    scene.artistic.exaggeration_ev = 2.0;
    scene.artistic.jitter_mm = 0.25;
    scene.artistic.seed = 4294967295U;
    scene.artistic.ghosts = {GhostStyle{.path = {{4, 2}},
                                        .on = false,
                                        .gain_ev = 1.0,
                                        .tint = {1.0, 0.5, 0.0},
                                        .offset_x_mm = 1.0,
                                        .offset_y_mm = -2.0}};
    scene.tolerance = 0.003;
    scene.flare_tolerance = 0.07;
    EXPECT_EQ(scene_from_json(scene_to_json(scene), lens, default_scene(lens)), scene);
}

TEST(SceneJson, KeepsTheRestWhereItDoesNotUnderstand) {
    const Prescription lens = zoom();
    const Scene otherwise = default_scene(lens);
    for (const char* text :
         {"", "[]", "{\"field_deg\": 90}", "{\"field_deg\": \"ten\"}", "{\"tolerance\": 0}",
          "{\"spectrum\": \"candle\"}", "{\"configuration\": \"none such\"}", "{\"spectrum\": 5}"})
        EXPECT_EQ(scene_from_json(text, lens, otherwise), otherwise) << text;
}

TEST(SceneJson, ReadsFilesOfOneLight) {
    const Prescription lens = zoom();
    const Scene scene = scene_from_json(
        R"({"field_deg": 7.5, "azimuth_deg": 12, "spectrum": "A", "tolerance": 0.02})", lens,
        default_scene(lens));
    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(scene.light().direction, (LightDirection{7.5, 12.0}));
    EXPECT_EQ(scene.light().spectrum, Spectrum(StandardLight{Illuminant::a}));
    EXPECT_EQ(scene.tolerance, 0.02);
}

TEST(SceneJson, LeavesOutWhatIsOutOfRangeInsideItsParts) {
    const Prescription lens = zoom();
    const Scene scene = scene_from_json(
        R"({"lights": [{"field_deg": 95, "size": "moon", "intensity_ev": 1e9}, 7],
            "active_light": 9, "layers": {"veil": {"on": "yes", "gain_ev": 1e4}, "alone": "sky"},
            "veil": {"folded_share": 2, "kernel": "box", "exponent": 1},
            "artistic": {"seed": -1, "jitter_mm": -1,
                         "ghosts": [{"ghost": "0-1"}, {"ghost": "x"}, {"ghost": "5-3", "gain_ev": 1e9}]}})",
        lens, default_scene(lens));
    EXPECT_EQ(scene.lights.size(), 2U);
    EXPECT_EQ(scene.active_light, 0U);
    EXPECT_EQ(scene.lights[0], default_scene(lens).light());
    EXPECT_EQ(scene.layers, LayerSettings{});
    EXPECT_EQ(scene.veil, Veil{});
    ASSERT_EQ(scene.artistic.ghosts.size(), 1U);
    EXPECT_TRUE(scene.artistic.is_neutral());
}

}  // namespace
}  // namespace ghostlight
