#include "core/fit/ghost_basis.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace ghostlight {
namespace {

GhostBasis basis_of(const FitScene& scene, std::size_t ghost, const LightDirection& light,
                    const PixelFrame& frame, const FitPlace& place, const GhostPieces& pieces) {
    const GhostPath& path = scene.ghosts[ghost];
    GhostBasis basis;
    basis.ghost = ghost;
    basis.traced = pieces.traced;
    basis.grid = pieces.grid;
    if (pieces.empty()) return basis;
    const double c = std::cos(place.rotation_rad), s = std::sin(place.rotation_rad);
    auto column = [&](const BundlePiece& p) {
        return frame.column(c * p.x_mm - s * p.y_mm + place.shift_x_mm) - 0.5;
    };
    auto row = [&](const BundlePiece& p) {
        return frame.row(s * p.x_mm + c * p.y_mm + place.shift_y_mm) - 0.5;
    };
    double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
    for (const auto& list : pieces.at_node)
        for (const BundlePiece& piece : list) {
            x0 = std::min(x0, column(piece));
            x1 = std::max(x1, column(piece));
            y0 = std::min(y0, row(piece));
            y1 = std::max(y1, row(piece));
        }
    basis.first_column = std::max(0, static_cast<int>(std::floor(x0 - 1.0)));
    basis.first_row = std::max(0, static_cast<int>(std::floor(y0 - 1.0)));
    basis.columns =
        std::min(frame.width_px, static_cast<int>(std::ceil(x1 + 2.0))) - basis.first_column;
    basis.rows = std::min(frame.height_px, static_cast<int>(std::ceil(y1 + 2.0))) - basis.first_row;
    if (basis.columns <= 0 || basis.rows <= 0) return basis;
    basis.nodes = pieces.at_node.size();
    std::vector<double> sums(basis.width() * static_cast<std::size_t>(basis.columns * basis.rows),
                             0.0);
    for (std::size_t node = 0; node < basis.nodes; ++node)
        for (const BundlePiece& piece : pieces.at_node[node]) {
            auto terms = pupil_functions(piece.u, piece.v);
            for (double& term : terms) term *= piece.area_mm2 / frame.pixel_area_mm2();
            const double x = column(piece), y = row(piece);
            const int i0 = static_cast<int>(std::floor(x + 0.5)) - 1,
                      j0 = static_cast<int>(std::floor(y + 0.5)) - 1;
            for (int j = std::max(j0, basis.first_row);
                 j <= j0 + 2 && j < basis.first_row + basis.rows; ++j) {
                const double wy = spline(y - j);
                for (int i = std::max(i0, basis.first_column);
                     i <= i0 + 2 && i < basis.first_column + basis.columns; ++i) {
                    const double w = wy * spline(x - i);
                    double* to = &sums[basis.width() * static_cast<std::size_t>(
                                                           (j - basis.first_row) * basis.columns +
                                                           i - basis.first_column) +
                                       node * pupil_terms];
                    for (std::size_t t = 0; t < pupil_terms; ++t) to[t] += w * terms[t];
                }
            }
        }
    basis.values.assign(sums.begin(), sums.end());

    basis.events = film_events(scene, path);
    const BeamFrame beam = beam_frame(light);
    const std::size_t count = pieces.grid.ray_places.size();
    for (const auto& at : pieces.grid.ray_places)
        basis.rays.push_back(film_ray(scene, path, beam, at));
    // Weighted least squares of the rays' weights by the pupil functions, the smallest solution.
    Eigen::MatrixXd design(count, pupil_terms);
    Eigen::VectorXd root(count);
    for (std::size_t r = 0; r < count; ++r) {
        const auto terms = pupil_functions(
            pieces.grid.ray_places[r][0] / pieces.grid.u_half_mm,
            (pieces.grid.ray_places[r][1] - pieces.grid.v_mid_mm) / pieces.grid.v_half_mm);
        root(static_cast<Eigen::Index>(r)) = std::sqrt(pieces.grid.ray_areas[r]);
        for (std::size_t t = 0; t < pupil_terms; ++t)
            design(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(t)) =
                root(static_cast<Eigen::Index>(r)) * terms[t];
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solved;
    solved.setThreshold(1e-6);
    solved.compute(design);
    const Eigen::MatrixXd projection = solved.pseudoInverse() * root.asDiagonal();
    for (Eigen::Index t = 0; t < pupil_terms; ++t)
        for (Eigen::Index r = 0; r < static_cast<Eigen::Index>(count); ++r)
            basis.projection.push_back(projection(t, r));
    return basis;
}

}  // namespace

GhostBasis ghost_basis(const FitScene& scene, std::size_t ghost, const LightDirection& light,
                       const PixelFrame& frame, const FitPlace& place, bool main_only) {
    return basis_of(scene, ghost, light, frame, place,
                    ghost_pieces(scene, scene.ghosts[ghost], light, frame, main_only));
}

GhostBasis ghost_basis(const FitScene& scene, std::size_t ghost, const LightDirection& light,
                       const PixelFrame& frame, const FitPlace& place, const GhostGrid& grid) {
    return basis_of(scene, ghost, light, frame, place,
                    ghost_pieces(scene, scene.ghosts[ghost], light, frame, grid));
}

std::vector<GhostBasis> ghost_bases(const FitScene& scene, const LightDirection& light,
                                    const PixelFrame& frame, const FitPlace& place, bool main_only,
                                    unsigned threads, std::stop_token stop) {
    std::vector<GhostBasis> all(scene.ghosts.size());
    if (!parallel_for(all.size(), threads, std::move(stop), [&](std::size_t g) {
            all[g] = ghost_basis(scene, g, light, frame, place, main_only);
        }))
        return {};
    std::erase_if(all, [](const GhostBasis& basis) { return basis.empty(); });
    return all;
}

}  // namespace ghostlight
