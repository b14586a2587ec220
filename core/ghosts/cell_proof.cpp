#include "core/ghosts/cell_proof.h"

#include <algorithm>
#include <cmath>
#include <limits>

// The formulas are those of core/optics/trace_steps.h on affine forms, for rays that pass: what is
// known of these (within the clear radius, direction of unit length, …) confines every quantity
// and narrows the rectangle on the way.

namespace ghostlight {
namespace {

/// Narrowed below this share, a cell is better begun anew on what is left of it.
constexpr double restart_share = 0.5;
constexpr int newton_rounds = 8;            ///< for the middle ray of an asphere; any start is safe
constexpr int enclosing_rounds = 2;         ///< of the asphere's intersection
constexpr double worse_than_nothing = 0.5;  ///< of a known radius, as error of a form

const Interval unit{-1.0, 1.0};
const Interval open_share{0.0, 1.0};

struct AffineVector {
    Affine x, y, z;
};
Affine dot(const AffineVector& a, const AffineVector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Affine norm2(const AffineVector& a) { return square(a.x) + square(a.y) + square(a.z); }

/// Sag and dsag/d(r²) of a surface for r² in an interval.
struct SagRange {
    Interval sag, slope;
    bool finite = true;
};

class CellTrace {
   public:
    CellTrace(const ProofPath& path, const BeamFrame& frame, const PupilBox& cell)
        : path_(path), cell_(cell) {
        const Affine u = across(cell.u0_mm, cell.u1_mm, 1.0, 0.0);
        const Affine v = across(cell.v0_mm, cell.v1_mm, 0.0, 1.0);
        auto start = [&](int axis) { return frame.e1[axis] * u + frame.e2[axis] * v; };
        position_ = {start(0), start(1), start(2)};
        direction_ = {constant(frame.direction.x), constant(frame.direction.y),
                      constant(frame.direction.z)};
    }

    CellVerdict follow(bool on_sensor) {
        int reflection = 0;
        for (const ProofPath::Step& step : path_.steps) {
            switch (pass(step)) {
                case Fate::none:
                    verdict_.may_pass = false;
                    return verdict_;
                case Fate::unknown:
                    return ended();
                case Fate::passes:
                    break;
            }
            if (step.event.reflects && reflection < 2) {
                const Interval cosine = range(cosine_, domain_);
                verdict_.cosine[reflection++] = intersection(cosine, {0.0, 1.0 + affine_rounding});
            }
            if (domain_.share() < restart_share) return ended();
        }
        return land(on_sensor);
    }

   private:
    enum class Fate { none, unknown, passes };

    const ProofPath& path_;
    PupilBox cell_;
    AffineDomain domain_;
    AffineVector position_, direction_, normal_;
    AffineVector start_;  ///< before the last move
    Affine moved_;        ///< along the ray
    Affine cosine_;
    CellVerdict verdict_;

    static Affine across(double low, double high, double du, double dv) {
        const double middle = 0.5 * (low + high);
        const double half = just_above(std::max(high - middle, middle - low));
        return {middle, du * half, dv * half, 0.0};
    }

    CellVerdict ended() {
        auto at = [](double low, double high, double share) {
            return std::lerp(low, high, 0.5 * (share + 1.0));
        };
        // The domain's ends are outward already; lerp's rounding is not.
        const double slack = 1e-14;
        verdict_.live = {at(cell_.u0_mm, cell_.u1_mm, std::max(-1.0, domain_.u.low - slack)),
                         at(cell_.u0_mm, cell_.u1_mm, std::min(1.0, domain_.u.high + slack)),
                         at(cell_.v0_mm, cell_.v1_mm, std::max(-1.0, domain_.v.low - slack)),
                         at(cell_.v0_mm, cell_.v1_mm, std::min(1.0, domain_.v.high + slack))};
        return verdict_;
    }

    /// A form that says less than what is known of the quantity is replaced by that.
    static void confine(Affine& x, const Interval& known) {
        const double radius = 0.5 * known.width();
        if (x.radius() > radius && x.error > worse_than_nothing * radius) x = anything_in(known);
    }
    Interval known(const Affine& x, const Interval& also) const {
        return intersection(range(x, domain_), also);
    }

    void advance(const Affine& t) {
        start_ = position_;
        moved_ = t;
        position_ = {position_.x + t * direction_.x, position_.y + t * direction_.y,
                     position_.z + t * direction_.z};
    }

    /// Where no form can be had: rays that pass meet the surface somewhere within its limits.
    void be_anywhere(const ProofPath::Step& step) {
        start_ = position_;
        moved_.error = std::numeric_limits<double>::infinity();
        const Affine across = anything_in({-step.limit_mm, step.limit_mm});
        position_ = {across, across, anything_in(step.sag_mm)};
    }

    Fate meet_plane(const ProofPath::Step& step) {
        const Interval dz = range(direction_.z, domain_);
        if (dz.contains(0.0)) {
            be_anywhere(step);
            return Fate::passes;
        }
        const Affine t = -(position_.z * reciprocal(direction_.z, dz));
        position_.x = position_.x + t * direction_.x;
        position_.y = position_.y + t * direction_.y;
        position_.z = constant(0.0);
        return Fate::passes;
    }

    /// The sine of incidence is c |p × d| about the centre of curvature, wherever on the ray p is.
    Fate meet_sphere(const ProofPath::Step& step) {
        const double c = step.event.curvature, sense = step.event.sense;
        const AffineVector& p = position_;
        const AffineVector& d = direction_;
        const AffineVector moment{c * (p.y * d.z - p.z * d.y) + d.y,
                                  c * (p.z * d.x - p.x * d.z) - d.x, c * (p.x * d.y - p.y * d.x)};
        const Affine sine2 = norm2(moment);
        if (!narrow(domain_, sine2, open_share)) return Fate::none;
        const Affine cosine2 = 1.0 - sine2;
        cosine_ = sqrt(cosine2, known(cosine2, open_share));
        const Affine divisor = d.z - c * dot(p, d) + sense * cosine_;
        const Interval size = range(divisor, domain_);
        if (!size.contains(0.0)) {
            advance((c * norm2(p) - 2.0 * p.z) * reciprocal(divisor, size));
            return Fate::passes;
        }
        // The normal is the cosine along the ray and the moment across it.
        const Affine along = sense * cosine_;
        const Affine x = along * d.x - (d.y * moment.z - d.z * moment.y);
        const Affine y = along * d.y - (d.z * moment.x - d.x * moment.z);
        const Affine z = along * d.z - (d.x * moment.y - d.y * moment.x);
        start_ = position_;
        moved_.error = std::numeric_limits<double>::infinity();
        position_ = {(-1.0 / c) * x, (-1.0 / c) * y, (1.0 / c) * (1.0 - z)};
        return Fate::passes;
    }

    Fate meet_conic(const ProofPath::Step& step) {
        const double c = step.event.curvature, k1 = 1.0 + step.event.conic;
        const AffineVector& p = position_;
        const AffineVector& d = direction_;
        const Affine f = c * (square(p.x) + square(p.y) + k1 * square(p.z)) - 2.0 * p.z;
        const Affine g = d.z - c * (p.x * d.x + p.y * d.y + k1 * (p.z * d.z));
        const Affine margin = square(g) - c * ((1.0 + step.event.conic * square(d.z)) * f);
        constexpr double all = std::numeric_limits<double>::max();
        if (!narrow(domain_, margin, {0.0, all})) return Fate::none;
        cosine_ = sqrt(margin, known(margin, {0.0, all}));
        const Affine divisor = g + step.event.sense * cosine_;
        const Interval size = range(divisor, domain_);
        if (size.contains(0.0))
            be_anywhere(step);
        else
            advance(f * reciprocal(divisor, size));
        return Fate::passes;
    }

    SagRange sag_range(const ProofPath::Step& step, const Interval& r2) const {
        const double c = step.event.curvature, k1 = 1.0 + step.event.conic;
        const Interval domain = Interval{1.0, 1.0} - (k1 * c * c) * r2;
        SagRange result;
        const Interval root = sqrt(domain);
        if (!(root.low > 0.0)) {
            result.finite = false;
            return result;
        }
        const Interval one{1.0, 1.0};
        result.sag = c * r2 / (one + root);
        result.slope = Interval{c, c} / (2.0 * root);
        Interval power = r2;
        const double* a = path_.aspheric.data() + step.event.first_aspheric;
        for (int i = 0; i < step.event.aspheric_count; ++i) {
            result.slope = result.slope + (i + 2.0) * a[i] * power;
            power = power * r2;
            result.sag = result.sag + a[i] * power;
        }
        return result;
    }

    /// Sag of the form r², and its slope; false where the conic's edge may be reached.
    bool sag_form(const ProofPath::Step& step, const Affine& r2, Affine& sag, Affine& slope) const {
        const double c = step.event.curvature, k1 = 1.0 + step.event.conic;
        const double limit2 = step.limit_mm * step.limit_mm;
        const Affine domain = 1.0 - (k1 * c * c) * r2;
        const Interval least = Interval{1.0, 1.0} - (k1 * c * c) * Interval{0.0, limit2};
        // r² may lie beyond the limit here: the intersection's first guess is not bound by it.
        const Interval size = range(domain, domain_);
        if (!(size.low > 0.0) || !(least.low > 0.0)) return false;
        const Affine root = sqrt(domain, size);
        const Interval root_size = sqrt(size);
        sag = c * (r2 * reciprocal(1.0 + root, Interval{1.0, 1.0} + root_size));
        slope = (0.5 * c) * reciprocal(root, root_size);
        Affine power = r2;
        const double* a = path_.aspheric.data() + step.event.first_aspheric;
        for (int i = 0; i < step.event.aspheric_count; ++i) {
            slope = slope + ((i + 2.0) * a[i]) * power;
            power = power * r2;
            sag = sag + a[i] * power;
        }
        return true;
    }

    /// Interval Newton about an affine guess: a root t of F within an interval T that also holds
    /// the guess m lies in m − F(m)/F'(T).
    Fate meet_asphere(const ProofPath::Step& step) {
        const Interval dz = range(direction_.z, domain_);
        if (dz.contains(0.0)) return meet_asphere_anywhere(step);
        const double limit = step.limit_mm;
        const Interval within{-limit, limit};
        const Interval x0 = range(position_.x, domain_), y0 = range(position_.y, domain_);
        const Interval dx = intersection(range(direction_.x, domain_), unit);
        const Interval dy = intersection(range(direction_.y, domain_), unit);
        const Interval reach = (step.sag_mm - range(position_.z, domain_)) / dz;

        const double guess = middle_root(step);
        Affine miss, slope;
        if (!miss_at(step, constant(guess), miss)) return meet_asphere_anywhere(step);
        const double rate = middle_rate(step, guess);
        if (!(std::abs(rate) > 1e-6)) return meet_asphere_anywhere(step);
        const Affine m{guess, -miss.du / rate, -miss.dv / rate, 0.0};
        if (!miss_at(step, m, miss)) return meet_asphere_anywhere(step);
        const Interval guesses = range(m, domain_);
        Affine t = m;
        Interval reachable = reach;
        for (int round = 0; round < enclosing_rounds; ++round) {
            const Interval all = hull(reachable, guesses);
            // Rays that pass lie within the limit, guesses anywhere, what is between them between.
            const Interval x = hull(intersection(x0 + reachable * dx, within), x0 + guesses * dx);
            const Interval y = hull(intersection(y0 + reachable * dy, within), y0 + guesses * dy);
            if (x.empty() || y.empty() || all.empty()) return Fate::none;
            const SagRange sag = sag_range(step, square(x) + square(y));
            if (!sag.finite) return meet_asphere_anywhere(step);
            const Interval rates = dz - 2.0 * (sag.slope * (x * dx + y * dy));
            if (rates.contains(0.0))
                return round == 0 ? meet_asphere_anywhere(step) : finish_asphere(step, t);
            t = m - miss * anything_in(Interval{1.0, 1.0} / rates);
            reachable = intersection(reachable, range(t, domain_));
            if (reachable.empty()) return Fate::none;
        }
        return finish_asphere(step, t);
    }

    Fate meet_asphere_anywhere(const ProofPath::Step& step) {
        be_anywhere(step);
        return find_normal(step);
    }
    Fate finish_asphere(const ProofPath::Step& step, const Affine& t) {
        advance(t);
        return find_normal(step);
    }
    Fate find_normal(const ProofPath::Step& step) {
        const Affine r2 = square(position_.x) + square(position_.y);
        const double limit2 = step.limit_mm * step.limit_mm;
        if (!narrow(domain_, r2, {0.0, limit2})) return Fate::none;
        Affine held = r2;
        confine(held, {0.0, limit2});
        Affine sag, slope;
        if (!sag_form(step, held, sag, slope)) return Fate::unknown;
        normal_ = {-2.0 * (slope * position_.x), -2.0 * (slope * position_.y), constant(1.0)};
        return Fate::passes;
    }

    bool miss_at(const ProofPath::Step& step, const Affine& t, Affine& miss) const {
        const Affine x = position_.x + t * direction_.x, y = position_.y + t * direction_.y;
        Affine sag, slope;
        if (!sag_form(step, square(x) + square(y), sag, slope)) return false;
        miss = position_.z + t * direction_.z - sag;
        return true;
    }

    /// Of the ray in the middle, no more than a good guess.
    double middle_root(const ProofPath::Step& step) const {
        double t = -position_.z.center / direction_.z.center;
        for (int i = 0; i < newton_rounds; ++i) {
            double sag = 0.0, slope = 0.0;
            middle_sag(step, t, sag, slope);
            const double rate = middle_rate(step, t);
            if (!(std::abs(rate) > 1e-6)) break;
            const double miss = position_.z.center + t * direction_.z.center - sag;
            t -= std::clamp(miss / rate, -step.limit_mm, step.limit_mm);
        }
        return t;
    }
    double middle_rate(const ProofPath::Step& step, double t) const {
        double sag = 0.0, slope = 0.0;
        middle_sag(step, t, sag, slope);
        const double x = position_.x.center + t * direction_.x.center;
        const double y = position_.y.center + t * direction_.y.center;
        return direction_.z.center -
               2.0 * slope * (x * direction_.x.center + y * direction_.y.center);
    }
    void middle_sag(const ProofPath::Step& step, double t, double& sag, double& slope) const {
        const double c = step.event.curvature, k1 = 1.0 + step.event.conic;
        const double x = position_.x.center + t * direction_.x.center;
        const double y = position_.y.center + t * direction_.y.center;
        const double r2 = x * x + y * y;
        const double root = std::sqrt(std::max(1e-6, 1.0 - k1 * c * c * r2));
        sag = c * r2 / (1.0 + root);
        slope = 0.5 * c / root;
        double power = r2;
        const double* a = path_.aspheric.data() + step.event.first_aspheric;
        for (int i = 0; i < step.event.aspheric_count; ++i) {
            slope += (i + 2.0) * a[i] * power;
            power *= r2;
            sag += a[i] * power;
        }
    }

    /// Within the clear radius, on the surface's own side.
    bool clip(const ProofPath::Step& step) {
        const double limit = step.limit_mm;
        const Interval within{-limit, limit};
        AffineVector& p = position_;
        if (!narrow(domain_, p.x, within) || !narrow(domain_, p.y, within)) return false;
        const Interval x = range(p.x, domain_), y = range(p.y, domain_);
        const Interval r2 = square(x) + square(y);
        if (r2.low > limit * limit * (1.0 + affine_rounding)) return false;
        // A circle lies on the near side of each of its tangents.
        const double length = std::hypot(x.middle(), y.middle());
        if (length > 0.0) {
            const double nx = x.middle() / length, ny = y.middle() / length;
            const double reach = limit * (1.0 + affine_rounding);
            if (!narrow(domain_, nx * p.x + ny * p.y, {-reach, reach})) return false;
        }
        confine(p.x, within);
        confine(p.y, within);
        lie_on_surface(step);
        if (!narrow(domain_, p.z, step.sag_mm)) return false;
        confine(p.z, step.sag_mm);
        return true;
    }

    /// The sag of x and y errs less than the height along the ray, whose errors it takes only by
    /// the surface's slope; with that height the move along the ray errs less, and so do x and y.
    void lie_on_surface(const ProofPath::Step& step) {
        if (step.event.aspheric_count > 0 || step.event.curvature == 0.0) return;
        const double c = step.event.curvature, k1 = 1.0 + step.event.conic;
        const double limit2 = step.limit_mm * step.limit_mm;
        Affine r2 = square(position_.x) + square(position_.y);
        confine(r2, {0.0, limit2});
        const Affine domain = 1.0 - (k1 * c * c) * r2;
        constexpr double all = std::numeric_limits<double>::max();
        const Interval size = known(domain, {0.0, all});
        if (size.empty()) return;
        const Affine root = sqrt(domain, size);
        const Affine sag = c * (r2 * reciprocal(1.0 + root, Interval{1.0, 1.0} + sqrt(size)));
        if (sag.error >= position_.z.error) return;
        position_.z = sag;
        const Interval dz = range(direction_.z, domain_);
        if (dz.contains(0.0)) return;
        const Affine t = (sag - start_.z) * reciprocal(direction_.z, dz);
        if (t.error >= moved_.error) return;
        moved_ = t;
        position_.x = start_.x + t * direction_.x;
        position_.y = start_.y + t * direction_.y;
    }

    /// The component along the axis, from those across it, where that errs less.
    void have_unit_length(double sense) {
        const Affine across2 = square(direction_.x) + square(direction_.y);
        const Affine along2 = 1.0 - across2;
        const Interval size = known(along2, open_share);
        if (size.empty()) return;
        const Affine along = sense * sqrt(along2, size);
        if (along.error < direction_.z.error) direction_.z = along;
    }

    Fate pass(const ProofPath::Step& step) {
        const TraceStep<double>& event = step.event;
        const Interval onward = event.sense > 0.0 ? Interval{0.0, 1.0 + affine_rounding}
                                                  : Interval{-1.0 - affine_rounding, 0.0};
        if (!narrow(domain_, direction_.z, onward)) return Fate::none;
        if (!narrow(domain_, square(direction_.x) + square(direction_.y), open_share))
            return Fate::none;
        have_unit_length(event.sense);
        confine(direction_.z, onward);
        position_.z = position_.z + event.gap_mm;
        const bool plane = event.curvature == 0.0 && event.aspheric_count == 0;
        const Fate met = plane                      ? meet_plane(step)
                         : event.aspheric_count > 0 ? meet_asphere(step)
                         : event.conic == 0.0       ? meet_sphere(step)
                                                    : meet_conic(step);
        if (met != Fate::passes) return met;
        if (!clip(step)) return Fate::none;
        if (!event.reflects && event.n_in == event.n_out) return Fate::passes;
        if (plane) {
            cosine_ = event.sense * direction_.z;
            normal_ = {constant(0.0), constant(0.0), constant(event.sense)};
        } else if (event.aspheric_count == 0) {
            const double c = event.curvature, k1 = 1.0 + event.conic;
            normal_ = {-c * position_.x, -c * position_.y, 1.0 - (k1 * c) * position_.z};
        }
        if (event.spherical && !plane) {
            normal_ = {event.sense * normal_.x, event.sense * normal_.y, event.sense * normal_.z};
        } else if (!plane && !normalise()) {
            return Fate::unknown;
        }
        confine(cosine_, open_share);
        return turn(event);
    }

    /// Unit length, turned along the ray; the cosine of incidence with it.
    bool normalise() {
        const Affine projected = dot(normal_, direction_);
        const Interval side = range(projected, domain_);
        if (side.contains(0.0)) return false;
        const Affine length2 = norm2(normal_);
        const Interval size2 = range(length2, domain_);
        if (!(size2.low > 0.0)) return false;
        const Affine length = sqrt(length2, size2);
        const Affine inverse = (side.low > 0.0 ? 1.0 : -1.0) * reciprocal(length, sqrt(size2));
        normal_ = {normal_.x * inverse, normal_.y * inverse, normal_.z * inverse};
        cosine_ = projected * inverse;
        return true;
    }

    Fate turn(const TraceStep<double>& event) {
        AffineVector& d = direction_;
        if (event.reflects) {
            const Affine twice = -2.0 * cosine_;
            d = {d.x + twice * normal_.x, d.y + twice * normal_.y, d.z + twice * normal_.z};
        } else {
            const Affine cosine2 = 1.0 - (event.eta * event.eta) * (1.0 - square(cosine_));
            if (!narrow(domain_, cosine2, open_share)) return Fate::none;
            const Affine q = sqrt(cosine2, known(cosine2, open_share)) - event.eta * cosine_;
            d = {event.eta * d.x + q * normal_.x, event.eta * d.y + q * normal_.y,
                 event.eta * d.z + q * normal_.z};
        }
        confine(d.x, unit);
        confine(d.y, unit);
        return Fate::passes;
    }

    CellVerdict land(bool on_sensor) {
        verdict_.may_pass = false;
        const Interval forward{0.0, 1.0 + affine_rounding};
        if (!narrow(domain_, direction_.z, forward)) return verdict_;
        position_.z = position_.z + path_.sensor_gap_mm;
        verdict_.may_pass = true;
        if (range(direction_.z, domain_).contains(0.0)) return ended();
        ProofPath::Step sensor;
        sensor.limit_mm = path_.sensor_radius_mm;
        meet_plane(sensor);
        if (on_sensor && !clip(sensor)) {
            verdict_.may_pass = false;
            return verdict_;
        }
        verdict_.sensor_x_mm = range(position_.x, domain_);
        verdict_.sensor_y_mm = range(position_.y, domain_);
        verdict_.complete = true;
        return ended();
    }
};

/// Of a surface within a radius, on the vertex's hemisphere.
Interval sag_within(const SurfaceAt& surface, double radius_mm) {
    const double c = surface.curvature_per_mm, k1 = 1.0 + surface.conic;
    double r2 = radius_mm * radius_mm;
    if (k1 * c * c * r2 > 1.0) r2 = 1.0 / (k1 * c * c);
    const double root = std::sqrt(std::max(0.0, 1.0 - k1 * c * c * r2));
    const double rim = c * r2 / (1.0 + root);
    // The root loses half of its digits where it is near zero.
    const double slack = 1e-7 * std::abs(rim);
    Interval sag{std::min(0.0, rim - slack), std::max(0.0, rim + slack)};
    const Interval all{0.0, just_above(r2)};
    Interval power = all;
    for (const double a : surface.aspheric) {
        power = power * all;
        sag = sag + a * power;
    }
    return sag;
}

}  // namespace

ProofPath proof_path(const OpticalSystem& system, const GhostPath& ghost) {
    const TracePath<double> traced = trace_path<double>(system, ghost);
    ProofPath path;
    path.aspheric = traced.aspheric;
    path.sensor_gap_mm = traced.sensor_gap_mm;
    path.sensor_radius_mm =
        0.5 * just_above(std::hypot(system.sensor_width_mm, system.sensor_height_mm));
    for (const TraceStep<double>& event : traced.steps) {
        const SurfaceAt& surface = system.surfaces[static_cast<std::size_t>(event.surface)];
        const double limit = just_above(event.at_stop ? system.stop_mask.semi_diameter_mm
                                                      : surface.semi_diameter_mm);
        path.steps.push_back({event, limit, sag_within(surface, limit)});
    }
    return path;
}

CellVerdict prove_cell(const ProofPath& path, const BeamFrame& frame, const PupilBox& cell,
                       bool on_sensor) {
    return CellTrace(path, frame, cell).follow(on_sensor);
}

}  // namespace ghostlight
