// Weights of a fit's ghosts: against single traced rays, and their slopes against differences.

#include "core/fit/ghost_weights.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/fit/photo_model.h"
#include "core/flare/flare_image.h"
#include "core/optics/trace.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr int across = 24;

struct Kit {
    FitScene scene;
    PixelFrame frame;
    std::vector<GhostBasis> bases;
    std::vector<const GhostBasis*> all;
};

void fill(Kit& kit, const Prescription& lens, const Spectrum& spectrum, double field_deg,
          std::size_t most) {
    kit.scene = fit_scene({lens, {}}, spectrum, 5);
    kit.frame = pixel_frame(lens.sensor.width_mm, lens.sensor.height_mm, across);
    // Ghosts spread over the list.
    std::vector<GhostPath> some;
    const std::size_t step = std::max<std::size_t>(1, kit.scene.ghosts.size() / most);
    for (std::size_t g = 0; g < kit.scene.ghosts.size(); g += step)
        some.push_back(kit.scene.ghosts[g]);
    kit.scene.ghosts = some;
    kit.bases = ghost_bases(kit.scene, {field_deg, 90.0}, kit.frame, {}, true, 0, {});
    for (const GhostBasis& basis : kit.bases) kit.all.push_back(&basis);
}

std::vector<double> light_of(const GhostBasis& basis, const GhostWeights& weights,
                             std::size_t parameters, std::vector<double>* slopes) {
    std::vector<double> values, by;
    weights.coefficients(basis, values, slopes != nullptr ? &by : nullptr);
    std::vector<double> light(3, 0.0);
    if (slopes != nullptr) slopes->assign(3 * parameters, 0.0);
    for (std::size_t k = 0; k < basis.values.size(); ++k) {
        const std::size_t r = k % basis.width();
        for (std::size_t c = 0; c < 3; ++c) {
            light[c] += static_cast<double>(basis.values[k]) * values[3 * r + c];
            for (std::size_t p = 0; p < parameters && slopes != nullptr; ++p)
                (*slopes)[c * parameters + p] +=
                    static_cast<double>(basis.values[k]) * by[(3 * r + c) * parameters + p];
        }
    }
    return light;
}

TEST(GhostWeights, SlopesAreThoseOfDifferencesOnEveryLens) {
    for (const BundledLens& each : bundled_lenses()) {
        const Prescription lens = read_lens(each.file).lens;
        Kit kit;
        fill(kit, lens, StandardLight{}, 3.0, 3);
        if (kit.bases.empty()) continue;
        auto parameters = parse_vary("center@all", lens);
        parameters.resize(std::min<std::size_t>(parameters.size(), 3));
        const auto first = parameters.front().rows.front();
        for (const char* kind : {"thickness", "layer-index.1"})
            for (const FitParameter& p :
                 parse_vary(std::string(kind) + "@" + std::to_string(first + 1), lens))
                parameters.push_back(p);
        GhostWeights weights(kit.scene, kit.all, parameters, 0);
        std::vector<double> at;
        for (std::size_t p = 0; p < parameters.size(); ++p)
            at.push_back(parameters[p].start +
                         (parameters[p].kind == FitKind::center ? 13.0 : 0.01));
        weights.update(at, true);
        std::vector<std::vector<double>> slopes(kit.bases.size());
        std::vector<std::vector<double>> light;
        for (std::size_t g = 0; g < kit.bases.size(); ++g)
            light.push_back(light_of(kit.bases[g], weights, parameters.size(), &slopes[g]));
        for (std::size_t p = 0; p < parameters.size(); ++p) {
            const double step = 1e-3 * parameters[p].prior;
            auto moved = at;
            moved[p] += step;
            weights.update(moved, false);
            std::vector<std::vector<double>> more, less;
            for (const GhostBasis& basis : kit.bases)
                more.push_back(light_of(basis, weights, 0, nullptr));
            moved[p] -= 2.0 * step;
            weights.update(moved, false);
            for (const GhostBasis& basis : kit.bases)
                less.push_back(light_of(basis, weights, 0, nullptr));
            for (std::size_t g = 0; g < kit.bases.size(); ++g)
                for (std::size_t c = 0; c < 3; ++c) {
                    const double difference = (more[g][c] - less[g][c]) / (2.0 * step);
                    // The prior's breadth is what matters: 1e-5 of the light over it.
                    EXPECT_NEAR(slopes[g][c * parameters.size() + p] * parameters[p].prior,
                                difference * parameters[p].prior,
                                1e-5 * std::abs(light[g][c]) +
                                    1e-4 * std::abs(difference) * parameters[p].prior)
                        << each.name << ", " << name(parameters[p]) << ", ghost " << g;
                }
        }
    }
}

TEST(GhostWeights, SlopesAreNumbersBeyondTheCriticalAngle) {
    // Tables reach over all rays that meet a surface, here from glass beyond its critical angle,
    // where nothing passes.
    const Prescription lens = bundled("nikkor_z_58_f0.95_noct");
    Kit kit;
    fill(kit, lens, StandardLight{}, 5.0, 1000);
    const auto parameters = parse_vary("center@all", lens);
    GhostWeights weights(kit.scene, kit.all, parameters, 0);
    std::vector<double> at;
    for (const FitParameter& p : parameters) at.push_back(p.start);
    weights.update(at, true);
    std::size_t wrong = 0;
    for (const GhostBasis& basis : kit.bases) {
        std::vector<double> values, by;
        weights.coefficients(basis, values, &by);
        for (const double each : by) wrong += std::isfinite(each) ? 0 : 1;
    }
    EXPECT_EQ(wrong, 0U);
}

TEST(GhostWeights, PictureIsTheReferencesOne) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    const LightDirection light{5.0, 70.0};
    FitScene scene = fit_scene({lens, {}}, Monochromatic{550.0}, 1);
    const GhostPath path{{4, 2}};
    scene.ghosts = {path};
    FlareRequest request;
    request.light = light;
    request.spectrum = Monochromatic{550.0};
    request.method = FlareMethod::reference;
    request.width_px = 240;
    request.only = {path};
    const FlareImage image = *render_flare(lens, request);
    Photo photo;
    photo.width_px = image.width_px;
    photo.height_px = image.height_px;
    photo.rgb = image.rgb;
    photo.masked.assign(photo.pixels(), 0);
    photo.noise.read = 1e-12;
    const FitData data = fit_data(photo,
                                  {.sensor_width_mm = lens.sensor.width_mm,
                                   .axis_column = 0.5 * photo.width_px,
                                   .axis_row = 0.5 * photo.height_px,
                                   .rotation_rad = 0.0},
                                  lens.sensor.width_mm, lens.sensor.height_mm, 48);
    const auto bases = ghost_bases(scene, light, data.frame, {}, false, 0, {});
    ASSERT_EQ(bases.size(), 1U);
    const GhostWeights weights(scene, {&bases.front()}, {}, 0);
    const ModelPicture model = one_ghost(bases.front(), weights, data.frame);
    double off = 0.0, sum = 0.0;
    for (std::size_t s = 0; s < data.samples(); ++s) {
        if (!data.used[s]) continue;
        off += std::abs(*model.at(s, 1) - data.value[3 * s + 1]);
        sum += data.value[3 * s + 1];
    }
    ASSERT_GT(sum, 0.0);
    // The fit's stated model error is 0.3 % a sample.
    EXPECT_LT(off / sum, 5e-3);
}

}  // namespace
}  // namespace ghostlight
