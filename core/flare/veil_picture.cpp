#include "core/flare/veil_picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/flare/picture_levels.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

/// Points of the coarse grid within a standard deviation of the narrowest ghost: interpolating
/// linearly between them is off by 1/(8 · 6²) = 0.35 % of its peak.
constexpr double points_in_sigma = 6.0;
constexpr std::size_t rows_together = 8;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// Where a fine pixel lies among the coarse ones.
struct Between {
    std::size_t low;
    float share;
};
Between between(int fine, const RasterSize& coarse) {
    const double at = (fine + 0.5) * coarse.scale + coarse.margin_px - 0.5;
    const double low = std::floor(at);
    return {static_cast<std::size_t>(low), static_cast<float>(at - low)};
}

/// A row of a coarse grid as a row of the picture.
void draw_row(const std::vector<float>& mixed, const std::vector<Between>& columns, float* rgb,
              float* irradiance) {
    // All pixels but the last are written four floats wide: the next one overwrites the fourth.
    const std::size_t last = columns.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
        const float* from = mixed.data() + columns[i].low * 4;
        float value[4];
        for (std::size_t c = 0; c < 4; ++c)
            value[c] = from[c] + columns[i].share * (from[4 + c] - from[c]);
        irradiance[i] = std::max(0.0F, value[3]);
        std::memcpy(rgb + 3 * i, value, (i < last ? 4 : 3) * sizeof(float));
    }
}

}  // namespace

int veil_level(double narrowest_mm, const PixelFrame& frame) {
    const double step_px = narrowest_mm / (points_in_sigma * frame.pitch_mm);
    return std::clamp(static_cast<int>(std::floor(std::log2(std::max(step_px, 1.0)))), 0,
                      picture_levels - 1);
}

void draw_veil(const VeilSeries& series, double narrowest_mm, const PixelFrame& frame,
               unsigned threads, FlareImage& image) {
    const RasterSize coarse = level_size(frame, veil_level(narrowest_mm, frame));
    const double pitch_mm = frame.pitch_mm / coarse.scale;
    // One point more at the far ends, so that level 0, which has no margin, has a neighbour too.
    std::vector<double> x_mm, y_mm;
    for (int i = 0; i <= coarse.width_px; ++i)
        x_mm.push_back(frame.left_mm + (i - coarse.margin_px + 0.5) * pitch_mm);
    for (int j = 0; j <= coarse.height_px; ++j)
        y_mm.push_back(frame.bottom_mm + (j - coarse.margin_px + 0.5) * pitch_mm);
    const std::vector<float> values = series.grid(x_mm, y_mm, threads);
    std::vector<Between> columns;
    for (int i = 0; i < frame.width_px; ++i) columns.push_back(between(i, coarse));
    const std::size_t stride = x_mm.size() * 4, width = idx(frame.width_px);
    const std::size_t height = idx(frame.height_px);
    parallel_for((height + rows_together - 1) / rows_together, threads, {}, [&](std::size_t block) {
        std::vector<float> mixed(stride);
        for (std::size_t j = block * rows_together;
             j < std::min(height, (block + 1) * rows_together); ++j) {
            const Between rows = between(static_cast<int>(j), coarse);
            const float* below = values.data() + rows.low * stride;
            for (std::size_t i = 0; i < stride; ++i)
                mixed[i] = below[i] + rows.share * (below[stride + i] - below[i]);
            draw_row(mixed, columns, &image.rgb[3 * j * width], &image.irradiance[j * width]);
        }
    });
}

}  // namespace ghostlight
