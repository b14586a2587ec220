#include "core/flare/grid_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ghostlight {
namespace {

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

double inverse_square(double nm) { return 1.0 / (nm * nm); }

}  // namespace

ColorAxis::ColorAxis(const std::vector<SpectralSample>& samples) {
    const double first = inverse_square(samples.front().wavelength_nm);
    const double last = inverse_square(samples.back().wavelength_nm);
    low_ = std::min(first, last);
    span_ = std::abs(last - first);
}

double ColorAxis::at(double wavelength_nm) const {
    return span_ > 0.0 ? (inverse_square(wavelength_nm) - low_) / span_ : 0.5;
}

double ColorAxis::wavelength_nm(double at) const { return 1.0 / std::sqrt(low_ + at * span_); }

double band_weight(double t, int band, int bands) {
    const double at = std::clamp(t * bands - 0.5, 0.0, bands - 1.0);
    return std::max(0.0, 1.0 - std::abs(at - band));
}

void fill_failed(const MirrorGrid& grid, int channels, std::vector<float>& values) {
    const int across = grid.half_side(), rows = grid.side();
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < across; ++i) {
            const int k = j * across + i;
            if (grid.half.margin[idx(k)] >= 0.0F) continue;
            int count = 0;
            for (int c = 0; c < channels; ++c) values[idx(k * channels + c)] = 0.0F;
            for (int n = std::max(0, j - 1); n <= std::min(rows - 1, j + 1); ++n)
                for (int m = std::max(0, i - 1); m <= std::min(across - 1, i + 1); ++m) {
                    const int other = n * across + m;
                    if (grid.half.margin[idx(other)] < 0.0F) continue;
                    ++count;
                    for (int c = 0; c < channels; ++c)
                        values[idx(k * channels + c)] += values[idx(other * channels + c)];
                }
            for (int c = 0; c < channels && count > 0; ++c)
                values[idx(k * channels + c)] /= static_cast<float>(count);
        }
}

void correct_means(const MirrorGrid& grid, int channels, std::vector<float>& values) {
    const std::vector<float> given = values;
    const int across = grid.half_side(), rows = grid.side();
    auto at = [&](int i, int j, int c) {
        return given[idx((j * across + std::abs(i)) * channels + c)];
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < across; ++i) {
            const int m = std::min(i, across - 2), n = std::clamp(j, 1, rows - 2);
            for (int c = 0; c < channels; ++c) {
                const float along = at(m - 1, j, c) - 2.0F * at(m, j, c) + at(m + 1, j, c);
                const float up = at(i, n - 1, c) - 2.0F * at(i, n, c) + at(i, n + 1, c);
                const float own = at(i, j, c);
                // Where the correction is large the values are too rough for it.
                values[idx((j * across + i) * channels + c)] =
                    own -
                    std::clamp((along + up) / 12.0F, -0.2F * std::abs(own), 0.2F * std::abs(own));
            }
        }
}

namespace {

/// One column of a full grid between the columns of a half grid.
struct Between {
    int column = 0;
    float share = 0.0F;
};

template <int C>
void interpolate_channels(const MirrorGrid& from, const std::vector<float>& values, int cells,
                          std::vector<float>& nodes) {
    const int across = from.half_side(), side = cells + 1;
    nodes.resize(idx(side * side * C));
    std::vector<Between> columns(idx(side));
    for (int i = 0; i < side; ++i) {
        const float x = std::abs(static_cast<float>(i * from.cells) / static_cast<float>(cells) -
                                 0.5F * static_cast<float>(from.cells));
        const int column = std::min(static_cast<int>(x), across - 2);
        columns[idx(i)] = {column * C, x - static_cast<float>(column)};
    }
    std::vector<float> row(idx(across * C));
    for (int j = 0; j < side; ++j) {
        const float y = static_cast<float>(j * from.cells) / static_cast<float>(cells);
        const int j0 = std::min(static_cast<int>(y), from.cells - 1);
        const float fy = y - static_cast<float>(j0);
        const float* low = values.data() + j0 * across * C;
        const float* high = low + across * C;
        for (int k = 0; k < across * C; ++k) row[idx(k)] = low[k] + fy * (high[k] - low[k]);
        float* to = nodes.data() + j * side * C;
        for (const Between& at : columns) {
            const float* left = row.data() + at.column;
            for (int c = 0; c < C; ++c) to[c] = left[c] + at.share * (left[C + c] - left[c]);
            to += C;
        }
    }
}

}  // namespace

void interpolate(const MirrorGrid& from, const std::vector<float>& values, int channels, int cells,
                 std::vector<float>& nodes) {
    channels == 1 ? interpolate_channels<1>(from, values, cells, nodes)
                  : interpolate_channels<4>(from, values, cells, nodes);
}

namespace {

/// Four neighbouring nodes of a line, and their shares at a place between the middle two (or the
/// outer two, at an end): Lagrange's cubic.
struct Cubic {
    int first = 0;
    std::array<float, 4> share{};
};

Cubic cubic_at(float x, int first, int last) {
    Cubic at;
    at.first = std::clamp(static_cast<int>(std::floor(x)) - 1, first, last - 3);
    const float t = x - static_cast<float>(at.first);
    at.share = {(t - 1.0F) * (t - 2.0F) * (t - 3.0F) / -6.0F, t * (t - 2.0F) * (t - 3.0F) / 2.0F,
                t * (t - 1.0F) * (t - 3.0F) / -2.0F, t * (t - 1.0F) * (t - 2.0F) / 6.0F};
    return at;
}

}  // namespace

std::vector<float> interpolate_smooth(int from_cells, const std::vector<float>& values,
                                      int channels, int cells) {
    const int across = from_cells / 2 + 1, side = cells + 1, half = cells / 2 + 1;
    const float scale = static_cast<float>(from_cells) / static_cast<float>(cells);
    std::vector<Cubic> columns;
    // One mirrored column on the other side of the middle belongs to the same smooth function.
    for (int i = 0; i < half; ++i)
        columns.push_back(cubic_at(static_cast<float>(i) * scale, -1, across - 1));
    std::vector<float> result(idx(side * half * channels), 0.0F), row(idx(across * channels));
    for (int j = 0; j < side; ++j) {
        const Cubic up = cubic_at(static_cast<float>(j) * scale, 0, from_cells);
        std::ranges::fill(row, 0.0F);
        for (int k = 0; k < 4; ++k) {
            const float* line = values.data() + (up.first + k) * across * channels;
            for (int m = 0; m < across * channels; ++m) row[idx(m)] += up.share[idx(k)] * line[m];
        }
        float* to = result.data() + j * half * channels;
        for (const Cubic& at : columns) {
            for (int k = 0; k < 4; ++k) {
                const float* node = row.data() + std::abs(at.first + k) * channels;
                for (int c = 0; c < channels; ++c) to[c] += at.share[idx(k)] * node[c];
            }
            to += channels;
        }
    }
    return result;
}

}  // namespace ghostlight
