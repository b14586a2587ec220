// The search for minima: thinned photographs are the same photograph, and a lens whose coatings
// are exchanged is brought back to the truth.

#include "core/fit/coating_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr int across = 32;

/// A photograph that is the model's own picture, so that the truth's cost is 0 but for priors.
struct Kit {
    FitLayout layout;
    std::vector<FitView> views;
    FitScene scene;
    std::unique_ptr<GhostWeights> weights;
};

void make(Kit& kit, const Prescription& lens, const std::string& vary) {
    kit.layout.coatings = parse_vary(vary, lens);
    kit.layout.photos = 1;
    kit.layout.shading = false;
    kit.layout.place = false;
    kit.scene = fit_scene({lens, {}}, StandardLight{}, 7);
    FitView& view = kit.views.emplace_back();
    view.light = {5.0, 90.0};
    view.data.frame = pixel_frame(lens.sensor.width_mm, lens.sensor.height_mm, across);
    view.bases = ghost_bases(kit.scene, view.light, view.data.frame, {}, true, 0, {});
    std::vector<const GhostBasis*> all;
    for (const GhostBasis& basis : view.bases) all.push_back(&basis);
    kit.weights = std::make_unique<GhostWeights>(kit.scene, all, kit.layout.coatings, 0);
    view.data.value = ghost_picture(view.bases, *kit.weights, view.data.frame, 0, false, 0).values;
    const std::size_t samples = view.data.value.size() / 3;
    double level = 0.0;
    for (double& each : view.data.value) level = std::max(level, each);
    view.data.used.assign(samples, 1);
    view.data.count = samples;
    view.data.inverse_count.assign(samples, 1.0);
    // 1 % of the brightest, everywhere.
    view.data.noise = {.shot = 0.0, .read = std::pow(0.01 * level, 2), .estimated = false};
    for (std::size_t s = 0; s < samples; ++s) {
        view.scales.push_back(stable_scale(view.data, s, 0.001, 0.0));
        for (std::size_t c = 0; c < 3; ++c)
            view.stable.push_back(view.scales[s].at(view.data.value[3 * s + c]));
    }
}

TEST(CoatingSearch, ThinnedPhotographsAreEverySecondSample) {
    Kit kit;
    make(kit, bundled("tessar_brendel_100_f2.8"), "center@1");
    const FitView& full = kit.views.front();
    const FitView thin = thinned(full, 2);
    const PixelFrame& frame = full.data.frame;
    ASSERT_EQ(thin.data.frame.width_px, (frame.width_px + 1) / 2);
    ASSERT_EQ(thin.data.frame.height_px, (frame.height_px + 1) / 2);
    const auto picture =
        ghost_picture(thin.bases, *kit.weights, thin.data.frame, 0, false, 0).values;
    double largest = 0.0;
    for (const double each : full.data.value) largest = std::max(largest, each);
    std::size_t t = 0;
    for (int row = 0; row < frame.height_px; row += 2)
        for (int column = 0; column < frame.width_px; column += 2)
            for (std::size_t c = 0; c < 3; ++c, ++t) {
                const auto s = static_cast<std::size_t>(row * frame.width_px + column);
                EXPECT_EQ(thin.data.value[t], full.data.value[3 * s + c]);
                // Bases are in single precision, summed in another order of blocks.
                EXPECT_NEAR(picture[t], full.data.value[3 * s + c], 1e-5 * largest);
            }
    EXPECT_EQ(t, picture.size());
}

TEST(CoatingSearch, ExchangedCoatingsAreFoundTheirPlaces) {
    Prescription lens = bundled("tessar_brendel_100_f2.8");
    std::get<QuarterWave>(lens.surfaces[5].coating).center_nm = 610.0;
    std::get<QuarterWave>(lens.surfaces[6].coating).center_nm = 490.0;
    Kit kit;
    make(kit, lens, "center@6,center@7");
    CoatingSearch search(kit.layout, kit.views, *kit.weights, FitLoss::none, 1.0, 0);
    std::vector<double> x(kit.layout.count(), 0.0);
    x[0] = (490.0 - 610.0) / kit.layout.coatings[0].prior;
    x[1] = -x[0];
    const FitMinimum from{.x = x, .log_gains = {0.0}, .cost = 0.0};
    const auto found = search.explore(from, 1e9, {}, [](const FitMinimum&) {});
    ASSERT_FALSE(found.empty());
    // The prior's middle is the truth, so that nothing pulls away from it: within a nanometre.
    for (std::size_t p = 0; p < 2; ++p)
        EXPECT_NEAR(found.front().x[p] * kit.layout.coatings[p].prior, 0.0, 1.0);
    // In order of their costs, no two alike, and the same on one thread.
    for (std::size_t k = 1; k < found.size(); ++k) {
        EXPECT_GE(found[k].cost, found.front().cost);
        EXPECT_FALSE(search.alike(found[k].x, found.front().x));
    }
    CoatingSearch alone(kit.layout, kit.views, *kit.weights, FitLoss::none, 1.0, 1);
    EXPECT_EQ(alone.explore(from, 1e9, {}, [](const FitMinimum&) {}).front().x, found.front().x);
}

}  // namespace
}  // namespace ghostlight
