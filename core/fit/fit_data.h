#pragma once

#include <cstddef>
#include <vector>

#include "core/fit/photo.h"
#include "core/flare/ghost_mesh.h"

namespace ghostlight {

/// The quadratic B-spline, 0 beyond ±1.5: the smooth footprint of everything on the fit's scale.
/// Its integral is 1 and the sum over integer shifts is 1 everywhere.
double spline(double t);
/// Its derivative.
double spline_slope(double t);
/// Reach of the spline to either side, in samples.
inline constexpr double spline_reach = 1.5;
/// Correlation of the noise of two samples `lag` apart along one axis: the spline's
/// autocorrelation (a quintic B-spline) over its value at 0. White noise of pixels much smaller
/// than a sample.
double spline_correlation(int lag);

/// χ² of all samples over that of as many independent ones, for a smooth signal: (Σ correlation)²
/// over both axes.
double shared_noise();

/// A photograph on the fit's scale: the mean of the linear photograph under a spline about each
/// sample, samples being the middles of the pixels of a coarse picture of the sensor.
struct FitData {
    PixelFrame frame;           ///< of the samples
    std::vector<double> value;  ///< 3 a sample
    /// Σ w² / (Σ w)² of the spline's weights: one over the number of pixels in a sample.
    std::vector<double> inverse_count;
    std::vector<char> used;  ///< 1 a sample: inside, and next to nothing of it masked
    PhotoNoise noise;
    std::size_t count = 0;  ///< samples used
    std::size_t samples() const { return used.size(); }
};

/// Where a photograph's pixels lie on the sensor.
struct PhotoPlace {
    double sensor_width_mm = 36.0;  ///< of the whole picture; crops are smaller than the sensor
    /// The axis in the photograph, pixels of the sensor's frame from the lower left corner.
    double axis_column = 0.0, axis_row = 0.0;
    double rotation_rad = 0.0;  ///< of the camera about the axis, counterclockwise on the sensor
    double pitch_mm(const Photo& photo) const { return sensor_width_mm / photo.width_px; }
};

/// Samples of sensor width / `across`. The spline needs at least two pixels a sample; a photograph
/// of fewer is sampled more coarsely. Throws Error where nothing can be used.
FitData fit_data(const Photo& photo, const PhotoPlace& place, double sensor_width_mm,
                 double sensor_height_mm, int across);

/// The scale on which noise and the model's own error are alike everywhere:
/// ∫ dy / σ(y), σ² = n (shot y + read) + (error y)², continued straight below 0; and σ. In the dark
/// σ is at least one photon's, and the model's error at `dim`: without that, a picture without read
/// noise would count a hair's breadth below 0 as ten thousand σ.
struct StableScale {
    double shot = 0.0, read = 0.0;  ///< of a sample
    double error = 0.0;             ///< relative, of the model
    double at(double value) const;
    double sigma(double value) const;
};
StableScale stable_scale(const FitData& data, std::size_t sample, double model_error, double dim);

}  // namespace ghostlight
