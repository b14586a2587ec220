#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/flare/color_mesh.h"
#include "core/flare/flare_drawing.h"
#include "core/flare/flare_image.h"
#include "core/flare/flare_plan.h"
#include "core/flare/flare_scene.h"
#include "core/flare/ghost_weights.h"
#include "core/flare/node_placement.h"
#include "core/ghosts/ghost_probe.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// What a plain drawing of a ghost's first grid would get wrong, mm² over E0, before saturation.
struct FirstErrors {
    int cells = 0;              ///< of that grid, across
    double area_px2 = 0.0;      ///< of the ghost's sheets on the sensor, near the frame
    double contrast_mm2 = 0.0;  ///< per pixel of blur
    double slopes_mm2 = 0.0;    ///< per pixel² of a blur's half variance
    double grid_mm2 = 0.0;      ///< the map's bend
    ColorMisplacement colors;   ///< all colours in one band
    double weight_mm2 = 0.0;    ///< interpolating the light between the probe's rays
    double singular_mm2 = 0.0;  ///< cells beside failing rays or total reflection
};

/// A ghost after its first look.
struct ProbedGhost {
    PlannedGhost planned;
    FirstErrors errors;
    MirrorGrid grid;          ///< the probe, at the main geometry wavelength, with its cosines
    std::size_t passing = 0;  ///< of its nodes
    /// What a plan nearby knew of its colours, polarisation and rounding; null: nothing that holds.
    const FirstLook* known = nullptr;
    std::vector<float> weights;  ///< of the probe's half grid, FilmTables::stride() a ray
    /// Single precision moves its rays by more than is_ill_conditioned() allows (path_stability.h):
    /// it is traced in double.
    bool in_double = false;
};

/// How finely a ghost is drawn, and the error that leaves, its level apart.
struct Fineness {
    int cells = 0, bands = 1;
    bool rough = false;       ///< weights are traced on the grid itself
    bool polarised = false;   ///< and polarisation with them
    bool split = false;       ///< singular cells get grids of their own
    bool own_colors = false;  ///< each band is traced, not interpolated: FlareScene::at_band()
    double error_mm2 = 0.0;
    double cells_wanted = 0.0;  ///< even where the probe has more of them
};

/// What all bands of a ghost are drawn from.
struct GhostGrids {
    Fineness fineness;
    std::vector<MeshNodes> placed;  ///< at the geometry wavelengths, or the main one alone
    std::vector<int> singular;      ///< cells that get grids of their own
    MirrorGrid main;                ///< empty: the probe
    std::vector<float> weights;     ///< of its rays; empty: the probe's
};

/// Cells across a grid for a singular cell.
inline constexpr int singular_cells_across = 4;

/// Cells across a probe, and across that of a ghost for which a plan nearby found these enough.
inline constexpr int probe_cells = 12, few_probe_cells = 8;

/// Plans and draws one ghost after another; holds what they share. Threads may use it together.
class GhostPlanner {
   public:
    /// All must outlive this.
    GhostPlanner(const FlareScene& scene, const LightDirection& light, const PixelFrame& frame,
                 ProbeSearch search = ProbeSearch::careful, PlanEconomies economies = {});

    /// Finds where it enters, and a bound of its light. With a plan for a light nearby (or a lens
    /// slightly other), what that found is looked at first.
    ProbedGhost find(const GhostPath& path, const PlannedGhost* nearby = nullptr) const;
    ProbedGhost find(const GhostPath& path, const PlannedGhost* nearby, ProbeSearch search) const;
    /// Then its light, and what a first drawing of it gets wrong.
    void weigh(ProbedGhost& ghost) const;
    /// Both.
    ProbedGhost probe(const GhostPath& path) const;

    /// How many cells draw() will make of it, in all bands.
    std::size_t cells_to_draw(const ProbedGhost& ghost) const;

    /// Chooses grid, level and bands within the ghost's allowance, and makes its mesh.
    template <int C>
    void draw(ProbedGhost& ghost, ColorMesh<C>& mesh) const;
    /// The same in steps, for ghosts whose mesh is too large to be held at once: what its bands
    /// share, its level by the first look, and band by band.
    GhostGrids lay_grids(ProbedGhost& ghost) const;
    void choose_level(const GhostGrids& grids, ProbedGhost& ghost) const;
    template <int C>
    void draw_band(const ProbedGhost& ghost, const GhostGrids& grids, int band,
                   ColorMesh<C>& mesh) const;

    /// All its light with its colours, from the probe.
    GhostSpot spot(const ProbedGhost& ghost) const;

    /// The same choices, its level from the first look, for an engine that traces and draws for
    /// itself.
    GhostDrawing prepare(ProbedGhost& ghost) const;

    /// Rays of its main wavelength, without weights.
    void trace_main(const ProbedGhost& ghost, Bundle<float>& rays) const {
        trace(ghost, scene_.system(), Weights::none, rays);
    }

    const NodePlacement& placement() const { return placement_; }
    const BeamFrame& beam() const { return beam_; }

   private:
    const FlareScene& scene_;
    ProbeSearch search_;
    PlanEconomies economies_;
    NodePlacement placement_;
    BeamFrame beam_;  ///< the field in the y–z plane
    PupilBox entrance_;

    Fineness choose(const ProbedGhost& ghost) const;
    void choose_level(const Fineness& fineness, double contrast_mm2, double slopes_mm2,
                      PlannedGhost& planned) const;
    MeshNodes at_wavelength(const std::vector<MeshNodes>& placed, double wavelength_nm) const;
    void trace(const ProbedGhost& ghost, const OpticalSystem& system, Weights weights,
               Bundle<float>& rays) const;
    void mind_rounding(ProbedGhost& ghost) const;
    ColorRoom room_for_colors(const ProbedGhost& ghost) const;
    void make_room_for_colors(ProbedGhost& ghost) const;
    std::shared_ptr<const WeightShares> shares_of(ProbedGhost& ghost,
                                                  const TracePath<float>& path) const;
    void trace_other_half(const ProbedGhost& ghost, const OpticalSystem& system, Weights weights,
                          MirrorGrid& grid) const;
    MirrorGrid traced(const ProbedGhost& ghost, const OpticalSystem& system, int cells,
                      bool keep_cosines = false, Weights weights = Weights::none) const;
    void look(const MirrorGrid& first, const MeshNodes& nodes, ProbedGhost& ghost) const;
    ColorMisplacement misplaced_colors(const ProbedGhost& ghost, const MeshNodes& main) const;
    struct SingularRays {
        Bundle<float> rays;        ///< cell by cell
        std::vector<float> light;  ///< C a ray
    };
    /// Singular cells of the half with u ≥ 0 of a grid of cells × cells over the ghost's box, on
    /// grids of their own, with films and polarisation.
    template <int C>
    SingularRays trace_singular(const ProbedGhost& ghost, int cells,
                                const std::vector<int>& singular, const OpticalSystem& system,
                                const std::vector<float>& shares) const;
    template <int C>
    void draw_singular(const ProbedGhost& ghost, int cells, const std::vector<int>& singular,
                       const OpticalSystem& system, const std::vector<float>& shares,
                       ColorMesh<C>& mesh) const;
};

/// The last channel of a mesh alone.
template <int C>
ColorMesh<gray_channels> last_channel(const ColorMesh<C>& mesh);

}  // namespace ghostlight
