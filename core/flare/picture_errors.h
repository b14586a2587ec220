#pragma once

#include <vector>

namespace ghostlight {

/// How far a ghost layer is from the true one, by several measures: each is blind to something.
/// Both are irradiances of the same pixels, the direct image not among them.
struct PictureErrors {
    double relative_l1 = 0.0;  ///< Σ|difference| / Σ truth: the headline
    double energy = 0.0;       ///< Σ picture / Σ truth − 1
    /// Mean over pixels of |a − b| / (a + b + floor), the floor 1 % of the truth's mean.
    double smape = 0.0;
    /// Mean absolute difference of log₂(irradiance + floor), in stops, over the pixels where the
    /// truth is above the floor.
    double log_stops = 0.0;
    /// HDR-FLIP (flip.h), 0 to 1: what the eye makes of it. Not filled in by picture_errors().
    double flip = 0.0;
};
PictureErrors picture_errors(const std::vector<float>& picture, const std::vector<float>& truth);

/// Light, place and size of a picture's light.
struct PictureMoments {
    double flux_mm2 = 0.0, x_mm = 0.0, y_mm = 0.0, rms_radius_mm = 0.0;
};
/// `width_px` pixels of `pitch_mm` a row, about the axis.
PictureMoments picture_moments(const std::vector<float>& irradiance, int width_px, double pitch_mm);

}  // namespace ghostlight
