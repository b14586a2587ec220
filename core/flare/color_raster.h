#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ghostlight {

/// Channels of a picture that is accumulated: 1 (irradiance), or 4 (linear Rec.709 and irradiance).
inline constexpr int gray_channels = 1, color_channels = 4;

/// A directed edge in pixel coordinates (x right, y up, pixel (i, j) covers [i, i+1) × [j, j+1)),
/// with a linear value e + gx x + gy y in each channel. Everything to its right within its span of
/// y gains the value where the edge goes up and loses it where it goes down: see RasterEdge.
template <int C>
struct ColorEdge {
    double x0, y0, x1, y1;
    double e[C], gx[C], gy[C];
};

/// Flux (value × px²) that lands on a spot too small to have an irradiance.
template <int C>
struct ColorPoint {
    double x, y;
    double flux[C];
};

/// One pixel of an edge raster.
template <int C>
struct RasterCell {
    double now[C];    ///< belongs to this pixel alone
    double level[C];  ///< added to this pixel and all to its right
    double slope[C];  ///< the same, times the pixel's centre x
};

/// A picture of 1/scale of the full size, with a margin of `margin_px` around it.
struct RasterSize {
    int width_px = 0, height_px = 0;
    double scale = 1.0;
    int margin_px = 0;
};

/// Accumulates edges and points, given in full-size pixels, over a band of rows of a picture of
/// any RasterSize, with exact area coverage: BandRaster for several channels, in the widest vectors
/// that this machine has. Work goes with what is touched, not with the picture's size.
template <int C>
class ColorBand {
   public:
    /// The accumulators belong to the thread: one band at a time on each.
    ColorBand(const RasterSize& size, int first_row, int row_count);
    /// `open_right`: edges right of the frame are missing, so that light may reach to its end.
    void add(std::span<const ColorEdge<C>> edges, std::span<const std::uint32_t> chosen,
             bool open_right = false);
    void add(const ColorPoint<C>& point);
    /// Adds the mean values of the pixels that were touched, C a pixel, row by row; clears the
    /// accumulators.
    void resolve(std::span<float> pixels);

   private:
    RasterSize size_;
    int first_row_, row_count_;
    int first_column_, last_column_;  ///< touched
    std::vector<RasterCell<C>>& cells_;

    void touch(double low, double high);
};

}  // namespace ghostlight
