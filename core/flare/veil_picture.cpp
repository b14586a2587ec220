#include "core/flare/veil_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/flare/picture_levels.h"
#include "core/flare/veil_kernel.h"
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

/// A row of a coarse grid as a row of the picture, for any size of the coarse one.
void draw_any_row(const std::vector<float>& mixed, const std::vector<Between>& columns, float* rgb,
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

/// The same of a grid at 1/8 of the size or less, in blocks of eight pixels.
class BlockRows {
   public:
    static constexpr int block_px = 8;
    BlockRows(int width_px, int level)
        : width_px_(width_px),
          step_px_(1 << level),
          // The first point's pixels begin half a step beside the picture.
          first_px_(-step_px_ / 2),
          first_whole_(idx((step_px_ / 2 + block_px - 1) / block_px)) {}

    void draw(const std::vector<float>& mixed, float* rgb, float* irradiance) const {
        const int begin_px = first_px_ + block_px * static_cast<int>(first_whole_);
        const std::size_t whole = idx((width_px_ - begin_px) / block_px);
        spread(mixed, first_whole_, whole, rgb + 3 * begin_px, irradiance + begin_px);
        const int end_px = begin_px + block_px * static_cast<int>(whole);
        if (begin_px > 0) draw_part(mixed, first_whole_ - 1, begin_px - block_px, rgb, irradiance);
        if (end_px < width_px_) draw_part(mixed, first_whole_ + whole, end_px, rgb, irradiance);
    }

   private:
    int width_px_, step_px_, first_px_;
    std::size_t first_whole_;  ///< block on the picture

    void spread(const std::vector<float>& mixed, std::size_t first, std::size_t blocks, float* rgb,
                float* irradiance) const {
        const std::size_t per_point = idx(step_px_ / block_px);
        const float step = 1.0F / static_cast<float>(step_px_);
        const VeilSpreadView view{mixed.data() + 4 * (first / per_point),
                                  blocks,
                                  static_cast<int>(per_point),
                                  static_cast<int>(first % per_point),
                                  0.5F * step,
                                  step,
                                  rgb,
                                  irradiance};
        GHOSTLIGHT_DISPATCH(veil_spread, view);
    }
    /// A block that begins at `first_px`, as far as it lies on the picture.
    void draw_part(const std::vector<float>& mixed, std::size_t block, int first_px, float* rgb,
                   float* irradiance) const {
        std::array<float, 3 * block_px> colors;
        std::array<float, block_px> light;
        spread(mixed, block, 1, colors.data(), light.data());
        for (int k = std::max(0, -first_px); k < std::min(block_px, width_px_ - first_px); ++k) {
            std::copy_n(&colors[idx(3 * k)], 3, rgb + 3 * (first_px + k));
            irradiance[first_px + k] = light[idx(k)];
        }
    }
};

}  // namespace

int veil_level(double narrowest_mm, const PixelFrame& frame) {
    const double step_px = narrowest_mm / (points_in_sigma * frame.pitch_mm);
    return std::clamp(static_cast<int>(std::floor(std::log2(std::max(step_px, 1.0)))), 0,
                      picture_levels - 1);
}

void draw_veil(const VeilSeries& series, double narrowest_mm, const PixelFrame& frame,
               unsigned threads, FlareImage& image) {
    const int level = veil_level(narrowest_mm, frame);
    const RasterSize coarse = level_size(frame, level);
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
    const BlockRows block_rows(frame.width_px, level);
    const bool in_blocks =
        coarse.scale * BlockRows::block_px <= 1.0 && frame.width_px >= 4 * BlockRows::block_px;
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
            float *rgb = &image.rgb[3 * j * width], *irradiance = &image.irradiance[j * width];
            if (in_blocks)
                block_rows.draw(mixed, rgb, irradiance);
            else
                draw_any_row(mixed, columns, rgb, irradiance);
        }
    });
}

}  // namespace ghostlight
