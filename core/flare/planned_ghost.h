#pragma once

#include <vector>

#include "core/flare/color_mesh.h"
#include "core/flare/flare_plan.h"
#include "core/flare/flare_scene.h"
#include "core/ghosts/ghost_probe.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// A ghost after its first look.
struct ProbedGhost {
    PlannedGhost planned;
    std::vector<MirrorGrid> grids;  ///< the probe at every geometry wavelength
    std::vector<float>
        weights;  ///< of the probe's half grid at the main one, FilmTables::stride() a ray
};

/// Plans and draws one ghost after another; holds what they share. Threads may use it together.
class GhostPlanner {
   public:
    /// All must outlive this.
    GhostPlanner(const FlareScene& scene, const LightDirection& light, const PixelFrame& frame);

    /// Finds where it enters, and what light it brings.
    ProbedGhost probe(const GhostPath& path) const;

    /// Chooses grid, level and bands within the ghost's allowance, and makes its mesh.
    template <int C>
    void draw(ProbedGhost& ghost, ColorMesh<C>& mesh) const;

   private:
    const FlareScene& scene_;
    const PixelFrame& frame_;
    BeamFrame beam_;      ///< the field in the y–z plane
    StopMask stop_mask_;  ///< turned against the light's azimuth
    double cos_azimuth_, sin_azimuth_;
    PupilBox entrance_;

    template <class RayOf>
    MeshNodes place(const Bundle<float>& rays, int cells, double cell_area_mm2, RayOf ray_of) const;
    MeshNodes place(const MirrorGrid& grid) const;
    MeshNodes at_wavelength(const std::vector<MeshNodes>& placed, double wavelength_nm) const;
    std::vector<float> weigh(const TracePath<float>& trace, const MirrorGrid& grid) const;
    double color_shift_px(const ProbedGhost& ghost) const;
    template <int C>
    std::vector<float> channel_shares(int band, int bands) const;
    template <int C>
    std::vector<float> light_of(const MirrorGrid& grid, const std::vector<float>& weights,
                                const std::vector<float>& shares) const;
    template <int C>
    void draw_grids(const std::vector<const MirrorGrid*>& geometry, const MirrorGrid& weight_grid,
                    const std::vector<float>& weights, int bands, bool split,
                    const PlannedGhost& planned, ColorMesh<C>& mesh) const;
    template <int C>
    void draw_singular(const MirrorGrid& grid, const std::vector<int>& cells,
                       const MirrorGrid& weight_grid, const std::vector<float>& light,
                       const PlannedGhost& planned, ColorMesh<C>& mesh) const;
};

/// The last channel of a mesh alone.
template <int C>
ColorMesh<gray_channels> last_channel(const ColorMesh<C>& mesh);

}  // namespace ghostlight
