#include "core/flare/ghost_spot.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ghostlight {
namespace {

/// A place within a cell and its share of the cell's area.
struct Part {
    float u, v, share;
};

/// Gauss's rule: exact for a bilinear weight times the square of a bilinear place.
constexpr float gauss = 0.21132487F;
constexpr std::array<Part, 4> whole_cell = {{{gauss, gauss, 0.25F},
                                             {1.0F - gauss, gauss, 0.25F},
                                             {gauss, 1.0F - gauss, 0.25F},
                                             {1.0F - gauss, 1.0F - gauss, 0.25F}}};
/// Of a cell with a rim, each way: the rim's place to a few per cent of a cell.
constexpr int rim_parts = 6;

std::array<Part, rim_parts * rim_parts> split_cell() {
    std::array<Part, rim_parts * rim_parts> parts{};
    for (int k = 0; k < rim_parts * rim_parts; ++k)
        parts[static_cast<std::size_t>(k)] = {
            (static_cast<float>(k % rim_parts) + 0.5F) / rim_parts,
            (static_cast<float>(k / rim_parts) + 0.5F) / rim_parts, 1.0F / (rim_parts * rim_parts)};
    return parts;
}

class Sums {
   public:
    Sums(const MeshNodes& nodes, int channels, const PixelFrame& frame)
        : nodes_(nodes), channels_(static_cast<std::size_t>(channels)), frame_(frame) {}

    void add_cell(const std::array<std::size_t, 4>& corners) {
        if (std::ranges::any_of(corners, [&](std::size_t k) { return nodes_.margin[k] < 0.0F; }))
            return add_valid(corners);
        bool cut = false;
        for (const auto& clearance : nodes_.clearances) {
            const auto [least, most] = std::minmax({clearance[corners[0]], clearance[corners[1]],
                                                    clearance[corners[2]], clearance[corners[3]]});
            if (most < 0.0F) return;
            cut = cut || least < 0.0F;
        }
        static const auto split = split_cell();
        if (!cut)
            for (const Part& part : whole_cell) add(corners, part);
        else
            for (const Part& part : split) add_inside(corners, part);
    }

    GhostSpot spot() const {
        GhostSpot spot;
        for (std::size_t c = 0; c < 4; ++c) spot.flux_mm2[c] = flux_[channels_ == 1 ? 0 : c];
        const double flux = spot.flux();
        if (!(flux > 0.0)) return spot;
        spot.x_mm = x_ / flux;
        spot.y_mm = y_ / flux;
        spot.xx_mm2 = std::max(0.0, xx_ / flux - spot.x_mm * spot.x_mm);
        spot.xy_mm2 = xy_ / flux - spot.x_mm * spot.y_mm;
        spot.yy_mm2 = std::max(0.0, yy_ / flux - spot.y_mm * spot.y_mm);
        return spot;
    }

   private:
    const MeshNodes& nodes_;
    std::size_t channels_;
    const PixelFrame& frame_;
    std::array<double, 4> flux_{};
    double x_ = 0.0, y_ = 0.0, xx_ = 0.0, xy_ = 0.0, yy_ = 0.0;

    static std::array<float, 4> shares_of(const Part& part) {
        const float u = part.u, v = part.v;
        return {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
    }
    static float mixed(const std::array<std::size_t, 4>& corners,
                       const std::array<float, 4>& shares, const std::vector<float>& values,
                       std::size_t stride, std::size_t c) {
        float sum = 0.0F;
        for (std::size_t n = 0; n < 4; ++n) sum += shares[n] * values[corners[n] * stride + c];
        return sum;
    }

    /// Beside failing rays nothing can be interpolated: those that pass stand for a quarter each.
    void add_valid(const std::array<std::size_t, 4>& corners) {
        for (const std::size_t k : corners) {
            const bool passes =
                nodes_.margin[k] >= 0.0F &&
                std::ranges::all_of(nodes_.clearances, [&](const auto& c) { return c[k] >= 0.0F; });
            if (passes) add({k, k, k, k}, {0.5F, 0.5F, 0.25F});
        }
    }

    void add_inside(const std::array<std::size_t, 4>& corners, const Part& part) {
        const auto shares = shares_of(part);
        for (const auto& clearance : nodes_.clearances)
            if (mixed(corners, shares, clearance, 1, 0) < 0.0F) return;
        add(corners, part);
    }

    void add(const std::array<std::size_t, 4>& corners, const Part& part) {
        const auto shares = shares_of(part);
        const double area = nodes_.cell_area_mm2 * static_cast<double>(part.share);
        double light = 0.0;  // of the last channel, which is irradiance
        for (std::size_t c = 0; c < channels_; ++c) {
            light =
                area * static_cast<double>(mixed(corners, shares, nodes_.weights, channels_, c));
            flux_[c] += light;
        }
        const double x =
            frame_.left_mm +
            frame_.pitch_mm * static_cast<double>(mixed(corners, shares, nodes_.column, 1, 0));
        const double y =
            frame_.bottom_mm +
            frame_.pitch_mm * static_cast<double>(mixed(corners, shares, nodes_.row, 1, 0));
        x_ += light * x;
        y_ += light * y;
        xx_ += light * x * x;
        xy_ += light * x * y;
        yy_ += light * y * y;
    }
};

}  // namespace

std::array<double, 2> GhostSpot::sigmas_mm() const {
    const double middle = 0.5 * (xx_mm2 + yy_mm2);
    const double apart = std::hypot(0.5 * (xx_mm2 - yy_mm2), xy_mm2);
    return {std::sqrt(std::max(0.0, middle - apart)), std::sqrt(std::max(0.0, middle + apart))};
}

GhostSpot spot_of(const MeshNodes& nodes, int channels, const PixelFrame& frame) {
    Sums sums(nodes, channels, frame);
    const auto side = static_cast<std::size_t>(nodes.cells) + 1;
    for (std::size_t j = 0; j + 1 < side; ++j)
        for (std::size_t i = 0; i + 1 < side; ++i) {
            const std::size_t a = j * side + i;
            sums.add_cell({a, a + 1, a + side, a + side + 1});
        }
    return sums.spot();
}

}  // namespace ghostlight
