#pragma once

#include <vector>

#include "core/flare/color_raster.h"
#include "core/flare/ghost_mesh.h"

namespace ghostlight {

/// A picture at full size and at halved sizes: what is broad and faint is drawn small and
/// brought up in the end. Level l has 1/2^l of the size and, but for level 0, a margin of one
/// pixel, so that bringing it up needs no special case at the frame's edge.
inline constexpr int picture_levels = 5;

RasterSize level_size(const PixelFrame& frame, int level);

/// What blurring by drawing at a level misplaces, as a share of edge_contrast (irradiance × px):
/// a pixel's box and the tent that brings it up have a standard deviation of half a pixel.
double blur_px(int level);
/// The same of slope_contrast (irradiance): half the blur's variance along an axis, px².
double blur_px2(int level);

/// Adds the next coarser level to rows of `finer`, by linear interpolation: light is conserved.
/// Rows count from the bottom of the finer picture, its margin included.
template <int C>
void add_coarser_rows(const std::vector<float>& coarser, const RasterSize& coarser_size,
                      const RasterSize& finer_size, int first_row, int last_row,
                      std::vector<float>& finer);

}  // namespace ghostlight
