#include "core/flare/diffraction_omissions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/flare/direct_beam.h"
#include "core/flare/ringing.h"

namespace ghostlight {
namespace {

constexpr double first_maximum_w =
    1.2172;                           ///< of Cornu's straight edge, where fringes are measured
constexpr double airy_zero = 3.8317;  ///< of J₁: the first dark ring
/// Some of the fringes is left after averaging over pixels that they nearly fill.
constexpr double doubt = 2.0;

Omission fringes(const FlareScene& scene, const FlareRequest& request, const FlarePlan& plan) {
    const OpticalSystem& system = scene.system();
    const double pitch_mm = system.sensor_width_mm / request.width_px;
    std::vector<const PlannedGhost*> drawn;
    std::vector<GhostPath> paths;
    for (const PlannedGhost& ghost : plan.ghosts)
        if (ghost.fate == GhostFate::drawn) {
            drawn.push_back(&ghost);
            paths.push_back(ghost.path);
        }
    const std::vector<bool> shows = shows_fringes(system, paths, pitch_mm);
    Omission omission{.what = request.ringing ? "fringes finer than a pixel" : "fringes at rims",
                      .why = request.ringing
                                 ? "a pixel's mean is nearly what the picture has already"
                                 : "ringing is off",
                      .ghosts = 0,
                      .bound_mm2 = 0.0,
                      .proven = false};
    for (std::size_t g = 0; g < drawn.size(); ++g) {
        if (request.ringing && shows[g]) continue;
        ++omission.ghosts;
        const GhostFringes found =
            ghost_fringes(system, paraxial_ghost(system, paths[g]), pitch_mm);
        const double change =
            doubt *
            fringes_change(drawn[g]->spot, found.first_fringe_px / first_maximum_w * pitch_mm);
        // Wider than the ghost, they change all of its light: what is missing is elsewhere too.
        *omission.bound_mm2 += std::min(2.0, change) * drawn[g]->flux_mm2;
    }
    return omission;
}

Omission starburst(const FlareScene& scene, const FlareRequest& request) {
    Omission omission{.what = "the starburst",
                      .why = "no light comes straight through",
                      .ghosts = 0,
                      .bound_mm2 = std::nullopt,
                      .proven = false};
    const OpticalSystem& system = scene.system();
    const auto beam = direct_beam(scene.geometry, request.light, request.threads);
    if (!beam || beam->is_dark()) return omission;
    const double unit_mm = std::abs(beam->radius_per_k_mm);
    const double pitch_mm = system.sensor_width_mm / request.width_px;
    const double beside_mm =
        std::hypot(std::max(0.0, std::abs(beam->x_mm) - 0.5 * system.sensor_width_mm),
                   std::max(0.0, std::abs(beam->y_mm) - 0.5 * system.sensor_height_mm));
    if (beside_mm > 0.0) {
        omission.why = fmt::format(
            "the light's image is {:.2g} mm beside the sensor; {:.1g} % of its light goes further",
            beside_mm, 100.0 * beyond_airy(beside_mm / unit_mm));
        return omission;
    }
    const double pixel_radius_mm = pitch_mm / std::sqrt(std::numbers::pi);
    omission.why = fmt::format(
        "a layer of its own; first dark ring {:.2g} pixels out, {:.2g} % of the light beyond its "
        "pixel",
        airy_zero * unit_mm / pitch_mm, 100.0 * beyond_airy(pixel_radius_mm / unit_mm));
    return omission;
}

}  // namespace

double fringes_change(const GhostSpot& spot, double width_mm) {
    const auto [least, most] = spot.sigmas_mm();
    const double a = 2.0 * most, b = 2.0 * least;  // half axes of an even ellipse
    if (!(a * b > 0.0)) return 2.0;
    const double rim_over_area = std::sqrt(2.0 * (a * a + b * b)) / (a * b);
    return rim_over_area * width_mm / std::numbers::pi;
}

double beyond_airy(double v) {
    const double j0 = std::cyl_bessel_j(0.0, v), j1 = std::cyl_bessel_j(1.0, v);
    return j0 * j0 + j1 * j1;
}

std::vector<Omission> diffraction_omissions(const FlareScene& scene, const FlareRequest& request,
                                            const FlarePlan& plan) {
    std::vector<Omission> omissions;
    if (Omission each = fringes(scene, request, plan); each.ghosts > 0)
        omissions.push_back(std::move(each));
    if (plan.fringes_left_out.ghosts > 0)
        omissions.push_back(
            {.what = "fringes that change little",
             .why = "all that these would change is less than half of the tolerance",
             .ghosts = plan.fringes_left_out.ghosts,
             .bound_mm2 = plan.fringes_left_out.changed_mm2,
             .proven = false});
    omissions.push_back(starburst(scene, request));
    return omissions;
}

}  // namespace ghostlight
