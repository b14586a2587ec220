#include "core/flare/color_raster.h"

#include <cmath>

#include "core/flare/color_raster_kernel.h"

namespace ghostlight {

template <int C>
ColorBand<C>::ColorBand(const RasterSize& size, int first_row, int row_count)
    : size_(size),
      first_row_(first_row),
      row_count_(row_count),
      cells_(static_cast<std::size_t>(size.width_px + 2) * static_cast<std::size_t>(row_count)) {}

template <int C>
void ColorBand<C>::add(std::span<const ColorEdge<C>> edges, std::span<const std::uint32_t> chosen) {
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
    RasterCell<C>& cell =
        cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width_px + 2) +
               static_cast<std::size_t>(x)];
    for (int c = 0; c < C; ++c) cell.now[c] += point.flux[c] * size_.scale * size_.scale;
}

template <int C>
void ColorBand<C>::resolve(std::span<float> pixels) {
    const ResolveView<C> view{cells_.data(), size_.width_px, row_count_, pixels.data()};
    GHOSTLIGHT_DISPATCH(resolve_cells, view);
}

template class ColorBand<gray_channels>;
template class ColorBand<color_channels>;

}  // namespace ghostlight
