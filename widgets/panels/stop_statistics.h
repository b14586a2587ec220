#pragma once

#include <QString>

#include "core/optics/optical_system.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// What the stop's shape and dirt come to, in words, a line each: the starburst's arms, and how
/// much of what lies on the stop takes how much of the light. Throws Error like dirt_statistics().
QString stop_statistics(const Stop& stop, const OpticalSystem& system);

}  // namespace ghostlight
