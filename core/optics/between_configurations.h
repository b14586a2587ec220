#pragma once

#include <string>
#include <string_view>

#include "core/optics/prescription.h"

namespace ghostlight {

/// A position between two of a lens's, linear in every gap and in the f-number: share 0 is the
/// first, 1 the second. An empty name is the lens as listed. What neither of them sets is not
/// set. Real cams are not linear: ends are exact, and between them the image may be out of focus.
/// The result has no name and states nothing as published. Throws Error naming an unknown
/// position, or for a share outside 0 to 1.
Configuration between_configurations(const Prescription& lens, std::string_view first,
                                     std::string_view second, double share);

}  // namespace ghostlight
