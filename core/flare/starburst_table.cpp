#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/flare/starburst.h"
#include "core/flare/starburst_kernel.h"
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
/// Breadth of a ring over its radius.
constexpr double ring_ratio = std::numbers::ln2 / PolarPattern::rings_per_octave;

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
        std::vector<const float*> taps;
        std::vector<float> light;
        for (const Shift& shift : shifts) {
            const int from = static_cast<int>(ring) - shift.rings;
            if (from < 0) continue;
            for (std::size_t p = 0; p < patterns.size(); ++p) {
                if (from >= patterns[p].rings || shift.weight[p] == Color{}) continue;
                taps.push_back(&patterns[p].share[idx(from) * sectors]);
                light.insert(light.end(), shift.weight[p].begin(), shift.weight[p].end());
            }
        }
        std::vector<float> planes(channels * sectors);
        const RingMixView mix{taps.data(), light.data(), taps.size(), sectors, planes.data()};
        GHOSTLIGHT_DISPATCH(mix_rings, mix);
        std::vector<Color> own(sectors);
        for (std::size_t s = 0; s < sectors; ++s)
            for (std::size_t c = 0; c < channels; ++c) own[s][c] = planes[c * sectors + s];
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
                               FlareImage& image) const {
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
        const std::size_t pixel =
            static_cast<std::size_t>(row) * idx(frame.width_px) + static_cast<std::size_t>(column);
        const double share = placement.gain / frame.pixel_area_mm2();
        for (std::size_t c = 0; c < 3; ++c)
            image.rgb[3 * pixel + c] += static_cast<float>(flux[c] * share);
        image.irradiance[pixel] += static_cast<float>(flux[3] * share);
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

/// density() × scale where neither rings nor sectors end.
void StarburstTable::add_density(float ring, float from, float to, float scale,
                                 float (&color)[channels]) const {
    const auto low = static_cast<std::size_t>(ring);
    const auto first = static_cast<std::size_t>(from), last = static_cast<std::size_t>(to);
    const float ring_part = ring - static_cast<float>(low);
    const float first_part = from - static_cast<float>(first);
    const float last_part = to - static_cast<float>(last);
    for (const std::size_t r : {low, low + 1}) {
        const Color* below = &below_[r * (sectors + 1)];
        const float share = (r == low ? 1.0F - ring_part : ring_part) * scale *
                            static_cast<float>(sectors_per_mm2_[r]) / (to - from);
        for (std::size_t c = 0; c < channels; ++c)
            color[c] +=
                share * (below[last][c] + last_part * (below[last + 1][c] - below[last][c]) -
                         below[first][c] - first_part * (below[first + 1][c] - below[first][c]));
    }
}

bool StarburstTable::draw(const Placement& placement, const PixelFrame& frame, unsigned threads,
                          const std::stop_token& stop, FlareImage& image) const {
    const auto width = idx(frame.width_px), height = idx(frame.height_px);
    image.rgb.resize(3 * width * height);
    image.irradiance.resize(width * height);
    const double cos_t = std::cos(placement.tangential_rad),
                 sin_t = std::sin(placement.tangential_rad);
    const double stretch = placement.sagittal_stretch * placement.tangential_stretch;
    // Lengths on the sensor in the pattern's own: a pixel is smaller there.
    const double pitch = frame.pitch_mm / std::sqrt(stretch);
    const double core_mm = std::max(core_px * pitch, around_blur * blur_mm_);
    const auto scale = static_cast<float>(placement.gain / stretch);
    const double per_rad = sectors / (half_turn_ ? pi : 2.0 * pi);
    auto own = [&](double i, double j) {
        const double x = frame.left_mm + i * frame.pitch_mm - placement.x_mm;
        const double y = frame.bottom_mm + j * frame.pitch_mm - placement.y_mm;
        const double along = (cos_t * x + sin_t * y) / placement.tangential_stretch;
        const double across = (cos_t * y - sin_t * x) / placement.sagittal_stretch;
        return glm::dvec2(cos_t * along - sin_t * across, sin_t * along + cos_t * across);
    };
    const auto square = [](double length) { return static_cast<float>(length * length); };
    // Where a pixel spans less than a ring: between the middles of two, a look-up.
    const float plain_from = square(std::max(core_mm + pitch, 1.01 * pitch / ring_ratio));
    const float last = square(edge_mm_.back()), begin = square(std::max(0.0, core_mm - pitch));
    const auto half_pixel = static_cast<float>(0.5 * pitch * per_rad);
    auto draw_row = [&](std::size_t row, std::vector<float>& lines) {
        const std::size_t count = lines.size() / 3;
        const double j = static_cast<double>(row) + 0.5;
        const glm::dvec2 first = own(0.5, j), step = own(1.5, j) - first;
        const PolarRowView view{
            static_cast<float>(first.x),
            static_cast<float>(first.y),
            static_cast<float>(step.x),
            static_cast<float>(step.y),
            PolarPattern::rings_per_octave,
            static_cast<float>(PolarPattern::rings_per_octave * std::log2(first_radius_mm_) + 0.5),
            static_cast<float>(per_rad),
            static_cast<float>(turned_rad_),
            static_cast<float>(half_turn_ ? pi : 2.0 * pi),
            count,
            lines.data(),
            lines.data() + count,
            lines.data() + 2 * count};
        GHOSTLIGHT_DISPATCH(polar_row, view);
        for (std::size_t column = 0; column < width; ++column) {
            float color[channels] = {};
            const float r2 = view.square[column];
            if (r2 >= begin && r2 <= last) {
                const float ring = view.ring[column];
                const float half = std::max(0.5F, half_pixel / std::sqrt(r2));
                const float from = view.sector[column] - half, to = view.sector[column] + half;
                if (r2 > plain_from && ring >= 0.0F && ring < static_cast<float>(rings_ - 1) &&
                    from >= 0.0F && to < static_cast<float>(sectors)) {
                    add_density(ring, from, to, scale, color);
                } else {
                    const double i = static_cast<double>(column) + 0.5;
                    const glm::dvec2 at = own(i, j);
                    const double radius = std::sqrt(at.x * at.x + at.y * at.y);
                    double share = 1.0;
                    if (radius < core_mm + pitch) {
                        // The core ends within this pixel.
                        constexpr int parts = 8;
                        int outside = 0;
                        for (int a = 0; a < parts * parts; ++a) {
                            const glm::dvec2 p = own(i - 0.5 + (a % parts + 0.5) / parts,
                                                     j - 0.5 + (a / parts + 0.5) / parts);
                            outside += std::hypot(p.x, p.y) >= core_mm ? 1 : 0;
                        }
                        share = static_cast<double>(outside) / (parts * parts);
                    }
                    if (share > 0.0) {
                        const Color mean =
                            mean_at(radius, std::atan2(at.y, at.x) - turned_rad_, pitch);
                        for (std::size_t c = 0; c < channels; ++c)
                            color[c] = scale * static_cast<float>(share) * mean[c];
                    }
                }
            }
            const std::size_t pixel = row * width + column;
            for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * pixel + c] = color[c];
            image.irradiance[pixel] = color[3];
        }
    };
    const std::size_t padded = (width + sector_padding - 1) / sector_padding * sector_padding;
    const bool finished = parallel_for(
        (height + rows_together - 1) / rows_together, threads, stop, [&](std::size_t block) {
            std::vector<float> lines(3 * padded);
            for (std::size_t row = block * rows_together;
                 row < std::min(height, (block + 1) * rows_together); ++row)
                draw_row(row, lines);
        });
    if (!finished) return false;
    draw_core(placement, frame, core_mm, image);
    return true;
}

}  // namespace ghostlight
