#include "core/ghosts/flux_quadrature.h"

#include <algorithm>
#include <cmath>

#include "core/ghosts/weighted_grid.h"

namespace ghostlight {
namespace {

constexpr std::size_t most_rays = 400'000;  ///< per path and wavelength
constexpr int deepest_level = 10;  ///< splits below the pupil search's cells: 24 · 2²⁶ fit

/// First and second moments of weight dA over a piece: the edge midpoints' rule on a fan of
/// triangles, exact for quadratics.
void add_moments(const Piece& piece, FluxSums& sums) {
    const PieceCorner& o = piece.corners[0];
    for (int k = 1; k + 1 < piece.count; ++k) {
        const PieceCorner* corner[3] = {&o, &piece.corners[k], &piece.corners[k + 1]};
        const double area = 0.5 * std::abs((corner[1]->u_mm - o.u_mm) * (corner[2]->v_mm - o.v_mm) -
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

/// The two triangles of a cell, their diagonal mirrored about the pupil's middle column.
struct Halves {
    TriangleNodes half[2];
};
Halves halves_of(const FluxCell& cell, int across) {
    const auto& [a, b, c, d] = cell.corner;
    const bool left = 2.0 * cell.i < std::ldexp(across, cell.level);
    if (left) return {{{{a, b, c}}, {{d, c, b}}}};
    return {{{{a, b, d}}, {{d, c, a}}}};
}

template <class Visit>
void visit_pieces(const PathFlux& flux, const FluxCell& cell, Visit visit) {
    for (const TriangleNodes& nodes : halves_of(cell, flux.pupil.across).half) {
        const Piece piece = clip_triangle(flux.field, nodes);
        if (piece.count >= 3) visit(piece, nodes);
    }
}

double flux_of(const PathFlux& flux, const FluxCell& cell) {
    double sum = 0.0;
    visit_pieces(flux, cell,
                 [&](const Piece& piece, const TriangleNodes&) { sum += flux_mm2(piece); });
    return sum;
}

/// A corner of a cell on the lattice of the deepest level.
std::uint64_t lattice_key(const FluxCell& cell, int corner) {
    const int shift = deepest_level - cell.level;
    const std::uint64_t i = std::uint64_t{cell.i + static_cast<std::uint32_t>(corner & 1)} << shift;
    const std::uint64_t j = std::uint64_t{cell.j + static_cast<std::uint32_t>(corner >> 1)}
                            << shift;
    return (j << 32) | i;
}

/// Area of a piece on the sensor plane, mm², whichever way round its map has turned it.
double sensor_area_mm2(const Piece& piece) {
    double twice = 0.0;
    for (int k = 0; k < piece.count; ++k) {
        const PieceCorner& a = piece.corners[k];
        const PieceCorner& b = piece.corners[(k + 1) % piece.count];
        twice += a.x_mm * b.y_mm - b.x_mm * a.y_mm;
    }
    return 0.5 * std::abs(twice);
}

double pupil_area_mm2(const Piece& piece) {
    double twice = 0.0;
    for (int k = 0; k < piece.count; ++k) {
        const PieceCorner& a = piece.corners[k];
        const PieceCorner& b = piece.corners[(k + 1) % piece.count];
        twice += a.u_mm * b.v_mm - b.u_mm * a.v_mm;
    }
    return 0.5 * std::abs(twice);
}

bool passes(const RayField<double>& field, std::size_t node) {
    return std::ranges::all_of(field.clearances,
                               [&](const auto& clearance) { return clearance[node] >= 0.0; });
}

/// Adds the rays of `more` to `field`.
void append(RayField<double>& field, RayField<double> more) {
    auto join = [](std::vector<double>& to, const std::vector<double>& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    Bundle<double>& a = field.rays;
    const Bundle<double>& b = more.rays;
    a.stop_crossings = b.stop_crossings;
    join(a.u_mm, b.u_mm);
    join(a.v_mm, b.v_mm);
    join(a.x_mm, b.x_mm);
    join(a.y_mm, b.y_mm);
    join(a.weight, b.weight);
    join(a.margin, b.margin);
    a.reflections = b.reflections;
    for (std::size_t k = 0; k < static_cast<std::size_t>(b.reflections); ++k) {
        join(a.reflectance[k], b.reflectance[k]);
        join(a.onset[k], b.onset[k]);
    }
    field.clearances.resize(more.clearances.size());
    for (std::size_t k = 0; k < more.clearances.size(); ++k)
        join(field.clearances[k], more.clearances[k]);
}

}  // namespace

void SensorBox::add(double x_mm, double y_mm) {
    x0_mm = std::min(x0_mm, x_mm);
    x1_mm = std::max(x1_mm, x_mm);
    y0_mm = std::min(y0_mm, y_mm);
    y1_mm = std::max(y1_mm, y_mm);
}

void SensorBox::add(const SensorBox& other) {
    if (other.empty()) return;
    add(other.x0_mm, other.y0_mm);
    add(other.x1_mm, other.y1_mm);
}

FluxSums& FluxSums::operator+=(const FluxSums& other) {
    flux += other.flux;
    on_sensor += other.on_sensor;
    x += other.x;
    y += other.y;
    r2 += other.r2;
    area_mm2 += other.area_mm2;
    pupil_area_mm2 += other.pupil_area_mm2;
    for (std::size_t k = 0; k < reflectance.size(); ++k) {
        reflectance[k] += other.reflectance[k];
        incidence_rad[k] += other.incidence_rad[k];
        largest_incidence_rad[k] =
            std::max(largest_incidence_rad[k], other.largest_incidence_rad[k]);
    }
    box.add(other.box);
    return *this;
}

FluxSums operator*(double scale, FluxSums sums) {
    for (double* value : {&sums.flux, &sums.on_sensor, &sums.x, &sums.y, &sums.r2, &sums.area_mm2,
                          &sums.pupil_area_mm2})
        *value *= scale;
    for (std::size_t k = 0; k < sums.reflectance.size(); ++k) {
        sums.reflectance[k] *= scale;
        sums.incidence_rad[k] *= scale;
    }
    return sums;
}

PathQuadrature::PathQuadrature(const OpticalSystem& system, const GhostPath& path,
                               const BeamFrame& frame)
    : system_(system), ghost_(path), path_(trace_path<double>(system, path)), frame_(frame) {
    for (const TraceStep<double>& step : path_.steps)
        if (step.reflects) inverse_eta2_.push_back(1.0 / (step.eta * step.eta));
}

/// From cos² of the refraction, which the trace keeps to find the onset of total reflection.
double PathQuadrature::incidence_rad(const PathFlux& flux, std::size_t reflection,
                                     std::size_t node) const {
    const double sin2 = (1.0 - flux.field.rays.onset[reflection][node]) * inverse_eta2_[reflection];
    return std::asin(std::sqrt(std::clamp(sin2, 0.0, 1.0)));
}

FluxSums PathQuadrature::sums_of(const PathFlux& flux) const {
    const auto reflections = static_cast<std::size_t>(flux.field.rays.reflections);
    FluxSums sums;
    for (const FluxCell& cell : flux.cells) {
        if (cell.flux_mm2 == 0.0) continue;
        visit_pieces(flux, cell, [&](const Piece& piece, const TriangleNodes& nodes) {
            const double part = flux_mm2(piece);
            sums.flux += part;
            sums.on_sensor += flux_on_sensor(piece, 0.5 * system_.sensor_width_mm,
                                             0.5 * system_.sensor_height_mm);
            add_moments(piece, sums);
            sums.area_mm2 += sensor_area_mm2(piece);
            sums.pupil_area_mm2 += pupil_area_mm2(piece);
            for (int k = 0; k < piece.count; ++k)
                sums.box.add(piece.corners[k].x_mm, piece.corners[k].y_mm);
            for (std::size_t k = 0; k < reflections; ++k) {
                double reflectance = 0.0, incidence = 0.0;
                for (const int corner : nodes.node) {
                    const auto node = static_cast<std::size_t>(corner);
                    const double angle = incidence_rad(flux, k, node);
                    reflectance += flux.field.rays.reflectance[k][node] / 3.0;
                    incidence += angle / 3.0;
                    if (passes(flux.field, node))
                        sums.largest_incidence_rad[k] =
                            std::max(sums.largest_incidence_rad[k], angle);
                }
                sums.reflectance[k] += part * reflectance;
                sums.incidence_rad[k] += part * incidence;
            }
        });
    }
    return sums;
}

void PathQuadrature::trace_lattice(PathFlux& flux, const std::vector<std::uint64_t>& keys) const {
    const PupilBox& box = flux.pupil.entrance;
    const double across = std::ldexp(flux.pupil.across, deepest_level);
    Bundle<double> rays;
    for (const std::uint64_t key : keys) {
        const auto [entry, is_new] = flux.node_at.try_emplace(key, 0);
        if (!is_new) continue;
        entry->second = static_cast<int>(flux.field.rays.size() + rays.size());
        const double i = static_cast<double>(key & 0xffffffffU), j = static_cast<double>(key >> 32);
        rays.u_mm.push_back(std::lerp(box.u0_mm, box.u1_mm, i / across));
        rays.v_mm.push_back(std::lerp(box.v0_mm, box.v1_mm, j / across));
    }
    if (rays.size() == 0) return;
    flux.rays += rays.size();
    append(flux.field, trace_field(system_, path_, frame_, std::move(rays), Weights::polarised));
}

/// Splits every cell whose error is above the limit, all at once, so that rays are traced in bulk.
void PathQuadrature::split(PathFlux& flux, double above_mm2) const {
    std::vector<FluxCell> kept, children;
    std::vector<double> parent_flux;
    for (const FluxCell& cell : flux.cells) {
        if (cell.error_mm2 <= above_mm2 || cell.level >= deepest_level) {
            kept.push_back(cell);
            continue;
        }
        parent_flux.push_back(cell.flux_mm2);
        for (std::uint32_t k = 0; k < 4; ++k)
            children.push_back(
                {.i = 2 * cell.i + (k & 1), .j = 2 * cell.j + (k >> 1), .level = cell.level + 1});
    }
    std::vector<std::uint64_t> keys;
    for (const FluxCell& child : children)
        for (int k = 0; k < 4; ++k) keys.push_back(lattice_key(child, k));
    trace_lattice(flux, keys);
    for (std::size_t p = 0; p < parent_flux.size(); ++p) {
        double sum = 0.0;
        for (std::size_t c = 4 * p; c < 4 * p + 4; ++c) {
            for (int k = 0; k < 4; ++k)
                children[c].corner[k] = flux.node_at.at(lattice_key(children[c], k));
            children[c].flux_mm2 = flux_of(flux, children[c]);
            sum += children[c].flux_mm2;
        }
        for (std::size_t c = 4 * p; c < 4 * p + 4; ++c)
            children[c].error_mm2 = 0.25 * std::abs(sum - parent_flux[p]);
    }
    kept.insert(kept.end(), children.begin(), children.end());
    flux.cells = std::move(kept);
    flux.sums.flux = 0.0;
    flux.error_mm2 = 0.0;
    for (const FluxCell& cell : flux.cells) {
        flux.sums.flux += cell.flux_mm2;
        flux.error_mm2 += cell.error_mm2;
    }
}

PathFlux PathQuadrature::start() const {
    PathFlux flux;
    flux.pupil = find_pupil(system_, path_, frame_);
    flux.rays = flux.pupil.rays;
    std::vector<std::uint64_t> keys;
    for (const PupilCell& cell : flux.pupil.cells) {
        flux.cells.push_back({.i = cell.i, .j = cell.j});
        for (int k = 0; k < 4; ++k) keys.push_back(lattice_key(flux.cells.back(), k));
    }
    trace_lattice(flux, keys);
    for (FluxCell& cell : flux.cells) {
        for (int k = 0; k < 4; ++k) cell.corner[k] = flux.node_at.at(lattice_key(cell, k));
        cell.flux_mm2 = flux_of(flux, cell);
        cell.error_mm2 = 1.0;  // not known yet: every cell is split once
    }
    if (!flux.cells.empty()) split(flux, 0.0);
    return flux;
}

void PathQuadrature::refine(PathFlux& flux, double share, double floor_mm2,
                            std::stop_token stop) const {
    for (;;) {
        const double allowed = std::max(share * flux.sums.flux, floor_mm2);
        if (flux.error_mm2 <= allowed || flux.rays >= most_rays || stop.stop_requested()) break;
        const std::size_t before = flux.cells.size();
        split(flux, 0.5 * allowed / static_cast<double>(flux.cells.size()));
        if (flux.cells.size() == before) break;
    }
    flux.sums = sums_of(flux);
}

std::vector<BeamPart> PathQuadrature::parts(const PathFlux& flux) const {
    std::vector<BeamPart> parts;
    for (const FluxCell& cell : flux.cells) {
        if (cell.flux_mm2 == 0.0) continue;
        visit_pieces(flux, cell, [&](const Piece& piece, const TriangleNodes&) {
            BeamPart part{0.0, 0.0, pupil_area_mm2(piece)};
            for (int k = 0; k < piece.count; ++k) {
                part.u_mm += piece.corners[k].u_mm / piece.count;
                part.v_mm += piece.corners[k].v_mm / piece.count;
            }
            parts.push_back(part);
        });
    }
    return parts;
}

GhostMesh PathQuadrature::mesh(PathFlux& flux, const PixelFrame& pixels, int cells,
                               double gain) const {
    if (flux.cells.empty()) return {};
    const auto path = trace_path<float>(system_, ghost_);
    const auto probe = probe_bundle(system_, path, frame_, flux.pupil.box);
    const auto grid = weighted_grid(system_, path, frame_, flux.pupil.box, probe, cells);
    flux.rays += grid.rays() + probe.rays.size();
    double on_grid = 0.0;
    for_each_piece(
        grid, [&](const BundleGrid<float>&, const Piece& piece) { on_grid += flux_mm2(piece); });
    if (!(on_grid > 0.0)) return {};
    return ghost_mesh(grid, pixels, gain * flux.sums.flux / on_grid);
}

}  // namespace ghostlight
