#pragma once

#include <cstddef>
#include <stop_token>

#include "core/flare/ghost_mesh.h"
#include "core/ghosts/bundle.h"
#include "core/ghosts/pupil.h"

namespace ghostlight {

/// Integrals over a path's bundle at one wavelength, or sums of them over a spectrum. Positions
/// and reflectances are weighted by flux: divide by `flux`.
struct FluxSums {
    double flux = 0.0;       ///< mm²
    double on_sensor = 0.0;  ///< mm² of it inside the sensor's rectangle
    double x = 0.0, y = 0.0, r2 = 0.0;
    double reflectance[2] = {0.0, 0.0};
    FluxSums& operator+=(const FluxSums& other);
};
FluxSums operator*(double scale, FluxSums sums);

/// One path at one wavelength, refined as far as it has been asked to.
struct PathFlux {
    FluxSums sums;
    double error_mm2 = 0.0;  ///< of the flux, the quadrature's own estimate
    int cells = 0;           ///< across the pupil
    std::size_t rays = 0;
    PupilBox box;
    bool empty = true;
};

/// The flux of one path by uniform grids over the pupil, weight and clearances linear on each
/// triangle, refined by doubling. The polarisation state is carried.
class PathQuadrature {
   public:
    /// `system` must outlive this.
    PathQuadrature(const OpticalSystem& system, const GhostPath& path, const BeamFrame& frame);

    /// Finds the pupil and integrates on the coarsest grid.
    PathFlux start() const;

    /// Doubles the grid until the error is below max(share × flux, floor), or the finest grid.
    void refine(PathFlux& flux, double share, double floor_mm2, std::stop_token stop) const;

    /// The path's irradiance for a raster, on the grid that the flux was found on or finer.
    GhostMesh mesh(PathFlux& flux, const PixelFrame& pixels, double gain) const;

   private:
    const OpticalSystem& system_;
    TracePath<double> path_;
    BeamFrame frame_;

    void integrate(PathFlux& flux, int cells) const;
};

}  // namespace ghostlight
