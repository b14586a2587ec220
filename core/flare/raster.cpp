#include "core/flare/raster.h"

#include <algorithm>
#include <cmath>

namespace ghostlight {

BandRaster::BandRaster(int width_px, int first_row, int row_count)
    : width_(width_px),
      first_row_(first_row),
      row_count_(row_count),
      cells_(static_cast<std::size_t>(width_px + 2) * static_cast<std::size_t>(row_count)) {}

/// A part of an edge within one row: ∫dy ∫ from the edge to the right, by the divergence theorem.
void BandRaster::add_in_row(Cell* row, double x0, double y0, double x1, double y1,
                            const LinearValue& value) {
    auto all_right_of = [&](int column, double dy, double y_mean) {
        row[column].level += dy * (value.e + value.gy * y_mean);
        row[column].slope += dy * value.gx;
    };
    auto in_column = [&](int column, double xa, double ya, double xb, double yb) {
        const double dy = yb - ya, dx = xb - xa;
        const double y_mean = 0.5 * (ya + yb), x_mean = 0.5 * (xa + xb);
        const double right = column + 1.0;
        const double inside = right - x_mean;
        const double x2_mean = x_mean * x_mean + dx * dx / 12.0;
        row[column].now += dy * (value.e * inside + value.gy * (y_mean * inside - dx * dy / 12.0) +
                                 0.5 * value.gx * (right * right - x2_mean));
        all_right_of(column + 1, dy, y_mean);
    };
    const double width = width_;
    const double low = std::min(x0, x1), high = std::max(x0, x1);
    if (low >= width) return;
    if (high <= 0.0) return all_right_of(0, y1 - y0, 0.5 * (y0 + y1));
    const int first = static_cast<int>(std::floor(low));
    if (low >= 0.0 && high <= first + 1.0) return in_column(first, x0, y0, x1, y1);
    // Walk the columns in the edge's own direction.
    const double dydx = (y1 - y0) / (x1 - x0);
    const bool rightwards = x1 > x0;
    double x = x0, y = y0;
    auto advance = [&](double to, auto&& put) {
        const double y_to = to == x1 ? y1 : y0 + (to - x0) * dydx;
        put(x, y, to, y_to);
        x = to;
        y = y_to;
    };
    auto left_part = [&](double, double ya, double, double yb) {
        all_right_of(0, yb - ya, 0.5 * (ya + yb));
    };
    if (rightwards) {
        if (x < 0.0) advance(0.0, left_part);
        const double end = std::min(x1, width);
        for (int column = static_cast<int>(x); x < end; ++column)
            advance(std::min(end, column + 1.0), [&](double xa, double ya, double xb, double yb) {
                in_column(column, xa, ya, xb, yb);
            });
    } else {
        if (x > width) advance(width, [](double, double, double, double) {});
        const double end = std::max(x1, 0.0);
        for (int column = static_cast<int>(std::ceil(x)) - 1; x > end; --column)
            advance(std::max(end, static_cast<double>(column)),
                    [&](double xa, double ya, double xb, double yb) {
                        in_column(column, xa, ya, xb, yb);
                    });
        if (x > x1) advance(x1, left_part);
    }
}

void BandRaster::add(const RasterEdge& edge) {
    const bool upwards = edge.y1 > edge.y0;
    double xa = upwards ? edge.x0 : edge.x1, ya = upwards ? edge.y0 : edge.y1;
    const double xb = upwards ? edge.x1 : edge.x0, yb = upwards ? edge.y1 : edge.y0;
    const double bottom = first_row_, top = first_row_ + row_count_;
    if (yb <= bottom || ya >= top || ya == yb) return;
    const double dxdy = (xb - xa) / (yb - ya);
    const double y_origin = ya, x_origin = xa;
    auto x_of = [&](double y) {
        return y >= yb ? xb
                       : std::clamp(x_origin + (y - y_origin) * dxdy, std::min(x_origin, xb),
                                    std::max(x_origin, xb));
    };
    if (ya < bottom) {
        xa = x_of(bottom);
        ya = bottom;
    }
    const double end = std::min(yb, top);
    const LinearValue value = upwards ? edge.value : -1.0 * edge.value;
    for (int row = static_cast<int>(std::floor(ya)); ya < end; ++row) {
        const double y_next = std::min(end, row + 1.0);
        const double x_next = x_of(y_next);
        Cell* cells = cells_.data() + static_cast<std::size_t>(row - first_row_) *
                                          static_cast<std::size_t>(width_ + 2);
        add_in_row(cells, xa, ya, x_next, y_next, value);
        xa = x_next;
        ya = y_next;
    }
}

void BandRaster::add_point(double x, double y, double flux) {
    const int column = static_cast<int>(std::floor(x));
    const int row = static_cast<int>(std::floor(y)) - first_row_;
    if (!(x >= 0.0) || column >= width_ || row < 0 || row >= row_count_) return;
    cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_ + 2) +
           static_cast<std::size_t>(column)]
        .now += flux;
}

void BandRaster::resolve(std::span<double> pixels) {
    double* out = pixels.data();
    for (int row = 0; row < row_count_; ++row) {
        Cell* cells =
            cells_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(width_ + 2);
        double level = 0.0, slope = 0.0;
        for (int i = 0; i < width_; ++i) {
            level += cells[i].level;
            slope += cells[i].slope;
            *out++ = cells[i].now + level + slope * (i + 0.5);
            cells[i] = {};
        }
        cells[width_] = {};
        cells[width_ + 1] = {};
    }
}

}  // namespace ghostlight
