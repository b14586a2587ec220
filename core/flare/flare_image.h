#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/flare_plan.h"
#include "core/flare/flare_scene.h"
#include "core/flare/spectrum.h"
#include "core/ghosts/ghost_path.h"
#include "core/ghosts/ghost_probe.h"
#include "core/optics/prescription.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// How a picture is made.
enum class FlareMethod {
    planned,    ///< the least work for a tolerance
    paraxial,   ///< to first order (Lee and Eisemann 2013)
    uniform,    ///< every ghost at every wavelength on a grid of its own (Hullin et al. 2011)
    reference,  ///< refined until two samplings agree (reference_image.h)
};

/// What the planned method saves. Each is there to be switched off, to see what it is worth.
struct PlanEconomies {
    bool smaller_sizes = true;  ///< broad ghosts are drawn at a half to a sixteenth of the size
    bool leaving_out = true;    ///< the weakest are not drawn, by their bounds
    bool probed_light = true;   ///< light is interpolated between few rays where it is smooth
    bool split_edges = true;    ///< cells beside failing rays get grids of their own
    bool merged_colors = true;  ///< wavelengths that land together are drawn as one
    bool half_beams = true;     ///< of each beam one half is traced: the other mirrors it
    bool operator==(const PlanEconomies&) const = default;
};

/// What to draw, and how finely. The direct image is not part of the ghost layer.
struct FlareRequest {
    LightDirection light;
    Spectrum spectrum = Monochromatic{};
    FlareMethod method = FlareMethod::planned;
    /// planned, reference: L1 error of the ghost layer's irradiance on the sensor, relative to its
    /// light.
    double tolerance = 0.02;
    /// planned: how hard to look for where ghosts enter; quick while a light is dragged.
    ProbeSearch search = ProbeSearch::careful;
    /// planned: a plan for a light close to this one, or a lens slightly other. Its ghosts' boxes
    /// are looked at first, but for every eighth ghost, another eighth for every `turn`: for a
    /// light that is being dragged, picture by picture.
    std::shared_ptr<const FlarePlan> nearby;
    int turn = 0;
    PlanEconomies economies;
    /// planned: ghosts of the least irradiance are not drawn but folded (fold_ghosts.h), up to this
    /// share of the light of all.
    double folded_share = 0.0;
    int width_px = 1280;  ///< the height follows from the sensor's shape
    CoatingModel coating_model = CoatingModel::exact;  ///< planned and paraxial
    double bend_px = 0.2;      ///< each ghost's grid is as fine as keeps its map bilinear to this
    int grid = 0;              ///< uniform: cells across every ghost's pupil; 0 = by bend_px
    double culled = 0.0;       ///< uniform: share of the ghosts, the weakest, that is not drawn
    int spectral_samples = 5;  ///< uniform: used when the light is not of one wavelength
    /// Draw these paths alone; empty = all ghosts.
    std::vector<GhostPath> only;
    /// Diffraction at the ghosts' rims, where it shows (ringing.h); not with `paraxial`.
    bool ringing = false;
    std::vector<GhostPath> highlighted;  ///< these ghosts also go into FlareImage::highlight
    unsigned threads = 0;
};

/// Wall time of the parts of a picture, ms.
struct FlareTimes {
    double bounds_ms = 0.0, trace_ms = 0.0, raster_ms = 0.0, composite_ms = 0.0, total_ms = 0.0;
    double ringing_ms = 0.0;
};

/// A ghost that got its fringes.
struct RungGhost {
    GhostPath path;
    double fresnel_number = 0.0;
    double first_fringe_px = 0.0;  ///< from the rim to the first bright one
    bool propagated = false;       ///< the whole mask, not its edge alone
};

/// Irradiance / E0 on the sensor. Row 0 is the lowest y, column 0 the lowest x, as seen on the
/// sensor plane (data are never flipped); upright_* converts to a camera picture.
struct FlareImage {
    int width_px = 0, height_px = 0;
    double sensor_width_mm = 36.0, sensor_height_mm = 24.0;
    std::vector<float> rgb;         ///< 3 per pixel, linear Rec.709, the light itself is (1, 1, 1)
    std::vector<float> irradiance;  ///< 1 per pixel: mean over the pixel, per E0
    std::vector<float>
        highlight;  ///< 1 per pixel: irradiance of the highlighted ghosts; empty if none asked
    double flux_mm2 = 0.0;  ///< of all ghosts together, on the whole sensor plane
    double flux_on_sensor_mm2 = 0.0;
    std::size_t ghosts = 0, rays = 0, cells = 0;
    FlareTimes times;
    std::vector<RungGhost> ringing;
    std::vector<GhostSpot> folded;  ///< ghosts that are not in it: what the veil has of them
    FlarePlan plan;                 ///< of the methods `planned` and `reference`; else empty
};

/// Traces every two-reflection ghost in uniform bundles and accumulates them with exact pixel
/// coverage, so that flux is conserved and folded sheets add. The polarisation is carried, on a
/// coarser grid where the weights are smooth. Bit-identical for any number of threads. Returns
/// nothing when stopped.
std::optional<FlareImage> render_flare(const Prescription& lens, const FlareRequest& request,
                                       std::stop_token stop = {});

/// The planned method traces half of each beam, turned into the y–z plane: the rectangle of a
/// sensor that reflects has to be symmetric about that. Its grids are as fine as the map asks for,
/// which an image in the stop may not be content with. Where either is the case, render_flare()
/// draws uniformly.
bool can_be_planned(const OpticalSystem& system, const LightDirection& light);

/// The method `uniform`.
std::optional<FlareImage> render_uniform(const Prescription& lens, const FlareRequest& request,
                                         std::stop_token stop = {});

/// Turns sensor data into an upright camera picture with row 0 at the top: the sensor seen from
/// behind and rotated by 180°, so that the picture's right is −x and its top is −y. In memory that
/// is a mirror image left to right. `channels` floats per pixel.
std::vector<float> upright_picture(const std::vector<float>& data, int width_px, int height_px,
                                   int channels);

}  // namespace ghostlight
