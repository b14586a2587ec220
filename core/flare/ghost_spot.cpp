#include "core/flare/ghost_spot.h"

#include <algorithm>
#include <cmath>

namespace ghostlight {

std::array<double, 2> GhostSpot::sigmas_mm() const {
    const double middle = 0.5 * (xx_mm2 + yy_mm2);
    const double apart = std::hypot(0.5 * (xx_mm2 - yy_mm2), xy_mm2);
    return {std::sqrt(std::max(0.0, middle - apart)), std::sqrt(std::max(0.0, middle + apart))};
}

GhostSpot spot_of(const MeshNodes& nodes, const PixelFrame& frame) {
    constexpr int parts = 6;  // of a cell, each way: a rim's place to a few per cent of a cell
    GhostSpot moments;
    const int side = nodes.cells + 1;
    double x_sum = 0.0, y_sum = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    for (int j = 0; j < nodes.cells; ++j)
        for (int i = 0; i < nodes.cells; ++i) {
            const auto a = static_cast<std::size_t>(j * side + i);
            const std::size_t corners[4] = {a, a + 1, a + static_cast<std::size_t>(side),
                                            a + static_cast<std::size_t>(side) + 1};
            if (std::ranges::any_of(corners, [&](std::size_t k) { return nodes.margin[k] < 0.0F; }))
                continue;
            for (int q = 0; q < parts; ++q)
                for (int p = 0; p < parts; ++p) {
                    const float u = (static_cast<float>(p) + 0.5F) / parts;
                    const float v = (static_cast<float>(q) + 0.5F) / parts;
                    const float shares[4] = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
                    const auto at = [&](const std::vector<float>& values, std::size_t stride,
                                        std::size_t c) {
                        float sum = 0.0F;
                        for (std::size_t n = 0; n < 4; ++n)
                            sum += shares[n] * values[corners[n] * stride + c];
                        return sum;
                    };
                    if (std::ranges::any_of(nodes.clearances, [&](const auto& clearance) {
                            return at(clearance, 1, 0) < 0.0F;
                        }))
                        continue;
                    const double area = nodes.cell_area_mm2 / (parts * parts);
                    for (std::size_t c = 0; c < 4; ++c)
                        moments.flux_mm2[c] += area * static_cast<double>(at(nodes.weights, 4, c));
                    const double weight = area * static_cast<double>(at(nodes.weights, 4, 3));
                    const double x = frame.left_mm +
                                     frame.pitch_mm * static_cast<double>(at(nodes.column, 1, 0));
                    const double y =
                        frame.bottom_mm + frame.pitch_mm * static_cast<double>(at(nodes.row, 1, 0));
                    x_sum += weight * x;
                    y_sum += weight * y;
                    xx += weight * x * x;
                    xy += weight * x * y;
                    yy += weight * y * y;
                }
        }
    const double flux = moments.flux();
    if (!(flux > 0.0)) return moments;
    moments.x_mm = x_sum / flux;
    moments.y_mm = y_sum / flux;
    moments.xx_mm2 = std::max(0.0, xx / flux - moments.x_mm * moments.x_mm);
    moments.xy_mm2 = xy / flux - moments.x_mm * moments.y_mm;
    moments.yy_mm2 = std::max(0.0, yy / flux - moments.y_mm * moments.y_mm);
    return moments;
}

}  // namespace ghostlight
