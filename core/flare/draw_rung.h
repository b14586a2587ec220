#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/flare/color_raster.h"
#include "core/flare/rung_mesh.h"

namespace ghostlight {

/// What fringes are added to: rows of a picture, or of a part of one, of any RasterSize.
struct RungCanvas {
    RasterSize size;
    /// Of its lower left corner, in its own pixels from that of `size`'s picture.
    double left_px = 0.0, bottom_px = 0.0;
    float* irradiance = nullptr;
    std::size_t irradiance_step = 1;
    float* rgb = nullptr;  ///< null: irradiance alone
    std::size_t rgb_step = 3;
};
/// 1 or 4 channels a pixel, side by side.
RungCanvas canvas_of(std::vector<float>& values, int channels, const RasterSize& size);

/// Triangles by the bands of rows they touch.
std::vector<std::vector<std::uint32_t>> sorted_by_band(const RungMesh& mesh, const RasterSize& size,
                                                       int band_rows);

/// Adds what diffraction changes, row by row from first_row to before last_row: irradiance × the
/// product of all rims' profiles, less what the picture has. Along a triangle w is linear.
void draw_rung(const RungMesh& mesh, std::span<const std::uint32_t> triangles,
               const RungCanvas& canvas, int first_row, int last_row);

}  // namespace ghostlight
