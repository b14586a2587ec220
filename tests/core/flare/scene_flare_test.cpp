#include "core/flare/scene_flare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/flare/fold_ghosts.h"
#include "core/flare/planned_flare.h"
#include "core/ghosts/ghost_table.h"
#include "core/io/scene_pictures.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr int width_px = 200;

struct SceneFlare : testing::Test {
    SceneFlare() : lens(bundled("cooke_triplet_50_f5")) {
        scene.light().direction = {8.0, 70.0};
        request.width_px = width_px;
        request.tolerance = 0.01;
    }
    SceneView view() { return {lens, scene, spectra, pattern_of, draw}; }
    FlareImage ghosts() { return *ghosts_layer(view(), request); }

    Prescription lens;
    Scene scene;
    FlareRequest request;
    CompiledSpectra spectra;
    PatternOf pattern_of = pattern_of_size;
    DrawGhosts draw = [](const FlareScene& compiled, const FlareRequest& one,
                         std::stop_token stop) {
        return render_planned(compiled, one, std::move(stop));
    };
};

double largest(const std::vector<float>& values) {
    return static_cast<double>(*std::max_element(values.begin(), values.end()));
}

void expect_same(const std::vector<float>& a, const std::vector<float>& b, double tolerance) {
    ASSERT_EQ(a.size(), b.size());
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, std::abs(static_cast<double>(a[i] - b[i])));
    EXPECT_LE(most, tolerance * largest(b));
}

TEST_F(SceneFlare, OnePlainLightIsTheEnginesPicture) {
    FlareRequest one = request;
    one.light = scene.light().direction;
    one.spectrum = scene.light().spectrum;
    EXPECT_EQ(ghosts().rgb, render_planned(flare_scene(lens, StandardLight{}), one)->rgb);
}

TEST_F(SceneFlare, TwoLightsAdd) {
    const FlareImage first = ghosts();
    scene.light().direction = {5.0, 200.0};
    scene.light().intensity_ev = -1.0;
    const FlareImage second = ghosts();
    scene.lights = {Light{.name = {}, .direction = {8.0, 70.0}}, scene.light()};
    const FlareImage both = ghosts();
    FlareImage sum = first;
    add_image(sum, second, {1.0, 1.0, 1.0, 1.0});
    constexpr double rounding = 1e-6;
    expect_same(both.rgb, sum.rgb, rounding);
    expect_same(both.irradiance, sum.irradiance, rounding);
    EXPECT_NEAR(both.flux_mm2, sum.flux_mm2, 1e-9 * sum.flux_mm2);
}

TEST_F(SceneFlare, IntensityIsInStops) {
    const FlareImage once = ghosts();
    scene.light().intensity_ev = 3.0;
    FlareImage eight = ghosts();
    for (float& value : eight.rgb) value /= 8.0F;
    expect_same(eight.rgb, once.rgb, 1e-6);
    scene.light().on = false;
    EXPECT_EQ(largest(ghosts().rgb), 0.0);
}

TEST_F(SceneFlare, AWiderSpectrumIsTheIntegralOverItsWavelengths) {
    request.width_px = 160;
    scene.light().spectrum = StandardLight{Illuminant::e};
    const FlareImage white = ghosts();
    FlareImage sum = black_image(lens.sensor, request.width_px);
    // Another rule than the engine's own bands.
    const auto nodes = nested_samples(StandardLight{Illuminant::e}, 33);
    for (const SpectralSample& node : nodes) {
        scene.light().spectrum = Monochromatic{node.wavelength_nm};
        add_image(sum, ghosts(), {node.weight, node.weight, node.weight, node.weight});
    }
    double difference = 0.0, light = 0.0;
    for (std::size_t i = 0; i < white.irradiance.size(); ++i) {
        difference += std::abs(static_cast<double>(white.irradiance[i] - sum.irradiance[i]));
        light += static_cast<double>(sum.irradiance[i]);
    }
    // 33 sharp pictures leave edges that a continuum has not; both within 1 %.
    EXPECT_LT(difference / light, 0.04);
    EXPECT_NEAR(white.flux_on_sensor_mm2 / sum.flux_on_sensor_mm2, 1.0, 0.01);
}

TEST_F(SceneFlare, ANeutralGhostIsNeutralUnderItsOwnLightsBalance) {
    // Bare glass of one index reflects every colour alike.
    Prescription plain =
        lens_of({row(60, 6, 1.5, 12), row(-200, 20, 1.0, 12), row(0, 30, 1.0, 8)}, 2);
    plain.sensor = lens.sensor;
    lens = plain;
    for (const Illuminant illuminant : {Illuminant::d65, Illuminant::a, Illuminant::led_b3}) {
        scene.light().spectrum = StandardLight{illuminant};
        const FlareImage image = ghosts();
        ASSERT_GT(largest(image.irradiance), 0.0);
        double worst = 0.0;
        for (std::size_t i = 0; i < image.irradiance.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(static_cast<double>(image.rgb[3 * i + c] -
                                                                     image.irradiance[i])));
        EXPECT_LT(worst, 1e-4 * largest(image.irradiance));
    }
}

TEST_F(SceneFlare, FoldedGhostsKeepTheirLight) {
    request.width_px = 320;
    const FlareImage all = ghosts();
    scene.veil.folded_share = 0.3;
    scene.layers.of(LayerKind::veil).on = true;
    const FlareImage drawn = ghosts();
    const FlareImage veil = *veil_layer(view(), request);
    // What the ghosts' layer knows is what the veil would find for itself.
    EXPECT_EQ(veil_layer(view(), request, {}, &drawn)->irradiance, veil.irradiance);
    EXPECT_EQ(drawn.folded.size(), drawn.plan.count(GhostFate::folded));
    EXPECT_GT(drawn.plan.count(GhostFate::folded), 0U);
    // At most the share that was asked for, and so is what folding may change, twice over.
    EXPECT_GT(drawn.plan.folded_mm2, 0.0);
    EXPECT_LE(drawn.plan.folded_mm2, 0.3 * (drawn.plan.folded_mm2 + drawn.plan.flux_mm2));
    EXPECT_GT(veil.flux_on_sensor_mm2, 0.0);
    EXPECT_LT(drawn.flux_on_sensor_mm2, all.flux_on_sensor_mm2);
    // What kernels of the same moments bring to the sensor, and a probe's few per cent.
    EXPECT_NEAR((drawn.flux_on_sensor_mm2 + veil.flux_on_sensor_mm2) / all.flux_on_sensor_mm2, 1.0,
                0.05);
    // What is folded is looked at once and traced no further.
    EXPECT_LT(drawn.rays, all.rays);
    // Without the layer nothing is folded away.
    scene.layers.of(LayerKind::veil).on = false;
    EXPECT_EQ(ghosts().irradiance, all.irradiance);
}

TEST_F(SceneFlare, OtherEnginesTakeSizesAndArtisticChangesToo) {
    scene.light().spectrum = Monochromatic{};
    scene.light().size = DiscSize{1.0};
    scene.artistic.exaggeration_ev = 1.0;
    request.width_px = 96;
    const FlareImage planned = ghosts();
    request.method = FlareMethod::uniform;
    const FlareImage uniform = ghosts();
    // Twenty-five patches for a disc, and grids of another kind.
    EXPECT_NEAR(uniform.flux_on_sensor_mm2 / planned.flux_on_sensor_mm2, 1.0, 0.03);
    scene.artistic.exaggeration_ev = 0.0;
    EXPECT_NEAR(ghosts().flux_on_sensor_mm2 / uniform.flux_on_sensor_mm2, 0.5, 0.01);
}

TEST(OtherLights, AreThoseThatAreOnButForTheChosenOne) {
    Scene scene;
    scene.lights.resize(4);
    for (std::size_t k = 0; k < 4; ++k)
        scene.lights[k].direction.field_deg = static_cast<double>(k + 1);
    scene.lights[2].on = false;
    scene.active_light = 1;
    EXPECT_EQ(other_lights(scene),
              (std::vector<LightDirection>{scene.lights[0].direction, scene.lights[3].direction}));
}

TEST(Foldable, TakesTheFaintAndBroadUpToItsShare) {
    const auto spot = [](double flux, double sigma) {
        GhostSpot m;
        m.flux_mm2 = {flux, flux, flux, flux};
        m.xx_mm2 = m.yy_mm2 = sigma * sigma;
        return m;
    };
    const std::vector ghosts = {spot(1.0, 5.0), spot(0.05, 5.0), spot(0.05, 0.1), spot(0.2, 6.0),
                                spot(0.0, 4.0)};
    EXPECT_EQ(foldable(ghosts, 0.0, 36, 24), (std::vector<std::size_t>{}));
    EXPECT_EQ(foldable(ghosts, 0.1, 36, 24), (std::vector<std::size_t>{1}));
    EXPECT_EQ(foldable(ghosts, 0.2, 36, 24), (std::vector<std::size_t>{1, 3}));
}

TEST_F(SceneFlare, ScatteredLightIsItsShareOfTheDirectLight) {
    scene.light().direction = {0.0, 90.0};
    scene.light().spectrum = Monochromatic{};
    scene.layers.of(LayerKind::veil).on = true;
    scene.veil.spread = {.share = 0.02, .exponent = 6.0, .core_deg = 0.5};
    const FlareImage veil = *veil_layer(view(), request);
    // Steep enough to be all on the sensor; the direct flux by the ghost table's quadrature.
    const GhostTable table = *ghost_table(lens, {.light = scene.light().direction, .peaks = false});
    EXPECT_NEAR(veil.flux_on_sensor_mm2 / (0.02 * table.direct.flux_mm2), 1.0, 0.02);
}

TEST(Layers, ComposeIsTheWeightedSum) {
    const Sensor sensor;
    FlareImage a = black_image(sensor, 16), b = a;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        a.rgb[i] = static_cast<float>(i);
        b.rgb[i] = 100.0F;
    }
    LayerSettings settings;
    settings.of(LayerKind::veil) = {.on = true, .gain_ev = 1.0};
    const std::vector<LayerImage> layers = {{LayerKind::ghosts, &a}, {LayerKind::veil, &b}};
    EXPECT_EQ(compose(layers, settings).rgb[5], 205.0F);
    settings.of(LayerKind::veil).on = false;
    EXPECT_EQ(compose(layers, settings).rgb[5], 5.0F);
    settings.alone = LayerKind::veil;
    EXPECT_EQ(compose(layers, settings).rgb[5], 200.0F);
    settings.alone = LayerKind::backdrop;
    EXPECT_TRUE(compose(layers, settings).rgb.empty());
}

TEST(Artistic, IsNeutralByDefault) {
    EXPECT_TRUE(Artistic{}.is_neutral());
    const GhostLook look = look_of({}, {{4, 2}});
    EXPECT_TRUE(look.on);
    EXPECT_EQ(look.gain, (std::array{1.0, 1.0, 1.0, 1.0}));
    EXPECT_EQ(look.offset_x_mm, 0.0);
    Artistic jittered;
    jittered.jitter_mm = 1.0;
    EXPECT_FALSE(jittered.is_neutral());
    // The same seed, the same place; over many ghosts of the size asked for.
    double square = 0.0;
    constexpr int count = 2000;
    for (std::size_t k = 1; k <= count; ++k) {
        const GhostLook at = look_of(jittered, {{k, 0}});
        EXPECT_EQ(at.offset_x_mm, look_of(jittered, {{k, 0}}).offset_x_mm);
        square += at.offset_x_mm * at.offset_x_mm + at.offset_y_mm * at.offset_y_mm;
    }
    EXPECT_NEAR(square / (2 * count), 1.0, 4.0 / std::sqrt(2.0 * count));  // 4 standard errors
}

}  // namespace
}  // namespace ghostlight
