// Slopes of a fit's pictures by the lens's geometry and the light, against differences of pictures.

#include "core/fit/picture_slopes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/fit/photo_model.h"
#include "core/io/lens_file.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr int across = 32;
const LightDirection light{4.0, 80.0};

struct Kit {
    FitScene scene;
    PixelFrame frame;
    std::vector<GhostBasis> bases;
};

Kit kit_of(const Prescription& lens, std::size_t most) {
    Kit kit{.scene = fit_scene({lens, {}}, Monochromatic{550.0}, 1),
            .frame = pixel_frame(lens.sensor.width_mm, lens.sensor.height_mm, across),
            .bases = {}};
    const auto all = ghost_bases(kit.scene, light, kit.frame, {}, true, 0, {});
    const std::size_t step = std::max<std::size_t>(1, all.size() / most);
    for (std::size_t g = 0; g < all.size() && kit.bases.size() < most; g += step) {
        // Where a cell takes one point more the picture jumps by what points leave: little, so
        // close together, beside what a small move changes.
        GhostGrid grid = all[g].grid;
        grid.point_spacing = 0.15;
        kit.bases.push_back(ghost_basis(kit.scene, all[g].ghost, light, kit.frame, {}, grid));
    }
    return kit;
}

std::vector<double> picture_of(const FitScene& scene, const std::vector<GhostBasis>& bases,
                               const PixelFrame& frame) {
    std::vector<const GhostBasis*> all;
    for (const GhostBasis& basis : bases) all.push_back(&basis);
    const GhostWeights weights(scene, all, {}, 0);
    return ghost_picture(bases, weights, frame, 0, false, 0).values;
}

/// The same rays of another lens or light.
std::vector<double> moved_picture(const Kit& kit, const FittedLens& lens,
                                  const LightDirection& from) {
    FitScene scene = fit_scene(lens, Monochromatic{550.0}, 1);
    scene.ghosts = kit.scene.ghosts;
    std::vector<GhostBasis> bases;
    for (const GhostBasis& each : kit.bases)
        bases.push_back(ghost_basis(scene, each.ghost, from, kit.frame, {}, each.grid));
    std::erase_if(bases, [](const GhostBasis& basis) { return basis.empty(); });
    return picture_of(scene, bases, kit.frame);
}

double root_of_squares(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double each : values) sum += each * each;
    return std::sqrt(sum);
}

std::vector<double> column(const ModelPicture& picture, std::size_t which) {
    std::vector<double> values;
    for (std::size_t k = which; k < picture.values.size(); k += picture.columns)
        values.push_back(picture.values[k]);
    return values;
}

TEST(PictureSlopes, AreThoseOfDifferencesOnEveryLens) {
    for (const BundledLens& each : bundled_lenses()) {
        Prescription lens = read_lens(each.file).lens;
        // Closed, with blades: as wide as its rim, a stop hardly cuts a ghost.
        lens = stopped_down(lens, 0.6 * lens.surfaces[lens.stop.surface].semi_diameter_mm);
        if (lens.stop.blades < 3) lens.stop.blades = 6;
        const Kit kit = kit_of(lens, 3);
        if (kit.bases.empty()) continue;
        const auto now = picture_of(kit.scene, kit.bases, kit.frame);
        std::vector<const GhostBasis*> all;
        for (const GhostBasis& basis : kit.bases) all.push_back(&basis);
        const GhostWeights weights(kit.scene, all, {}, 0);
        std::vector<FitParameter> parameters;
        for (const char* kind : {"radius@all", "gap@1", "index@all", "semi-diameter@1", "stop-size",
                                 "stop-x", "stop-y", "stop-rotation"})
            parameters.push_back(parse_vary(kind, lens).front());
        LensMoves moves{.film_now = compiled_films(kit.scene, lens), .moves = {}};
        auto lens_at = [&](const FitParameter& p, double by) {
            FittedLens moved{lens, {}};
            set(moved, p, p.start + by * p.prior);
            return moved;
        };
        for (const FitParameter& p : parameters)
            moves.moves.push_back(
                lens_move(kit.scene, lens_at(p, -1e-3), lens_at(p, 1e-3), light, 2e-3));
        // The field in units of what a fit's prior gives it, degrees.
        constexpr double field_unit_deg = 0.03;
        auto turned = [&](double by) {
            return LightDirection{light.field_deg + by * field_unit_deg, light.azimuth_deg};
        };
        moves.moves.push_back(light_move(kit.scene, turned(-1e-3), turned(1e-3), 2e-3));
        const ModelPicture slopes =
            picture_slopes(kit.scene, kit.bases, weights, light, kit.frame, {}, moves, 0, {});
        for (std::size_t k = 0; k < moves.moves.size(); ++k) {
            const bool of_lens = k < parameters.size();
            // Rays in single precision leave 3e-5 of the picture: over less of a prior's breadth
            // that would be all that is seen.
            constexpr double step = 0.3;
            auto at = [&](double by) {
                return of_lens ? moved_picture(kit, lens_at(parameters[k], by), light)
                               : moved_picture(kit, {lens, {}}, turned(by));
            };
            const auto more = at(step), less = at(-step);
            auto slope = column(slopes, place_slopes + k);
            std::vector<double> difference(slope.size());
            for (std::size_t s = 0; s < slope.size(); ++s) {
                difference[s] = (more[s] - less[s]) / (2.0 * step);
                slope[s] -= difference[s];
            }
            // A twentieth of the slope, for what bends over the step (blades' corners most), and
            // that rounding.
            EXPECT_LT(root_of_squares(slope),
                      0.05 * root_of_squares(difference) + 1e-4 * root_of_squares(now))
                << each.file << ", " << (of_lens ? name(parameters[k]) : "field");
        }
    }
}

TEST(PictureSlopes, StopSizeAddsTheLightOfItsRim) {
    // A round stop's picture gains light as its area does: dF/F = 2 da/a where nothing else clips
    // and films hardly change over the pupil; f/11 keeps all else out of the way.
    Prescription lens = bundled("tessar_brendel_100_f2.8");
    lens.stop.f_number = 11.0;
    lens.stop.blades = 0;
    FitScene scene = fit_scene({lens, {}}, Monochromatic{550.0}, 1);
    scene.ghosts = {parse_ghost("5-2", scene.system())};
    const LightDirection on_axis{0.5, 90.0};
    // So large a sensor that nothing is lost beside it.
    const PixelFrame frame = pixel_frame(400.0, 400.0, 64);
    const auto bases = ghost_bases(scene, on_axis, frame, {}, true, 0, {});
    ASSERT_EQ(bases.size(), 1U);
    const GhostWeights weights(scene, {&bases.front()}, {}, 0);
    const FitParameter size = parse_vary("stop-size", lens).front();
    auto lens_at = [&](double value) {
        FittedLens moved{lens, {}};
        set(moved, size, value);
        return moved;
    };
    LensMoves moves{.film_now = compiled_films(scene, lens), .moves = {}};
    moves.moves.push_back(lens_move(scene, lens_at(0.9999), lens_at(1.0001), on_axis, 2e-4));
    const ModelPicture slopes =
        picture_slopes(scene, bases, weights, on_axis, frame, {}, moves, 0, {});
    const ModelPicture now = one_ghost(bases.front(), weights, frame);
    double light_now = 0.0, gained = 0.0;
    for (const double each : now.values) light_now += each;
    for (const double each : column(slopes, place_slopes)) gained += each;
    // 2 %: what films and the pupil's aberrations change across the rim.
    EXPECT_NEAR(gained / light_now, 2.0, 0.04);
}

}  // namespace
}  // namespace ghostlight
