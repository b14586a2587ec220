#pragma once

#include <vector>

#include "core/optics/optical_system.h"

namespace ghostlight {

/// Light that reaches the sensor after 0, 1, … `most` reflections in the lens's surfaces taken as
/// plane, parallel and incoherent, at normal incidence: shares of what comes in. Odd entries are 0.
/// Says how much of the stray light the ghosts of two reflections leave out, whatever the lens's
/// shape; exact for plane plates.
std::vector<double> shares_by_reflections(const OpticalSystem& system, int most);

/// Light of four and more reflections over that of two.
double higher_order_share(const OpticalSystem& system);

}  // namespace ghostlight
