#pragma once

#include "core/ghosts/bundle.h"
#include "core/ghosts/ghost_path.h"
#include "core/optics/optical_system.h"

namespace ghostlight {

/// Traces a bundle of floats in double precision and rounds what comes of it: for ghosts that
/// single precision does not hold still, at about three times the cost.
void trace_in_double(const OpticalSystem& system, const GhostPath& path, const BeamFrame& frame,
                     Weights weights, Bundle<float>& rays);

/// How far single precision moved rays that pass all clear radii and land within the circle around
/// the sensor: the worst of at most `rays` of them, mm.
double float_displacement_mm(const OpticalSystem& system, const GhostPath& path,
                             const BeamFrame& frame, const Bundle<float>& traced, std::size_t rays);

}  // namespace ghostlight
