#pragma once

#include <stop_token>
#include <vector>

#include "core/flare/color_mesh.h"
#include "core/flare/flare_image.h"

namespace ghostlight {

/// A ghost to be drawn, and at which level of the picture (picture_levels.h).
template <int C>
struct DrawnGhost {
    ColorMesh<C> mesh;
    int level = 0;
};

/// A black picture of a lens's sensor.
FlareImage empty_image(const OpticalSystem& system, const PixelFrame& frame);

/// Draws ghosts level by level, brings the levels together, and fills rgb, irradiance, flux on the
/// sensor and the times of raster and composite. Rows in bands, each by one thread and in the
/// ghosts' order, so that the picture does not depend on the number of threads. False when stopped.
template <int C>
bool draw_picture(const std::vector<DrawnGhost<C>>& ghosts, const PixelFrame& frame,
                  unsigned threads, const std::stop_token& stop, FlareImage& image);

/// The same for FlareImage::highlight.
bool draw_highlight(const std::vector<DrawnGhost<gray_channels>>& ghosts, const PixelFrame& frame,
                    unsigned threads, const std::stop_token& stop, FlareImage& image);

}  // namespace ghostlight
