#pragma once

#include <cstddef>

#include "core/instruction_set.h"

namespace ghostlight {

/// Pixels that a kernel is given at once.
inline constexpr std::size_t rung_chunk = 128;

/// One rim along a row of pixels.
struct RungRimView {
    const float* profile;     ///< 4 values a step; null: as `is_sharp` says
    float place, place_step;  ///< of the first pixel's middle, in steps, cut off; per pixel
    float last;               ///< place that still is the last step
    float cover, cover_step;  ///< share of the pixel inside, before it is held within 0 and 1
    bool is_sharp;            ///< without a profile: it clips, too; else the mask has it already
};

/// A part of a row over which light, places and shares are linear.
struct RungRowView {
    const RungRimView* rims;
    std::size_t rim_count;
    float light, light_step;
    const float* color;  ///< 4
    const float* mask;   ///< 4 a pixel, coloured: the light inside of its rims; null: `color`
    std::size_t count;   ///< rung_chunk at most
    float* pixels;       ///< 4 a pixel, added to
};

/// Adds light × (inside × the product of the rims' profiles − color × that of their shares).
#define GHOSTLIGHT_RUNG_KERNELS(set)      \
    namespace set {                       \
    void add_fringes(const RungRowView&); \
    }
GHOSTLIGHT_EVERY_SET(GHOSTLIGHT_RUNG_KERNELS)
#undef GHOSTLIGHT_RUNG_KERNELS

}  // namespace ghostlight
