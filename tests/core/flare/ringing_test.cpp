#include "core/flare/ringing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/flare/extended_flare.h"
#include "core/flare/fresnel.h"
#include "core/flare/planned_flare.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

FlareRequest request_of(double field_deg, int width_px) {
    FlareRequest request;
    request.light = {field_deg, 90.0};
    request.width_px = width_px;
    request.tolerance = 0.01;
    return request;
}

double sum_of(const FlareImage& image) {
    double sum = 0.0;
    for (const float value : image.irradiance) sum += static_cast<double>(value);
    return sum;
}

/// One ghost that lies within the frame, rung and not.
struct Pair {
    FlareImage plain, rung;
};
Pair pair_of(const Prescription& lens, const GhostPath& ghost, FlareRequest request) {
    const FlareScene scene = flare_scene(lens, request.spectrum);
    request.only = {ghost};
    Pair pair{*render_planned(scene, request), {}};
    request.ringing = true;
    pair.rung = *render_planned(scene, request);
    return pair;
}

/// A ghost of the Tessar stopped down whose image lies well within the frame.
Prescription small_stop_tessar(int blades) {
    Prescription lens = bundled("tessar_brendel_100_f2.8");
    lens.stop.f_number = 16.0;
    lens.stop.blades = blades;
    return lens;
}

/// Ghosts on axis that lie within the frame and show fringes.
std::vector<GhostPath> rung_ghosts(const Prescription& lens, const FlareRequest& request) {
    const FlareScene scene = flare_scene(lens, request.spectrum);
    const OpticalSystem& system = scene.system();
    const double pitch = system.sensor_width_mm / request.width_px;
    const auto shows = shows_fringes(system, scene.ghosts, pitch);
    std::vector<GhostPath> chosen;
    for (std::size_t g = 0; g < scene.ghosts.size(); ++g) {
        const ParaxialGhost ghost = paraxial_ghost(system, scene.ghosts[g]);
        // Cut by the stop alone, seen as a whole, and not by a few pixels.
        const bool by_stop = ghost.entrance_semi_diameter_mm * std::abs(ghost.to_stop.a) >
                             0.999 * system.stop_mask.semi_diameter_mm;
        const double px = ghost.diameter_mm / pitch;
        if (shows[g] && by_stop && ghost.stop_crossings == 1 && px > 20.0 &&
            ghost.diameter_mm < 0.9 * system.sensor_height_mm)
            chosen.push_back(scene.ghosts[g]);
    }
    return chosen;
}

TEST(Ringing, FluxIsUnchanged) {
    for (const int blades : {0, 6}) {
        const Prescription lens = small_stop_tessar(blades);
        const FlareRequest request = request_of(0.0, 1200);
        const auto ghosts = rung_ghosts(lens, request);
        ASSERT_GE(ghosts.size(), 2U);
        for (std::size_t g = 0; g < std::min<std::size_t>(ghosts.size(), 4); ++g) {
            const Pair pair = pair_of(lens, ghosts[g], request);
            ASSERT_EQ(pair.rung.ringing.size(), 1U);
            // The rim's own coverage by pixels, and weights that are not quite even: 0.5 %.
            EXPECT_NEAR(sum_of(pair.rung) / sum_of(pair.plain), 1.0, 6e-3)
                << name(ghosts[g]) << " N " << pair.rung.ringing[0].fresnel_number;
            EXPECT_NE(pair.rung.irradiance, pair.plain.irradiance);
        }
    }
}

TEST(Ringing, FirstFringeIsCornusWhereItBelongs) {
    // From the middle of a round ghost outwards: the brightest place before the rim, and 1/4 there.
    const Prescription lens = small_stop_tessar(0);
    FlareRequest request = request_of(0.0, 2400);
    int looked_at = 0;
    for (const GhostPath& path : rung_ghosts(lens, request)) {
        const FlareScene scene = flare_scene(lens, request.spectrum);
        const ParaxialGhost ghost = paraxial_ghost(scene.system(), path);
        const GhostFringes fringes =
            ghost_fringes(scene.system(), ghost, scene.system().sensor_width_mm / 2400);
        if (fringes.fresnel_number < 40.0 || fringes.first_fringe_px < 4.0) continue;
        const Pair pair = pair_of(lens, path, request);
        const int row = pair.rung.height_px / 2;
        auto at = [&](const FlareImage& image, double radius) {
            const auto i = static_cast<std::size_t>(row * image.width_px + image.width_px / 2 +
                                                    static_cast<int>(radius));
            return static_cast<double>(image.irradiance[i]);
        };
        // The rim: where the plain picture has half of what is inside.
        double rim = 0.0;
        for (double r = 10.0; r < 1100.0; r += 1.0)
            if (at(pair.plain, r) > 0.5 * at(pair.plain, std::max(0.0, r - 6.0))) rim = r;
        if (rim < 5.0 * fringes.first_fringe_px) continue;
        double brightest = 0.0, where = 0.0;
        for (double r = rim - 2.5 * fringes.first_fringe_px; r < rim; r += 1.0) {
            const double ratio = at(pair.rung, r) / at(pair.plain, r);
            if (ratio > brightest) {
                brightest = ratio;
                where = r;
            }
        }
        ++looked_at;
        // Pixels of a sixth of a fringe; the map's stretch at the rim is not the paraxial one.
        EXPECT_NEAR(brightest, 1.37, 0.05) << name(path);
        EXPECT_NEAR((rim + 0.5 - where) / fringes.first_fringe_px, 1.0, 0.3) << name(path);
        // Outside there is light where there was none.
        EXPECT_GT(at(pair.rung, rim + 0.3 * fringes.first_fringe_px + 1.0), 0.0);
    }
    EXPECT_GE(looked_at, 1);
}

double l1(const FlareImage& a, const FlareImage& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.irradiance.size(); ++k)
        sum +=
            std::abs(static_cast<double>(a.irradiance[k]) - static_cast<double>(b.irradiance[k]));
    return sum;
}

TEST(Ringing, ARimIsTheSameWhateverCutsIt) {
    // The stop wide open, and where it is a clear radius as small as it was: the same opening.
    const Prescription by_stop = small_stop_tessar(0);
    Prescription by_surface = by_stop;
    const std::size_t row = by_stop.stop.surface;
    Surface opening;
    opening.medium_after = by_stop.surfaces[row - 1].medium_after;
    opening.semi_diameter_mm = compile(by_stop, d_line_nm).stop_mask.semi_diameter_mm;
    by_surface.surfaces.insert(by_surface.surfaces.begin() + static_cast<std::ptrdiff_t>(row),
                               opening);
    by_surface.stop.surface = row + 1;
    by_surface.stop.f_number.reset();
    // Just off the axis, where the pictures without fringes are drawn by grids, too.
    const FlareRequest request = request_of(0.01, 900);
    int compared = 0;
    for (const GhostPath& path : rung_ghosts(by_stop, request)) {
        GhostPath same = path;
        for (std::size_t& surface : same.reflections) surface += surface >= row ? 1 : 0;
        const Pair a = pair_of(by_stop, path, request), b = pair_of(by_surface, same, request);
        if (a.rung.ringing.size() != 1 || a.rung.ringing[0].propagated) continue;
        ASSERT_EQ(b.rung.ringing.size(), 1U) << name(path);
        EXPECT_NEAR(b.rung.ringing[0].fresnel_number / a.rung.ringing[0].fresnel_number, 1.0, 1e-6);
        // Grids of another box for each: what the pictures without fringes differ by, and a tenth
        // of what the fringes change.
        EXPECT_LT(l1(a.rung, b.rung), l1(a.plain, b.plain) + 0.1 * l1(a.rung, a.plain))
            << name(path);
        ++compared;
    }
    EXPECT_GE(compared, 2);
}

TEST(Ringing, OfADiscIsTheMeanOfItsPoints) {
    const Prescription lens = small_stop_tessar(6);
    FlareRequest request = request_of(1.0, 500);
    request.ringing = true;
    const FlareScene scene = flare_scene(lens, request.spectrum);
    const LightPattern disc = disc_pattern(0.1);
    const auto ghosts = rung_ghosts(lens, request);
    ASSERT_FALSE(ghosts.empty());
    request.only = {ghosts.front()};
    const FlareImage rung = *render_extended(scene, request, disc, {});
    ASSERT_EQ(rung.ringing.size(), 1U);
    const FlareImage mean = *render_sampled(lens, request, disc, 5);
    request.ringing = false;
    const FlareImage plain = *render_extended(scene, request, disc, {});
    // Twenty-five points for a disc: still, what is left is a part of what the fringes change.
    EXPECT_LT(l1(rung, mean), 0.4 * l1(plain, mean));
    EXPECT_NEAR(sum_of(rung) / sum_of(plain), 1.0, 6e-3);
}

TEST(Ringing, OnlyWhereItShows) {
    // A coarse picture has no pixel fine enough: 3-2's fringes are 0.3 mm, a pixel 2.25 mm.
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    FlareRequest request = request_of(8.0, 16);
    request.only = {{{2, 1}}};
    request.ringing = true;
    const FlareImage rung = *render_flare(lens, request);
    request.ringing = false;
    EXPECT_TRUE(rung.ringing.empty());
    EXPECT_EQ(rung.irradiance, render_flare(lens, request)->irradiance);
}

TEST(Ringing, UniformPictureGetsTheSameFringes) {
    const Prescription lens = small_stop_tessar(6);
    FlareRequest request = request_of(0.0, 900);
    const auto ghosts = rung_ghosts(lens, request);
    ASSERT_FALSE(ghosts.empty());
    request.only = {ghosts.front()};
    request.ringing = true;
    const FlareImage planned = *render_flare(lens, request);
    request.method = FlareMethod::uniform;
    const FlareImage uniform = *render_flare(lens, request);
    ASSERT_EQ(uniform.ringing.size(), planned.ringing.size());
    double difference = 0.0;
    for (std::size_t k = 0; k < planned.irradiance.size(); ++k)
        difference += std::abs(static_cast<double>(planned.irradiance[k] - uniform.irradiance[k]));
    EXPECT_LT(difference / sum_of(uniform), 0.02);
}

TEST(Ringing, IsTheSameForAnyNumberOfThreads) {
    const Prescription lens = small_stop_tessar(5);
    FlareRequest request = request_of(4.0, 700);
    request.spectrum = StandardLight{};
    request.ringing = true;
    request.threads = 1;
    const FlareImage one = *render_flare(lens, request);
    request.threads = 3;
    EXPECT_EQ(render_flare(lens, request)->rgb, one.rgb);
}

}  // namespace
}  // namespace ghostlight
