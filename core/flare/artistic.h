#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/ghosts/ghost_path.h"

namespace ghostlight {

/// What an artist changes about one ghost's picture. Tables, plans and fits never see it.
struct GhostStyle {
    GhostPath path;
    bool on = true;
    double gain_ev = 0.0;
    std::array<double, 3> tint = {1.0, 1.0, 1.0};  ///< linear Rec.709 factors
    double offset_x_mm = 0.0, offset_y_mm = 0.0;   ///< on the sensor
    bool operator==(const GhostStyle&) const = default;
};

/// Everything that is not physics, in one place; neutral as it stands.
struct Artistic {
    std::vector<GhostStyle> ghosts;  ///< those that differ
    double exaggeration_ev = 0.0;    ///< of all ghosts
    /// Every ghost is moved by a normal deviate of this size each way, its own for each seed.
    double jitter_mm = 0.0;
    std::uint32_t seed = 1;
    bool operator==(const Artistic&) const = default;

    bool is_neutral() const;
};

/// The largest that offsets and jitter may be, mm, and tints.
inline constexpr double most_offset_mm = 100.0, most_tint = 10.0;

/// What all of that comes to for one ghost.
struct GhostLook {
    bool on = true;
    std::array<double, 4> gain = {1.0, 1.0, 1.0, 1.0};  ///< linear Rec.709, irradiance
    double offset_x_mm = 0.0, offset_y_mm = 0.0;
};
GhostLook look_of(const Artistic& artistic, const GhostPath& path);

}  // namespace ghostlight
