#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace ghostlight {

/// Variance of a pixel's value: shot × signal + read, values as in `Photo::rgb`.
struct PhotoNoise {
    double shot = 0.0;
    double read = 0.0;
    bool estimated = false;  ///< from the picture itself, not from what its file says
    bool operator==(const PhotoNoise&) const = default;
};

/// Why a pixel says nothing about the flare.
namespace mask_reason {
inline constexpr char saturated = 1, not_a_number = 2, hot = 3, light = 4, painted = 5, cropped = 6;
}

/// A photograph, linear in the light. Row 0 is the lowest y, column 0 the lowest x, as seen on the
/// sensor plane, like FlareImage; files hold upright pictures (upright_picture() converts).
struct Photo {
    int width_px = 0, height_px = 0;
    std::vector<float> rgb;    ///< 3 a pixel; 1 is where the camera saturates
    std::vector<char> masked;  ///< 1 a pixel: 0, or a mask_reason
    double saturation = 1.0;   ///< values from here on are clipped; infinite where nothing is
    PhotoNoise noise;
    /// Relative: how far values may be off because the curve that made them linear is a guess. 0
    /// where the camera wrote linear values.
    double curve_error = 0.0;
    std::optional<double> exposure_s, f_number, focal_length_mm;
    std::string camera, taken;
    std::string file;
    Notes notes;

    std::size_t pixels() const {
        return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    }
    const float* at(int column, int row) const {
        return &rgb[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px) +
                         static_cast<std::size_t>(column))];
    }
};

/// Noise from the picture itself: differences of neighbours, which a smooth flare hardly has,
/// against the level; a robust line through their medians.
PhotoNoise estimated_noise(const Photo& photo);

/// Pixels by reason.
struct MaskCounts {
    std::size_t saturated = 0, not_a_number = 0, hot = 0, light = 0, painted = 0, cropped = 0;
    std::size_t all() const { return saturated + not_a_number + hot + light + painted + cropped; }
};
MaskCounts count_masked(const Photo& photo);

/// Masks what is clipped (and its neighbours, into which light spills), what is not a number, and,
/// where the noise is known, hot pixels. Returns how many each, neighbours of the clipped ones not
/// among them. Throws Error where nothing is left: all black, all saturated, all NaN.
MaskCounts mask_unusable(Photo& photo);

/// Masks pixels that stand out of all their eight neighbours by ten standard deviations. Returns
/// how many. Needs `noise`.
std::size_t mask_hot(Photo& photo);

/// Exposures of one scene merged into one: each pixel the mean of those that are not masked there,
/// weighted by exposure time over noise variance (the inverse of each value's variance after
/// division by the time; Debevec and Malik 1997 with weights of known noise). In units of the
/// longest exposure. Throws Error for sizes that differ, or times that are missing.
Photo merged(const std::vector<Photo>& exposures);

/// Where the light's own image is: the centre of the largest patch of the brightest pixels, which
/// may be saturated, in pixels of the sensor's frame from its lower left corner. Throws Error where
/// nothing stands out.
struct LightSpot {
    double column = 0.0, row = 0.0;
    double radius_px = 0.0;  ///< of a disc of the patch's area
    std::size_t pixels = 0;
};
LightSpot find_light(const Photo& photo);

/// How far the light's own image and the core of its starburst reach, pixels from its middle: to
/// where rings about it are no more than half above the level further out, at least `least_px` and
/// at most 8 % of the width.
double light_core_px(const Photo& photo, double column, double row, double least_px);

/// Masks a disc as the light's, pixels of the sensor's frame.
void mask_disc(Photo& photo, double column, double row, double radius_px);

}  // namespace ghostlight
