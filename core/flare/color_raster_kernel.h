#pragma once

#include <cstddef>
#include <cstdint>

#include "core/flare/color_raster.h"
#include "core/instruction_set.h"

namespace ghostlight {

template <int C>
struct BandView {
    RasterCell<C>* cells;  ///< (width + 2) for each row
    int width, first_row, row_count;
    double scale, margin;
    const ColorEdge<C>* edges;
    const std::uint32_t* chosen;
    std::size_t count;
};

template <int C>
struct ResolveView {
    RasterCell<C>* cells;
    int width, row_count;
    float* pixels;
};

#define GHOSTLIGHT_RASTER_KERNELS(set)         \
    namespace set {                            \
    void add_edges(const BandView<1>&);        \
    void add_edges(const BandView<4>&);        \
    void resolve_cells(const ResolveView<1>&); \
    void resolve_cells(const ResolveView<4>&); \
    }
GHOSTLIGHT_EVERY_SET(GHOSTLIGHT_RASTER_KERNELS)
#undef GHOSTLIGHT_RASTER_KERNELS

}  // namespace ghostlight
