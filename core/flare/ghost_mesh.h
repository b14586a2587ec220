#pragma once

#include <vector>

#include "core/flare/raster.h"
#include "core/ghosts/cells.h"

namespace ghostlight {

/// The sensor's rectangle as pixels.
struct PixelFrame {
    int width_px = 1280, height_px = 853;
    double pitch_mm = 36.0 / 1280;
    double left_mm = -18.0, bottom_mm = -12.0;

    double column(double x_mm) const { return (x_mm - left_mm) / pitch_mm; }
    double row(double y_mm) const { return (y_mm - bottom_mm) / pitch_mm; }
    double pixel_area_mm2() const { return pitch_mm * pitch_mm; }
};
/// Square pixels of sensor width / width_px; the height is rounded to whole pixels about the axis.
PixelFrame pixel_frame(double sensor_width_mm, double sensor_height_mm, int width_px);

/// Flux that lands within a pixel's breadth of a line: pieces too thin to have an irradiance.
struct RasterPoint {
    double x, y, flux;
};

/// A ghost as the raster takes it: irradiance / E0 as linear values between edges, and points.
struct GhostMesh {
    std::vector<RasterEdge> edges;
    std::vector<RasterPoint> points;
    double flux_mm2 = 0.0;  ///< Σ weight dA over all pieces, on or off the sensor
    std::size_t cells = 0;  ///< pieces that pass
};

/// Turns a traced grid into edges. Each piece carries its flux exactly: its irradiance is linear
/// over the piece (from areas averaged at the grid's nodes) and scaled so that its integral is the
/// piece's flux. What is off the frame on a side that cannot matter is dropped, its flux counted.
template <class T>
GhostMesh ghost_mesh(const SplitGrid<T>& grid, const PixelFrame& frame, double gain);

}  // namespace ghostlight
