#include "core/flare/polar_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.h"

namespace ghostlight {
namespace {

constexpr double pi = std::numbers::pi;
/// Up to here the transform itself is summed. Fringes from opposite edges are then as narrow as
/// rings, and what is left of them beyond averages out.
constexpr double last_exact_k = 96.0;
std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// |transform|² of a polygon at points of an arc, many at once in single precision: what
/// polygon_transform() is at one point. Plain loops over arrays, for the compiler to vectorise.
class ArcPower {
   public:
    explicit ArcPower(const std::vector<glm::dvec2>& corners) : corners_(corners) {}

    /// Adds weight × |F|² at k (cos, sin)(π s/around) for s = 0 … around − 1 to `power`.
    void add(double k, int around, double weight, std::vector<double>& power) {
        const std::size_t n = idx(around);
        for (auto* values : {&kx_, &ky_, &re_, &im_, &cos_a_, &sin_a_, &cos_b_, &sin_b_})
            values->resize(n);
        for (std::size_t s = 0; s < n; ++s) {
            const double angle = pi * static_cast<double>(s) / around;
            kx_[s] = static_cast<float>(k * std::cos(angle));
            ky_[s] = static_cast<float>(k * std::sin(angle));
            re_[s] = im_[s] = 0.0F;
        }
        turn(corners_.front(), cos_b_, sin_b_);
        for (std::size_t e = 0; e < corners_.size(); ++e) {
            const glm::dvec2 from = corners_[e], to = corners_[(e + 1) % corners_.size()];
            cos_a_.swap(cos_b_);
            sin_a_.swap(sin_b_);
            turn(to, cos_b_, sin_b_);
            add_edge(static_cast<float>(to.x - from.x), static_cast<float>(to.y - from.y));
        }
        const auto scale = static_cast<float>(weight / (k * k * k * k));
        for (std::size_t s = 0; s < n; ++s)
            power[s] += static_cast<double>(scale * (re_[s] * re_[s] + im_[s] * im_[s]));
    }

   private:
    const std::vector<glm::dvec2>& corners_;
    std::vector<float> kx_, ky_, re_, im_, cos_a_, sin_a_, cos_b_, sin_b_;

    /// Cosine and sine of k·corner, to 1e-6, by a reduction to ±π/4 and polynomials.
    void turn(const glm::dvec2& corner, std::vector<float>& cosine,
              std::vector<float>& sine) const {
        const auto x = static_cast<float>(corner.x), y = static_cast<float>(corner.y);
        constexpr float to_quarters = 0.636619772F;
        constexpr float rounding = 12582912.0F;  // 1.5 · 2²³: its last bit is worth one
        constexpr float quarter_high = 1.5707855F, quarter_low = 1.0780605e-5F;
        const float* kx = kx_.data();
        const float* ky = ky_.data();
        float* c = cosine.data();
        float* s = sine.data();
        const std::size_t n = kx_.size();
        for (std::size_t i = 0; i < n; ++i) {
            const float phase = kx[i] * x + ky[i] * y;
            const float quarters = (phase * to_quarters + rounding) - rounding;
            const int q = static_cast<int>(quarters);
            const float r = (phase - quarters * quarter_high) - quarters * quarter_low;
            const float r2 = r * r;
            const float sin_r =
                r * (1.0F + r2 * (-0.16666654F + r2 * (0.00833216F - r2 * 0.00019515F)));
            const float cos_r =
                1.0F + r2 * (-0.5F + r2 * (0.041666645F + r2 * (-0.0013888397F + r2 * 2.4433e-5F)));
            const float swapped_sin = (q & 1) != 0 ? cos_r : sin_r;
            const float swapped_cos = (q & 1) != 0 ? sin_r : cos_r;
            s[i] = (q & 2) != 0 ? -swapped_sin : swapped_sin;
            c[i] = ((q + 1) & 2) != 0 ? -swapped_cos : swapped_cos;
        }
    }

    /// (k × d) sinc(k·d/2) exp(−i k·m), from the phases of its ends: their difference over k·d, or
    /// where that is small their mean.
    void add_edge(float dx, float dy) {
        constexpr float small = 0.02F;  // there the fourth power of it is below rounding
        const float *kx = kx_.data(), *ky = ky_.data();
        const float *ca = cos_a_.data(), *sa = sin_a_.data();
        const float *cb = cos_b_.data(), *sb = sin_b_.data();
        float *re = re_.data(), *im = im_.data();
        const std::size_t n = kx_.size();
        for (std::size_t i = 0; i < n; ++i) {
            const float across = kx[i] * dy - ky[i] * dx;
            const float x = 0.5F * (kx[i] * dx + ky[i] * dy);
            const bool is_small = std::abs(x) < small;
            const float by_difference = across / (2.0F * (is_small ? 1.0F : x));
            // sinc(x)/cos(x)/2
            const float by_mean = across * (0.5F + x * x * (1.0F / 6.0F));
            const float real =
                is_small ? by_mean * (ca[i] + cb[i]) : by_difference * (sb[i] - sa[i]);
            const float imaginary =
                is_small ? -by_mean * (sa[i] + sb[i]) : by_difference * (cb[i] - ca[i]);
            re[i] += real;
            im[i] += imaginary;
        }
    }
};

/// ∫ from −∞ of sinc²(x) dx over π: the share of an edge's light below x. Tabulated; beyond the
/// table by the mean of its tail, 1/(2π|x|).
class EdgeSpread {
   public:
    EdgeSpread() : below_(count + 1) {
        double sum = 0.0;
        auto sinc2 = [](double x) {
            const double s = x == 0.0 ? 1.0 : std::sin(x) / x;
            return s * s;
        };
        std::vector<double> from_zero(count / 2 + 1, 0.0);
        for (int i = 1; i <= count / 2; ++i) {
            const double x0 = (i - 1) * step, x1 = i * step;
            sum += step / 6.0 * (sinc2(x0) + 4.0 * sinc2(0.5 * (x0 + x1)) + sinc2(x1));
            from_zero[idx(i)] = sum / pi;
        }
        for (int i = 0; i <= count; ++i) {
            const int side = i - count / 2;
            below_[idx(i)] = 0.5 + (side < 0 ? -from_zero[idx(-side)] : from_zero[idx(side)]);
        }
    }
    double below(double x) const {
        if (x <= -reach) return -1.0 / (2.0 * pi * x);
        if (x >= reach) return 1.0 - 1.0 / (2.0 * pi * x);
        const double at = x / step + count / 2;
        const int i = std::min(static_cast<int>(at), count - 1);
        return std::lerp(below_[idx(i)], below_[idx(i) + 1], at - i);
    }

   private:
    static constexpr double step = 0.05, reach = 40.0;
    static constexpr int count = static_cast<int>(2.0 * reach / step);
    std::vector<double> below_;
};

/// An edge as the far field sees it.
struct FarEdge {
    double length = 0.0;
    double normal_rad = 0.0;  ///< direction across it
    double turn_rad = 0.0;    ///< of a curved one, from end to end
    double arc_length = 0.0;  ///< of all chords that go round together
};

std::vector<FarEdge> far_edges(const ApertureOutline& outline) {
    const std::size_t n = outline.corners.size();
    std::vector<FarEdge> edges(n);
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec2 d = outline.corners[(i + 1) % n] - outline.corners[i];
        edges[i].length = edges[i].arc_length = std::hypot(d.x, d.y);
        edges[i].normal_rad = std::atan2(-d.x, d.y);
    }
    // Curvature at its smooth ends, times its length.
    auto curvature = [&](std::size_t before, std::size_t after) {
        const double turn =
            std::remainder(edges[after].normal_rad - edges[before].normal_rad, 2.0 * pi);
        const double length = 0.5 * (edges[before].length + edges[after].length);
        return length > 0.0 ? turn / length : 0.0;
    };
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = (i + 1) % n, before = (i + n - 1) % n;
        double sum = 0.0, ends = 0.0;
        if (outline.is_smooth[i]) {
            sum += curvature(before, i);
            ends += 1.0;
        }
        if (outline.is_smooth[next]) {
            sum += curvature(i, next);
            ends += 1.0;
        }
        if (ends > 0.0) edges[i].turn_rad = edges[i].length * sum / ends;
    }
    for (std::size_t i = 0; i < n; ++i) {
        // Onwards and back over smooth joints; a round opening has no others.
        for (std::size_t k = 1; k < n && outline.is_smooth[(i + k) % n]; ++k)
            edges[i].arc_length += edges[(i + k) % n].length;
        for (std::size_t k = 0; k + 1 < n && outline.is_smooth[(i + n - k) % n]; ++k)
            edges[i].arc_length += edges[(i + n - k - 1) % n].length;
        edges[i].arc_length = std::min(edges[i].arc_length, outline.perimeter());
    }
    return edges;
}

/// Sectors of a ring, filled edge by edge.
class Sectors {
   public:
    Sectors(const EdgeSpread& spread, std::vector<double>& sum) : spread_(spread), sum_(sum) {}

    /// Light about a direction, spread as sinc²(width × angle).
    void add(double direction_rad, double light, double width) {
        const double from = std::fmod(direction_rad + 4.0 * pi, pi) / sector_rad;
        const int reach = reach_of(width);
        const int first = static_cast<int>(std::floor(from)) - reach;
        double before = spread_.below(width * (first - from) * sector_rad);
        double kept = -before;
        for (int s = first; s < first + 2 * reach; ++s) {
            const double after = spread_.below(width * (s + 1 - from) * sector_rad);
            at(s) += light * (after - before);
            before = after;
        }
        kept += before;
        everywhere_ += light * (1.0 - kept);
    }

    /// Light evenly over a fan of directions, its ends spread likewise.
    void add_fan(double from_rad, double fan_rad, double light, double width) {
        if (fan_rad < 0.0) return add_fan(from_rad + fan_rad, -fan_rad, light, width);
        const double from = std::fmod(from_rad + 4.0 * pi, pi) / sector_rad;
        const double fan = fan_rad / sector_rad;
        const int reach = reach_of(width);
        const int first = static_cast<int>(std::floor(from)) - reach;
        const int count =
            std::min(2 * reach + static_cast<int>(std::ceil(fan)), 8 * PolarPattern::sectors);
        double kept = 0.0;
        for (int s = first; s < first + count; ++s) {
            const double x = width * (s + 0.5 - from) * sector_rad;
            const double part = (spread_.below(x) - spread_.below(x - width * fan_rad)) / fan;
            at(s) += light * part;
            kept += part;
        }
        everywhere_ += light * (1.0 - kept);
    }

    void finish(float* share) const {
        for (int s = 0; s < PolarPattern::sectors; ++s)
            share[s] = static_cast<float>(sum_[idx(s)] + everywhere_ / PolarPattern::sectors);
    }

    static constexpr double sector_rad = pi / PolarPattern::sectors;

   private:
    /// Beyond it an edge's light, 1/(π x) of it, is spread evenly.
    static constexpr double most_x = 30.0;

    static int reach_of(double width) {
        return std::min(PolarPattern::sectors / 2,
                        1 + static_cast<int>(std::ceil(most_x / (width * sector_rad))));
    }
    double& at(int sector) {
        return sum_[idx((sector + 8 * PolarPattern::sectors) % PolarPattern::sectors)];
    }
    const EdgeSpread& spread_;
    std::vector<double>& sum_;
    double everywhere_ = 0.0;
};

/// One ring by the edges alone: length / k³ across each, spread by its diffraction. An edge's two
/// directions fall into one sector.
void add_far_ring(const std::vector<FarEdge>& edges, const EdgeSpread& spread, double area,
                  int ring, float* share) {
    const double k0 = PolarPattern::edge_k(ring), k1 = PolarPattern::edge_k(ring + 1.0);
    // ∫ k dk · 2 directions · L 2π/k³ / (4π² A)
    const double per_length = (1.0 / k0 - 1.0 / k1) / (pi * area);
    const double k = std::sqrt(k0 * k1);
    std::vector<double> sum(PolarPattern::sectors, 0.0);
    Sectors sectors(spread, sum);
    for (const FarEdge& edge : edges) {
        const double width = 0.5 * k * edge.arc_length;
        const double light = edge.length * per_length;
        if (edge.turn_rad == 0.0)
            sectors.add(edge.normal_rad, light, width);
        else
            sectors.add_fan(edge.normal_rad - 0.5 * edge.turn_rad, edge.turn_rad, light, width);
    }
    sectors.finish(share);
}

PolarPattern airy_pattern(double last_k) {
    PolarPattern pattern(last_k);
    for (int ring = 0; ring < pattern.rings; ++ring) {
        const double share = airy_encircled(PolarPattern::edge_k(ring + 1.0)) -
                             airy_encircled(PolarPattern::edge_k(ring));
        std::fill_n(pattern.share.begin() + ring * PolarPattern::sectors, PolarPattern::sectors,
                    static_cast<float>(share / PolarPattern::sectors));
    }
    pattern.inside = airy_encircled(PolarPattern::first_k);
    pattern.beyond = 1.0 - airy_encircled(PolarPattern::edge_k(pattern.rings));
    return pattern;
}

}  // namespace

PolarPattern::PolarPattern(double last_k)
    : rings(std::max(1, static_cast<int>(std::ceil(ring_of(last_k))))),
      share(idx(rings) * sectors, 0.0F) {}

double PolarPattern::edge_k(double ring) { return first_k * std::exp2(ring / rings_per_octave); }
double PolarPattern::ring_of(double k) { return rings_per_octave * std::log2(k / first_k); }

double PolarPattern::span_rad() const { return half_turn ? pi : 2.0 * pi; }

double PolarPattern::total() const {
    double sum = inside + beyond;
    for (const float each : share) sum += static_cast<double>(each);
    return sum;
}

double PolarPattern::encircled(double k) const {
    double sum = inside;
    const double last = ring_of(k);
    for (int ring = 0; ring < rings && ring < last; ++ring) {
        double own = 0.0;
        for (int s = 0; s < sectors; ++s)
            own += static_cast<double>(share[idx(ring) * sectors + idx(s)]);
        sum += own * std::min(1.0, last - ring);
    }
    return sum;
}

double airy_encircled(double k) {
    if (k < 1e-4) return 0.25 * k * k;
    const double j0 = std::cyl_bessel_j(0.0, k), j1 = std::cyl_bessel_j(1.0, k);
    return 1.0 - j0 * j0 - j1 * j1;
}

PolarPattern pattern_of(const ApertureOutline& outline, double last_k, unsigned threads,
                        const std::stop_token& stop) {
    if (outline.is_unit_circle) return airy_pattern(last_k);
    PolarPattern pattern(last_k);
    const double area = outline.area();
    const std::vector<FarEdge> edges = far_edges(outline);
    const EdgeSpread spread;
    const int exact =
        std::min(pattern.rings, static_cast<int>(std::ceil(PolarPattern::ring_of(last_exact_k))));
    constexpr std::size_t together = 16;
    const bool finished = parallel_for(
        (idx(pattern.rings) + together - 1) / together, threads, stop, [&](std::size_t block) {
            ArcPower at(outline.corners);
            // The outermost are the dearest of the exact ones: they come first.
            const std::size_t last = idx(pattern.rings) - block * together;
            for (std::size_t r = last; r-- > (last > together ? last - together : 0);) {
                const int ring = static_cast<int>(r);
                float* share = &pattern.share[r * PolarPattern::sectors];
                if (ring < exact)
                    add_sampled_ring(
                        pattern, ring, area,
                        [&at](double k, int around, double weight, std::vector<double>& power) {
                            at.add(k, around, weight, power);
                        });
                else
                    add_far_ring(edges, spread, area, ring, share);
            }
        });
    if (!finished) return {};
    pattern.inside = area * PolarPattern::first_k * PolarPattern::first_k / (4.0 * pi);
    double inner = pattern.inside, outer = 0.0;
    for (std::size_t k = 0; k < pattern.share.size(); ++k)
        (k < idx(exact) * PolarPattern::sectors ? inner : outer) +=
            static_cast<double>(pattern.share[k]);
    const double last_edge = PolarPattern::edge_k(pattern.rings);
    if (pattern.rings == exact) {
        pattern.beyond = 1.0 - inner;
        return pattern;
    }
    pattern.beyond = outline.perimeter() / (pi * area * last_edge);
    // Parseval: what the exact part leaves is the rest's. The two agree to a few per cent.
    const double scale = (1.0 - inner) / (outer + pattern.beyond);
    for (std::size_t k = idx(exact) * PolarPattern::sectors; k < pattern.share.size(); ++k)
        pattern.share[k] *= static_cast<float>(scale);
    pattern.beyond *= scale;
    return pattern;
}

}  // namespace ghostlight
