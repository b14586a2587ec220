#pragma once

#include <string>

#include "core/error.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// The lens as a FlareSim .lens: radius, thickness, index, Abbe number, semi-aperture (a radius,
/// as the format means it), layers of the coating. What it lacks goes to the notes.
std::string write_flaresim_lens(const Prescription& lens, Notes& notes);

}  // namespace ghostlight
