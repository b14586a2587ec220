#include "core/flare/masked_pattern.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/flare/fourier_2d.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int transform_across = 1024;
/// The core's raster: padded eightfold, steps of k of a sixteenth of π.
constexpr int coarse_across = 128;
/// The rest's: padded twofold, as much as keeps |F|² apart from its repeats.
constexpr int fine_across = 512;
/// Where the one ends, in k: half of the coarse raster's Nyquist frequency.
constexpr double core_k = 96.0;
/// And the other, in its Nyquist frequencies: beyond, repeats of the edges' light show.
constexpr double outer_share = 0.7;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

double sinc(double x) { return std::abs(x) < 1e-4 ? 1.0 : std::sin(x) / x; }

void add_rings(PolarPattern& pattern, const PowerGrid& grid, double area, int first, int last,
               unsigned threads, const std::stop_token& stop) {
    parallel_for(idx(std::max(0, last - first)), threads, stop, [&](std::size_t r) {
        add_sampled_ring(pattern, first + static_cast<int>(r), area,
                         [&](double k, int around, double weight, std::vector<double>& power) {
                             // Turned step by step, anew from time to time.
                             constexpr int anew_every = 64;
                             const double step = pattern.span_rad() / around;
                             const double c = std::cos(step), s = std::sin(step);
                             double x = k, y = 0.0;
                             for (int n = 0; n < around; ++n) {
                                 if (n % anew_every == 0) {
                                     x = k * std::cos(step * n);
                                     y = k * std::sin(step * n);
                                 }
                                 power[idx(n)] += weight * grid.at_k(x, y);
                                 const double turned = c * x - s * y;
                                 y = s * x + c * y;
                                 x = turned;
                             }
                         });
    });
}

/// Rays alone: what is open at ρ lands at k = 2π N ρ.
PolarPattern geometric_pattern(const MaskRaster& raster, double fresnel_number, double last_k) {
    PolarPattern pattern(std::max(last_k, 2.1 * pi * std::abs(fresnel_number)));
    pattern.half_turn = false;
    const double area = raster.area(), pitch = raster.pitch();
    constexpr int parts = 3;  // across a pixel
    for (int j = 0; j < parts * raster.across; ++j)
        for (int i = 0; i < parts * raster.across; ++i) {
            const float open = raster.open[idx(j / parts * raster.across + i / parts)];
            if (open <= 0.0F) continue;
            const double kx = 2.0 * pi * fresnel_number * ((i + 0.5) * pitch / parts - 1.0);
            const double ky = 2.0 * pi * fresnel_number * ((j + 0.5) * pitch / parts - 1.0);
            const double k = std::hypot(kx, ky);
            const double share = static_cast<double>(open) * pitch * pitch / (area * parts * parts);
            const double ring = k > 0.0 ? PolarPattern::ring_of(k) : -1.0;
            if (ring < 0.0) {
                pattern.inside += share;
                continue;
            }
            const double turn = std::atan2(ky, kx) + (ky < 0.0 ? 2.0 * pi : 0.0);
            const int sector = std::min(static_cast<int>(turn / (2.0 * pi) * PolarPattern::sectors),
                                        PolarPattern::sectors - 1);
            pattern.share[idx(static_cast<int>(ring)) * PolarPattern::sectors + idx(sector)] +=
                static_cast<float>(share);
        }
    return pattern;
}

/// Every ring beyond as the octave before, per direction.
void continue_outwards(PolarPattern& pattern, int from) {
    std::vector<double> by_sector(PolarPattern::sectors, 0.0);
    for (int ring = std::max(0, from - PolarPattern::rings_per_octave); ring < from; ++ring)
        for (int s = 0; s < PolarPattern::sectors; ++s)
            by_sector[idx(s)] +=
                static_cast<double>(pattern.share[idx(ring) * PolarPattern::sectors + idx(s)]);
    // ∝ 1/k³ per area: between k and 2k as much as beyond 2k.
    const double k = PolarPattern::edge_k(from);
    for (int ring = from; ring < pattern.rings; ++ring) {
        const double part = k / PolarPattern::edge_k(ring) - k / PolarPattern::edge_k(ring + 1.0);
        for (int s = 0; s < PolarPattern::sectors; ++s)
            pattern.share[idx(ring) * PolarPattern::sectors + idx(s)] =
                static_cast<float>(part * by_sector[idx(s)]);
    }
    double all = 0.0;
    for (const double each : by_sector) all += each;
    pattern.beyond = all * k / PolarPattern::edge_k(pattern.rings);
}

}  // namespace

PowerGrid::PowerGrid(int across, double pitch)
    : across_(across), step_(2.0 * pi / (across * pitch)), power_(idx(across) * idx(across)) {}

PowerGrid::PowerGrid(const MaskRaster& raster, int across, double fresnel_number, unsigned threads,
                     const std::stop_token& stop)
    : PowerGrid(across, raster.pitch()) {
    std::vector<std::complex<float>> field(idx(across) * idx(across));
    const double pitch = raster.pitch();
    for (int j = 0; j < raster.across; ++j)
        for (int i = 0; i < raster.across; ++i) {
            const float open = raster.open[idx(j * raster.across + i)];
            const double x = (i + 0.5) * pitch - 1.0, y = (j + 0.5) * pitch - 1.0;
            const double phase = pi * fresnel_number * (x * x + y * y);
            field[idx(j) * idx(across) + idx(i)] =
                std::polar(open, static_cast<float>(std::remainder(phase, 2.0 * pi)));
        }
    is_complete_ = transform_2d(field, across, false, threads, stop);
    for (std::size_t k = 0; k < field.size(); ++k) power_[k] = std::norm(field[k]);
    sharpen(pitch);
}

std::array<PowerGrid, 2> PowerGrid::of_two(const MaskRaster& a, const MaskRaster& b, int across,
                                           unsigned threads, const std::stop_token& stop) {
    std::array<PowerGrid, 2> grids = {PowerGrid(across, a.pitch()), PowerGrid(across, b.pitch())};
    const std::size_t n = idx(across);
    std::vector<std::complex<float>> field(n * n);
    // About as much in the one as in the other, for rounding's sake.
    const float scale =
        static_cast<float>(b.across * b.across) / static_cast<float>(a.across * a.across);
    for (int j = 0; j < a.across; ++j)
        for (int i = 0; i < a.across; ++i)
            field[idx(j) * n + idx(i)].real(scale * a.open[idx(j * a.across + i)]);
    for (int j = 0; j < b.across; ++j)
        for (int i = 0; i < b.across; ++i)
            field[idx(j) * n + idx(i)].imag(b.open[idx(j * b.across + i)]);
    const bool complete = transform_2d(field, across, false, threads, stop);
    // F = A + iB, and A(−k) = A*(k).
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
            const std::complex<float> here = field[j * n + i];
            const std::complex<float> there = std::conj(field[(n - j) % n * n + (n - i) % n]);
            grids[0].power_[j * n + i] = 0.25F * std::norm(here + there) / (scale * scale);
            grids[1].power_[j * n + i] = 0.25F * std::norm(here - there);
        }
    grids[0].sharpen(a.pitch());
    grids[1].sharpen(b.pitch());
    grids[0].is_complete_ = grids[1].is_complete_ = complete;
    return grids;
}

void PowerGrid::sharpen(double pitch) {
    std::vector<float> own(idx(across_));
    for (int i = 0; i < across_; ++i)
        own[idx(i)] = static_cast<float>(sinc(pi * (i < across_ / 2 ? i : i - across_) / across_));
    const auto scale = static_cast<float>(pitch * pitch * pitch * pitch);
    // Up to where it has half of its power.
    for (int j = 0; j < across_; ++j)
        for (int i = 0; i < across_; ++i) {
            const float both = std::max(0.5F, own[idx(i)] * own[idx(j)]);
            power_[idx(j) * idx(across_) + idx(i)] *= scale / (both * both);
        }
}

double PowerGrid::at(int i, int j) const {
    const int mask = across_ - 1;
    return static_cast<double>(power_[idx(j & mask) * idx(across_) + idx(i & mask)]);
}

double PowerGrid::at_k(double kx, double ky) const {
    const double x = kx / step_, y = ky / step_;
    const double i = std::floor(x), j = std::floor(y);
    const int a = static_cast<int>(i), b = static_cast<int>(j);
    return std::lerp(std::lerp(at(a, b), at(a + 1, b), x - i),
                     std::lerp(at(a, b + 1), at(a + 1, b + 1), x - i), y - j);
}

std::optional<PolarPattern> masked_pattern(const PatternMask& mask, double fresnel_number,
                                           double last_k, unsigned threads,
                                           const std::stop_token& stop) {
    const ApertureOutline* beam = mask.beam ? &*mask.beam : nullptr;
    const MaskRaster fine = mask_raster(mask.stop, mask.dirt, fine_across, beam);
    if (std::abs(fresnel_number) > most_fresnel_number)
        return geometric_pattern(fine, fresnel_number, last_k);
    PolarPattern pattern(last_k);
    pattern.half_turn = fresnel_number == 0.0;
    double area = 0.0;  // of the light: a half-open pixel at an edge counts as half
    for (const float open : fine.open) area += static_cast<double>(open);
    area *= fine.pitch() * fine.pitch();
    const double outer_k = outer_share * pi / fine.pitch();
    const int core = std::min(pattern.rings, static_cast<int>(PolarPattern::ring_of(core_k)));
    const int outer = std::min(pattern.rings, static_cast<int>(PolarPattern::ring_of(outer_k)));
    // Out of focus the phase needs the fine raster everywhere, and blurs what the core would show.
    const bool in_focus = std::abs(fresnel_number) <= 1.0;
    std::optional<PowerGrid> whole;
    if (in_focus) {
        const MaskRaster coarse = mask_raster(mask.stop, mask.dirt, coarse_across, beam);
        std::optional<PowerGrid> middle;
        if (fresnel_number == 0.0) {
            auto both = PowerGrid::of_two(coarse, fine, transform_across, threads, stop);
            middle = std::move(both[0]);
            whole = std::move(both[1]);
        } else {
            middle.emplace(coarse, transform_across, fresnel_number, threads, stop);
        }
        if (!middle->is_complete()) return std::nullopt;
        add_rings(pattern, *middle, area, 0, core, threads, stop);
    }
    if (!whole) whole.emplace(fine, transform_across, fresnel_number, threads, stop);
    const PowerGrid& grid = *whole;
    if (!grid.is_complete()) return std::nullopt;
    add_rings(pattern, grid, area, in_focus ? core : 0, outer, threads, stop);
    if (stop.stop_requested()) return std::nullopt;
    if (outer < pattern.rings) continue_outwards(pattern, outer);
    pattern.inside = (in_focus ? grid.at(0, 0) : grid.at_k(0.0, 0.0)) * PolarPattern::first_k *
                     PolarPattern::first_k / (4.0 * pi * area);
    const double scale = 1.0 / pattern.total();
    for (float& share : pattern.share) share *= static_cast<float>(scale);
    pattern.inside *= scale;
    pattern.beyond *= scale;
    return pattern;
}

}  // namespace ghostlight
