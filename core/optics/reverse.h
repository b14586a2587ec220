#pragma once

#include "core/optics/prescription.h"

namespace ghostlight {

/// The lens turned end for end about its own middle: rows in reverse, each curve and asphere with
/// the other sign, coatings seen from their other side; stop and configurations follow. The
/// distance to the sensor and what the source states stay as they are, so that twice reversed is
/// the lens itself. Throws Error where the last surface is not followed by air, since light comes
/// from air.
Prescription reversed(const Prescription& lens);

/// The same coating for light from its other side.
Coating reversed(const Coating& coating);

}  // namespace ghostlight
