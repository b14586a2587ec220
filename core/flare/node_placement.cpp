#include "core/flare/node_placement.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/units.h"

namespace ghostlight {
namespace {

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// stop_margin() of a blade, with what does not depend on the ray worked out once.
struct Blade {
    double nx, ny;                  ///< of a straight one: outwards, over the semi-diameter
    double distance;                ///< from the middle
    double radius;                  ///< of a curved one, in semi-diameters; 0: straight
    double per_mm, back_x, back_y;  ///< to the middle of its arc
    double margin(double u_mm, double v_mm) const {
        if (radius == 0.0) return distance - (u_mm * nx + v_mm * ny);
        const double x = u_mm * per_mm + back_x, y = v_mm * per_mm + back_y;
        return radius - std::sqrt(x * x + y * y);
    }
};

std::vector<Blade> blades_of(const StopMask& mask) {
    std::vector<Blade> blades;
    const double per_mm = 1.0 / mask.semi_diameter_mm;
    for (int edge = 0; edge < (mask.blades < 3 ? 0 : mask.blades); ++edge) {
        const double half = std::numbers::pi / mask.blades;
        const double middle = mask.rotation_rad + half * (2 * edge + 1);
        const double nx = std::cos(middle), ny = std::sin(middle);
        const bool curved = mask.blade_curvature > 0.0;
        const double radius = curved ? 1.0 / mask.blade_curvature : 0.0;
        const double back =
            curved ? std::sqrt(radius * radius - std::pow(std::sin(half), 2)) - std::cos(half)
                   : 0.0;
        blades.push_back(
            {nx * per_mm, ny * per_mm, std::cos(half), radius, per_mm, back * nx, back * ny});
    }
    return blades;
}

}  // namespace

NodePlacement::NodePlacement(const OpticalSystem& system, const LightDirection& light,
                             const PixelFrame& frame)
    : frame_(frame), stop_mask_(system.stop_mask) {
    const double turn = rad_from_deg(light.azimuth_deg - 90.0);
    cos_azimuth_ = std::cos(turn);
    sin_azimuth_ = std::sin(turn);
    stop_mask_.rotation_rad -= turn;
}

template <class RayOf>
MeshNodes NodePlacement::place(const Bundle<float>& rays, int cells, double cell_area_mm2,
                               RayOf ray_of) const {
    MeshNodes nodes;
    nodes.cells = cells;
    nodes.cell_area_mm2 = cell_area_mm2;
    const int side = cells + 1;
    const std::size_t count = idx(side * side);
    nodes.column.resize(count);
    nodes.row.resize(count);
    nodes.margin.resize(count);
    const int edges = stop_edges(stop_mask_);
    nodes.clearances.assign(1 + idx(rays.stop_crossings * edges), std::vector<float>(count));
    const auto pitch = static_cast<float>(1.0 / frame_.pitch_mm);
    const auto xc = static_cast<float>(cos_azimuth_) * pitch;
    const auto xs = static_cast<float>(sin_azimuth_) * pitch;
    const auto left = static_cast<float>(-frame_.left_mm) * pitch;
    const auto bottom = static_cast<float>(-frame_.bottom_mm) * pitch;
    const auto inverse_stop = static_cast<float>(1.0 / stop_mask_.semi_diameter_mm);
    const std::vector<Blade> blades = blades_of(stop_mask_);
    std::size_t k = 0;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i, ++k) {
            const auto [of, mirror] = ray_of(i, j);
            const float x = mirror * rays.x_mm[of], y = rays.y_mm[of];
            nodes.column[k] = xc * x - xs * y + left;
            nodes.row[k] = xs * x + xc * y + bottom;
            nodes.margin[k] = rays.margin[of];
            nodes.clearances[0][k] = 1.0F - rays.r_rel[of];
            for (int s = 0; s < rays.stop_crossings; ++s) {
                const float u = mirror * rays.stop_u_mm[idx(s)][of];
                const float v = rays.stop_v_mm[idx(s)][of];
                int edge = 0;
                // Linear along the radius, unlike stop_margin: chords fit a rim better.
                if (stop_mask_.blades == 0)
                    nodes.clearances[1 + idx(s * edges + edge++)][k] =
                        1.0F - std::sqrt(u * u + v * v) * inverse_stop;
                for (; idx(edge) < blades.size(); ++edge)
                    nodes.clearances[1 + idx(s * edges + edge)][k] = static_cast<float>(
                        blades[idx(edge)].margin(static_cast<double>(u), static_cast<double>(v)));
                for (; edge < edges; ++edge)
                    nodes.clearances[1 + idx(s * edges + edge)][k] = static_cast<float>(stop_margin(
                        stop_mask_, edge, static_cast<double>(u), static_cast<double>(v)));
            }
        }
    for (auto& clearance : nodes.clearances) correct_curvature(cells, clearance);
    return nodes;
}

MeshNodes NodePlacement::place(const MirrorGrid& grid) const {
    return place(grid.half, grid.cells, grid.box.area_mm2() / (grid.cells * grid.cells),
                 [&](int i, int j) {
                     return std::pair{grid.of_node(i, j), grid.is_mirrored(i) ? -1.0F : 1.0F};
                 });
}

MeshNodes NodePlacement::place(const Bundle<float>& rays, std::size_t first, int cells,
                               double cell_area_mm2, float mirror) const {
    return place(rays, cells, cell_area_mm2, [=](int i, int j) {
        return std::pair{first + idx(j * (cells + 1) + i), mirror};
    });
}

}  // namespace ghostlight
