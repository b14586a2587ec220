#pragma once

#include <cmath>
#include <numbers>

namespace ghostlight {

/// The only place where units are converted. Lengths are mm, wavelengths nm (in standard air),
/// angles degrees at interfaces and radians inside.
constexpr double rad_from_deg(double angle_deg) { return angle_deg * std::numbers::pi / 180.0; }
constexpr double deg_from_rad(double angle_rad) { return angle_rad * 180.0 / std::numbers::pi; }
/// Exact at both ends: 1 at 0°, 0 at 90°.
inline double cos_from_deg(double angle_deg) {
    return angle_deg <= 45.0 ? std::cos(rad_from_deg(angle_deg))
                             : std::sin(rad_from_deg(90.0 - angle_deg));
}
constexpr double um_from_nm(double length_nm) { return length_nm * 1e-3; }
constexpr double nm_from_um(double length_um) { return length_um * 1e3; }
constexpr double mm_from_nm(double length_nm) { return length_nm * 1e-6; }

/// Fraunhofer lines, nm in standard air.
inline constexpr double d_line_nm = 587.5618;
inline constexpr double f_line_nm = 486.1327;
inline constexpr double c_line_nm = 656.2725;

}  // namespace ghostlight
