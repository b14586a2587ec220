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
    scene.light = {-7.25, 123.456};
    scene.spectrum = Blackbody{3200.0};
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

}  // namespace
}  // namespace ghostlight
