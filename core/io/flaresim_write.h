#pragma once

#include <string>
#include <string_view>

#include "core/error.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// A remark that says so in files written here: most others hold diameters, whatever they say.
inline constexpr std::string_view flaresim_radii_remark =
    "semi-apertures are radii, the stop's as it is open";

/// The lens as a FlareSim .lens: radius, thickness, index, Abbe number, semi-aperture (a radius,
/// as the format means it), layers of the coating. What it lacks goes to the notes.
std::string write_flaresim_lens(const Prescription& lens, Notes& notes);

}  // namespace ghostlight
