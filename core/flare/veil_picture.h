#pragma once

#include "core/flare/flare_image.h"
#include "core/flare/ghost_mesh.h"
#include "core/flare/veiling_glare.h"

namespace ghostlight {

/// The series is evaluated at 1/2^k of a picture's size, as its narrowest ghost allows: this k.
int veil_level(double narrowest_mm, const PixelFrame& frame);

/// A series as a picture, interpolated linearly between the points where it is evaluated. Fills rgb
/// and irradiance, which have the frame's size already; negative irradiance, as of an ellipse that
/// rings about zero, becomes none.
void draw_veil(const VeilSeries& series, double narrowest_mm, const PixelFrame& frame,
               unsigned threads, FlareImage& image);

}  // namespace ghostlight
