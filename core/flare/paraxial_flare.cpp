#include "core/flare/paraxial_flare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/elapsed.h"
#include "core/flare/draw_picture.h"
#include "core/flare/planned_ghost.h"
#include "core/optics/paraxial.h"
#include "core/parallel.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr int round_corners = 64;  ///< of a disc drawn as a polygon of the same area

struct Point {
    double x, y;
};
/// A circle that the beam must pass, on the entrance plane, mm.
struct Disc {
    double y, radius;
};

std::vector<Point> polygon_of(const Disc& disc) {
    // n/2 sin(2π/n) r² is the polygon's area: the radius makes it the disc's.
    const double turn = 2.0 * std::numbers::pi / round_corners;
    const double radius =
        disc.radius * std::sqrt(2.0 * std::numbers::pi / (round_corners * std::sin(turn)));
    std::vector<Point> corners;
    for (int k = 0; k < round_corners; ++k)
        corners.push_back({radius * std::cos(turn * k), disc.y + radius * std::sin(turn * k)});
    return corners;
}

/// The part of a convex polygon inside a disc.
std::vector<Point> clipped(std::vector<Point> polygon, const Disc& disc) {
    auto outside = [&](const Point& p) { return std::hypot(p.x, p.y - disc.y) > disc.radius; };
    if (std::ranges::none_of(polygon, outside)) return polygon;
    const std::vector<Point> rim = polygon_of(disc);
    for (std::size_t e = 0; e < rim.size() && !polygon.empty(); ++e) {
        const Point &a = rim[e], &b = rim[(e + 1) % rim.size()];
        auto side = [&](const Point& p) {
            return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        };
        std::vector<Point> kept;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Point &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
            const double f = side(from), t = side(to);
            if (f >= 0.0) kept.push_back(from);
            if ((f >= 0.0) != (t >= 0.0)) {
                const double s = f / (f - t);
                kept.push_back({std::lerp(from.x, to.x, s), std::lerp(from.y, to.y, s)});
            }
        }
        polygon = std::move(kept);
    }
    return polygon;
}

/// The corners of the stop's opening as drawn from its blades, turned against the azimuth.
std::vector<Point> blades_of(const StopMask& mask, double turn_rad) {
    std::vector<Point> corners;
    for (int k = 0; k < mask.blades; ++k) {
        const double at = mask.rotation_rad - turn_rad + 2.0 * std::numbers::pi * k / mask.blades;
        corners.push_back(
            {mask.semi_diameter_mm * std::cos(at), mask.semi_diameter_mm * std::sin(at)});
    }
    return corners;
}

double area_of(const std::vector<Point>& polygon) {
    double twice = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * std::abs(twice);
}

class ParaxialPainter {
   public:
    ParaxialPainter(const FlareScene& scene, const LightDirection& light, const PixelFrame& frame)
        : scene_(scene),
          frame_(frame),
          turn_rad_(rad_from_deg(light.azimuth_deg - 90.0)),
          slope_(std::tan(rad_from_deg(light.field_deg))),
          cos_field_(std::cos(rad_from_deg(light.field_deg))) {}

    template <int C>
    void paint(const GhostPath& path, ColorMesh<C>& mesh) const {
        const OpticalSystem& system = scene_.system();
        std::vector<Disc> discs;
        std::vector<Point> entrance;
        for (const ParaxialMeeting& meeting : paraxial_meetings(system, path)) {
            if (meeting.to_here.a == 0.0) continue;
            const double shift = -meeting.to_here.b * slope_ / meeting.to_here.a;
            discs.push_back({shift, meeting.clear_radius_mm / std::abs(meeting.to_here.a)});
            if (meeting.at_stop && system.stop_mask.blades > 0 && entrance.empty())
                for (const Point& p : blades_of(system.stop_mask, turn_rad_))
                    entrance.push_back({p.x / meeting.to_here.a, p.y / meeting.to_here.a + shift});
        }
        if (entrance.empty())
            entrance = polygon_of(*std::ranges::min_element(discs, {}, &Disc::radius));
        for (const Disc& disc : discs) entrance = clipped(std::move(entrance), disc);
        if (entrance.size() < 3) return;
        const RayMatrix whole = paraxial_ghost(system, path).to_sensor;
        const double flux_per_weight = cos_field_ * area_of(entrance);
        const std::array<double, C> weight = channel_weights<C>(path);
        std::array<double, C> flux_px;
        for (std::size_t c = 0; c < C; ++c) {
            mesh.flux_mm2[c] += flux_per_weight * weight[c];
            flux_px[c] = flux_per_weight * weight[c] / frame_.pixel_area_mm2();
        }
        std::vector<Point> image;
        const double cosine = std::cos(turn_rad_), sine = std::sin(turn_rad_);
        for (const Point& p : entrance) {
            const double x = whole.a * p.x, y = whole.a * p.y + whole.b * slope_;
            image.push_back(
                {frame_.column(cosine * x - sine * y), frame_.row(sine * x + cosine * y)});
        }
        add_even_polygon<C>(image, flux_px, mesh);
    }

   private:
    const FlareScene& scene_;
    const PixelFrame& frame_;
    double turn_rad_, slope_, cos_field_;

    /// Light per E0 in each channel, all films at normal incidence.
    template <int C>
    std::array<double, C> channel_weights(const GhostPath& path) const {
        const auto trace = trace_path<float>(scene_.system(), path);
        Bundle<float> axis;
        axis.u_mm = axis.v_mm = {0.0F};
        axis.cosine_stride = 1;
        axis.cosines.assign(trace.steps.size(), 1.0F);
        if (trace.absorbs) {
            for (const TraceStep<float>& step : trace.steps)
                axis.lengths_mm.push_back(-step.sense * step.gap_mm);
            axis.lengths_mm.push_back(-trace.sensor_gap_mm);
        }
        std::vector<float> weights;
        scene_.films.weights(trace, axis, weights);
        std::array<double, C> sums{};
        const std::vector<float> shares = channel_shares<C>(scene_, 0, 1);
        for (std::size_t w = 0; w < scene_.samples.size(); ++w)
            for (std::size_t c = 0; c < C; ++c)
                sums[c] += static_cast<double>(shares[w * C + c] * weights[w]);
        return sums;
    }

    template <int C>
    static void add_even_polygon(const std::vector<Point>& image,
                                 const std::array<double, C>& flux_px, ColorMesh<C>& mesh) {
        constexpr double least_area_px2 = 1e-4;
        const double area = area_of(image);
        if (area < least_area_px2) {
            ColorPoint<C> point{image.front().x, image.front().y, {}};
            std::copy_n(flux_px.begin(), C, point.flux);
            mesh.points.push_back(point);
            return;
        }
        double twice = 0.0;
        for (std::size_t k = 0; k < image.size(); ++k) {
            const Point &a = image[k], &b = image[(k + 1) % image.size()];
            twice += a.x * b.y - a.y * b.x;
        }
        for (std::size_t k = 0; k < image.size(); ++k) {
            const Point &a = image[k], &b = image[(k + 1) % image.size()];
            ColorEdge<C> edge{a.x, a.y, b.x, b.y, {}, {}, {}};
            // Clockwise polygons add.
            for (std::size_t c = 0; c < C; ++c)
                edge.e[c] = (twice > 0.0 ? -1.0 : 1.0) * flux_px[c] / area;
            mesh.edges.push_back(edge);
        }
        ++mesh.cells;
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
    const ParaxialPainter painter(scene, request.light, frame);
    std::vector<DrawnGhost<C>> drawn(ghosts.size());
    if (!parallel_for(drawn.size(), request.threads, stop,
                      [&](std::size_t g) { painter.paint(ghosts[g], drawn[g].mesh); }))
        return std::nullopt;
    if (!draw_picture<C>(drawn, frame, request.threads, stop, image)) return std::nullopt;
    for (const DrawnGhost<C>& ghost : drawn) {
        image.flux_mm2 += ghost.mesh.flux_mm2[C - 1];
        image.cells += ghost.mesh.cells;
    }
    image.times.total_ms = ms_since(began);
    return image;
}

}  // namespace

std::optional<FlareImage> render_paraxial(const FlareScene& scene, const FlareRequest& request,
                                          std::stop_token stop) {
    return scene.is_gray() ? render<gray_channels>(scene, request, stop)
                           : render<color_channels>(scene, request, stop);
}

}  // namespace ghostlight
