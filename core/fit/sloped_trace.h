#pragma once

#include <ceres/jet.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/fit/lens_move.h"
#include "core/ghosts/bundle.h"
#include "core/optics/trace_steps.h"

// The trace on ceres::Jet: how rays and their weights move with a lens and its light.

namespace ghostlight {

template <int N>
using SlopeJet = ceres::Jet<double, N>;

/// A move as one wavelength sees it; null where the lens stays.
struct SystemSides {
    const OpticalSystem *less = nullptr, *more = nullptr;
    double width = 1.0;
};

/// A path whose numbers carry their slopes by up to N moves.
template <int N>
TracePath<SlopeJet<N>> sloped_path(const OpticalSystem& now, const GhostPath& ghost,
                                   std::span<const SystemSides> sides) {
    using Jet = SlopeJet<N>;
    TracePath<Jet> path = trace_path<Jet>(now, ghost);
    for (std::size_t slot = 0; slot < sides.size(); ++slot) {
        if (sides[slot].less == nullptr) continue;
        const auto less = trace_path<double>(*sides[slot].less, ghost),
                   more = trace_path<double>(*sides[slot].more, ghost);
        auto slope = [&](Jet& to, double a, double b) {
            to.v[static_cast<int>(slot)] = (b - a) / sides[slot].width;
        };
        for (std::size_t k = 0; k < path.steps.size(); ++k) {
            TraceStep<Jet>& step = path.steps[k];
            const TraceStep<double>&a = less.steps[k], &b = more.steps[k];
            slope(step.gap_mm, a.gap_mm, b.gap_mm);
            slope(step.curvature, a.curvature, b.curvature);
            slope(step.conic, a.conic, b.conic);
            slope(step.inverse_clear, a.inverse_clear, b.inverse_clear);
            slope(step.n_in, a.n_in, b.n_in);
            slope(step.n_out, a.n_out, b.n_out);
            slope(step.eta, a.eta, b.eta);
            slope(step.absorption_per_mm, a.absorption_per_mm, b.absorption_per_mm);
        }
        if (less.layers.size() == path.layers.size() && more.layers.size() == path.layers.size())
            for (std::size_t k = 0; k < path.layers.size(); ++k) {
                slope(path.layers[k].n2_re, less.layers[k].n2_re, more.layers[k].n2_re);
                slope(path.layers[k].n2_im, less.layers[k].n2_im, more.layers[k].n2_im);
                slope(path.layers[k].k0_d, less.layers[k].k0_d, more.layers[k].k0_d);
            }
        slope(path.sensor_gap_mm, less.sensor_gap_mm, more.sensor_gap_mm);
        slope(path.sensor_absorption_per_mm, less.sensor_absorption_per_mm,
              more.sensor_absorption_per_mm);
    }
    return path;
}

/// The beam's frame with its slopes.
template <int N>
struct SlopedBeam {
    Vec3<SlopeJet<N>> direction, e1, e2;

    SlopedBeam(const LightDirection& light, std::span<const LensMove* const> moves) {
        using Jet = SlopeJet<N>;
        const BeamFrame now = beam_frame(light);
        auto jets = [](const glm::dvec3& v) { return Vec3<Jet>(Jet(v.x), Jet(v.y), Jet(v.z)); };
        direction = jets(now.direction);
        e1 = jets(now.e1);
        e2 = jets(now.e2);
        for (std::size_t slot = 0; slot < moves.size(); ++slot) {
            const LensMove& move = *moves[slot];
            if (move.light_less == move.light_more) continue;
            const BeamFrame less = beam_frame(move.light_less), more = beam_frame(move.light_more);
            auto slope = [&](Vec3<Jet>& to, const glm::dvec3& a, const glm::dvec3& b) {
                const glm::dvec3 by = (b - a) / move.width;
                const int s = static_cast<int>(slot);
                to.x.v[s] = by.x;
                to.y.v[s] = by.y;
                to.z.v[s] = by.z;
            };
            slope(direction, less.direction, more.direction);
            slope(e1, less.e1, more.e1);
            slope(e2, less.e2, more.e2);
        }
    }
    RayAt<SlopeJet<N>> ray(double u_mm, double v_mm) const {
        auto across = [&](const SlopeJet<N>& a, const SlopeJet<N>& b) {
            return SlopeJet<N>(u_mm * a + v_mm * b);
        };
        return {{across(e1.x, e2.x), across(e1.y, e2.y), across(e1.z, e2.z)}, direction};
    }
};

/// Where a ray lands, what it clears, and where it crosses the stop: as the bundles' kernel has it.
template <int N>
struct SlopedRay {
    SlopeJet<N> x_mm, y_mm, margin, clear;
    std::array<SlopeJet<N>, max_stop_crossings> stop_u_mm, stop_v_mm;
};

template <int N>
SlopedRay<N> sloped_ray(const TracePath<SlopeJet<N>>& path, const SlopedBeam<N>& beam, double u_mm,
                        double v_mm) {
    using Jet = SlopeJet<N>;
    SlopedRay<N> found;
    RayAt<Jet> ray = beam.ray(u_mm, v_mm);
    Jet margin(1.0), r2(0.0);
    auto narrow = [&](const Jet& next) {
        if (margin.a >= 0.0) margin = smaller(margin, next);
    };
    std::size_t crossing = 0;
    for (const TraceStep<Jet>& step : path.steps) {
        const Meeting<Jet> meeting = meet(step, path.aspheric.data(), margin, ray);
        narrow(smaller(meeting.turned_margin,
                       smaller(meeting.miss_margin, meeting.hemisphere_margin)));
        if (step.at_stop) {
            if (crossing < max_stop_crossings) {
                found.stop_u_mm[crossing] = ray.position.x;
                found.stop_v_mm[crossing] = ray.position.y;
            }
            ++crossing;
        } else {
            r2 = larger(r2, r2_rel(step, ray.position));
        }
        const Jet cos2_squared = turn(step, meeting, ray);
        if (!step.reflects) narrow(cos2_squared);
    }
    narrow(ray.direction.z);
    const Jet t = -(ray.position.z + path.sensor_gap_mm) / ray.direction.z;
    found.x_mm = ray.position.x + t * ray.direction.x;
    found.y_mm = ray.position.y + t * ray.direction.y;
    found.margin = margin;
    // A ray along the axis clears everything, however the lens moves.
    found.clear = r2.a > 0.0 ? Jet(1.0 - sqrt(r2)) : Jet(1.0);
    return found;
}

/// The weight of a ray, polarisation carried along.
template <int N>
SlopeJet<N> sloped_weight(const TracePath<SlopeJet<N>>& path, const SlopedBeam<N>& beam,
                          double u_mm, double v_mm) {
    using Jet = SlopeJet<N>;
    RayAt<Jet> ray = beam.ray(u_mm, v_mm);
    JonesState<Jet> jones = jones_start<Jet>(beam.e1);
    Jet depth(0.0);
    for (const TraceStep<Jet>& step : path.steps) {
        const Vec3<Jet> start = ray.position;
        const Meeting<Jet> meeting = meet(step, path.aspheric.data(), Jet(1.0), ray);
        const Vec3<Jet>& end = ray.position;
        const Jet length = (end.x - start.x) * ray.direction.x +
                           (end.y - start.y) * ray.direction.y +
                           (end.z - start.z - step.gap_mm) * ray.direction.z;
        depth += step.absorption_per_mm * length;
        const Vec3<Jet> before = ray.direction;
        turn(step, meeting, ray);
        if (step.invisible) continue;
        apply(amplitudes(step, path.layers.data(), meeting.cos_incidence), step.reflects, meeting,
              before, jones);
    }
    const Jet passed = depth.a > 0.0 ? Jet(exp(-depth)) : Jet(1.0);
    return 0.5 * passed * (jones.intensity(0) + jones.intensity(1));
}

}  // namespace ghostlight
