#include "core/flare/color_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/flare/thin_piece.h"

namespace ghostlight {
namespace {

/// Below this area a piece has no usable slope: its irradiance is constant over it.
constexpr double least_sloped_px2 = 0.25;
/// Below this it has no usable area: its flux is put along it as points.
constexpr double least_area_px2 = 1e-4;
/// Halves of a cell whose areas differ by more are on a fold or beside one.
constexpr double least_even_share = 0.05;
/// Spreading a spot's flux over pixels misplaces all of it.
constexpr double spot_contrast_per_px = 2.0;
/// Of the steps between the planes of whole cells, how much is the picture's own: the rest comes
/// from drawing a smooth density in planes, and blurring it is no loss.
constexpr double facet_contrast = 0.25;
/// The same of the sides of triangles on a fold.
constexpr double fold_contrast = 0.5;
/// A plane whose integral is further from the piece's flux says nothing about it.
constexpr double most_rescaled = 4.0;

struct Point {
    double x, y;
};
double cross(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/// e + gx x + gy y in every channel.
template <int C>
struct Plane {
    std::array<double, C> e{}, gx{}, gy{};
    bool is_set = false;

    double at(int c, const Point& p) const {
        const auto k = static_cast<std::size_t>(c);
        return e[k] + gx[k] * p.x + gy[k] * p.y;
    }
};

struct Corner {
    double share[3];  ///< of the triangle's nodes
};
constexpr int most_corners = 40;

template <int C>
class Builder {
   public:
    Builder(const MeshNodes& nodes, const PixelFrame& frame, ColorMesh<C>& mesh)
        : n_(nodes), frame_(frame), mesh_(mesh), across_(nodes.cells), side_(nodes.cells + 1) {}

    void build() {
        judge_nodes();
        average_density();
        planes_.assign(idx(across_ * across_), {});
        for (int j = 0; j < across_; ++j)
            for (int i = 0; i < across_; ++i) add_cell(i, j);
        add_shared_edges();
    }

   private:
    const MeshNodes& n_;
    const PixelFrame& frame_;
    ColorMesh<C>& mesh_;
    int across_, side_;
    std::vector<char> inside_, valid_;
    std::vector<float> density_;    ///< per node: entrance area over sensor area
    std::vector<Plane<C>> planes_;  ///< of whole cells, signed for a clockwise drawing

    static std::size_t idx(int i) { return static_cast<std::size_t>(i); }
    int node(int i, int j) const { return j * side_ + i; }
    Point at(int node) const {
        return {static_cast<double>(n_.column[idx(node)]), static_cast<double>(n_.row[idx(node)])};
    }
    double weight(int node, int c) const {
        return static_cast<double>(n_.weights[idx(node * C + c)]);
    }

    void judge_nodes() {
        const std::size_t count = idx(side_ * side_);
        inside_.resize(count);
        valid_.resize(count);
        for (std::size_t k = 0; k < count; ++k)
            inside_[k] = valid_[k] = n_.margin[k] >= 0.0F ? 1 : 0;
        for (const auto& clearance : n_.clearances)
            for (std::size_t k = 0; k < count; ++k)
                inside_[k] = static_cast<char>(inside_[k] & (clearance[k] >= 0.0F ? 1 : 0));
    }

    /// Both areas summed over the cells about a node.
    void average_density() {
        std::vector<float> area(idx(side_ * side_), 0.0F), count(area);
        for (int j = 0; j < across_; ++j)
            for (int i = 0; i < across_; ++i) {
                const int a = node(i, j), b = a + 1, c = a + side_, d = c + 1;
                if (!(valid_[idx(a)] && valid_[idx(b)] && valid_[idx(c)] && valid_[idx(d)]))
                    continue;
                const Point pa = at(a), pb = at(b), pc = at(c), pd = at(d);
                const auto size = static_cast<float>(
                    0.5 * (std::abs(cross(pa, pb, pc)) + std::abs(cross(pd, pc, pb))));
                for (const int k : {a, b, c, d}) {
                    area[idx(k)] += size;
                    count[idx(k)] += 1.0F;
                }
            }
        density_.resize(area.size());
        const auto scale = static_cast<float>(n_.cell_area_mm2 / frame_.pixel_area_mm2());
        for (std::size_t k = 0; k < area.size(); ++k)
            density_[k] = area[k] > 0.0F ? scale * count[k] / area[k] : 0.0F;
    }

    void add_cell(int i, int j) {
        if (!n_.skipped.empty() && n_.skipped[idx(j * across_ + i)]) return;
        const int a = node(i, j), b = a + 1, c = a + side_, d = c + 1;
        const bool whole = inside_[idx(a)] && inside_[idx(b)] && inside_[idx(c)] && inside_[idx(d)];
        if (whole && add_whole(i, j, a, b, c, d)) return;
        if (!whole)
            for (const auto& clearance : n_.clearances)
                if (std::max({clearance[idx(a)], clearance[idx(b)], clearance[idx(c)],
                              clearance[idx(d)]}) < 0.0F)
                    return;
        // Diagonals mirror about the middle, so that a symmetric ghost is drawn symmetrically.
        if (2 * i >= across_) {
            add_triangle(a, b, d);
            add_triangle(d, c, a);
        } else {
            add_triangle(a, b, c);
            add_triangle(d, c, b);
        }
    }

    bool is_off_frame(const Point* p, int count) const {
        double left = p[0].x, right = left, bottom = p[0].y, top = bottom;
        for (int k = 1; k < count; ++k) {
            left = std::min(left, p[k].x);
            right = std::max(right, p[k].x);
            bottom = std::min(bottom, p[k].y);
            top = std::max(top, p[k].y);
        }
        // All that is right of the frame, below or above it does not matter; nor what is left of
        // it: the edges of one piece cancel there.
        return right <= -frame_edge || left >= frame_.width_px + frame_edge || top <= -frame_edge ||
               bottom >= frame_.height_px + frame_edge;
    }
    /// Coarse levels of a picture reach beyond the frame, px.
    static constexpr double frame_edge = 32.0;

    /// False where the cell is not plain enough for one plane.
    bool add_whole(int i, int j, int a, int b, int c, int d) {
        const Point p[4] = {at(a), at(b), at(d), at(c)};  // around the cell
        const double lower = cross(p[0], p[1], p[3]), upper = cross(p[2], p[3], p[1]);
        const double area = 0.5 * (lower + upper);
        if (!(lower * upper > 0.0) || std::abs(lower) < least_even_share * std::abs(upper) ||
            std::abs(upper) < least_even_share * std::abs(lower) ||
            std::abs(area) < least_sloped_px2)
            return false;
        ++mesh_.cells;
        std::array<double, C> flux;
        for (int k = 0; k < C; ++k) {
            flux[idx(k)] = 0.25 * n_.cell_area_mm2 *
                           (weight(a, k) + weight(b, k) + weight(c, k) + weight(d, k));
            mesh_.flux_mm2[idx(k)] += flux[idx(k)];
        }
        if (is_off_frame(p, 4)) {
            // Neighbours must not draw a shared edge against nothing: all of them are off the
            // frame on this side, or draw their own part.
            return true;
        }
        const double pixels = 1.0 / frame_.pixel_area_mm2();
        const Point across1{p[2].x - p[0].x, p[2].y - p[0].y};
        const Point across2{p[1].x - p[3].x, p[1].y - p[3].y};
        const double inverse = 1.0 / (across1.x * across2.y - across1.y * across2.x);
        const Point middle{0.25 * (p[0].x + p[1].x + p[2].x + p[3].x),
                           0.25 * (p[0].y + p[1].y + p[2].y + p[3].y)};
        // Centre of area: of the two triangles, weighted by their areas.
        const Point third1{(p[0].x + p[1].x + p[3].x) / 3.0, (p[0].y + p[1].y + p[3].y) / 3.0};
        const Point third2{(p[2].x + p[3].x + p[1].x) / 3.0, (p[2].y + p[3].y + p[1].y) / 3.0};
        const double share = lower / (lower + upper);
        const Point centre{third2.x + share * (third1.x - third2.x),
                           third2.y + share * (third1.y - third2.y)};
        const double size = std::abs(area), sign = area > 0.0 ? -1.0 : 1.0;
        mesh_.area_px2 += size;
        Plane<C>& plane = planes_[idx(j * across_ + i)];
        plane.is_set = true;
        for (int k = 0; k < C; ++k) {
            const double ea = weight(a, k) * static_cast<double>(density_[idx(a)]);
            const double eb = weight(b, k) * static_cast<double>(density_[idx(b)]);
            const double ec = weight(c, k) * static_cast<double>(density_[idx(c)]);
            const double ed = weight(d, k) * static_cast<double>(density_[idx(d)]);
            double gx = ((ed - ea) * across2.y - (eb - ec) * across1.y) * inverse;
            double gy = ((eb - ec) * across1.x - (ed - ea) * across2.x) * inverse;
            double e = 0.25 * (ea + eb + ec + ed) - gx * middle.x - gy * middle.y;
            const double flux_px = flux[idx(k)] * pixels;
            fit_to_flux(p, 4, centre, size, flux_px, e, gx, gy);
            plane.e[idx(k)] = sign * e;
            plane.gx[idx(k)] = sign * gx;
            plane.gy[idx(k)] = sign * gy;
        }
        return true;
    }

    /// Scales a plane so that its integral is the flux; a constant where it does not suit.
    static void fit_to_flux(const Point* p, int count, const Point& centre, double size,
                            double flux_px, double& e, double& gx, double& gy) {
        const double mean = flux_px / size;
        const double at_centre = e + gx * centre.x + gy * centre.y;
        bool fits = at_centre * most_rescaled > mean && at_centre < most_rescaled * mean;
        for (int k = 0; k < count; ++k) fits = fits && e + gx * p[k].x + gy * p[k].y >= 0.0;
        if (!fits) {
            e = mean;
            gx = gy = 0.0;
            return;
        }
        const double scale = mean / at_centre;
        e *= scale;
        gx *= scale;
        gy *= scale;
    }

    void add_triangle(int a, int b, int c) {
        const int nodes[3] = {a, b, c};
        Corner corners[most_corners];  // not cleared: this is the inner loop
        for (int k = 0; k < 3; ++k)
            for (int n = 0; n < 3; ++n) corners[k].share[n] = k == n ? 1.0 : 0.0;
        int count = 3;
        auto clip = [&](const std::vector<float>& clearance) {
            const double f[3] = {static_cast<double>(clearance[idx(a)]),
                                 static_cast<double>(clearance[idx(b)]),
                                 static_cast<double>(clearance[idx(c)])};
            if (f[0] >= 0.0 && f[1] >= 0.0 && f[2] >= 0.0) return;
            if (f[0] < 0.0 && f[1] < 0.0 && f[2] < 0.0) {
                count = 0;
                return;
            }
            if (count + 6 > most_corners) return;
            auto value = [&](const Corner& k) {
                return k.share[0] * f[0] + k.share[1] * f[1] + k.share[2] * f[2];
            };
            Corner kept[most_corners];
            int kept_count = 0;
            double before = value(corners[count - 1]);
            for (int k = 0; k < count; ++k) {
                const Corner& from = corners[(k + count - 1) % count];
                const Corner& to = corners[k];
                const double now = value(to);
                if ((before >= 0.0) != (now >= 0.0)) {
                    const double t = before / (before - now);
                    for (int s = 0; s < 3; ++s)
                        kept[kept_count].share[s] =
                            from.share[s] + t * (to.share[s] - from.share[s]);
                    ++kept_count;
                }
                if (now >= 0.0) kept[kept_count++] = to;
                before = now;
            }
            count = kept_count;
            std::copy_n(kept, count, corners);
        };
        clip(n_.margin);
        for (const auto& clearance : n_.clearances) {
            if (count < 3) return;
            clip(clearance);
        }
        if (count >= 3) add_piece(nodes, corners, count);
    }

    void add_piece(const int (&nodes)[3], const Corner* corners, int count) {
        // A failed ray's sensor point means nothing: it takes the mean of its valid neighbours'.
        Point p[3], mean{0.0, 0.0};
        int valid = 0;
        for (int s = 0; s < 3; ++s) {
            p[s] = at(nodes[s]);
            if (!valid_[idx(nodes[s])]) continue;
            mean.x += p[s].x;
            mean.y += p[s].y;
            ++valid;
        }
        for (int s = 0; s < 3 && valid > 0; ++s)
            if (!valid_[idx(nodes[s])]) p[s] = {mean.x / valid, mean.y / valid};
        Point polygon[most_corners];
        double area_share = 0.0;  // of the triangle, on the entrance
        double weight_share[3] = {0.0, 0.0, 0.0};
        for (int k = 0; k < count; ++k) {
            const double* s = corners[k].share;
            polygon[k] = {s[0] * p[0].x + s[1] * p[1].x + s[2] * p[2].x,
                          s[0] * p[0].y + s[1] * p[1].y + s[2] * p[2].y};
            if (k < 2) continue;
            const double *o = corners[0].share, *q = corners[k - 1].share;
            const double part =
                std::abs((q[1] - o[1]) * (s[2] - o[2]) - (s[1] - o[1]) * (q[2] - o[2]));
            area_share += part;
            for (int v = 0; v < 3; ++v) weight_share[v] += part * (o[v] + q[v] + s[v]) / 3.0;
        }
        if (!(area_share > 0.0)) return;
        ++mesh_.cells;
        std::array<double, C> flux;
        for (int k = 0; k < C; ++k) {
            flux[idx(k)] =
                0.5 * n_.cell_area_mm2 *
                (weight_share[0] * weight(nodes[0], k) + weight_share[1] * weight(nodes[1], k) +
                 weight_share[2] * weight(nodes[2], k));
            mesh_.flux_mm2[idx(k)] += flux[idx(k)];
        }
        if (is_off_frame(polygon, count)) return;
        const double pixels = 1.0 / frame_.pixel_area_mm2();
        for (double& f : flux) f *= pixels;
        double area = 0.0;
        Point centre{0.0, 0.0};
        for (int k = 2; k < count; ++k) {
            const double part = 0.5 * cross(polygon[0], polygon[k - 1], polygon[k]);
            area += part;
            centre.x += part * (polygon[0].x + polygon[k - 1].x + polygon[k].x) / 3.0;
            centre.y += part * (polygon[0].y + polygon[k - 1].y + polygon[k].y) / 3.0;
        }
        const double size = std::abs(area);
        mesh_.area_px2 += size;
        if (size < least_area_px2) return add_points(polygon, count, flux);
        centre.x /= area;
        centre.y /= area;
        const double twice = cross(p[0], p[1], p[2]);
        const bool sloped = size >= least_sloped_px2 && valid == 3 && std::abs(twice) > 1e-9;
        const double sign = area > 0.0 ? -1.0 : 1.0;
        Plane<C> plane;
        for (int k = 0; k < C; ++k) {
            double e = flux[idx(k)] / size, gx = 0.0, gy = 0.0;
            if (sloped) {
                double v[3];
                for (int s = 0; s < 3; ++s)
                    v[s] = weight(nodes[s], k) * static_cast<double>(density_[idx(nodes[s])]);
                gx =
                    ((v[1] - v[0]) * (p[2].y - p[0].y) - (v[2] - v[0]) * (p[1].y - p[0].y)) / twice;
                gy =
                    ((v[2] - v[0]) * (p[1].x - p[0].x) - (v[1] - v[0]) * (p[2].x - p[0].x)) / twice;
                e = v[0] - gx * p[0].x - gy * p[0].y;
                fit_to_flux(polygon, count, centre, size, flux[idx(k)], e, gx, gy);
            }
            plane.e[idx(k)] = sign * e;
            plane.gx[idx(k)] = sign * gx;
            plane.gy[idx(k)] = sign * gy;
        }
        double contrast = 0.0;
        bool is_cut = false;
        for (int k = 0; k < count; ++k) {
            const Point &from = polygon[k], &to = polygon[(k + 1) % count];
            if (!is_side(corners[k], corners[(k + 1) % count])) {
                is_cut = true;
                contrast += contrast_of(from, to, plane);
            }
            emit(from, to, plane);
        }
        for (int k = 0; k < count && !is_cut; ++k)
            contrast += fold_contrast * contrast_of(polygon[k], polygon[(k + 1) % count], plane);
        mesh_.edge_contrast += std::min(contrast, spot_contrast_per_px * flux[C - 1]);
    }

    /// Whether two corners lie on one side of their triangle: there the ghost goes on.
    static bool is_side(const Corner& a, const Corner& b) {
        constexpr double on_side = 1e-12;
        for (int s = 0; s < 3; ++s)
            if (a.share[s] < on_side && b.share[s] < on_side) return true;
        return false;
    }

    void add_points(const Point* polygon, int count, const std::array<double, C>& flux) {
        for_each_spot(polygon, count, [&](double x, double y, int parts) {
            const Point spot{x, y};
            if (is_off_frame(&spot, 1)) return;
            ColorPoint<C> point{x, y, {}};
            for (int c = 0; c < C; ++c) point.flux[c] = flux[idx(c)] / parts;
            mesh_.edge_contrast += spot_contrast_per_px * point.flux[C - 1];
            mesh_.points.push_back(point);
        });
    }

    static double contrast_of(const Point& a, const Point& b, const Plane<C>& value) {
        const double x = b.x - a.x, y = b.y - a.y;
        return std::sqrt(x * x + y * y) *
               std::abs(value.at(C - 1, {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}));
    }

    void emit(const Point& a, const Point& b, const Plane<C>& value) {
        if (a.y == b.y || std::max(a.y, b.y) <= -frame_edge ||
            std::min(a.y, b.y) >= frame_.height_px + frame_edge)
            return;
        if (std::min(a.x, b.x) >= frame_.width_px + frame_edge) {
            mesh_.reaches_past_right = true;
            return;
        }
        ColorEdge<C>& edge = mesh_.edges.emplace_back();
        edge.x0 = a.x;
        edge.y0 = a.y;
        edge.x1 = b.x;
        edge.y1 = b.y;
        std::copy_n(value.e.begin(), C, edge.e);
        std::copy_n(value.gx.begin(), C, edge.gx);
        std::copy_n(value.gy.begin(), C, edge.gy);
    }

    static Plane<C> difference(const Plane<C>& a, const Plane<C>& b) {
        Plane<C> result;
        for (std::size_t k = 0; k < C; ++k) {
            result.e[k] = a.e[k] - b.e[k];
            result.gx[k] = a.gx[k] - b.gx[k];
            result.gy[k] = a.gy[k] - b.gy[k];
        }
        return result;
    }

    void emit_shared(const Point& a, const Point& b, const Plane<C>& own, const Plane<C>& other) {
        const Plane<C> step = difference(own, other);
        // Beside a clipped cell the picture goes on smoothly.
        if (own.is_set && other.is_set) {
            mesh_.edge_contrast += facet_contrast * contrast_of(a, b, step);
            mesh_.slope_contrast +=
                std::abs(step.gx[C - 1] * (b.y - a.y) - step.gy[C - 1] * (b.x - a.x));
        }
        emit(a, b, step);
    }

    /// Edges between whole cells once, with the difference of their two sides.
    void add_shared_edges() {
        const Plane<C> nothing;
        auto plane = [&](int i, int j) -> const Plane<C>& {
            return i < 0 || j < 0 || i >= across_ || j >= across_ ? nothing
                                                                  : planes_[idx(j * across_ + i)];
        };
        for (int j = 0; j <= across_; ++j)
            for (int i = 0; i <= across_; ++i) {
                const Plane<C>& own = plane(i, j);
                if (i < across_) {
                    const Plane<C>& below = plane(i, j - 1);
                    if (own.is_set || below.is_set)
                        emit_shared(at(node(i, j)), at(node(i + 1, j)), own, below);
                }
                if (j < across_) {
                    const Plane<C>& before = plane(i - 1, j);
                    if (own.is_set || before.is_set)
                        emit_shared(at(node(i, j + 1)), at(node(i, j)), own, before);
                }
            }
    }
};

}  // namespace

template <int C>
void add_grid(const MeshNodes& nodes, const PixelFrame& frame, ColorMesh<C>& mesh) {
    Builder<C>(nodes, frame, mesh).build();
}
template void add_grid(const MeshNodes&, const PixelFrame&, ColorMesh<gray_channels>&);
template void add_grid(const MeshNodes&, const PixelFrame&, ColorMesh<color_channels>&);

void correct_curvature(int cells, std::vector<float>& clearance) {
    constexpr float most = 0.05F;  // beyond this the second difference is no curvature but a kink
    const auto side = static_cast<std::size_t>(cells) + 1;
    const std::vector<float> given = clearance;
    auto second = [&](std::size_t k, std::size_t step, std::size_t place) {
        // At the border the neighbour's second difference serves.
        const std::size_t middle = place == 0 ? k + step : place + 1 == side ? k - step : k;
        return given[middle - step] - 2.0F * given[middle] + given[middle + step];
    };
    for (std::size_t j = 0; j < side; ++j)
        for (std::size_t i = 0; i < side; ++i) {
            const std::size_t k = j * side + i;
            const float change = -(second(k, 1, i) + second(k, side, j)) / 12.0F;
            clearance[k] = given[k] + std::clamp(change, -most, most);
        }
}

}  // namespace ghostlight
