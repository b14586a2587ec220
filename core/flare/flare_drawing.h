#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/flare_image.h"
#include "core/flare/flare_plan.h"
#include "core/flare/flare_scene.h"
#include "core/flare/ghost_mesh.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// A ghost that is planned, for an engine that traces and draws it by itself: its grid, bands and
/// level, and its light, which is smooth and comes from a grid of its own.
struct GhostDrawing {
    PlannedGhost planned;
    int light_cells = 0;  ///< across planned.box, an even number
    /// Light per E0 in linear Rec.709 and irradiance, 4 a node: band by band, nodes of the half
    /// with u ≥ 0 row by row (MirrorGrid), made ready for linear interpolation.
    std::vector<float> light;
    /// The wavelength of each band's positions, nm; one band is drawn where the main one lands.
    std::vector<double> band_nm;
    /// Cells with u ≥ 0 that, with their mirror images, are drawn on grids of their own, at the
    /// main wavelength: where rays begin to fail. Numbered row by row.
    std::vector<int> singular;
    int singular_across = 0;            ///< cells of such a grid across
    std::vector<float> singular_light;  ///< 4 a node, cell by cell
};

/// All that is to be traced and drawn for a picture. The field lies in the y–z plane: points on the
/// sensor are turned by the azimuth afterwards, and the stop is turned against it.
struct FlareDrawing {
    PixelFrame frame;
    BeamFrame beam;
    StopMask stop_mask;
    double cos_azimuth = 1.0, sin_azimuth = 0.0;
    std::vector<GhostDrawing> ghosts;  ///< those of the plan that are drawn
    FlarePlan plan;                    ///< of all ghosts
    double planning_ms = 0.0;
};

/// Plans a picture as render_planned does, without its fine grids. Nothing when stopped.
std::optional<FlareDrawing> plan_drawing(const FlareScene& scene, const FlareRequest& request,
                                         std::stop_token stop = {});

}  // namespace ghostlight
