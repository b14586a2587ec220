// Compiled once per instruction set; see core/CMakeLists.txt. Nothing here may call an inline
// function that is shared with the rest of the program.
#include "core/flare/color_raster_kernel.h"

#include "core/lanes.h"

// Everything that takes or returns a vector here is inlined: there is no call whose form could
// differ between instruction sets.
#pragma GCC diagnostic ignored "-Wpsabi"

#define GHOSTLIGHT_JOIN_(a, b) a##b
#define GHOSTLIGHT_JOIN(a, b) GHOSTLIGHT_JOIN_(a, b)

namespace ghostlight::GHOSTLIGHT_JOIN(kernels_, GHOSTLIGHT_ISA) {
    namespace {

    template <int C>
    struct ValueOf {
        using type [[gnu::vector_size(C * sizeof(double))]] = double;
    };
    template <>
    struct ValueOf<1> {
        using type = double;
    };
    /// All channels of a pixel.
    template <int C>
    using Value = typename ValueOf<C>::type;

    template <int C>
    GHOSTLIGHT_INLINE Value<C> load(const double (&from)[C]) {
        Value<C> value;
        __builtin_memcpy(&value, from, sizeof value);
        return value;
    }
    template <int C>
    GHOSTLIGHT_INLINE void store(const Value<C>& value, double (&to)[C]) {
        __builtin_memcpy(to, &value, sizeof value);
    }

    GHOSTLIGHT_INLINE double least(double a, double b) { return b < a ? b : a; }
    GHOSTLIGHT_INLINE double most(double a, double b) { return a < b ? b : a; }
    /// Towards −∞, for what fits an int.
    GHOSTLIGHT_INLINE int floor_of(double x) {
        const int i = static_cast<int>(x);
        return static_cast<double>(i) > x ? i - 1 : i;
    }

    /// The value of an edge in the pixels of the picture that is drawn.
    template <int C>
    struct Linear {
        Value<C> e, gx, gy;
    };

    /// An edge's share of one row: ∫dy ∫ from the edge to the right, by the divergence theorem.
    template <int C>
    struct Row {
        RasterCell<C>* cells;
        const Linear<C>& value;

        GHOSTLIGHT_INLINE void all_right_of(int column, double dy, double y_mean) const {
            RasterCell<C>& cell = cells[column];
            store<C>(load<C>(cell.level) + dy * (value.e + value.gy * y_mean), cell.level);
            store<C>(load<C>(cell.slope) + dy * value.gx, cell.slope);
        }
        GHOSTLIGHT_INLINE void in_column(int column, double xa, double ya, double xb,
                                         double yb) const {
            const double dy = yb - ya, dx = xb - xa;
            const double y_mean = 0.5 * (ya + yb), x_mean = 0.5 * (xa + xb);
            const double right = column + 1.0;
            const double inside = right - x_mean;
            const double x2_mean = x_mean * x_mean + dx * dx * (1.0 / 12.0);
            const double in_e = dy * inside;
            const double in_gy = dy * (y_mean * inside - dx * dy * (1.0 / 12.0));
            const double in_gx = dy * 0.5 * (right * right - x2_mean);
            RasterCell<C>& cell = cells[column];
            store<C>(load<C>(cell.now) + in_e * value.e + in_gy * value.gy + in_gx * value.gx,
                     cell.now);
            all_right_of(column + 1, dy, y_mean);
        }
    };

    template <int C>
    void add_in_row(const Row<C>& row, double width, double x0, double y0, double x1, double y1) {
        const double low = least(x0, x1), high = most(x0, x1);
        if (low >= width) return;
        if (high <= 0.0) return row.all_right_of(0, y1 - y0, 0.5 * (y0 + y1));
        const int first = floor_of(low);
        if (low >= 0.0 && high <= first + 1.0) return row.in_column(first, x0, y0, x1, y1);
        const double dydx = (y1 - y0) / (x1 - x0);
        // Walk the columns from left to right; a leftward edge is the negative of its reverse.
        const bool rightwards = x1 > x0;
        double x = rightwards ? x0 : x1, y = rightwards ? y0 : y1;
        const double x_last = rightwards ? x1 : x0, y_last = rightwards ? y1 : y0;
        const double sign = rightwards ? 1.0 : -1.0;
        const Linear<C> signed_value{sign * row.value.e, sign * row.value.gx, sign * row.value.gy};
        const Row<C> walked{row.cells, signed_value};
        if (x < 0.0) {
            const double y_next = y - x * dydx;
            walked.all_right_of(0, y_next - y, 0.5 * (y + y_next));
            x = 0.0;
            y = y_next;
        }
        const double end = least(x_last, width);
        for (int column = static_cast<int>(x); x < end; ++column) {
            const double x_next = least(end, column + 1.0);
            const double y_next = x_next == x_last ? y_last : y + (x_next - x) * dydx;
            walked.in_column(column, x, y, x_next, y_next);
            x = x_next;
            y = y_next;
        }
    }

    template <int C>
    void add_one(const BandView<C>& band, const ColorEdge<C>& edge) {
        const bool upwards = edge.y1 > edge.y0;
        const double s = band.scale, m = band.margin;
        double xa = (upwards ? edge.x0 : edge.x1) * s + m;
        double ya = (upwards ? edge.y0 : edge.y1) * s + m;
        const double xb = (upwards ? edge.x1 : edge.x0) * s + m;
        const double yb = (upwards ? edge.y1 : edge.y0) * s + m;
        const double bottom = band.first_row, top = band.first_row + band.row_count;
        if (yb <= bottom || ya >= top || ya == yb) return;
        const double dxdy = (xb - xa) / (yb - ya);
        const double x_origin = xa, y_origin = ya;
        const double x_low = least(xa, xb), x_high = most(xa, xb);
        if (ya < bottom) {
            xa = least(x_high, most(x_low, x_origin + (bottom - y_origin) * dxdy));
            ya = bottom;
        }
        const double end = least(yb, top);
        const double sign = upwards ? 1.0 : -1.0;
        const Value<C> gx = load<C>(edge.gx), gy = load<C>(edge.gy);
        // The value is given over full-size pixels.
        const double per_px = 1.0 / s;
        const Linear<C> value{sign * (load<C>(edge.e) - (m * per_px) * (gx + gy)),
                              (sign * per_px) * gx, (sign * per_px) * gy};
        for (int row = floor_of(ya); ya < end; ++row) {
            const double y_next = least(end, row + 1.0);
            const double x_next =
                y_next >= yb ? xb
                             : least(x_high, most(x_low, x_origin + (y_next - y_origin) * dxdy));
            RasterCell<C>* cells = band.cells + static_cast<std::size_t>(row - band.first_row) *
                                                    static_cast<std::size_t>(band.width + 2);
            add_in_row(Row<C>{cells, value}, band.width, xa, ya, x_next, y_next);
            xa = x_next;
            ya = y_next;
        }
    }

    template <int C>
    void add_all(const BandView<C>& band) {
        for (std::size_t k = 0; k < band.count; ++k) add_one(band, band.edges[band.chosen[k]]);
    }

    template <int C>
    void resolve_all(const ResolveView<C>& view) {
        for (int row = 0; row < view.row_count; ++row) {
            RasterCell<C>* cells = view.cells + static_cast<std::size_t>(row) *
                                                    static_cast<std::size_t>(view.width + 2);
            float* out = view.pixels +
                         (static_cast<std::size_t>(row) * static_cast<std::size_t>(view.width) +
                          static_cast<std::size_t>(view.first_column)) *
                             C;
            Value<C> level{}, slope{};
            for (int i = view.first_column; i <= view.last_column; ++i) {
                level += load<C>(cells[i].level);
                slope += load<C>(cells[i].slope);
                double value[C];
                store<C>(load<C>(cells[i].now) + level + (i + 0.5) * slope, value);
                for (int c = 0; c < C; ++c) *out++ += static_cast<float>(value[c]);
            }
            // Two more: an edge in the last column changes the next one, too.
            __builtin_memset(
                cells + view.first_column, 0,
                static_cast<std::size_t>(view.last_column - view.first_column + 3) * sizeof *cells);
        }
    }

    }  // namespace

    void add_edges(const BandView<1>& band) { add_all(band); }
    void add_edges(const BandView<4>& band) { add_all(band); }
    void resolve_cells(const ResolveView<1>& view) { resolve_all(view); }
    void resolve_cells(const ResolveView<4>& view) { resolve_all(view); }

}  // namespace ghostlight::GHOSTLIGHT_JOIN(kernels_,GHOSTLIGHT_ISA)
