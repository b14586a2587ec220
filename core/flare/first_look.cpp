#include "core/flare/first_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/elapsed.h"
#include "core/flare/color_mesh.h"
#include "core/flare/draw_picture.h"
#include "core/flare/ghost_measures.h"
#include "core/flare/ghost_spot.h"
#include "core/flare/ghost_weights.h"
#include "core/flare/grid_light.h"
#include "core/flare/node_placement.h"
#include "core/flare/picture_levels.h"
#include "core/ghosts/mirror_grid.h"
#include "core/optics/paraxial.h"
#include "core/parallel.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr int look_cells = 6;
/// Around what is expected to pass: what is expected is to first order.
constexpr double room = 1.1, paraxial_room = 1.5;
/// Of a ghost's own light, for drawing it small.
constexpr double blurred_share = 0.1;

/// Where light may enter along the meridian, mm on the plane across the beam.
struct Span {
    double low = 0.0, high = 0.0;
    double middle() const { return 0.5 * (low + high); }
    double half() const { return 0.5 * (high - low); }
    bool is_empty() const { return !(low < high); }
};
Span common(const Span& a, const Span& b) {
    return {std::max(a.low, b.low), std::min(a.high, b.high)};
}
Span widened(const Span& span, double factor) {
    return {span.middle() - factor * span.half(), span.middle() + factor * span.half()};
}

class FirstLook {
   public:
    FirstLook(const FlareScene& scene, const LightDirection& light, const PixelFrame& frame)
        : scene_(scene),
          placement_(scene.system(), light, frame),
          beam_(beam_frame({light.field_deg, 90.0})),
          entrance_(entrance_box(scene.system(), beam_)),
          slope_(std::tan(rad_from_deg(light.field_deg))),
          cos_field_(std::cos(rad_from_deg(light.field_deg))) {}

    template <int C>
    void draw(const std::vector<float>& shares, PlannedGhost& planned, DrawnGhost<C>& drawn) const {
        const OpticalSystem& system = scene_.system();
        const PixelFrame& frame = placement_.frame();
        const auto path = trace_path<float>(system, planned.path);
        MirrorGrid grid;
        grid.box = planned.box = box_of(path, planned.path);
        grid.cells = look_cells;
        grid.half.keep_cosines = true;
        trace_mirrored(path, beam_, Weights::none, grid);
        planned.cells = look_cells;
        planned.rays = grid.half.size() + stencil_rays;
        MeshNodes nodes = placement_.place(grid);
        const std::vector<float> light = ray_light<C>(scene_, grid, weights_of(path, grid), shares);
        std::vector<float> colors;
        interpolate(grid, light, C, look_cells, colors);
        for (std::size_t k = C - 1; k < colors.size(); k += C) nodes.weights.push_back(colors[k]);
        const FrameLight on_frame = light_on_frame(nodes, frame);
        planned.flux_mm2 = on_frame.flux_mm2;
        planned.whole_flux_mm2 = on_frame.whole_flux_mm2;
        planned.spot = spot_of(nodes, gray_channels, frame);
        if (!on_frame.passes || !on_frame.near_frame) {
            planned.fate = on_frame.passes ? GhostFate::off_sensor : GhostFate::nothing_passes;
            planned.flux_mm2 = 0.0;
            return;
        }
        const double off_px =
            grid_factor * bend_px(nodes, frame) + rim_factor * rim_px(nodes, frame);
        // Beside failing rays and total reflection, light is anywhere within a cell.
        planned.error_mm2 = light_in(singular_cells(grid, nodes), nodes);
        nodes.weights = std::move(colors);
        add_grid(nodes, frame, drawn.mesh);
        judge(off_px, drawn.mesh.edge_contrast, drawn.mesh.slope_contrast, planned);
        drawn.level = planned.level;
    }

   private:
    static constexpr std::size_t stencil_rays = 6;
    const FlareScene& scene_;
    NodePlacement placement_;
    BeamFrame beam_;
    PupilBox entrance_;
    double slope_, cos_field_;

    /// With polarisation as if all planes of incidence were one, as they are in the meridian.
    std::vector<float> weights_of(const TracePath<float>& path, const MirrorGrid& grid) const {
        std::vector<float> weights = ghost_weights(scene_, path, grid, {});
        if (scene_.coating_model != CoatingModel::exact) return weights;
        std::vector<float> polarised;
        scene_.films.polarisation(path, grid.half, polarised);
        const std::size_t stride = scene_.films.stride();
        for (std::size_t k = 0; k < grid.half.size(); ++k)
            for (std::size_t w = 0; w < stride && grid.half.margin[k] >= 0.0F; ++w)
                weights[k * stride + w] *= polarised[k * stride + w];
        return weights;
    }

    /// The level, and the error with it.
    void judge(double off_px, double contrast, double slopes, PlannedGhost& planned) const {
        const double pixel_mm2 = placement_.frame().pixel_area_mm2();
        const auto blurred = [&](int level) {
            return pixel_mm2 * (blur_px(level) * contrast + blur_px2(level) * slopes);
        };
        while (planned.level + 1 < picture_levels &&
               blurred(planned.level + 1) < blurred_share * planned.flux_mm2)
            ++planned.level;
        // All of a ghost's light in the wrong place counts twice.
        planned.error_mm2 =
            std::min(2.0 * planned.flux_mm2, planned.error_mm2 + pixel_mm2 * contrast * off_px) +
            blurred(planned.level);
    }

    /// What all clear radii leave of the meridian, to first order; empty where nothing is left.
    Span paraxial_span(const GhostPath& path) const {
        Span span{entrance_.v0_mm, entrance_.v1_mm};
        for (const ParaxialMeeting& meeting : paraxial_meetings(scene_.system(), path)) {
            const auto [a, b, c, d] = meeting.to_here;
            if (a == 0.0) continue;
            const double middle = -b * slope_ / a, radius = meeting.clear_radius_mm / std::abs(a);
            span = common(span, {(middle - radius) * cos_field_, (middle + radius) * cos_field_});
        }
        return span;
    }

    /// The stop's pre-image about the ghost's own centre ray, by the derivatives of a few rays.
    PupilBox box_of(const TracePath<float>& path, const GhostPath& ghost) const {
        const Span whole{entrance_.v0_mm, entrance_.v1_mm};
        const double widest = std::max(std::abs(entrance_.u0_mm), std::abs(entrance_.u1_mm));
        Span expected = paraxial_span(ghost);
        const bool is_known = !expected.is_empty();
        if (!is_known) expected = widened(whole, 0.5);
        const double step = 0.5 * expected.half(), middle = expected.middle();
        Bundle<float> rays;
        for (const double u : {0.0, step})
            for (const double v : {middle - step, middle, middle + step}) {
                rays.u_mm.push_back(static_cast<float>(u));
                rays.v_mm.push_back(static_cast<float>(v));
            }
        trace_bundle(path, beam_, Weights::none, rays);
        const bool valid =
            std::ranges::all_of(rays.margin, [](float margin) { return margin >= 0.0F; });
        Span v = expected;
        double u = expected.half();
        if (valid && rays.stop_crossings > 0) {
            const auto at = [](const std::vector<float>& values, std::size_t k) {
                return static_cast<double>(values[k]);
            };
            const double radius = scene_.system().stop_mask.semi_diameter_mm;
            const double along =
                (at(rays.stop_v_mm[0], 2) - at(rays.stop_v_mm[0], 0)) / (2.0 * step);
            const double across = at(rays.stop_u_mm[0], 4) / step;
            if (std::abs(along) * whole.half() > 1e-6 * radius) {
                const double centre = middle - at(rays.stop_v_mm[0], 1) / along;
                const double half = radius / std::abs(along);
                v = {centre - half, centre + half};
            }
            if (std::abs(across) * widest > 1e-6 * radius) u = radius / std::abs(across);
        }
        v = widened(v, room);
        if (is_known && !common(v, widened(expected, paraxial_room)).is_empty())
            v = common(v, widened(expected, paraxial_room));
        v = common(v, whole);
        if (v.is_empty()) v = whole;
        u = std::min(room * u, widest);
        if (is_known) u = std::min(u, paraxial_room * std::max(expected.half(), v.half()));
        return {-u, u, v.low, v.high};
    }
};

template <int C>
std::optional<FlareImage> render(const FlareScene& scene, const FlareRequest& request,
                                 const std::stop_token& stop) {
    const auto began = Clock::now();
    const OpticalSystem& system = scene.system();
    const PixelFrame frame =
        pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    FlareImage image = empty_image(system, frame);
    const std::vector<GhostPath>& ghosts = request.only.empty() ? scene.ghosts : request.only;
    image.ghosts = ghosts.size();
    const FirstLook look(scene, request.light, frame);
    const std::vector<float> shares = channel_shares<C>(scene, 0, 1);
    std::vector<DrawnGhost<C>> drawn(ghosts.size());
    image.plan.tolerance = request.tolerance;
    image.plan.ghosts.resize(ghosts.size());
    if (!parallel_for(drawn.size(), request.threads, stop, [&](std::size_t g) {
            image.plan.ghosts[g].path = ghosts[g];
            look.draw(shares, image.plan.ghosts[g], drawn[g]);
        }))
        return std::nullopt;
    image.times.trace_ms = ms_since(began);
    if (!draw_picture<C>(drawn, frame, request.threads, stop, image)) return std::nullopt;
    for (const DrawnGhost<C>& ghost : drawn) {
        image.flux_mm2 += ghost.mesh.flux_mm2[C - 1];
        image.cells += ghost.mesh.cells;
    }
    for (const PlannedGhost& planned : image.plan.ghosts) {
        image.plan.flux_mm2 += planned.flux_mm2;
        image.plan.error_mm2 += planned.error_mm2;
        image.rays += planned.rays;
    }
    image.times.total_ms = ms_since(began);
    return image;
}

}  // namespace

std::optional<FlareImage> render_first_look(const FlareScene& scene, const FlareRequest& request,
                                            std::stop_token stop) {
    return scene.is_gray() ? render<gray_channels>(scene, request, stop)
                           : render<color_channels>(scene, request, stop);
}

}  // namespace ghostlight
