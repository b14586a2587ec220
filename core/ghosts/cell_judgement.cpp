#include "core/ghosts/cell_judgement.h"

#include <cmath>

namespace ghostlight {
namespace {

constexpr double blind_clearance = 5.0;  ///< r_rel beside a failing corner that may still fall to 1
constexpr double first_level_dip = 0.15;      ///< of r_rel inside a cell; falls fourfold a level
constexpr double beside_failing_share = 3.0;  ///< how far stop coordinates may reach there
constexpr int lone_corner_levels = 6;

}  // namespace

template <class T>
bool may_pass(const Bundle<T>& rays, const std::array<std::size_t, 4>& corners, int level,
              double stop_radius_mm, const SearchEffort& effort) {
    double share = level == 0 ? 0.75 : 0.4;
    Range margin, clearance;
    int valid = 0;
    for (const std::size_t c : corners) {
        margin.add(static_cast<double>(rays.margin[c]));
        if (rays.margin[c] >= T(0)) ++valid;
    }
    const bool singular = margin.low < margin.high - margin.low;
    if (valid == 0 && level == 0) return true;
    margin.widen(share);
    if (margin.high < 0.0) return false;
    if (valid == 0) return !effort.only_beside_valid && level < effort.blind_levels;
    // Past a miss or total reflection the map is only continued, and next to it it turns sharply:
    // trust the valid corners alone, and less.
    if (singular && level <= effort.blind_levels) share = 2.0;
    for (const std::size_t c : corners)
        if (rays.margin[c] >= T(0)) clearance.add(static_cast<double>(rays.r_rel[c]));
    if (valid < 4 && level <= effort.blind_levels) return clearance.low < blind_clearance;
    clearance.widen(share);
    // r_rel is a maximum over surfaces and may dip between equal corners.
    if (clearance.low - std::ldexp(first_level_dip, -2 * level) > 1.0) return false;
    // One valid corner alone says nothing about how far the stop coordinates reach.
    if (valid == 1) return level <= lone_corner_levels;
    if (valid < 4) share = beside_failing_share;
    for (std::size_t k = 0; k < static_cast<std::size_t>(rays.stop_crossings); ++k) {
        Range u, v;
        for (const std::size_t c : corners) {
            if (rays.margin[c] < T(0)) continue;
            u.add(static_cast<double>(rays.stop_u_mm[k][c]));
            v.add(static_cast<double>(rays.stop_v_mm[k][c]));
        }
        u.widen(share);
        v.widen(share);
        const double du = u.distance(), dv = v.distance();
        if (du * du + dv * dv > stop_radius_mm * stop_radius_mm) return false;
    }
    return true;
}

template <class T>
std::size_t passing_rays(const Bundle<T>& rays, double stop_radius_mm) {
    const T r2 = static_cast<T>(stop_radius_mm * stop_radius_mm);
    std::size_t count = 0;
    for (std::size_t n = 0; n < rays.size(); ++n) {
        bool passes = rays.margin[n] >= T(0) && rays.r_rel[n] <= T(1);
        for (std::size_t k = 0; k < static_cast<std::size_t>(rays.stop_crossings); ++k) {
            const T u = rays.stop_u_mm[k][n], v = rays.stop_v_mm[k][n];
            passes = passes && u * u + v * v <= r2;
        }
        count += passes ? 1 : 0;
    }
    return count;
}

template bool may_pass(const Bundle<float>&, const std::array<std::size_t, 4>&, int, double,
                       const SearchEffort&);
template bool may_pass(const Bundle<double>&, const std::array<std::size_t, 4>&, int, double,
                       const SearchEffort&);
template std::size_t passing_rays(const Bundle<float>&, double);
template std::size_t passing_rays(const Bundle<double>&, double);

}  // namespace ghostlight
