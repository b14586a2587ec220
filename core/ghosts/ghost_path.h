#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/optics/optical_system.h"

namespace ghostlight {

/// The surfaces where the light turns, in order, by row from 0, the count of surfaces meaning the
/// sensor; the direct image is the empty path. An even number of reflections, alternately back and
/// forth: {i, j} with i > j.
struct GhostPath {
    std::vector<std::size_t> reflections;
    bool is_direct() const { return reflections.empty(); }
    bool operator==(const GhostPath&) const = default;
    auto operator<=>(const GhostPath&) const = default;
};

/// "5-3", rows counted from 1; "direct" for the empty path; "sensor-3" for a ghost that turns at
/// the sensor of a lens of `surface_count` surfaces.
inline constexpr std::size_t any_surface_count = static_cast<std::size_t>(-1);
std::string name(const GhostPath& path, std::size_t surface_count = any_surface_count);

/// The reverse of name(). Throws Error saying what is wrong with the text for this lens.
GhostPath parse_ghost(std::string_view text, const OpticalSystem& system);

/// One meeting of the light with a surface on its way to the sensor.
struct PathEvent {
    std::size_t surface = 0;
    bool reflects = false;
    bool forward = true;  ///< direction of travel before the event: towards the sensor
};
/// Every meeting, in order, from the first surface to the last.
std::vector<PathEvent> events(const GhostPath& path, std::size_t surface_count);

/// True where the path can turn at a row; the row after the last is the sensor.
bool can_turn(const OpticalSystem& system, std::size_t row);

/// All two-reflection ghosts: pairs i > j of the surfaces that reflect, n(n−1)/2 of them, the
/// sensor's among them where it reflects.
std::vector<GhostPath> two_reflection_ghosts(const OpticalSystem& system);

}  // namespace ghostlight
