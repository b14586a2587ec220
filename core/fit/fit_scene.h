#pragma once

#include <cstddef>
#include <vector>

#include "core/fit/fit_parameters.h"
#include "core/flare/spectrum.h"
#include "core/ghosts/ghost_path.h"
#include "core/optics/optical_system.h"

namespace ghostlight {

/// A lens compiled for a fit: the geometry at a few wavelengths, weights at many.
struct FitScene {
    FittedLens lens;
    std::vector<SpectralSample> samples;
    std::vector<Rgb> colors;                 ///< of the samples, weight included
    std::vector<OpticalSystem> geometry;     ///< at one wavelength, or at three
    std::vector<std::vector<double>> nodes;  ///< by sample: shares of the geometry nodes
    std::size_t main = 0;
    std::vector<GhostPath> ghosts;
    const OpticalSystem& system() const { return geometry[main]; }
};
FitScene fit_scene(const FittedLens& lens, const Spectrum& spectrum, int spectral_samples);

}  // namespace ghostlight
