#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/flare/film_tables.h"
#include "core/flare/spectrum.h"
#include "core/ghosts/ghost_path.h"
#include "core/optics/optical_system.h"
#include "core/optics/prescription.h"

namespace ghostlight {

class PropagatedMasks;

/// A lens and the spectrum of its light, compiled for pictures: what does not change while the
/// light moves.
struct FlareScene {
    /// Samples of a spectrum that keep colours within 1 %.
    static constexpr int usual_samples = 16;
    /// Bands that a ghost may be traced in, each at its own wavelength: powers of two up to this.
    static constexpr int most_own_bands = 16;

    Spectrum spectrum;
    std::vector<SpectralSample> samples;  ///< where weights are evaluated
    std::vector<Rgb> colors;              ///< of the samples
    /// Where the geometry is traced: one wavelength, or three nodes in 1/λ² between which positions
    /// are interpolated. `main` of them, the sample at the mean of the light, stands for all where
    /// colour does not matter.
    std::vector<OpticalSystem> geometry;
    std::size_t main = 0;
    /// The lens at the middles of 2, 4, … most_own_bands bands, for ghosts in which interpolating
    /// between the geometry's wavelengths fails. Empty for one wavelength.
    std::vector<OpticalSystem> band_systems;
    CoatingModel coating_model = CoatingModel::exact;
    FilmTables films;
    std::vector<GhostPath> ghosts;
    StopDirt dirt;
    std::shared_ptr<PropagatedMasks> propagated_masks;  ///< never null

    bool is_gray() const { return samples.size() == 1; }
    const OpticalSystem& system() const { return geometry[main]; }
    /// The lens at the middle of one of 2, 4, … most_own_bands bands.
    const OpticalSystem& at_band(int band, int bands) const {
        return band_systems[static_cast<std::size_t>((2 * band + 1) * (most_own_bands / bands) -
                                                     1)];
    }
    /// Shares of the geometry nodes' positions in the position at a wavelength.
    std::vector<double> interpolation(double wavelength_nm) const;
};

/// Of half the range in 1/λ², from its middle: Chebyshev's outer two of three nodes.
inline constexpr double outer_geometry_node = 0.8660254037844386;

/// Where a spectrum's geometry is traced: its one wavelength, or three in 1/λ², the outer ones
/// Chebyshev's, the middle one the sample next to the mean of the light.
std::vector<double> geometry_wavelengths_nm(const std::vector<SpectralSample>& samples);

/// Shares of the positions at the wavelengths of `geometry` in the one at another wavelength.
std::vector<double> node_shares(const std::vector<OpticalSystem>& geometry, double wavelength_nm);

/// Compiles. Throws Error like compile().
FlareScene flare_scene(const Prescription& lens, const Spectrum& spectrum,
                       int spectral_samples = FlareScene::usual_samples, unsigned threads = 0,
                       CoatingModel model = CoatingModel::exact);

/// What each spectral sample gives to each channel of a band (grid_light.h): C values a sample,
/// linear Rec.709 and irradiance, or irradiance alone.
template <int C>
std::vector<float> channel_shares(const FlareScene& scene, int band, int bands);

}  // namespace ghostlight
