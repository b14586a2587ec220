#include "core/flare/ghost_rims.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/flare/fresnel.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr double first_maximum_w = 1.2172;
constexpr double first_maximum = 0.8607;  ///< of √(λ|z_eff|), z_eff = B/M
/// ∫ |profile − 1 in the light, profile in the shadow| dw of a straight edge, to w = 6.
constexpr double change_per_w = 1.04;

/// From |M|, |B|, the wavelength in the medium there and the rim's radius.
GhostFringes fringes_of(double magnified, double b_mm, double wavelength_mm, double radius_mm,
                        double pitch_mm) {
    const double spread = wavelength_mm * std::abs(b_mm);
    const double number = radius_mm * radius_mm * std::abs(magnified) / spread;
    if (!std::isfinite(number) || !std::isfinite(magnified)) return {};
    return {number, first_maximum * std::sqrt(spread * std::abs(magnified)) / pitch_mm};
}

/// The stop is where a beam that passes all clear radii is cut, and the other way round.
struct Cuts {
    bool surface = false;
    std::vector<bool> crossings;
    std::vector<std::size_t> by_surface;  ///< rays of the half grid that surfaces alone cut
    std::vector<bool> passes;             ///< of its rays
};
Cuts cuts_of(const StopMask& stop, const Bundle<float>& rays) {
    Cuts cuts;
    // Blades lie between two circles: of most rays these know.
    const double outer = std::pow(stop.semi_diameter_mm, 2);
    const double inner =
        stop.blades < 3 ? outer : outer * std::pow(std::cos(std::numbers::pi / stop.blades), 2);
    const auto passes = [&](float u, float v) {
        const double square = static_cast<double>(u * u + v * v);
        if (stop.picture == nullptr && square > outer) return false;
        if (stop.picture == nullptr && square < inner) return true;
        return stop_passes(stop, static_cast<double>(u), static_cast<double>(v));
    };
    const auto crossings = static_cast<std::size_t>(rays.stop_crossings);
    cuts.crossings.assign(crossings, false);
    cuts.passes.assign(rays.size(), false);
    for (std::size_t k = 0; k < rays.size(); ++k) {
        if (rays.margin[k] < 0.0F) continue;
        std::size_t stopped = 0, by = 0;
        for (std::size_t s = 0; s < crossings && stopped < 2; ++s)
            if (!passes(rays.stop_u_mm[s][k], rays.stop_v_mm[s][k])) {
                ++stopped;
                by = s;
            }
        const bool clipped = rays.r_rel[k] > 1.0F;
        if (clipped && stopped == 0) cuts.by_surface.push_back(k);
        if (!clipped && stopped == 1) cuts.crossings[by] = true;
        cuts.passes[k] = !clipped && stopped == 0;
    }
    cuts.surface = !cuts.by_surface.empty();
    return cuts;
}

/// Of the probe's cells that rims cut, those that land on the frame.
double rim_on_frame(const MirrorGrid& grid, const std::vector<bool>& passes,
                    const NodePlacement& placement) {
    const PixelFrame& frame = placement.frame();
    const double right_mm = -frame.left_mm, top_mm = -frame.bottom_mm;
    // By the box around a cell's corners: a large cell may hold the whole frame.
    const auto is_on_frame = [&](const std::array<std::size_t, 4>& corners, double mirror) {
        double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
        for (const std::size_t k : corners) {
            const double x = mirror * static_cast<double>(grid.half.x_mm[k]);
            const double y = static_cast<double>(grid.half.y_mm[k]);
            const double right = placement.cos_azimuth() * x - placement.sin_azimuth() * y;
            const double up = placement.sin_azimuth() * x + placement.cos_azimuth() * y;
            x0 = std::min(x0, right);
            x1 = std::max(x1, right);
            y0 = std::min(y0, up);
            y1 = std::max(y1, up);
        }
        return x0 <= right_mm && x1 >= -right_mm && y0 <= top_mm && y1 >= -top_mm;
    };
    int cut = 0, on_frame = 0;
    for (int j = 0; j < grid.cells; ++j)
        for (int i = grid.cells / 2; i < grid.cells; ++i) {
            const std::array corners{grid.of_node(i, j), grid.of_node(i + 1, j),
                                     grid.of_node(i, j + 1), grid.of_node(i + 1, j + 1)};
            const auto passing =
                std::ranges::count_if(corners, [&](std::size_t k) { return passes[k]; });
            if (passing == 0 || passing == 4) continue;
            for (const double mirror : {-1.0, 1.0}) {
                ++cut;
                if (is_on_frame(corners, mirror)) ++on_frame;
            }
        }
    return cut > 0 ? static_cast<double>(on_frame) / cut : 1.0;
}

}  // namespace

double GhostFringes::px_per_w() const { return first_fringe_px / first_maximum_w; }

GhostFringes ghost_fringes(const OpticalSystem& system, const ParaxialGhost& ghost,
                           double pitch_mm) {
    // |M| from the Fresnel number, which is that of the last crossing: N = a²|M|/(λ|B|).
    const double a = system.stop_mask.semi_diameter_mm;
    const double wavelength_mm =
        mm_from_nm(system.wavelength_nm) / system.surfaces[system.stop].n_before;
    const double b_mm = ghost.stop_to_sensor.b;
    const double magnified = ghost.fresnel_number * wavelength_mm * std::abs(b_mm) / (a * a);
    return fringes_of(magnified, b_mm, wavelength_mm, a, pitch_mm);
}

bool shows(const GhostFringes& fringes) {
    return fringes.fresnel_number >= least_propagated && fringes.first_fringe_px >= least_fringe_px;
}

std::vector<bool> shows_fringes(const OpticalSystem& system, const std::vector<GhostPath>& paths,
                                double pitch_mm) {
    std::vector<bool> result;
    for (const GhostPath& path : paths)
        result.push_back(shows(ghost_fringes(system, paraxial_ghost(system, path), pitch_mm)));
    return result;
}

double GhostRims::least_fresnel_number() const {
    double least = shows(surface) ? surface.fresnel_number : 0.0;
    for (const GhostFringes& rim : crossings)
        if (shows(rim) && (least == 0.0 || rim.fresnel_number < least)) least = rim.fresnel_number;
    return least;
}

double GhostRims::px_per_w() const {
    double least = shows(surface) ? surface.px_per_w() : 0.0;
    for (const GhostFringes& rim : crossings)
        if (shows(rim) && (least == 0.0 || rim.px_per_w() < least)) least = rim.px_per_w();
    return least;
}

double GhostRims::changed_px() const {
    double most = shows(surface) ? surface.px_per_w() : 0.0;
    for (const GhostFringes& rim : crossings)
        if (shows(rim)) most = std::max(most, rim.px_per_w());
    return change_per_w * most;
}

double GhostRims::changed_share(const EdgeFringes& edge) const {
    // A rim's length over its area, as deep as w = 1 is; at most all of it changes, there and here.
    auto share = [&](const GhostFringes& rim, double length) {
        return shows(rim)
                   ? length * edge.changed_w(rim.px_per_w()) / std::sqrt(2.0 * rim.fresnel_number)
                   : 0.0;
    };
    double sum = share(surface, 2.0);
    for (const GhostFringes& rim : crossings) sum += share(rim, stop_rim);
    return on_frame * std::min(2.0, sum);
}

GhostRims ghost_rims(const OpticalSystem& system, const NodePlacement& placement,
                     const ProbedGhost& ghost, double field_deg) {
    const StopMask& stop = placement.stop_mask();
    const double pitch_mm = placement.frame().pitch_mm;
    const GhostPath& path = ghost.planned.path;
    const Bundle<float>& rays = ghost.grid.half;
    const Cuts cuts = cuts_of(stop, rays);
    const std::vector<ParaxialMeeting> meetings = paraxial_meetings(system, path);
    const ParaxialGhost whole = paraxial_ghost(system, path);
    auto fringes_from = [&](const ParaxialMeeting& at) {
        // Unreduced matrices: det = n before the lens over n here, and S = whole · here⁻¹.
        const RayMatrix& here = at.to_here;
        const double det = here.a * here.d - here.b * here.c;
        const double b = (whole.to_sensor.b * here.a - whole.to_sensor.a * here.b) / det;
        return fringes_of(whole.to_sensor.a / here.a, b,
                          mm_from_nm(system.wavelength_nm) * std::abs(det), at.clear_radius_mm,
                          pitch_mm);
    };
    GhostRims rims;
    rims.on_frame = rim_on_frame(ghost.grid, cuts.passes, placement);
    if (stop.blades >= 3) rims.stop_rim = 2.0 / std::cos(std::numbers::pi / stop.blades);
    for (const ParaxialMeeting& at : meetings)
        if (at.at_stop) {
            const std::size_t s = rims.crossings.size();
            rims.crossings.push_back(
                s < cuts.crossings.size() && cuts.crossings[s] ? fringes_from(at) : GhostFringes{});
        }
    if (!cuts.surface) return rims;
    // A vote of the rays that surfaces alone cut: which one they pass furthest out of.
    const double slope = std::tan(rad_from_deg(field_deg));
    std::vector<std::size_t> votes(meetings.size(), 0);
    for (const std::size_t k : cuts.by_surface) {
        double furthest = 0.0;
        std::size_t worst = 0;
        for (std::size_t m = 0; m < meetings.size(); ++m) {
            if (meetings[m].at_stop) continue;
            const RayMatrix& here = meetings[m].to_here;
            const double out =
                std::hypot(here.a * static_cast<double>(rays.u_mm[k]),
                           here.a * static_cast<double>(rays.v_mm[k]) + here.b * slope) /
                meetings[m].clear_radius_mm;
            if (out > furthest) {
                furthest = out;
                worst = m;
            }
        }
        ++votes[worst];
    }
    rims.surface = fringes_from(
        meetings[static_cast<std::size_t>(std::ranges::max_element(votes) - votes.begin())]);
    return rims;
}

}  // namespace ghostlight
