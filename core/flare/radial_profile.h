#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/flare/ghost_mesh.h"

namespace ghostlight {

/// Light that is round about the middle of a picture: collected over the radius in bins of 1/16
/// pixel, each holding its flux exactly, and drawn once for all that was added. C channels.
template <int C>
class RadialProfile {
   public:
    explicit RadialProfile(const PixelFrame& frame);

    /// Adds flux (value × px²) spread evenly over the ring between two radii, px, in any order.
    void add(double radius_px, double other_px, const std::array<double, C>& flux);
    void add(const RadialProfile& other);

    /// Means over the pixels of rows of the lower half (row < (height + 1) / 2) and their columns
    /// of the left half, ready for draw_row().
    struct Filtered;
    Filtered filtered() const;

    /// The radius of the frame's corners, px.
    double reach_px() const { return reach_px_; }

   private:
    PixelFrame frame_;
    double reach_px_;
    std::vector<double> now_, level_;  ///< by bin and channel: in it; in it and all beyond, a px²

    void step(double radius_px, const std::array<double, C>& value);
};

/// A profile as pixels see it. A pixel is a box of one pixel's breadth along its rows and columns,
/// a triangle of the same variance along the diagonals, and between them in between; its middle
/// lies 1/(24 r) too near to the axis. Pixels about the axis are summed up from the rings' flux.
template <int C>
struct RadialProfile<C>::Filtered {
    PixelFrame frame;
    std::vector<float> box, triangle;  ///< by place, 16 a pixel, and channel
    int near_px = 0;                   ///< of the square about the axis, half its side
    std::vector<float> near;           ///< 2 near_px a side, row by row from its lower left corner

    /// The pixels of a row from the left edge to the middle, C values each.
    void draw_row(int row, std::span<float> pixels) const;
};

}  // namespace ghostlight
