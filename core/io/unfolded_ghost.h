#pragma once

#include <filesystem>
#include <string>

#include "core/error.h"
#include "core/ghosts/ghost_path.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// The light's way along a ghost as a lens of its own, a .zmx for sequential programs: every
/// surface as often as it is met, in that order, mirrors where light turns, negative thicknesses
/// on the way back. The rims cut rays (CLAP). The glasses are those of the lens; the stop is its
/// first crossing.
std::string unfolded_ghost(const Prescription& lens, const GhostPath& path, Notes& notes);

/// The same for a ghost by name ("5-3"). Throws Error for a name that is none of this lens, and for
/// a file that is not a .zmx.
std::string unfolded_ghost(const Prescription& lens, const std::string& ghost,
                           const std::filesystem::path& file, Notes& notes);

}  // namespace ghostlight
