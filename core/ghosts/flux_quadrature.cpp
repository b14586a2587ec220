#include "core/ghosts/flux_quadrature.h"

#include <algorithm>
#include <cmath>

#include "core/ghosts/cells.h"

namespace ghostlight {
namespace {

constexpr int coarsest_grid = 16;
constexpr int finest_grid = 512;
constexpr int mesh_grid = 32;   ///< at least, for irradiance
constexpr int split_cells = 8;  ///< across a singular cell

/// First and second moments of weight dA over a piece: the edge midpoints' rule on a fan of
/// triangles, exact for quadratics.
void add_moments(const Piece& piece, FluxSums& sums) {
    const PieceCorner& o = piece.corners[0];
    for (int k = 1; k + 1 < piece.count; ++k) {
        const PieceCorner* corner[3] = {&o, &piece.corners[k], &piece.corners[k + 1]};
        const double area =
            0.5 * std::abs((corner[1]->u_mm - o.u_mm) * (corner[2]->v_mm - o.v_mm) -
                           (corner[2]->u_mm - o.u_mm) * (corner[1]->v_mm - o.v_mm));
        for (int side = 0; side < 3; ++side) {
            const PieceCorner &a = *corner[side], &b = *corner[(side + 1) % 3];
            const double flux = area / 3.0 * 0.5 * (a.weight + b.weight);
            const double x = 0.5 * (a.x_mm + b.x_mm), y = 0.5 * (a.y_mm + b.y_mm);
            sums.x += flux * x;
            sums.y += flux * y;
            sums.r2 += flux * (x * x + y * y);
        }
    }
}

double flux_on_sensor(const Piece& piece, double half_width_mm, double half_height_mm) {
    bool inside = true;
    for (int k = 0; k < piece.count; ++k)
        inside = inside && std::abs(piece.corners[k].x_mm) <= half_width_mm &&
                 std::abs(piece.corners[k].y_mm) <= half_height_mm;
    if (inside) return flux_mm2(piece);
    Piece part = clipped(piece, [&](const PieceCorner& c) { return half_width_mm - c.x_mm; });
    part = clipped(part, [&](const PieceCorner& c) { return half_width_mm + c.x_mm; });
    part = clipped(part, [&](const PieceCorner& c) { return half_height_mm - c.y_mm; });
    part = clipped(part, [&](const PieceCorner& c) { return half_height_mm + c.y_mm; });
    return part.count < 3 ? 0.0 : flux_mm2(part);
}

double flux_at_stride(const SplitGrid<double>& grid, int stride) {
    double flux = 0.0;
    for_each_piece(grid, stride, [&](const BundleGrid<double>&, int, const Piece& piece) {
        flux += flux_mm2(piece);
    });
    return flux;
}

FluxSums sums_of(const SplitGrid<double>& grid, const OpticalSystem& system) {
    FluxSums sums;
    for_each_piece(grid, 1, [&](const BundleGrid<double>& on, int stride, const Piece& piece) {
        const double flux = flux_mm2(piece);
        sums.flux += flux;
        sums.on_sensor +=
            flux_on_sensor(piece, 0.5 * system.sensor_width_mm, 0.5 * system.sensor_height_mm);
        add_moments(piece, sums);
        const TriangleNodes nodes = triangle_nodes(on.cells, stride, piece.triangle);
        for (std::size_t k = 0; k < 2; ++k) {
            double mean = 0.0;
            for (const int node : nodes.node)
                mean += on.rays.reflectance[k][static_cast<std::size_t>(node)] / 3.0;
            sums.reflectance[k] += flux * mean;
        }
    });
    return sums;
}

}  // namespace

FluxSums& FluxSums::operator+=(const FluxSums& other) {
    flux += other.flux;
    on_sensor += other.on_sensor;
    x += other.x;
    y += other.y;
    r2 += other.r2;
    for (int k = 0; k < 2; ++k) reflectance[k] += other.reflectance[k];
    return *this;
}

FluxSums operator*(double scale, FluxSums sums) {
    for (double* value : {&sums.flux, &sums.on_sensor, &sums.x, &sums.y, &sums.r2,
                          &sums.reflectance[0], &sums.reflectance[1]})
        *value *= scale;
    return sums;
}

PathQuadrature::PathQuadrature(const OpticalSystem& system, const GhostPath& path,
                               const BeamFrame& frame)
    : system_(system), path_(trace_path<double>(system, path)), frame_(frame) {}

PathFlux PathQuadrature::start() const {
    PathFlux flux;
    const Pupil pupil = find_pupil(system_, path_, frame_);
    flux.rays = pupil.rays;
    flux.box = pupil.box;
    flux.empty = pupil.empty;
    if (!pupil.empty) integrate(flux, coarsest_grid);
    return flux;
}

void PathQuadrature::refine(PathFlux& flux, double share, double floor_mm2,
                            std::stop_token stop) const {
    while (!flux.empty && flux.cells < finest_grid && !stop.stop_requested() &&
           flux.error_mm2 > std::max(share * flux.sums.flux, floor_mm2))
        integrate(flux, 2 * flux.cells);
}

GhostMesh PathQuadrature::mesh(PathFlux& flux, const PixelFrame& pixels, double gain) const {
    if (flux.empty) return {};
    const int cells = std::max(flux.cells, mesh_grid);
    const auto grid = trace_grid(system_, path_, frame_, flux.box, cells, split_cells,
                                 Weights::polarised);
    flux.rays += grid.rays();
    return ghost_mesh(grid, pixels, gain);
}

/// The grid holds the two coarser ones: the quadrature is second order, so the difference to the
/// next coarser is about three times its error; the one before that guards against chance.
void PathQuadrature::integrate(PathFlux& flux, int cells) const {
    const auto grid = trace_grid(system_, path_, frame_, flux.box, cells, split_cells,
                                 Weights::polarised);
    flux.sums = sums_of(grid, system_);
    flux.cells = cells;
    flux.rays += grid.rays();
    const double half = flux_at_stride(grid, 2), quarter = flux_at_stride(grid, 4);
    flux.error_mm2 = std::abs(flux.sums.flux - half) + 0.25 * std::abs(half - quarter);
}

}  // namespace ghostlight
