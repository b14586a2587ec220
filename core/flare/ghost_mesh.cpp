#include "core/flare/ghost_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/flare/thin_piece.h"

namespace ghostlight {
namespace {

/// Below this area a piece has no usable slope: its irradiance is constant over it.
constexpr double least_sloped_px2 = 0.25;
/// Below this it has no usable area: its flux is put along it as points.
constexpr double least_area_px2 = 1e-4;

struct Point {
    double x, y;
};

double signed_area(const Point& a, const Point& b, const Point& c) {
    return 0.5 * ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
}

template <class T>
class MeshBuilder {
   public:
    MeshBuilder(const SplitGrid<T>& all, const PixelFrame& frame, double gain)
        : all_(all), grid_(all.base), rays_(all.base.field.rays), frame_(frame), gain_(gain) {}

    GhostMesh build() {
        place_nodes();
        average_irradiance();
        const int triangles = 2 * grid_.cells * grid_.cells;
        values_.assign(static_cast<std::size_t>(triangles), {});
        for_each_piece(
            all_, [&](const BundleGrid<T>& on, const Piece& piece) { add(piece, &on == &grid_); });
        add_shared_edges();
        return std::move(mesh_);
    }

   private:
    const SplitGrid<T>& all_;
    const BundleGrid<T>& grid_;
    const Bundle<T>& rays_;
    const PixelFrame& frame_;
    double gain_;
    GhostMesh mesh_;
    std::vector<Point> nodes_;
    std::vector<double> irradiance_;   ///< per node
    std::vector<LinearValue> values_;  ///< per whole triangle, signed for a clockwise drawing

    void place_nodes() {
        nodes_.reserve(rays_.size());
        for (std::size_t i = 0; i < rays_.size(); ++i)
            nodes_.push_back({frame_.column(static_cast<double>(rays_.x_mm[i])),
                              frame_.row(static_cast<double>(rays_.y_mm[i]))});
    }

    /// Entrance area over sensor area, both summed over the triangles about a node.
    void average_irradiance() {
        std::vector<double> area_out(rays_.size(), 0.0);
        std::vector<int> count(rays_.size(), 0);
        const int side = grid_.cells + 1;
        const double du = static_cast<double>(rays_.u_mm[1]) - static_cast<double>(rays_.u_mm[0]);
        const double dv = static_cast<double>(rays_.v_mm[static_cast<std::size_t>(side)]) -
                          static_cast<double>(rays_.v_mm[0]);
        const double area_in = 0.5 * std::abs(du * dv);
        for (int t = 0; t < 2 * grid_.cells * grid_.cells; ++t) {
            const TriangleNodes n = triangle_nodes(grid_.cells, t);
            bool valid = true;
            for (const int node : n.node) valid = valid && rays_.margin[idx(node)] >= T(0);
            if (!valid) continue;
            const double area = std::abs(signed_area(nodes_[idx(n.node[0])], nodes_[idx(n.node[1])],
                                                     nodes_[idx(n.node[2])])) *
                                frame_.pixel_area_mm2();
            for (const int node : n.node) {
                area_out[idx(node)] += area;
                ++count[idx(node)];
            }
        }
        irradiance_.assign(rays_.size(), 0.0);
        for (std::size_t i = 0; i < rays_.size(); ++i)
            if (area_out[i] > 0.0)
                irradiance_[i] =
                    gain_ * static_cast<double>(rays_.weight[i]) * area_in * count[i] / area_out[i];
    }

    static std::size_t idx(int i) { return static_cast<std::size_t>(i); }

    /// The plane through the nodes' irradiances over a triangle.
    LinearValue plane(const TriangleNodes& n) const {
        const Point &a = nodes_[idx(n.node[0])], &b = nodes_[idx(n.node[1])],
                    &c = nodes_[idx(n.node[2])];
        const double ea = irradiance_[idx(n.node[0])], eb = irradiance_[idx(n.node[1])],
                     ec = irradiance_[idx(n.node[2])];
        const double inverse = 0.5 / signed_area(a, b, c);
        LinearValue value;
        value.gx = ((eb - ea) * (c.y - a.y) - (ec - ea) * (b.y - a.y)) * inverse;
        value.gy = ((ec - ea) * (b.x - a.x) - (eb - ea) * (c.x - a.x)) * inverse;
        value.e = ea - value.gx * a.x - value.gy * a.y;
        return value;
    }

    /// Pieces of split cells stand alone, with a constant irradiance each.
    void add(const Piece& piece, bool on_base) {
        const double flux = gain_ * flux_mm2(piece);
        if (flux == 0.0) return;
        mesh_.flux_mm2 += flux;
        ++mesh_.cells;
        Point corner[Piece::max_corners];
        double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;
        for (int k = 0; k < piece.count; ++k) {
            corner[k] = {frame_.column(piece.corners[k].x_mm), frame_.row(piece.corners[k].y_mm)};
            left = std::min(left, corner[k].x);
            right = std::max(right, corner[k].x);
            bottom = std::min(bottom, corner[k].y);
            top = std::max(top, corner[k].y);
        }
        // All left of the frame matters no more than all right of it: edges of one piece cancel.
        if (right <= 0.0 || left >= frame_.width_px || top <= 0.0 || bottom >= frame_.height_px)
            return;
        const double flux_px = flux / frame_.pixel_area_mm2();
        double area = 0.0;
        for (int k = 1; k + 1 < piece.count; ++k)
            area += signed_area(corner[0], corner[k], corner[k + 1]);
        const double size = std::abs(area);
        if (size < least_area_px2) return add_points(corner, piece.count, flux_px);

        const LinearValue value = on_base ? linear_value(piece, corner, size, flux_px)
                                          : LinearValue{flux_px / size, 0.0, 0.0};
        // Clockwise pieces add, so a counter-clockwise one is drawn with the opposite sign.
        const LinearValue drawn = area > 0.0 ? -1.0 * value : value;
        if (piece.whole && on_base) {
            values_[idx(piece.triangle)] = drawn;
        } else {
            for (int k = 0; k < piece.count; ++k)
                emit(corner[k], corner[(k + 1) % piece.count], drawn);
        }
    }

    LinearValue linear_value(const Piece& piece, const Point* corner, double size,
                             double flux_px) const {
        const LinearValue constant{flux_px / size, 0.0, 0.0};
        if (size < least_sloped_px2) return constant;
        const TriangleNodes n = triangle_nodes(grid_.cells, piece.triangle);
        for (const int node : n.node)
            if (rays_.margin[idx(node)] < T(0)) return constant;
        const LinearValue value = plane(n);
        double integral = 0.0;
        for (int k = 1; k + 1 < piece.count; ++k) {
            const Point &a = corner[0], &b = corner[k], &c = corner[k + 1];
            integral +=
                std::abs(signed_area(a, b, c)) *
                (value.e + value.gx * (a.x + b.x + c.x) / 3.0 + value.gy * (a.y + b.y + c.y) / 3.0);
        }
        if (!(integral > 0.0)) return constant;
        return (flux_px / integral) * value;
    }

    void add_points(const Point* corner, int count, double flux_px) {
        for_each_spot(corner, count, [&](double x, double y, int parts) {
            if (x >= 0.0 && x < frame_.width_px && y >= 0.0 && y < frame_.height_px)
                mesh_.points.push_back({x, y, flux_px / parts});
        });
    }

    void emit(const Point& a, const Point& b, const LinearValue& value) {
        if (value.is_zero() || a.y == b.y) return;
        if (std::min(a.x, b.x) >= frame_.width_px || std::max(a.y, b.y) <= 0.0 ||
            std::min(a.y, b.y) >= frame_.height_px)
            return;
        mesh_.edges.push_back({a.x, a.y, b.x, b.y, value});
    }

    /// Inner edges once, with the difference of the two sides.
    void add_shared_edges() {
        const int across = grid_.cells, side = across + 1;
        auto value = [&](int i, int j, int half) {
            if (i < 0 || j < 0 || i >= across || j >= across) return LinearValue{};
            return values_[idx(2 * (j * across + i) + half)];
        };
        auto node = [&](int i, int j) -> const Point& { return nodes_[idx(j * side + i)]; };
        // Below a cell's diagonal lies its triangle 0, above it triangle 1 (see triangle_nodes).
        auto mirrored = [&](int i) { return 2 * i >= across; };
        auto left = [&](int i, int j) { return value(i, j, mirrored(i) ? 1 : 0); };
        auto right = [&](int i, int j) { return value(i, j, mirrored(i) ? 0 : 1); };
        for (int j = 0; j <= across; ++j)
            for (int i = 0; i <= across; ++i) {
                if (i < across)
                    emit(node(i, j), node(i + 1, j), value(i, j, 0) - value(i, j - 1, 1));
                if (j < across) emit(node(i, j + 1), node(i, j), left(i, j) - right(i - 1, j));
                if (i < across && j < across) {
                    const LinearValue across_diagonal = value(i, j, 0) - value(i, j, 1);
                    if (mirrored(i))
                        emit(node(i + 1, j + 1), node(i, j), across_diagonal);
                    else
                        emit(node(i + 1, j), node(i, j + 1), across_diagonal);
                }
            }
    }
};

}  // namespace

PixelFrame pixel_frame(double sensor_width_mm, double sensor_height_mm, int width_px) {
    PixelFrame frame;
    frame.width_px = width_px;
    frame.pitch_mm = sensor_width_mm / width_px;
    frame.height_px = std::max(1, static_cast<int>(std::lround(sensor_height_mm / frame.pitch_mm)));
    frame.left_mm = -0.5 * sensor_width_mm;
    frame.bottom_mm = -0.5 * frame.height_px * frame.pitch_mm;
    return frame;
}

template <class T>
GhostMesh ghost_mesh(const SplitGrid<T>& grid, const PixelFrame& frame, double gain) {
    return MeshBuilder<T>(grid, frame, gain).build();
}
template GhostMesh ghost_mesh(const SplitGrid<float>&, const PixelFrame&, double);
template GhostMesh ghost_mesh(const SplitGrid<double>&, const PixelFrame&, double);

}  // namespace ghostlight
