#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stop_token>
#include <vector>

#include "core/flare/aperture_outline.h"

namespace ghostlight {

/// The far-field pattern |∫∫ mask exp(−i k·r) dA|² of an opening at one wavelength, as shares of
/// its light: k is in 1/semi-diameters of the stop, so that the pattern holds for every wavelength
/// and lens. Rings of equal ratio, each cut into sectors from k along +x counter-clockwise. The
/// pattern of a real mask is the same at k and −k: then a sector and the one opposite are one bin.
struct PolarPattern {
    static constexpr int sectors = 1024;
    static constexpr int rings_per_octave = 48;
    static constexpr double first_k = 1.0 / 16.0;

    int rings = 0;
    bool half_turn = true;     ///< the sectors go round half a turn, each with its opposite
    std::vector<float> share;  ///< rings × sectors
    double inside = 0.0;       ///< share below the first ring
    double beyond = 0.0;       ///< share beyond the last

    PolarPattern() = default;
    /// Rings up to `last_k` at least, all dark.
    explicit PolarPattern(double last_k);
    /// Lower edge of a ring; ring(k) is its inverse, with the part within the ring.
    static double edge_k(double ring);
    static double ring_of(double k);
    double span_rad() const;  ///< of all sectors
    double total() const;
    /// Share below k, as the rings have it.
    double encircled(double k) const;
};

/// Of an opening by closed forms: a circle by Airy's encircled energy; a polygon by its transform
/// up to some hundred resolved fringes, and beyond by what each edge sends out, ∝ length/k³ in the
/// direction across it, as wide as its diffraction and as the turn of a curved one. Normalised by
/// Parseval's theorem. Nothing when stopped.
PolarPattern pattern_of(const ApertureOutline& outline, double last_k, unsigned threads,
                        const std::stop_token& stop = {});

/// Adds samples of a power spectrum to a ring: `sample(k, around, weight, power)` adds weight ×
/// |F|² at `around` equal steps of the sectors' span from 0.
template <class Sample>
void add_sampled_ring(PolarPattern& pattern, int ring, double area, Sample sample);

/// Airy's pattern: the share of the light within k of a round stop, 1 − J0²(k) − J1²(k).
double airy_encircled(double k);

template <class Sample>
void add_sampled_ring(PolarPattern& pattern, int ring, double area, Sample sample) {
    // An opening of diameter 2 has fringes of π and |F|² is known from steps of π/2; half of that.
    constexpr double step = 0.75;
    constexpr int least_around = 32;
    const double k0 = PolarPattern::edge_k(ring), k1 = PolarPattern::edge_k(ring + 1.0);
    const double span = pattern.span_rad();
    const int radial = std::max(1, static_cast<int>(std::ceil((k1 - k0) / step)));
    const int around = std::max(least_around, static_cast<int>(std::ceil(span * k1 / step)));
    std::vector<double> power(static_cast<std::size_t>(around) + 1, 0.0);
    for (int r = 0; r < radial; ++r) {
        const double low = k0 + (k1 - k0) * r / radial, high = k0 + (k1 - k0) * (r + 1) / radial;
        const double k = std::sqrt(0.5 * (low * low + high * high));  // halves the ring's area
        sample(k, around, 0.5 * (high * high - low * low), power);
    }
    power.back() = power.front();  // once round
    // Of both directions where they share a sector.
    const double scale = (pattern.half_turn ? 2.0 : 1.0) * span / PolarPattern::sectors /
                         (4.0 * std::numbers::pi * std::numbers::pi * area);
    float* share = &pattern.share[static_cast<std::size_t>(ring) * PolarPattern::sectors];
    for (int s = 0; s < PolarPattern::sectors; ++s) {
        const double from = (s + 0.5) * around / PolarPattern::sectors;
        const auto below = static_cast<std::size_t>(from);
        share[s] += static_cast<float>(
            scale * std::lerp(power[below], power[below + 1], from - static_cast<double>(below)));
    }
}

}  // namespace ghostlight
