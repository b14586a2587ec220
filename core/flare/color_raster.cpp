#include "core/flare/color_raster.h"

#include <algorithm>
#include <cmath>

#include "core/flare/color_raster_kernel.h"

namespace ghostlight {

namespace {

/// All zero between bands: resolve() clears what a band has touched.
template <int C>
std::vector<RasterCell<C>>& accumulators() {
    thread_local std::vector<RasterCell<C>> cells;
    return cells;
}

}  // namespace

template <int C>
ColorBand<C>::ColorBand(const RasterSize& size, int first_row, int row_count)
    : size_(size),
      first_row_(first_row),
      row_count_(row_count),
      first_column_(size.width_px),
      last_column_(-1),
      cells_(accumulators<C>()) {
    const std::size_t needed =
        static_cast<std::size_t>(size.width_px + 2) * static_cast<std::size_t>(row_count);
    if (cells_.size() < needed) cells_.resize(needed);
}

template <int C>
void ColorBand<C>::touch(double low, double high) {
    const double last = size_.width_px - 1.0;
    first_column_ = std::min(first_column_, static_cast<int>(std::clamp(low, 0.0, last)));
    last_column_ = std::max(last_column_, static_cast<int>(std::clamp(high, 0.0, last)));
}

template <int C>
void ColorBand<C>::add(std::span<const ColorEdge<C>> edges, std::span<const std::uint32_t> chosen,
                       bool open_right) {
    if (chosen.empty()) return;
    double low = edges[chosen.front()].x0, high = low;
    for (const std::uint32_t k : chosen) {
        low = std::min({low, edges[k].x0, edges[k].x1});
        high = std::max({high, edges[k].x0, edges[k].x1});
    }
    // A piece's edges cancel right of the last of them: nothing is touched beyond the next pixel.
    touch(low * size_.scale + size_.margin_px,
          open_right ? size_.width_px : high * size_.scale + size_.margin_px + 1.0);
    const BandView<C> view{cells_.data(), size_.width_px, first_row_,
                           row_count_,    size_.scale,    static_cast<double>(size_.margin_px),
                           edges.data(),  chosen.data(),  chosen.size()};
    GHOSTLIGHT_DISPATCH(add_edges, view);
}

template <int C>
void ColorBand<C>::add(const ColorPoint<C>& point) {
    const double x = point.x * size_.scale + size_.margin_px;
    const double y = point.y * size_.scale + size_.margin_px - first_row_;
    if (!(x >= 0.0) || x >= size_.width_px || !(y >= 0.0) || y >= row_count_) return;
    touch(x, x);
    RasterCell<C>& cell =
        cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width_px + 2) +
               static_cast<std::size_t>(x)];
    for (int c = 0; c < C; ++c) cell.now[c] += point.flux[c] * size_.scale * size_.scale;
}

template <int C>
void ColorBand<C>::resolve(std::span<float> pixels) {
    if (last_column_ < first_column_) return;
    const ResolveView<C> view{cells_.data(), size_.width_px, row_count_,
                              first_column_, last_column_,   pixels.data()};
    GHOSTLIGHT_DISPATCH(resolve_cells, view);
    first_column_ = size_.width_px;
    last_column_ = -1;
}

template class ColorBand<gray_channels>;
template class ColorBand<color_channels>;

}  // namespace ghostlight
