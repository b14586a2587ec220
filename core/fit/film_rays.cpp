#include "core/fit/film_rays.h"

#include <algorithm>
#include <cmath>

#include "core/optics/trace_steps.h"

namespace ghostlight {

std::vector<FilmEvent> film_events(const FitScene& scene, const GhostPath& path) {
    std::vector<FilmEvent> found;
    for (const TraceStep<double>& step : trace_path<double>(scene.system(), path).steps)
        if (!step.invisible)
            found.push_back(
                {static_cast<std::size_t>(step.surface), step.sense > 0.0, step.reflects});
    return found;
}

FilmRay film_ray(const FitScene& scene, const GhostPath& path, const BeamFrame& frame,
                 const std::array<double, 2>& place) {
    FilmRay found;
    const Prescription& lens = scene.lens.lens;
    const bool absorbs = lens.internal_transmittance;
    if (absorbs) found.passed.assign(scene.samples.size(), 1.0);
    // What is nothing at the main wavelength is left out at all.
    const auto main_trace = trace_path<double>(scene.system(), path);
    std::vector<std::vector<double>> cosines;  // node by node
    for (std::size_t node = 0; node < scene.geometry.size(); ++node) {
        const auto trace = trace_path<double>(scene.geometry[node], path);
        const glm::dvec3 origin = place[0] * frame.e1 + place[1] * frame.e2;
        RayAt<double> ray{{origin.x, origin.y, origin.z},
                          {frame.direction.x, frame.direction.y, frame.direction.z}};
        Vec3<double> s(frame.e1.x, frame.e1.y, frame.e1.z);
        auto& own = cosines.emplace_back();
        std::size_t k = 0;
        auto absorb = [&](const Vec3<double>& start, double gap_mm, const Medium& medium) {
            if (!absorbs || node != scene.main) return;
            const Vec3<double>& end = ray.position;
            const double length_mm = std::sqrt(
                (end.x - start.x) * (end.x - start.x) + (end.y - start.y) * (end.y - start.y) +
                (end.z - start.z - gap_mm) * (end.z - start.z - gap_mm));
            for (std::size_t w = 0; w < scene.samples.size(); ++w)
                found.passed[w] *=
                    internal_transmittance(medium, scene.samples[w].wavelength_nm, length_mm);
        };
        for (const TraceStep<double>& step : trace.steps) {
            const Vec3<double> start = ray.position;
            const auto meeting = meet(step, trace.aspheric.data(), 1.0, ray);
            const auto row = static_cast<std::size_t>(step.surface);
            absorb(start, step.gap_mm,
                   step.sense > 0.0 ? medium_before(lens, row) : lens.surfaces[row].medium_after);
            const Vec3<double> before = ray.direction;
            turn(step, meeting, ray);
            if (main_trace.steps[k++].invisible) continue;
            own.push_back(meeting.cos_incidence);
            if (node != scene.main) continue;
            const Vec3<double> n = cross(before, meeting.normal);
            const double n2 = dot(n, n);
            Vec3<double> now = s;
            if (n2 >= 1e-10) {
                const double inverse = 1.0 / std::sqrt(n2);
                now = Vec3<double>(n.x * inverse, n.y * inverse, n.z * inverse);
            }
            found.turn_cos.push_back(dot(s, now));
            found.turn_sin.push_back(dot(cross(before, s), now));
            s = now;
        }
    }
    const std::size_t events = cosines.front().size();
    for (std::size_t e = 0; e < events; ++e)
        for (const auto& shares : scene.nodes) {
            double cosine = 0.0;
            for (std::size_t node = 0; node < shares.size(); ++node)
                cosine += shares[node] * cosines[node][e];
            found.cosines.push_back(std::clamp(cosine, 0.0, 1.0));
        }
    return found;
}

}  // namespace ghostlight
