#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/flare/color_raster.h"
#include "core/flare/rung_kernel.h"
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

/// A ghost's fringes, ready to be added to bands of rows of one canvas: what all bands share is
/// worked out once, so that several threads may draw them.
class RungDrawing {
   public:
    /// Nothing to draw.
    RungDrawing() = default;
    /// The mesh must outlive this.
    RungDrawing(const RungMesh& mesh, const RungCanvas& canvas, int band_rows);
    RungDrawing(RungDrawing&&) = default;
    RungDrawing& operator=(RungDrawing&&) = default;
    RungDrawing(const RungDrawing&) = delete;  // rims point into tables
    RungDrawing& operator=(const RungDrawing&) = delete;

    /// Adds what diffraction changes: irradiance × the product of all rims' profiles, less what the
    /// picture has. Along a triangle w is linear.
    void draw(int band) const;

   private:
    /// A value that is linear over a triangle.
    struct Linear {
        float first = 0.0F, right = 0.0F, up = 0.0F;  ///< at the first corner; per pixel
    };
    /// A side that crosses rows, from its lower end, so that both neighbours compute the same.
    struct Side {
        double row = 0.0, column = 0.0;  ///< where it begins
        double step = 0.0;               ///< columns per row
        double at(double middle) const { return column + (middle - row) * step; }
    };
    /// A rim over a triangle: w is `light` and more where it is nothing but light, −`dark` and
    /// less where it is dark, in the picture, too.
    struct Rim {
        Linear w;
        float per_step = 0.0F;  ///< 1 over the change of w from pixel to pixel of a row
        float per_ramp = 0.0F;  ///< 1 over the change of w along the picture's own rim
        float dark = 0.0F, light = 0.0F;
        float first_step = 0.0F;                       ///< of w = 0
        const std::vector<RimColor>* table = nullptr;  ///< a pixel's means
        std::uint32_t group = 0;
        RimKind kind = RimKind::sharp;
    };
    struct Placed {
        double x = 0.0, y = 0.0;  ///< its first corner
        int first_row = 0, last_row = 0;
        Side long_side, low_side, high_side;  ///< over all rows, below and above `middle`
        double middle = 0.0;
        Linear light, u, v;
        std::uint32_t first_rim = 0, rim_count = 0;
    };

    const RungMesh* mesh_ = nullptr;
    RungCanvas canvas_;
    int band_rows_ = 1;
    std::vector<Placed> triangles_;
    std::vector<Rim> rims_;
    std::vector<std::uint32_t> first_of_band_, by_band_;
    /// A group's profile as pixels have it, by group and by half their breadth in its steps.
    std::map<std::pair<std::uint32_t, int>, std::vector<RimColor>> tables_;

    void place(const RungTriangle& triangle);
    Rim rim_of(std::uint32_t group, const Linear& w);
    void sort_by_band();
    void draw_row(const Placed& triangle, int row, int first, int last,
                  std::vector<RungRimView>& rims) const;
    void draw_piece(const Placed& triangle, int row, int first, int last,
                    std::vector<RungRimView>& rims) const;
};

}  // namespace ghostlight
