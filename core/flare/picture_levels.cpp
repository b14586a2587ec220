#include "core/flare/picture_levels.h"

#include <algorithm>
#include <cmath>

namespace ghostlight {

RasterSize level_size(const PixelFrame& frame, int level) {
    if (level == 0) return {frame.width_px, frame.height_px, 1.0, 0};
    const int step = 1 << level;
    constexpr int margin_px = 1;
    return {(frame.width_px + step - 1) / step + 2 * margin_px,
            (frame.height_px + step - 1) / step + 2 * margin_px, 1.0 / step, margin_px};
}

double blur_px(int level) {
    // Mean distance from the middle of a nearly normal distribution of σ = 2^l / 2.
    return level == 0 ? 0.0 : 0.4 * std::ldexp(1.0, level);
}

double blur_px2(int level) {
    // Averaging over a pixel of 2^l and the linear interpolation after it: σ = 2^l / 2.
    return level == 0 ? 0.0 : 0.125 * std::ldexp(1.0, 2 * level);
}

namespace {

/// The two coarser pixels that a finer one lies between: it lies a quarter of their distance from
/// the nearer one.
struct Between {
    int low, high;
    float share_high;
};
Between between(int fine, int fine_margin, int coarse_margin, int coarse_count) {
    // Its middle is at (2 n − 1) / 4 coarser pixels from the middle of the first.
    const int n = fine - fine_margin + 2 * coarse_margin;
    const int low = (n - 1) >> 1;
    return {std::clamp(low, 0, coarse_count - 1), std::clamp(low + 1, 0, coarse_count - 1),
            n % 2 == 0 ? 0.75F : 0.25F};
}

}  // namespace

template <int C>
void add_coarser_rows(const std::vector<float>& coarser, const RasterSize& coarser_size,
                      const RasterSize& finer_size, int first_row, int last_row,
                      std::vector<float>& finer) {
    const std::size_t stride = static_cast<std::size_t>(coarser_size.width_px) * C;
    std::vector<float> mixed(stride);
    for (int row = first_row; row < last_row; ++row) {
        const Between rows =
            between(row, finer_size.margin_px, coarser_size.margin_px, coarser_size.height_px);
        const float* below = coarser.data() + static_cast<std::size_t>(rows.low) * stride;
        const float* above = coarser.data() + static_cast<std::size_t>(rows.high) * stride;
        for (std::size_t i = 0; i < stride; ++i)
            mixed[i] = below[i] + rows.share_high * (above[i] - below[i]);
        float* to = finer.data() + static_cast<std::size_t>(row) *
                                       static_cast<std::size_t>(finer_size.width_px * C);
        for (int column = 0; column < finer_size.width_px; ++column) {
            const Between at = between(column, finer_size.margin_px, coarser_size.margin_px,
                                       coarser_size.width_px);
            const float* a = mixed.data() + at.low * C;
            const float* b = mixed.data() + at.high * C;
            for (int c = 0; c < C; ++c) to[c] += a[c] + at.share_high * (b[c] - a[c]);
            to += C;
        }
    }
}

template void add_coarser_rows<gray_channels>(const std::vector<float>&, const RasterSize&,
                                              const RasterSize&, int, int, std::vector<float>&);
template void add_coarser_rows<color_channels>(const std::vector<float>&, const RasterSize&,
                                               const RasterSize&, int, int, std::vector<float>&);

}  // namespace ghostlight
