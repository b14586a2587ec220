#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/flare/starburst.h"
#include "core/parallel.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int sectors = PolarPattern::sectors;
/// Within so many pixels of its middle the pattern is put into the pixels ring by ring, so that
/// nothing of it is lost however small it is; further out each pixel takes its mean.
constexpr double core_px = 8.0;
/// Samples of a ring in the core, a pixel.
constexpr double core_samples = 12.0;
/// So much more of a blur than its rim is taken for the core.
constexpr double around_blur = 1.3;
constexpr int rows_together = 16;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// What goes into a ring of all wavelengths from a pattern's rings: linear between two of them.
struct Shift {
    int rings;
    std::vector<std::array<float, StarburstTable::channels>> weight;  ///< by pattern
};

}  // namespace

StarburstTable::StarburstTable(const std::vector<PolarPattern>& patterns,
                               const std::vector<SpectralSample>& samples,
                               const std::vector<Rgb>& colors, const std::vector<double>& weights,
                               double radius_per_k_mm_per_nm, double blur_mm, double smoothing_deg,
                               unsigned threads)
    : blur_mm_(blur_mm),
      half_turn_(patterns.front().half_turn),
      turned_rad_(!half_turn_ && radius_per_k_mm_per_nm < 0.0 ? pi : 0.0) {
    double shortest_nm = samples.front().wavelength_nm, longest_nm = shortest_nm;
    for (const SpectralSample& s : samples) {
        shortest_nm = std::min(shortest_nm, s.wavelength_nm);
        longest_nm = std::max(longest_nm, s.wavelength_nm);
    }
    first_radius_mm_ = PolarPattern::first_k * std::abs(radius_per_k_mm_per_nm) * shortest_nm;
    const double most_shift = PolarPattern::rings_per_octave * std::log2(longest_nm / shortest_nm);
    std::vector<Shift> shifts(static_cast<std::size_t>(most_shift) + 2);
    for (std::size_t k = 0; k < shifts.size(); ++k) {
        shifts[k].rings = static_cast<int>(k);
        shifts[k].weight.resize(patterns.size());
    }
    for (std::size_t w = 0; w < samples.size(); ++w) {
        const double shift =
            PolarPattern::rings_per_octave * std::log2(samples[w].wavelength_nm / shortest_nm);
        const auto whole = static_cast<std::size_t>(shift);
        const double part = shift - static_cast<double>(whole);
        const std::size_t of = patterns.size() == 1 ? 0 : w;
        const double light[channels] = {weights[w] * colors[w].r, weights[w] * colors[w].g,
                                        weights[w] * colors[w].b, weights[w]};
        for (std::size_t c = 0; c < channels; ++c) {
            shifts[whole].weight[of][c] += static_cast<float>((1.0 - part) * light[c]);
            shifts[whole + 1].weight[of][c] += static_cast<float>(part * light[c]);
            inside_[c] += light[c] * patterns[of].inside;
            flux_[c] += light[c];
        }
    }
    int most_rings = 0;
    for (const PolarPattern& pattern : patterns) most_rings = std::max(most_rings, pattern.rings);
    rings_ = most_rings + static_cast<int>(shifts.size()) - 1;
    below_.resize(idx(rings_) * (sectors + 1));
    for (int ring = 0; ring <= rings_; ++ring)
        edge_mm_.push_back(first_radius_mm_ *
                           std::exp2(static_cast<double>(ring) / PolarPattern::rings_per_octave));
    for (int ring = 0; ring < rings_; ++ring) {
        const double inner = edge_mm_[idx(ring)], outer = edge_mm_[idx(ring) + 1];
        // Sectors of half a turn hold two areas, opposite each other.
        sectors_per_mm2_.push_back(sectors / (pi * (outer * outer - inner * inner)));
    }
    const double smoothed = std::clamp(
        rad_from_deg(smoothing_deg) / patterns.front().span_rad() * sectors, 0.0, sectors * 1.0);
    parallel_for(idx(rings_), threads, {}, [&](std::size_t ring) {
        std::vector<Color> own(sectors, Color{});
        for (const Shift& shift : shifts) {
            const int from = static_cast<int>(ring) - shift.rings;
            if (from < 0) continue;
            for (std::size_t p = 0; p < patterns.size(); ++p) {
                if (from >= patterns[p].rings || shift.weight[p] == Color{}) continue;
                const float* share = &patterns[p].share[idx(from) * sectors];
                const Color weight = shift.weight[p];
                for (std::size_t s = 0; s < sectors; ++s)
                    for (std::size_t c = 0; c < channels; ++c) own[s][c] += share[s] * weight[c];
            }
        }
        Color* below = &below_[ring * (sectors + 1)];
        for (std::size_t s = 0; s < sectors; ++s)
            for (std::size_t c = 0; c < channels; ++c) below[s + 1][c] = below[s][c] + own[s][c];
        if (smoothed < 1.0) return;
        for (int s = 0; s < sectors; ++s)
            for (std::size_t c = 0; c < channels; ++c) own[idx(s)][c] = 0.0F;
        for (int s = 0; s < sectors; ++s) {
            const Color mean = flux_between(static_cast<int>(ring), s + 0.5 - 0.5 * smoothed,
                                            s + 0.5 + 0.5 * smoothed);
            for (std::size_t c = 0; c < channels; ++c)
                own[idx(s)][c] = mean[c] / static_cast<float>(smoothed);
        }
        for (std::size_t s = 0; s < sectors; ++s)
            for (std::size_t c = 0; c < channels; ++c) below[s + 1][c] = below[s][c] + own[s][c];
    });
}

double StarburstTable::ring_of(double radius) const {
    return PolarPattern::rings_per_octave * std::log2(radius / first_radius_mm_);
}

StarburstTable::Color StarburstTable::flux_between(int ring, double from, double to) const {
    const Color* below = &below_[idx(ring) * (sectors + 1)];
    const Color& whole = below[sectors];
    auto at = [&](double sector) {
        const double turns = std::floor(sector / sectors);
        const double within = sector - turns * sectors;
        const int s = std::min(static_cast<int>(within), sectors - 1);
        const auto part = static_cast<float>(within - s), round = static_cast<float>(turns);
        Color value;
        for (std::size_t c = 0; c < channels; ++c)
            value[c] = round * whole[c] + below[s][c] + part * (below[s + 1][c] - below[s][c]);
        return value;
    };
    const Color low = at(from), high = at(to);
    Color result;
    for (std::size_t c = 0; c < channels; ++c) result[c] = high[c] - low[c];
    return result;
}

/// Per area, at a ring's middle.
StarburstTable::Color StarburstTable::density(double ring, double from, double to) const {
    const int low = static_cast<int>(std::floor(ring));
    Color sum{};
    for (int r = low; r <= low + 1; ++r) {
        if (r < 0 || r >= rings_) continue;
        const double share = r == low ? 1.0 - (ring - low) : ring - low;
        const Color flux = flux_between(r, from, to);
        const auto scale = static_cast<float>(share * sectors_per_mm2_[idx(r)] / (to - from));
        for (std::size_t c = 0; c < channels; ++c) sum[c] += scale * flux[c];
    }
    return sum;
}

/// Mean over what a pixel covers of radius and turn.
StarburstTable::Color StarburstTable::mean_at(double radius, double turn_rad,
                                              double pitch_mm) const {
    const double per_rad = sectors / (half_turn_ ? pi : 2.0 * pi);
    const double sector = turn_rad * per_rad;
    const double half = std::max(0.5, 0.5 * pitch_mm / radius * per_rad);
    const double inner = radius - 0.5 * pitch_mm, outer = radius + 0.5 * pitch_mm;
    // Where a pixel spans less than a ring, between the middles of two.
    constexpr double ring_ratio = std::numbers::ln2 / PolarPattern::rings_per_octave;
    if (pitch_mm < ring_ratio * radius)
        return density(ring_of(radius) - 0.5, sector - half, sector + half);
    const double first = ring_of(inner), last = ring_of(outer);
    Color sum{};
    const double turn = 2.0 * half / per_rad;
    const double area = (half_turn_ ? 2.0 : 1.0) * 0.5 * (outer * outer - inner * inner) * turn;
    for (int r = std::max(0, static_cast<int>(std::floor(first))); r < last && r < rings_; ++r) {
        const double from = edge_mm_[idx(r)], to = edge_mm_[idx(r) + 1];
        const double low = std::max(inner, from), high = std::min(outer, to);
        const auto part =
            static_cast<float>((high * high - low * low) / (to * to - from * from) / area);
        const Color flux = flux_between(r, sector - half, sector + half);
        for (std::size_t c = 0; c < channels; ++c) sum[c] += part * flux[c];
    }
    return sum;
}

void StarburstTable::draw_core(const Placement& placement, const PixelFrame& frame, double core_mm,
                               std::vector<float>& values) const {
    const double cos_t = std::cos(placement.tangential_rad),
                 sin_t = std::sin(placement.tangential_rad);
    auto put = [&](double radius, double turn, const double(&flux)[channels]) {
        // In the pattern's own directions, stretched along and across the field.
        const double x = radius * std::cos(turn), y = radius * std::sin(turn);
        const double along = placement.tangential_stretch * (cos_t * x + sin_t * y);
        const double across = placement.sagittal_stretch * (cos_t * y - sin_t * x);
        const double column = frame.column(placement.x_mm + cos_t * along - sin_t * across);
        const double row = frame.row(placement.y_mm + sin_t * along + cos_t * across);
        if (!(column >= 0.0 && column < frame.width_px && row >= 0.0 && row < frame.height_px))
            return;
        float* pixel = &values[(static_cast<std::size_t>(row) * idx(frame.width_px) +
                                static_cast<std::size_t>(column)) *
                               channels];
        for (std::size_t c = 0; c < channels; ++c)
            pixel[c] += static_cast<float>(flux[c] * placement.gain / frame.pixel_area_mm2());
    };
    double centre[channels];
    std::ranges::copy(inside_, centre);
    put(0.0, 0.0, centre);
    const double span = half_turn_ ? pi : 2.0 * pi;
    const int repeats = half_turn_ ? 2 : 1;
    for (int ring = 0; ring < rings_ && edge_mm_[idx(ring)] < core_mm; ++ring) {
        const double inner = edge_mm_[idx(ring)], whole = edge_mm_[idx(ring) + 1];
        const double outer = std::min(whole, core_mm);
        const double fine = frame.pitch_mm / core_samples;
        const int radial = std::max(1, static_cast<int>(std::ceil((outer - inner) / fine)));
        const int around = std::max(8, static_cast<int>(std::ceil(span * outer / fine)));
        // Each ring begins elsewhere, by the golden ratio, so that rings do not beat with pixels.
        const double begin = std::fmod(ring * std::numbers::phi, 1.0);
        const double kept = (outer * outer - inner * inner) / (whole * whole - inner * inner);
        for (int a = 0; a < around; ++a) {
            const Color flux = flux_between(ring, static_cast<double>(a) * sectors / around,
                                            (a + 1.0) * sectors / around);
            double share[channels];
            for (std::size_t c = 0; c < channels; ++c)
                share[c] = static_cast<double>(flux[c]) * kept / (radial * repeats);
            for (int r = 0; r < radial; ++r) {
                const double radius =
                    std::sqrt(std::lerp(inner * inner, outer * outer, (r + 0.5) / radial));
                for (int side = 0; side < repeats; ++side)
                    put(radius, turned_rad_ + span * (a + begin) / around + side * pi, share);
            }
        }
    }
}

bool StarburstTable::draw(const Placement& placement, const PixelFrame& frame, unsigned threads,
                          const std::stop_token& stop, std::vector<float>& values) const {
    const auto width = idx(frame.width_px), height = idx(frame.height_px);
    values.assign(width * height * channels, 0.0F);
    const double cos_t = std::cos(placement.tangential_rad),
                 sin_t = std::sin(placement.tangential_rad);
    const double stretch = placement.sagittal_stretch * placement.tangential_stretch;
    // Lengths on the sensor in the pattern's own: a pixel is smaller there.
    const double pitch = frame.pitch_mm / std::sqrt(stretch);
    const double core_mm = std::max(core_px * pitch, around_blur * blur_mm_);
    const auto scale = static_cast<float>(placement.gain / stretch);
    const double last_mm = edge_mm_.back();
    const bool finished = parallel_for(
        (height + rows_together - 1) / rows_together, threads, stop, [&](std::size_t block) {
            for (std::size_t row = block * rows_together;
                 row < std::min(height, (block + 1) * rows_together); ++row)
                for (std::size_t column = 0; column < width; ++column) {
                    auto own = [&](double i, double j) {
                        const double x = frame.left_mm + i * frame.pitch_mm - placement.x_mm;
                        const double y = frame.bottom_mm + j * frame.pitch_mm - placement.y_mm;
                        const double along = (cos_t * x + sin_t * y) / placement.tangential_stretch;
                        const double across = (cos_t * y - sin_t * x) / placement.sagittal_stretch;
                        return glm::dvec2(cos_t * along - sin_t * across,
                                          sin_t * along + cos_t * across);
                    };
                    const double i = static_cast<double>(column) + 0.5;
                    const double j = static_cast<double>(row) + 0.5;
                    const glm::dvec2 at = own(i, j);
                    const double radius = std::sqrt(at.x * at.x + at.y * at.y);
                    if (radius < core_mm - pitch || radius > last_mm) continue;
                    float share = scale;
                    if (radius < core_mm + pitch) {
                        // The core ends within this pixel.
                        constexpr int parts = 8;
                        int outside = 0;
                        for (int a = 0; a < parts * parts; ++a) {
                            const glm::dvec2 p = own(i - 0.5 + (a % parts + 0.5) / parts,
                                                     j - 0.5 + (a / parts + 0.5) / parts);
                            outside += std::hypot(p.x, p.y) >= core_mm ? 1 : 0;
                        }
                        share *= static_cast<float>(outside) / (parts * parts);
                        if (outside == 0) continue;
                    }
                    const Color mean = mean_at(radius, std::atan2(at.y, at.x) - turned_rad_, pitch);
                    float* pixel = &values[(row * width + column) * channels];
                    for (std::size_t c = 0; c < channels; ++c) pixel[c] = share * mean[c];
                }
        });
    if (!finished) return false;
    draw_core(placement, frame, core_mm, values);
    return true;
}

}  // namespace ghostlight
