#pragma once

#include <vector>

#include "core/flare/flare_scene.h"
#include "core/ghosts/mirror_grid.h"
#include "core/optics/trace_path.h"

namespace ghostlight {

/// What polarisation does to a path's weights over its box: the polarised weight over the mean of s
/// and p at every surface, at one wavelength. Smooth where the weights themselves are not, and so
/// known from few rays.
struct PolarisedShare {
    MirrorGrid grid;
    std::vector<float> ratio;  ///< a ray of the half grid; empty: 1 everywhere
    double error = 0.0;        ///< estimated, of interpolating it: a share of the light
};
PolarisedShare polarised_share(const FlareScene& scene, const TracePath<float>& path,
                               const BeamFrame& beam, const PupilBox& box);

/// What other wavelengths do to a path's weights beyond their own films: their rays meet the
/// surfaces at other angles, known from rays of the outer geometry wavelengths and interpolated
/// like positions; and polarisation has another effect on them, known from what s and p go through
/// at each wavelength and from the effect at the main one.
struct ColorShare {
    int cells = 0;                   ///< of the grid of a PolarisedShare
    std::vector<double> samples_nm;  ///< the scene's; empty: nothing to take off
    std::vector<float> ratio;        ///< a value a sample for each ray of that half grid
    std::size_t rays = 0;            ///< traced for it

    bool is_for(const FlareScene& scene) const;
};
ColorShare color_share(const FlareScene& scene, const GhostPath& path, const BeamFrame& beam,
                       const PolarisedShare& polarised);

/// What a path's weights have beyond the films' tables, smooth over its box and with the light's
/// direction.
struct WeightShares {
    PolarisedShare polarised;
    ColorShare colors;
};

/// Weights of a half grid that kept its cosines, at the scene's samples, FilmTables::stride() a
/// ray, polarisation included (by the grid's own rays, if they are traced so); failed rays take
/// their neighbours'.
std::vector<float> ghost_weights(const FlareScene& scene, const TracePath<float>& path,
                                 const MirrorGrid& grid, const WeightShares& shares);

/// Light per E0 in each channel, ray by ray of a half grid, made ready for interpolation. `shares`
/// as channel_shares() gives them.
template <int C>
std::vector<float> ray_light(const FlareScene& scene, const MirrorGrid& grid,
                             const std::vector<float>& weights, const std::vector<float>& shares);

/// Light per E0 in each channel of rays that kept their cosines and were traced with polarisation
/// at one wavelength, whose effect is taken to be that at the others. C a ray; `shares` as
/// channel_shares() gives them.
template <int C>
std::vector<float> bundle_light(const FlareScene& scene, const TracePath<float>& path,
                                const Bundle<float>& rays, const std::vector<float>& shares);

/// The most light that a path can bring through the box of a half grid that kept its cosines, mm²
/// over E0: the box, the largest reflectances at the incidences seen there (beside rays that get
/// through) and somewhat steeper ones, and no loss at any transmission.
double box_bound_mm2(const FlareScene& scene, const TracePath<float>& path, const MirrorGrid& grid);

}  // namespace ghostlight
