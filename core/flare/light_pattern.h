#pragma once

#include <vector>

#include "core/optics/trace.h"

namespace ghostlight {

/// Where a light of some extent is bright: shares of its irradiance over a raster of directions
/// around its middle, as a camera sees it upright: row 0 at the top, column 0 at the left. Without
/// cells the light is a point.
struct LightPattern {
    int width = 0, height = 0;
    double cell_rad = 0.0;      ///< breadth of a cell
    std::vector<float> shares;  ///< sum 1
    bool is_point() const { return shares.empty(); }
    /// Half the diagonal.
    double radius_rad() const;
};

/// An evenly bright disc, cells at its rim by the share they have inside.
LightPattern disc_pattern(double diameter_deg);

/// From a picture's luminances, row 0 at the top; averaged down to at most `most_cells` across,
/// negative values and NaN taken as dark. Throws Error when all is dark.
LightPattern picture_pattern(const std::vector<float>& luminance, int width, int height,
                             double width_deg);
inline constexpr int most_pattern_cells = 48;

/// A part of a pattern about a direction of its own.
struct PatternPatch {
    LightPattern pattern;  ///< shares sum to 1
    double share = 1.0;    ///< of the whole
    LightDirection light;
};
/// Cuts a pattern into `across` × `across` patches, each about the middle of its cells; dark ones
/// are left out. Shares sum to 1.
std::vector<PatternPatch> patches(const LightPattern& pattern, const LightDirection& light,
                                  int across);

/// Direction of a light that is seen `right_rad` to the right and `up_rad` above another one.
LightDirection offset_light(const LightDirection& light, double right_rad, double up_rad);

/// The same offset in the light's own frame: along the growing field angle, and across it along
/// the growing azimuth.
struct FieldOffset {
    double along_rad = 0.0, across_rad = 0.0;
};
FieldOffset field_offset(const LightDirection& light, double right_rad, double up_rad);

}  // namespace ghostlight
