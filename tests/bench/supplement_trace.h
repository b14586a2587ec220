#pragma once

#include <vector>

#include "core/ghosts/bundle.h"
#include "core/optics/optical_system.h"

namespace ghostlight::bench {

/// An interface as the supplement of Hullin et al. 2011 has it: by its centre in space.
struct SupplementInterface {
    double center_z_mm, radius_mm;  ///< of a plane: its z, and 0
    double clear_radius_mm;
    double n0, n1, n2;    ///< before, of the coating, behind, along the way
    double thickness_nm;  ///< of the coating
    bool reflects;
};

/// A path's interfaces in order, and the sensor plane.
struct SupplementPath {
    std::vector<SupplementInterface> interfaces;
    double sensor_z_mm = 0.0;
    double wavelength_nm = 0.0;
};
/// Of a lens of spheres and planes.
SupplementPath supplement_path(const OpticalSystem& system, const GhostPath& ghost);

/// The algorithm of that supplement's Listing 1, one ray after another in double: spheres from
/// their centres, angles by inverse cosines, its coating formula at the two reflections and no loss
/// elsewhere. Fills x, y, weight, r_rel and margin (−1 where a ray fails) of a bundle traced
/// before.
void trace_supplement(const SupplementPath& path, const BeamFrame& frame, Bundle<double>& bundle);

}  // namespace ghostlight::bench
