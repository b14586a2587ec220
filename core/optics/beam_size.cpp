#include "core/optics/beam_size.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/optics/paraxial.h"
#include "core/optics/trace.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr double largest_field_step_deg = 4.0;  ///< the chief ray is followed in such steps
constexpr int directions = 9;                   ///< about the chief ray, over half a turn
constexpr int halvings = 24;                    ///< 6e-8 of the pupil's radius

/// What a cut leaves of the stop's radius; never nothing, so that there is a beam to follow.
double left_open(double cut) { return std::max(1.0 - cut, 0.01); }

class BeamTracer {
   public:
    BeamTracer(const OpticalSystem& system, const std::vector<bool>& rims)
        : system_(system), rims_(rims), heights_(system.surfaces.size(), 0.0) {
        const double radius = first_order(system).entrance_pupil_radius_mm;
        const double first = system.surfaces.front().semi_diameter_mm;
        step_mm_ = std::isfinite(radius) && radius > 0.0 ? radius : first;
    }

    const std::vector<double>& heights() const { return heights_; }

    /// The ray through (u, v) of the plane across the beam, where it gets through at all.
    std::optional<TracedRay> trace(const BeamField& field, double u, double v) const {
        const BeamFrame frame = beam_frame({field.field_deg, 90.0});
        TracedRay ray = trace_ray(system_, {}, {u * frame.e1 + v * frame.e2, frame.direction});
        if (!ray.status.reaches_sensor()) return std::nullopt;
        return ray;
    }

    bool passes(const BeamField& field, double u, double v) {
        const auto ray = trace(field, u, v);
        if (!ray) return false;
        const double a = system_.stop_mask.semi_diameter_mm;
        const double y = ray->stop_point.y;
        const double b = a * left_open(y > 0.0 ? field.cut_upper : field.cut_lower);
        const double side = a * left_open(field.cut_sides);
        // 1e-9: the stop's own edge belongs to the beam.
        if (std::pow(ray->stop_point.x / side, 2) + std::pow(y / b, 2) > 1.0 + 1e-9) return false;
        for (const RayHit& hit : ray->hits)
            if (rims_[hit.surface] && hit.surface != system_.stop && hit.r_rel > 1.0) return false;
        for (const RayHit& hit : ray->hits)
            heights_[hit.surface] =
                std::max(heights_[hit.surface], std::hypot(hit.point.x, hit.point.y));
        return true;
    }

    /// v of the ray through the middle of the stop, by secants from a guess.
    std::optional<double> chief(const BeamField& field, double guess_mm) const {
        const auto height = [&](double v) -> std::optional<double> {
            const auto ray = trace(field, 0.0, v);
            if (!ray) return std::nullopt;
            return ray->stop_point.y;
        };
        double v0 = guess_mm, v1 = guess_mm + 0.01 * step_mm_;
        auto h0 = height(v0), h1 = height(v1);
        const double fine = 1e-10 * system_.stop_mask.semi_diameter_mm;
        for (int i = 0; i < 30 && h0 && h1; ++i) {
            if (std::abs(*h1) <= fine) return v1;
            if (*h1 == *h0) return std::nullopt;
            double next = v1 - *h1 * (v1 - v0) / (*h1 - *h0);
            next = std::clamp(next, v1 - 4.0 * step_mm_, v1 + 4.0 * step_mm_);
            v0 = v1;
            h0 = h1;
            v1 = next;
            h1 = height(v1);
        }
        return std::nullopt;
    }

    /// Follows the beam outwards from its chief ray. False when that ray itself is stopped.
    bool fill(const BeamField& field, double chief_mm) {
        if (!passes(field, 0.0, chief_mm)) return false;
        for (int k = 0; k < directions; ++k) {
            const double angle = std::numbers::pi * (k / (directions - 1.0) - 0.5);
            const double du = std::cos(angle), dv = std::sin(angle);
            double inside = 0.0, outside = step_mm_;
            for (int i = 0; i < 8 && passes(field, outside * du, chief_mm + outside * dv); ++i) {
                inside = outside;
                outside *= 2.0;
            }
            for (int i = 0; i < halvings; ++i) {
                const double middle = 0.5 * (inside + outside);
                (passes(field, middle * du, chief_mm + middle * dv) ? inside : outside) = middle;
            }
        }
        return true;
    }

   private:
    const OpticalSystem& system_;
    const std::vector<bool>& rims_;
    std::vector<double> heights_;
    double step_mm_ = 1.0;
};

/// Films neither bend rays nor are wanted here, and an f-number would be worked out each time.
Prescription bare(Prescription lens) {
    for (Surface& surface : lens.surfaces) surface.coating = Uncoated{};
    return lens;
}

}  // namespace

BeamSizes beam_sizes(const Prescription& lens, std::span<const BeamField> fields,
                     const std::vector<bool>& rims) {
    const OpticalSystem system = compile(bare(lens), d_line_nm);
    BeamTracer tracer(system, rims);
    std::vector<BeamField> ascending(fields.begin(), fields.end());
    std::ranges::sort(ascending, {}, &BeamField::field_deg);
    BeamSizes sizes;
    double reached_deg = 0.0, chief_mm = 0.0;
    for (const BeamField& field : ascending) {
        std::optional<double> found = chief_mm;
        while (found && reached_deg < field.field_deg) {
            const double before_deg = reached_deg;
            reached_deg = std::min(field.field_deg, reached_deg + largest_field_step_deg);
            BeamField between = field;
            between.field_deg = reached_deg;
            // From the axis the paraxial pupil is the guess, later the last step's slope.
            const double slope = before_deg > 0.0 ? chief_mm / std::sin(rad_from_deg(before_deg))
                                                  : -first_order(system).entrance_pupil_z_mm;
            const double guess = slope * std::sin(rad_from_deg(reached_deg));
            found = tracer.chief(between, std::isfinite(guess) ? guess : chief_mm);
            if (found) chief_mm = *found;
        }
        if (!found || !tracer.fill(field, chief_mm)) break;
        sizes.widest_field_deg = field.field_deg;
    }
    sizes.height_mm = tracer.heights();
    return sizes;
}

}  // namespace ghostlight
