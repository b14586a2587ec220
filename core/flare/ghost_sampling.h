#pragma once

#include <cstddef>
#include <vector>

#include "core/flare/ghost_mesh.h"
#include "core/flare/spectrum.h"
#include "core/ghosts/ghost_path.h"
#include "core/ghosts/pupil.h"
#include "core/optics/optical_system.h"
#include "core/optics/prescription.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// What a ray's weight is made of; all but the first are for measuring what they leave out.
enum class WeightModel {
    carried,          ///< the polarisation carried along the path
    averaged,         ///< (R_s + R_p)/2 and (T_s + T_p)/2 at every surface (Hullin et al. 2011)
    reflections_only  ///< averaged, and every transmission taken as 1, as their shader does
};

enum class TracePrecision { double_precision, single_precision };

/// The light and lens that ghosts are sampled for.
struct SamplingScene {
    Prescription lens;
    LightDirection light;
    /// Angular diameter of a disc of even radiance about the light's direction; 0 = a point.
    double disc_diameter_deg = 0.0;
    Spectrum spectrum = Monochromatic{};
    PixelFrame pixels;
    WeightModel weights = WeightModel::carried;
    TracePrecision precision = TracePrecision::double_precision;

    int channels() const { return is_gray() ? 1 : 4; }
    bool is_gray() const { return std::holds_alternative<Monochromatic>(spectrum); }
    bool has_disc() const { return disc_diameter_deg > 0.0; }
};

/// How finely a ghost is sampled. Each level halves the squared spacing of the rays, of the
/// directions within a disc and of the wavelengths, and none of its samples is one of the level
/// before: where errors fall with the square of the spacing, two levels differ by the finer one's
/// error.
struct SamplingLevel {
    int cells = 0, directions = 1, wavelengths = 1;
    /// The grid's corner lies beside the pupil's by these shares of a cell.
    double shift_u = 0.0, shift_v = 0.0;
};
SamplingLevel sampling_level(int level, bool disc, bool spectrum);

/// A lens compiled at the wavelengths of a level.
struct SampledSpectrum {
    std::vector<SpectralSample> samples;
    std::vector<Rgb> colors;
    std::vector<OpticalSystem> systems;
};
SampledSpectrum sampled_spectrum(const SamplingScene& scene, const SamplingLevel& level);

/// A picture in bands of rows, of which those without light are empty. Irradiance / E0, or linear
/// Rec.709 and irradiance: `channels` values a pixel.
struct BandedPicture {
    static constexpr int band_rows = 32;
    int width_px = 0, height_px = 0, channels = 1;
    std::vector<std::vector<double>> bands;

    int rows(std::size_t band) const;
    /// Irradiance of a pixel of a band that is not empty.
    double irradiance(std::size_t band, std::size_t pixel) const {
        const auto c = static_cast<std::size_t>(channels);
        return bands[band][pixel * c + c - 1];
    }
};

/// One ghost sampled at one level.
struct SampledGhost {
    BandedPicture picture;
    double flux_mm2 = 0.0;       ///< on the whole sensor plane
    double on_sensor_mm2 = 0.0;  ///< of it, in the picture
    std::size_t rays = 0, pieces = 0;
};

/// Draws one ghost: a grid of rays in tiles over where it enters, each wavelength and direction by
/// itself, pieces accumulated with exact pixel coverage. No symmetry, no interpolation of weights.
/// `pupils` are where it enters, for each direction and in it for the outer and the middle
/// wavelength: found where they are empty, else taken from another level of the same ghost (a
/// disc's levels have directions of their own).
SampledGhost sample_ghost(const SamplingScene& scene, const SampledSpectrum& spectrum,
                          const SamplingLevel& level, const GhostPath& path,
                          std::vector<Pupil>& pupils);

/// L1 distance of two pictures' irradiances on the sensor, mm² (over E0).
double l1_distance_mm2(const BandedPicture& a, const BandedPicture& b, double pixel_area_mm2);

}  // namespace ghostlight
