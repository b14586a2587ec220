#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/ghosts/ghost_path.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// What of a row a finding is about.
enum class LensCell { whole, curve, asphere, thickness, medium, semi_diameter, coating };
/// "radius", "thickness", … as people call it; empty for the whole row.
const char* name_of(LensCell cell);

/// Something suspicious of a lens as it stands.
struct Finding {
    /// Error: cannot be traced. Warning: hardly meant. Info: worth knowing.
    Note::Severity severity = Note::Severity::warning;
    std::optional<std::size_t> surface;  ///< row from 0; none: the lens as a whole
    LensCell cell = LensCell::whole;
    std::string text;
    std::string proposal;                ///< what to do about it; empty where nothing is to be done
    std::vector<GhostPath> ghosts = {};  ///< those it is about
    bool operator==(const Finding&) const = default;
};

struct LensCheckRequest {
    double shortest_nm = 400.0, longest_nm = 700.0;  ///< of the light: glasses have to cover it
    double wavelength_nm = 587.5618;                 ///< for ghosts' foci
    /// A ghost is called focused where its light on the sensor is within this share of the
    /// sensor's diagonal, to first order.
    double focused_share = 0.04;
};

/// Looks a lens over, in one of its positions: rims wider than their spheres, surfaces that cross,
/// glasses unknown, odd or without an index in the light, coatings that raise what they should
/// lower, a stop that is not the narrowest place, a sensor off the focus, ghosts in focus on it.
/// Gravest first, then by row. Throws nothing: what cannot be traced is a finding.
std::vector<Finding> check_lens(const Prescription& configured,
                                const LensCheckRequest& request = {});

}  // namespace ghostlight
