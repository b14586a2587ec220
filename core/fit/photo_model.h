#pragma once

#include <array>
#include <cstddef>
#include <stop_token>
#include <vector>

#include "core/fit/fit_data.h"
#include "core/fit/ghost_basis.h"
#include "core/fit/ghost_weights.h"

namespace ghostlight {

/// Values in pictures of the fit: `columns` values for each of 3 channels of each sample. Column 0
/// is the value, the others are derivatives.
struct ModelPicture {
    std::size_t columns = 1;
    std::vector<double> values;
    double* at(std::size_t sample, std::size_t channel) {
        return &values[(3 * sample + channel) * columns];
    }
    const double* at(std::size_t sample, std::size_t channel) const {
        return &values[(3 * sample + channel) * columns];
    }
};

/// Σ over ghosts of basis × coefficients, and its derivatives by the coatings. When stopped, what
/// comes back is no picture.
ModelPicture ghost_picture(const std::vector<GhostBasis>& bases, const GhostWeights& weights,
                           const PixelFrame& frame, std::size_t coatings, bool slopes,
                           unsigned threads, std::stop_token stop = {});

/// One ghost alone, without derivatives.
ModelPicture one_ghost(const GhostBasis& basis, const GhostWeights& weights,
                       const PixelFrame& frame);

/// What is unknown of a photograph besides the lens, each with a prior: logarithms of the three
/// channels' gains, shading in the corners, background polynomials of each channel, and the place.
struct PhotoUnknowns {
    std::array<double, 3> log_gain{};
    double shading = 0.0;
    std::vector<double> background;  ///< terms × 3, channels running faster
    FitPlace place;
    double field_offset_deg = 0.0;
};
inline constexpr int place_unknowns = 4;  ///< shift x, y, rotation, field

/// Background polynomials over the frame, −1 to 1 each way: 0, 1, 3 or 6 of 1, x, y, x², xy, y².
std::array<double, 6> background_functions(const PixelFrame& frame, std::size_t sample);
/// r² over that of the corner.
double corner_distance2(const PixelFrame& frame, std::size_t sample);

}  // namespace ghostlight
