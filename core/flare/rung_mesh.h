#pragma once

#include <array>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "core/flare/flare_image.h"
#include "core/flare/ghost_rims.h"
#include "core/flare/planned_ghost.h"
#include "core/flare/propagated_masks.h"
#include "core/flare/rim_profile.h"

namespace ghostlight {

/// What a group of rims (MeshNodes::clearances) does to a ghost.
enum class RimKind {
    fringed,  ///< the picture's rim is replaced by the profile
    masked,   ///< by what the propagated mask has
    sharp     ///< its fringes do not show: it clips, as the picture has it
};
struct RimGroup {
    RimKind kind = RimKind::sharp;
    RimProfile profile;  ///< of those that are fringed
};

/// A rim within reach of a triangle: Fresnel's w at its corners, linear between them; of rims that
/// are not fringed the clearance.
struct RimAt {
    float w[3];
    std::uint32_t group = 0;  ///< of RungMesh::groups
};

/// Three neighbouring rays that land within reach of a rim.
struct RungTriangle {
    float column[3], row[3];  ///< on the sensor, full-size pixels
    float light[3];           ///< irradiance / E0 of the ghost without its rims
    float u[3], v[3];         ///< last stop crossing, semi-diameters, in the stop's own directions
    std::uint32_t first_rim = 0, rim_count = 0;
};

/// What diffraction changes of one ghost, ready to be drawn.
struct RungMesh {
    RungGhost report;
    std::array<float, rim_channels> color{};  ///< of its light, over irradiance
    std::vector<RimGroup> groups;
    std::vector<RimAt> rims;
    std::vector<RungTriangle> triangles;
    PropagatedMasks::Fields masks;  ///< where the whole mask is propagated, by colour group
    std::vector<std::array<float, rim_channels>> mask_shares;
    double px_per_w = 0.0;  ///< the least of the rims'
    int level = 0;          ///< fringes are drawn at
    double rim_px = 1.0;    ///< how softly the picture has its rim, full-size pixels

    /// Left out: the L1 that its fringes would change, mm² over E0.
    double left_out_mm2 = 0.0;

    bool empty() const { return triangles.empty(); }
};

/// Of a ghost that has been planned, drawn at `planned.level`. Empty where no fringes show or that
/// is stopped.
RungMesh rung_mesh(const FlareScene& scene, const GhostPlanner& planner, const EdgeFringes& edge,
                   const ProbedGhost& ghost, const GhostRims& rims, const std::stop_token& stop);

}  // namespace ghostlight
