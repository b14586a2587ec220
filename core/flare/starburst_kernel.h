#pragma once

#include <cstddef>

#include "core/instruction_set.h"

namespace ghostlight {

/// Weighted rings of patterns, summed sector by sector in four channels.
struct RingMixView {
    const float* const* rings;  ///< of each tap: `sectors` values
    const float* weights;       ///< of each tap: 4
    std::size_t taps;
    std::size_t sectors;  ///< a multiple of twice `sector_padding`
    float* sums;          ///< 4 × sectors, channel by channel
};
/// Lanes of the widest instruction set.
inline constexpr std::size_t sector_padding = 16;

/// A row of pixels in a polar table's own coordinates.
struct PolarRowView {
    float x, y;              ///< of the first pixel's middle, from the pattern's
    float x_step, y_step;    ///< from pixel to pixel
    float rings_per_octave;  ///< ring = rings_per_octave × log2(r) − first_ring
    float first_ring;
    float sectors_per_rad;
    float turned_rad;   ///< taken off the direction
    float span_rad;     ///< π or 2π: directions are taken modulo this
    std::size_t count;  ///< a multiple of `sector_padding`
    float *square, *ring, *sector;
};

#define GHOSTLIGHT_STARBURST_KERNELS(set) \
    namespace set {                       \
    void mix_rings(const RingMixView&);   \
    void polar_row(const PolarRowView&);  \
    }
GHOSTLIGHT_EVERY_SET(GHOSTLIGHT_STARBURST_KERNELS)
#undef GHOSTLIGHT_STARBURST_KERNELS

}  // namespace ghostlight
