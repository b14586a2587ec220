#include "widgets/ray_fan.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/optics/coating.h"
#include "core/units.h"

namespace ghostlight {

namespace {

constexpr int coarse_samples = 160;
constexpr int fine_samples = 960;  // when the coarse ones find nothing
constexpr int bisections = 24;
constexpr double meridional_azimuth_deg = 90.0;

struct Beam {
    BeamFrame frame;
    double low_mm = 0.0, high_mm = 0.0;  ///< what can meet the first surface within its rim
    double before_mm = 0.0;              ///< how far before z = 0 on the axis that surface reaches

    Ray ray(double v_mm) const { return {v_mm * frame.e2, frame.direction}; }
};

Beam meridional_beam(const OpticalSystem& system, double field_deg) {
    Beam beam;
    beam.frame = beam_frame({field_deg, meridional_azimuth_deg});
    const SurfaceAt& first = system.surfaces.front();
    Surface curve;
    curve.curve = Curvature{first.curvature_per_mm};
    curve.conic = first.conic;
    curve.aspheric = first.aspheric;
    constexpr int points = 32;
    for (int i = 0; i <= points; ++i) {
        const double y = first.semi_diameter_mm * (2.0 * i / points - 1.0);
        const glm::dvec3 point(0.0, y, sag_mm(curve, y));
        const double v = glm::dot(beam.frame.e2, point);
        beam.before_mm = std::max(beam.before_mm, -glm::dot(beam.frame.direction, point));
        beam.low_mm = i == 0 ? v : std::min(beam.low_mm, v);
        beam.high_mm = i == 0 ? v : std::max(beam.high_mm, v);
    }
    return beam;
}

bool survives(const OpticalSystem& system, const GhostPath& path, const Ray& ray) {
    return trace_ray(system, path, ray).status.fate == RayFate::ok;
}

/// The last surviving place between one that survives and one that does not.
double edge(const OpticalSystem& system, const GhostPath& path, const Beam& beam, double alive,
            double dead) {
    for (int i = 0; i < bisections; ++i) {
        const double middle = std::midpoint(alive, dead);
        (survives(system, path, beam.ray(middle)) ? alive : dead) = middle;
    }
    return alive;
}

std::vector<PupilSpan> spans_of(const OpticalSystem& system, const GhostPath& path,
                                const Beam& beam, int samples) {
    std::vector<PupilSpan> spans;
    double before = beam.low_mm;
    bool was_alive = false;
    for (int i = 0; i < samples; ++i) {
        const double v = std::lerp(beam.low_mm, beam.high_mm, (i + 0.5) / samples);
        const bool alive = survives(system, path, beam.ray(v));
        if (alive && !was_alive) {
            spans.push_back({edge(system, path, beam, v, before), v});
        } else if (!alive && was_alive) {
            spans.back().high_mm = edge(system, path, beam, before, v);
        }
        was_alive = alive;
        before = v;
    }
    if (was_alive) {
        spans.back().high_mm = edge(system, path, beam, before, beam.high_mm);
    }
    return spans;
}

std::vector<PupilSpan> spans_of(const OpticalSystem& system, const GhostPath& path,
                                const Beam& beam) {
    std::vector<PupilSpan> spans = spans_of(system, path, beam, coarse_samples);
    return spans.empty() ? spans_of(system, path, beam, fine_samples) : spans;
}

/// Places for rays: both ends of a single span included, several spans by their lengths.
std::vector<double> places(const std::vector<PupilSpan>& spans, int rays) {
    double length = 0.0;
    for (const PupilSpan& span : spans) {
        length += span.high_mm - span.low_mm;
    }
    std::vector<double> v_mm;
    for (int k = 0; k < rays; ++k) {
        double share = rays > 1 ? double(k) / (rays - 1) : 0.5;
        if (spans.size() > 1) {
            share = (k + 0.5) / rays;
        }
        double left = share * length;
        for (const PupilSpan& span : spans) {
            const double here = span.high_mm - span.low_mm;
            if (left <= here || &span == &spans.back()) {
                v_mm.push_back(std::min(span.low_mm + left, span.high_mm));
                break;
            }
            left -= here;
        }
    }
    return v_mm;
}

DrawingPoint drawn(const glm::dvec3& point) { return {point.z, point.y}; }

RayLeg leg_after(const GhostPath& path, std::size_t reflections) {
    if (path.is_direct()) {
        return RayLeg::direct;
    }
    if (reflections == 0) {
        return RayLeg::in;
    }
    return reflections < path.reflections.size() ? RayLeg::between : RayLeg::out;
}

DrawingPoint start(const Beam& beam, double v_mm, double lead_in_mm) {
    return drawn(v_mm * beam.frame.e2 - (lead_in_mm + beam.before_mm) * beam.frame.direction);
}

void add_surviving(RayFan& fan, const TracedRay& traced, DrawingPoint from) {
    std::size_t reflections = 0;
    const int ray = fan.rays;
    fan.stretches.push_back({leg_after(fan.path, 0), {from}, ray});
    for (const RayHit& hit : traced.hits) {
        fan.stretches.back().points.push_back(drawn(hit.point));
        if (hit.reflected) {
            const RayLeg next = leg_after(fan.path, ++reflections);
            if (next != fan.stretches.back().leg) {
                fan.stretches.push_back({next, {drawn(hit.point)}, ray});
            }
        }
    }
    fan.stretches.back().points.push_back(drawn(traced.sensor_point));
    fan.sensor_y_mm.push_back(traced.sensor_point.y);
    ++fan.rays;
}

void add_lost(RayFan& fan, const TracedRay& traced, DrawingPoint from) {
    RayStretch stretch{RayLeg::lost, {from}, -1 - static_cast<int>(fan.stretches.size())};
    for (const RayHit& hit : traced.hits) {
        stretch.points.push_back(drawn(hit.point));
        if (hit.r_rel > 1.0) {
            break;
        }
    }
    if (stretch.points.size() > 1) {
        fan.stretches.push_back(std::move(stretch));
    }
}

void add_meetings(RayFan& fan, const OpticalSystem& system, const std::vector<PathEvent>& path,
                  const TracedRay& traced) {
    for (std::size_t k = 0; k < std::min(path.size(), traced.hits.size()); ++k) {
        const RayHit& hit = traced.hits[k];
        const SurfaceAt& surface = surface_at(system, hit.surface);
        const double cosine = std::clamp(std::abs(hit.cos_incidence), 0.0, 1.0);
        RayMeeting meeting{hit.surface, drawn(hit.point), deg_from_rad(std::acos(cosine)), 0.0,
                           1.0,         hit.reflected};
        if (surface.uniform_reflectance) {
            meeting.reflectance = *surface.uniform_reflectance;
            meeting.transmittance = 1.0 - meeting.reflectance;
        } else {
            const Reflectances shares =
                reflectances(path[k].forward ? surface.film : reversed(surface.film), cosine);
            meeting.reflectance = shares.r();
            meeting.transmittance = shares.t();
        }
        fan.meetings.push_back(meeting);
    }
}

void add_marks(RayFan& fan, const TracedRay& traced) {
    for (const RayHit& hit : traced.hits) {
        if (hit.reflected) {
            fan.marks.push_back(
                {static_cast<int>(fan.marks.size()) + 1, hit.surface, drawn(hit.point)});
        }
    }
}

}  // namespace

std::vector<PupilSpan> surviving_spans(const OpticalSystem& system, const GhostPath& path,
                                       double field_deg) {
    return spans_of(system, path, meridional_beam(system, field_deg));
}

RayFan ray_fan(const OpticalSystem& system, const GhostPath& path, double field_deg, int rays,
               double lead_in_mm) {
    RayFan fan;
    fan.path = path;
    const Beam beam = meridional_beam(system, field_deg);
    const std::vector<PupilSpan> spans = spans_of(system, path, beam);
    if (spans.empty()) {
        for (const double v : places({{beam.low_mm, beam.high_mm}}, rays)) {
            add_lost(fan, trace_ray(system, path, beam.ray(v)), start(beam, v, lead_in_mm));
        }
        return fan;
    }
    fan.v_low_mm = spans.front().low_mm;
    fan.v_high_mm = spans.back().high_mm;
    const std::vector<double> v_mm = places(spans, rays);
    const std::vector<PathEvent> meetings = events(path, system.surfaces.size());
    for (std::size_t k = 0; k < v_mm.size(); ++k) {
        const TracedRay traced = trace_ray(system, path, beam.ray(v_mm[k]));
        if (traced.status.fate != RayFate::ok) {
            continue;  // an island too narrow for its neighbour's step
        }
        add_surviving(fan, traced, start(beam, v_mm[k], lead_in_mm));
        add_meetings(fan, system, meetings, traced);
        if (k == v_mm.size() / 2) {
            add_marks(fan, traced);
        }
    }
    return fan;
}

void add_stopped_rays(const OpticalSystem& system, double field_deg, int rays, double lead_in_mm,
                      RayFan& fan) {
    const Beam beam = meridional_beam(system, field_deg);
    for (const double v : places({{beam.low_mm, beam.high_mm}}, rays)) {
        const TracedRay traced = trace_ray(system, fan.path, beam.ray(v));
        if (traced.status.fate != RayFate::ok) {
            add_lost(fan, traced, start(beam, v, lead_in_mm));
        }
    }
}

std::vector<RayStretch> walked(const std::vector<RayStretch>& stretches, double share) {
    if (share >= 1.0) {
        return stretches;
    }
    const auto length = [](const RayStretch& stretch) {
        double sum = 0.0;
        for (std::size_t k = 1; k < stretch.points.size(); ++k) {
            sum += glm::distance(stretch.points[k - 1], stretch.points[k]);
        }
        return sum;
    };
    std::vector<RayStretch> kept;
    for (std::size_t first = 0; first < stretches.size();) {
        std::size_t end = first;
        double whole = 0.0;
        while (end < stretches.size() && stretches[end].ray == stretches[first].ray) {
            whole += length(stretches[end++]);
        }
        double left = share * whole;
        for (; first < end && left > 0.0; ++first) {
            RayStretch part{
                stretches[first].leg, {stretches[first].points.front()}, stretches[first].ray};
            for (std::size_t k = 1; k < stretches[first].points.size() && left > 0.0; ++k) {
                const DrawingPoint a = stretches[first].points[k - 1];
                const DrawingPoint b = stretches[first].points[k];
                const double step = glm::distance(a, b);
                part.points.push_back(step <= left ? b : a + (b - a) * (left / step));
                left -= step;
            }
            kept.push_back(std::move(part));
        }
        first = end;
    }
    return kept;
}

}  // namespace ghostlight
