#include "core/flare/spread_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/flare/draw_rung.h"
#include "core/flare/picture_levels.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr int band_rows = 16;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// A mesh in the pixels of a part of a level's picture.
ColorMesh<color_channels> moved(const ColorMesh<color_channels>& mesh, double dx, double dy,
                                const std::array<double, 4>& gain) {
    ColorMesh<color_channels> result;
    result.reaches_past_right = mesh.reaches_past_right;
    result.edges.reserve(mesh.edges.size());
    for (ColorEdge<color_channels> edge : mesh.edges) {
        edge.x0 += dx;
        edge.x1 += dx;
        edge.y0 += dy;
        edge.y1 += dy;
        for (std::size_t c = 0; c < 4; ++c) {
            edge.e[c] = gain[c] * (edge.e[c] - edge.gx[c] * dx - edge.gy[c] * dy);
            edge.gx[c] *= gain[c];
            edge.gy[c] *= gain[c];
        }
        result.edges.push_back(edge);
    }
    for (ColorPoint<color_channels> point : mesh.points) {
        point.x += dx;
        point.y += dy;
        for (std::size_t c = 0; c < 4; ++c) point.flux[c] *= gain[c];
        result.points.push_back(point);
    }
    return result;
}

struct Extent {
    double low = 1e300, high = -1e300;
    void take(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

/// Draws in bands, so that the accumulators stay small.
void draw(const ColorMesh<color_channels>& mesh, Spot& spot) {
    const RasterSize size{spot.width, spot.height, std::ldexp(1.0, -spot.level), 0};
    spot.values.assign(idx(spot.width * spot.height) * 4, 0.0F);
    std::vector<std::uint32_t> chosen;
    for (int row = 0; row < spot.height; row += band_rows) {
        const int rows = std::min(band_rows, spot.height - row);
        const double low = row / size.scale, high = (row + rows) / size.scale;
        chosen.clear();
        for (std::uint32_t k = 0; k < mesh.edges.size(); ++k) {
            const auto& edge = mesh.edges[k];
            if (std::max(edge.y0, edge.y1) >= low && std::min(edge.y0, edge.y1) <= high)
                chosen.push_back(k);
        }
        ColorBand<color_channels> band(size, row, rows);
        band.add(mesh.edges, chosen, mesh.reaches_past_right);
        for (const auto& point : mesh.points) band.add(point);
        band.resolve({spot.values.data() + idx(row * spot.width) * 4, idx(rows * spot.width) * 4});
    }
}

/// Adds a ghost's fringes to a spot that holds the ghost.
void add_rung(RungMesh rung, const RasterSize& whole, double dx_px, double dy_px,
              const std::array<double, 4>& gain, Spot& spot) {
    for (std::size_t c = 0; c < rim_channels; ++c) {
        rung.color[c] *= static_cast<float>(gain[c]);
        for (auto& share : rung.mask_shares) share[c] *= static_cast<float>(gain[c]);
    }
    rung.rim_px = 1.0 / whole.scale;
    RungCanvas canvas = canvas_of(spot.values, rim_channels, whole);
    canvas.left_px = spot.left - dx_px * whole.scale;
    canvas.bottom_px = spot.bottom - dy_px * whole.scale;
    canvas.size.width_px = spot.width;
    canvas.size.height_px = spot.height;
    RungDrawing(rung, canvas, std::max(spot.height, 1)).draw(0);
}

}  // namespace

SpreadKernel spread_kernel(const LightPattern& pattern, const LightDirection& light,
                           const GhostShift& shift, double scale) {
    if (pattern.is_point()) return {0, 0, {1.0F}};
    constexpr int parts = 3;  // of a cell, each way
    const double azimuth = rad_from_deg(light.azimuth_deg);
    const double c = std::cos(azimuth), s = std::sin(azimuth);
    struct Place {
        double x, y;
        float share;
    };
    std::vector<Place> places;
    Extent x_extent, y_extent;
    // Offsets are small: the frame's turn over the pattern is not.
    const FieldOffset right = field_offset(light, 1.0, 0.0), up = field_offset(light, 0.0, 1.0);
    for (int j = 0; j < pattern.height * parts; ++j)
        for (int i = 0; i < pattern.width * parts; ++i) {
            const float share = pattern.shares[idx(j / parts * pattern.width + i / parts)];
            if (share == 0.0F) continue;
            const double r = ((i + 0.5) / parts - 0.5 * pattern.width) * pattern.cell_rad;
            const double u = (0.5 * pattern.height - (j + 0.5) / parts) * pattern.cell_rad;
            const double along = (r * right.along_rad + u * up.along_rad) * shift.along_px * scale;
            const double across =
                (r * right.across_rad + u * up.across_rad) * shift.across_px * scale;
            places.push_back({along * c - across * s, along * s + across * c,
                              share / static_cast<float>(parts * parts)});
            x_extent.take(std::abs(places.back().x));
            y_extent.take(std::abs(places.back().y));
        }
    SpreadKernel kernel;
    kernel.reach_x = static_cast<int>(std::floor(x_extent.high)) + 1;
    kernel.reach_y = static_cast<int>(std::floor(y_extent.high)) + 1;
    const int across = 2 * kernel.reach_x + 1;
    kernel.shares.assign(idx(across * (2 * kernel.reach_y + 1)), 0.0F);
    for (const Place& place : places) {
        const double x = place.x + kernel.reach_x, y = place.y + kernel.reach_y;
        const int left = std::clamp(static_cast<int>(x), 0, across - 2);
        const int low = std::clamp(static_cast<int>(y), 0, 2 * kernel.reach_y - 1);
        const auto fx = static_cast<float>(x - left), fy = static_cast<float>(y - low);
        float* at = &kernel.shares[idx(low * across + left)];
        at[0] += place.share * (1 - fx) * (1 - fy);
        at[1] += place.share * fx * (1 - fy);
        at[across] += place.share * (1 - fx) * fy;
        at[across + 1] += place.share * fx * fy;
    }
    return kernel;
}

std::array<double, 2> spread_px(const LightPattern& pattern, const GhostShift& shift) {
    const double breadth_rad = pattern.cell_rad * std::max(pattern.width, pattern.height);
    const double along = breadth_rad * std::abs(shift.along_px);
    const double across = breadth_rad * std::abs(shift.across_px);
    return {std::min(along, across), std::max(along, across)};
}

Spot draw_spot(const ColorMesh<color_channels>& mesh, const RungMesh& rung, const PixelFrame& frame,
               int level, double dx_px, double dy_px, const std::array<double, 4>& gain,
               const SpreadKernel& kernel) {
    const RasterSize size = level_size(frame, level);
    Extent x, y;
    for (const auto& edge : mesh.edges) {
        x.take(std::min(edge.x0, edge.x1));
        x.take(std::max(edge.x0, edge.x1));
        y.take(std::min(edge.y0, edge.y1));
        y.take(std::max(edge.y0, edge.y1));
    }
    for (const auto& point : mesh.points) {
        x.take(point.x);
        y.take(point.y);
    }
    for (const RungTriangle& triangle : rung.triangles)
        for (std::size_t n = 0; n < 3; ++n) {
            x.take(static_cast<double>(triangle.column[n]));
            y.take(static_cast<double>(triangle.row[n]));
        }
    Spot spot;
    spot.level = level;
    if (x.low > x.high) return spot;
    if (mesh.reaches_past_right) x.high = std::max(x.high, static_cast<double>(frame.width_px));
    const auto pixel = [&](double at, int last) {
        return std::clamp(static_cast<int>(std::floor(at * size.scale)) + size.margin_px, 0, last);
    };
    spot.left = pixel(x.low + dx_px, size.width_px);
    spot.bottom = pixel(y.low + dy_px, size.height_px);
    spot.width = pixel(x.high + dx_px, size.width_px - 1) + 1 - spot.left;
    spot.height = pixel(y.high + dy_px, size.height_px - 1) + 1 - spot.bottom;
    if (spot.width < 1 || spot.height < 1) return {};
    // To the part's own corner, in full-size pixels.
    draw(moved(mesh, dx_px + (size.margin_px - spot.left) / size.scale,
               dy_px + (size.margin_px - spot.bottom) / size.scale, gain),
         spot);
    if (!rung.empty()) add_rung(rung, size, dx_px, dy_px, gain, spot);
    fold_spot(kernel, spot);
    return spot;
}

void fold_spot(const SpreadKernel& kernel, Spot& spot) {
    if (kernel.reach_x == 0 && kernel.reach_y == 0) return;
    Spot wide = spot;
    wide.left -= kernel.reach_x;
    wide.bottom -= kernel.reach_y;
    wide.width += 2 * kernel.reach_x;
    wide.height += 2 * kernel.reach_y;
    wide.values.assign(idx(wide.width * wide.height) * 4, 0.0F);
    const int across = 2 * kernel.reach_x + 1;
    for (int b = 0; b <= 2 * kernel.reach_y; ++b)
        for (int a = 0; a < across; ++a) {
            const float share = kernel.shares[idx(b * across + a)];
            if (share == 0.0F) continue;
            for (int row = 0; row < spot.height; ++row) {
                const float* from = spot.values.data() + idx(row * spot.width) * 4;
                float* to = wide.values.data() + idx((row + b) * wide.width + a) * 4;
                for (std::size_t i = 0; i < idx(spot.width) * 4; ++i) to[i] += share * from[i];
            }
        }
    spot = std::move(wide);
}

void add_spot(const Spot& spot, const PixelFrame& frame, std::vector<float>& picture) {
    const RasterSize size = level_size(frame, spot.level);
    const int first = std::max(0, -spot.left);
    const int last = std::min(spot.width, size.width_px - spot.left);
    for (int row = 0; row < spot.height && first < last; ++row) {
        const int at = spot.bottom + row;
        if (at < 0 || at >= size.height_px) continue;
        const float* from = spot.values.data() + idx(row * spot.width + first) * 4;
        float* to = picture.data() + idx(at * size.width_px + spot.left + first) * 4;
        for (std::size_t i = 0; i < idx(last - first) * 4; ++i) to[i] += from[i];
    }
}

}  // namespace ghostlight
