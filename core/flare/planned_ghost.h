#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/color_mesh.h"
#include "core/flare/flare_drawing.h"
#include "core/flare/flare_plan.h"
#include "core/flare/flare_scene.h"
#include "core/ghosts/ghost_probe.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// What a plain drawing of a ghost's first grid would get wrong, mm² over E0, before saturation.
struct FirstErrors {
    int cells = 0;              ///< of that grid, across
    double area_px2 = 0.0;      ///< of the ghost's sheets on the sensor, near the frame
    double contrast_mm2 = 0.0;  ///< per pixel of blur
    double grid_mm2 = 0.0;      ///< the map's bend
    double merging_mm2 = 0.0;   ///< all colours in one band
    double weight_mm2 = 0.0;    ///< interpolating the light between the probe's rays
};

/// A ghost after its first look.
struct ProbedGhost {
    PlannedGhost planned;
    FirstErrors errors;
    std::vector<MirrorGrid> grids;  ///< the probe at every geometry wavelength
    std::vector<float>
        weights;  ///< of the probe's half grid at the main one, FilmTables::stride() a ray
};

class GhostPlanner;

/// All ghosts of a scene after their first look, each with its share of the error asked for.
/// Nothing when stopped.
std::optional<std::vector<ProbedGhost>> probe_all(const FlareScene& scene,
                                                  const GhostPlanner& planner,
                                                  const FlareRequest& request,
                                                  std::stop_token stop);

/// Plans and draws one ghost after another; holds what they share. Threads may use it together.
class GhostPlanner {
   public:
    /// All must outlive this.
    GhostPlanner(const FlareScene& scene, const LightDirection& light, const PixelFrame& frame,
                 ProbeSearch search = ProbeSearch::careful);

    /// Finds where it enters, and what light it brings.
    ProbedGhost probe(const GhostPath& path) const;

    /// Chooses grid, level and bands within the ghost's allowance, and makes its mesh.
    template <int C>
    void draw(ProbedGhost& ghost, ColorMesh<C>& mesh) const;

    /// The same choices, its level from the first look, for an engine that traces and draws for
    /// itself.
    GhostDrawing prepare(ProbedGhost& ghost) const;

    const StopMask& stop_mask() const { return stop_mask_; }
    const BeamFrame& beam() const { return beam_; }
    double cos_azimuth() const { return cos_azimuth_; }
    double sin_azimuth() const { return sin_azimuth_; }

   private:
    /// How finely a ghost is drawn, and the error that leaves, its level apart.
    struct Fineness {
        int cells = 0, bands = 1;
        bool rough = false;  ///< weights are traced on the grid itself
        bool split = false;  ///< singular cells get grids of their own
        double error_mm2 = 0.0;
    };

    const FlareScene& scene_;
    const PixelFrame& frame_;
    ProbeSearch search_;
    BeamFrame beam_;      ///< the field in the y–z plane
    StopMask stop_mask_;  ///< turned against the light's azimuth
    double cos_azimuth_, sin_azimuth_;
    PupilBox entrance_;

    Fineness choose(const ProbedGhost& ghost) const;
    void choose_level(const Fineness& fineness, double contrast_mm2, PlannedGhost& planned) const;
    template <class RayOf>
    MeshNodes place(const Bundle<float>& rays, int cells, double cell_area_mm2, RayOf ray_of) const;
    MeshNodes place(const MirrorGrid& grid) const;
    MeshNodes at_wavelength(const std::vector<MeshNodes>& placed, double wavelength_nm) const;
    MirrorGrid traced(const PlannedGhost& planned, std::size_t node, int cells,
                      Weights weights) const;
    void look(const MirrorGrid& first, const MeshNodes& nodes, ProbedGhost& ghost) const;
    std::vector<float> weigh(const TracePath<float>& trace, const MirrorGrid& grid) const;
    template <int C>
    std::vector<float> light_of(const MirrorGrid& grid, const std::vector<float>& weights,
                                const std::vector<float>& shares) const;
    template <int C>
    void draw_grids(const std::vector<const MirrorGrid*>& geometry, const MirrorGrid& weight_grid,
                    const std::vector<float>& weights, int bands, bool split,
                    const PlannedGhost& planned, ColorMesh<C>& mesh) const;
    struct SingularRays {
        Bundle<float> rays;  ///< cell by cell
        std::vector<float> weights;
    };
    template <int C>
    SingularRays trace_singular(const MirrorGrid& grid, const std::vector<int>& cells,
                                const MirrorGrid& weight_grid, const std::vector<float>& light,
                                const PlannedGhost& planned) const;
    template <int C>
    void draw_singular(const MirrorGrid& grid, const std::vector<int>& cells,
                       const MirrorGrid& weight_grid, const std::vector<float>& light,
                       const PlannedGhost& planned, ColorMesh<C>& mesh) const;
};

/// The last channel of a mesh alone.
template <int C>
ColorMesh<gray_channels> last_channel(const ColorMesh<C>& mesh);

}  // namespace ghostlight
