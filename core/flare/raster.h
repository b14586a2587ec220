#pragma once

#include <span>
#include <vector>

namespace ghostlight {

/// A linear function of pixel coordinates, e + gx x + gy y.
struct LinearValue {
    double e = 0.0, gx = 0.0, gy = 0.0;
    friend LinearValue operator-(const LinearValue& a, const LinearValue& b) {
        return {a.e - b.e, a.gx - b.gx, a.gy - b.gy};
    }
    friend LinearValue operator*(double s, const LinearValue& a) {
        return {s * a.e, s * a.gx, s * a.gy};
    }
    bool is_zero() const { return e == 0.0 && gx == 0.0 && gy == 0.0; }
};

/// A directed edge in pixel coordinates (x right, y up, pixel (i, j) covers [i, i+1) × [j, j+1)).
/// Everything to its right within its span of y gains `value` where the edge goes up and loses it
/// where it goes down: the edges of a clockwise polygon, each with the polygon's value, add
/// exactly value × coverage to every pixel. Edges shared by two polygons
/// carry the difference of their values, so that each is drawn once.
struct RasterEdge {
    double x0, y0, x1, y1;
    LinearValue value;
};

/// Accumulates edges with exact area coverage over a band of pixel rows. The cost is that of the
/// edges' lengths, not of the areas between them, sub-pixel polygons keep their flux, and folded
/// sheets add. Sums are in double: what enters at a polygon's left edge leaves at its right one to
/// rounding.
class BandRaster {
   public:
    BandRaster(int width_px, int first_row, int row_count);
    void add(const RasterEdge& edge);
    /// Adds a flux (value × px²) to the pixel of a point, if it is in the band.
    void add_point(double x, double y, double flux);
    /// Mean values of the pixels, row by row; clears the accumulators.
    void resolve(std::span<double> pixels);

   private:
    struct Cell {
        double now = 0.0;    ///< belongs to this pixel alone
        double level = 0.0;  ///< added to this pixel and all to its right
        double slope = 0.0;  ///< the same, times the pixel's centre x
    };
    void add_in_row(Cell* row, double x0, double y0, double x1, double y1,
                    const LinearValue& value);

    int width_, first_row_, row_count_;
    std::vector<Cell> cells_;
};

}  // namespace ghostlight
