#pragma once

#include <cstddef>

#include "core/instruction_set.h"

namespace ghostlight {

/// A row of a grid of points, first over the orders in y: for each order in x eight sums, four
/// channels times cos and four times sin of x.
struct VeilOrdersView {
    const float* coefficients;   ///< of order n, m: cos·cos, sin·cos, cos·sin, sin·sin, 4 each
    const float *cosine, *sine;  ///< of the orders in y
    std::size_t orders;          ///< with the order 0
    float* sums;                 ///< 8 an order in x
};

/// Points of a row are padded to a multiple of this.
inline constexpr std::size_t veil_padding = 16;

/// Then over those in x.
struct VeilRowView {
    const float* sums;            ///< of VeilOrdersView
    const float *cosine, *sine;   ///< of order n at all columns, then of the next
    std::size_t orders, columns;  ///< columns: a multiple of veil_padding
    float* values;                ///< 4 a point
};

/// A row of a picture between the points of a coarse one, 8 pixels at a time: pixel k of a block is
/// share + k · step further than the block's point, towards the next.
struct VeilSpreadView {
    const float* points;  ///< 4 each
    std::size_t blocks;
    int blocks_per_point;  ///< 1 or more
    int first_block;       ///< of its point's
    float first_share, step;
    float *rgb, *irradiance;  ///< 24 and 8 a block; irradiance is held above zero
};

#define GHOSTLIGHT_VEIL_KERNELS(set)         \
    namespace set {                          \
    void veil_orders(const VeilOrdersView&); \
    void veil_row(const VeilRowView&);       \
    void veil_spread(const VeilSpreadView&); \
    }
GHOSTLIGHT_EVERY_SET(GHOSTLIGHT_VEIL_KERNELS)
#undef GHOSTLIGHT_VEIL_KERNELS

}  // namespace ghostlight
