#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/fit/fit_scene.h"
#include "core/flare/ghost_mesh.h"
#include "core/ghosts/weighted_grid.h"

namespace ghostlight {

/// Where and how finely a ghost's bundle is traced for a fit. Kept, its picture is a smooth
/// function of the lens: another box or another number of rays would be other noise.
struct GhostGrid {
    PupilBox box;
    int cells = 0;                   ///< across the box; 0: nothing lands on the frame
    std::vector<std::size_t> nodes;  ///< of the scene's geometry: one where colours fall together
    /// Of points, samples: so close they leave aliases of the spline below 1e-3.
    double point_spacing = 0.45;
    /// u, v from −1 to 1 over the part of the pupil that matters.
    double u_half_mm = 1.0, v_mid_mm = 0.0, v_half_mm = 1.0;
    std::vector<std::array<double, 2>> ray_places;  ///< u, v in mm across the beam, for FilmRays
    std::vector<double> ray_areas;
    std::size_t traced = 0;  ///< rays, in finding this
    bool empty() const { return cells == 0; }
};

/// A small part of a bundle that passes: its middle on the sensor and in the pupil, and its area
/// across the beam.
template <class S>
struct PieceOf {
    S x_mm, y_mm, u, v, area_mm2;
};

using BundlePiece = PieceOf<double>;

/// The pieces of one ghost, small against a sample, that land on the frame, at each of the grid's
/// nodes; u and v from −1 to 1.
struct GhostPieces {
    GhostGrid grid;
    std::vector<std::vector<BundlePiece>> at_node;
    std::size_t traced = 0;
    bool empty() const { return grid.ray_places.empty(); }
};

/// Looks for the ghost. `main_only`: at one geometry wavelength alone.
GhostPieces ghost_pieces(const FitScene& scene, const GhostPath& path, const LightDirection& light,
                         const PixelFrame& frame, bool main_only);
/// On a grid that was found before, for this lens or for one a little different.
GhostPieces ghost_pieces(const FitScene& scene, const GhostPath& path, const LightDirection& light,
                         const PixelFrame& frame, const GhostGrid& grid);

/// The rays themselves, the stop where the scene's lens has it.
SplitGrid<float> traced_grid(const FitScene& scene, std::size_t node, const GhostPath& path,
                             const BeamFrame& frame, const GhostGrid& grid);

}  // namespace ghostlight
