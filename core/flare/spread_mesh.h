#pragma once

#include <array>
#include <vector>

#include "core/flare/color_mesh.h"
#include "core/flare/light_pattern.h"
#include "core/flare/rung_mesh.h"

namespace ghostlight {

/// How a ghost's light moves over the sensor with the light's direction, in pixels per radian:
/// along the field (at `azimuth_rad` on the sensor), and across it.
struct GhostShift {
    double along_px = 0.0, across_px = 0.0;
};

/// A light's pattern as one ghost shows it: the shares of its irradiance over pixels of a picture
/// of some scale, (2 reach_x + 1) × (2 reach_y + 1) of them about the middle, sum 1.
struct SpreadKernel {
    int reach_x = 0, reach_y = 0;
    std::vector<float> shares;
};
SpreadKernel spread_kernel(const LightPattern& pattern, const LightDirection& light,
                           const GhostShift& shift, double scale);

/// Extent of the pattern on the sensor in full-size pixels: the smaller and the larger.
std::array<double, 2> spread_px(const LightPattern& pattern, const GhostShift& shift);

/// A picture of a part of a frame at 1/2^level of its size.
struct Spot {
    int level = 0;
    int left = 0, bottom = 0, width = 0, height = 0;  ///< in that level's pixels, margin included
    std::vector<float> values;                        ///< 4 a pixel
};

/// Draws a mesh alone and what its fringes change, moved by (dx, dy) full-size pixels and times
/// `gain` in each channel, and folds it with a kernel of its level.
Spot draw_spot(const ColorMesh<color_channels>& mesh, const RungMesh& rung, const PixelFrame& frame,
               int level, double dx_px, double dy_px, const std::array<double, 4>& gain,
               const SpreadKernel& kernel);

/// Folds a spot with a kernel of its level; it grows by the kernel's reach.
void fold_spot(const SpreadKernel& kernel, Spot& spot);

/// Adds a spot to a level's whole picture.
void add_spot(const Spot& spot, const PixelFrame& frame, std::vector<float>& picture);

}  // namespace ghostlight
