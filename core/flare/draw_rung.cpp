#include "core/flare/draw_rung.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ghostlight {
namespace {

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// A value that is linear over a triangle.
struct Linear {
    float first = 0.0F, right = 0.0F, up = 0.0F;  ///< at the first corner; per pixel
};

/// A triangle in a canvas's pixels.
class Placed {
   public:
    Placed(const RungTriangle& triangle, const RungCanvas& canvas) {
        for (std::size_t n = 0; n < 3; ++n) {
            x_[n] = static_cast<double>(triangle.column[n]) * canvas.size.scale +
                    canvas.size.margin_px - canvas.left_px;
            y_[n] = static_cast<double>(triangle.row[n]) * canvas.size.scale +
                    canvas.size.margin_px - canvas.bottom_px;
        }
        ax_ = x_[1] - x_[0];
        ay_ = y_[1] - y_[0];
        bx_ = x_[2] - x_[0];
        by_ = y_[2] - y_[0];
        const double twice = ax_ * by_ - ay_ * bx_;
        inverse_ = std::abs(twice) > 1e-9 ? 1.0 / twice : 0.0;
    }
    bool is_thin() const { return inverse_ == 0.0; }

    Linear linear(const float (&at)[3]) const {
        const double d1 = static_cast<double>(at[1] - at[0]);
        const double d2 = static_cast<double>(at[2] - at[0]);
        return {at[0], static_cast<float>((d1 * by_ - d2 * ay_) * inverse_),
                static_cast<float>((d2 * ax_ - d1 * bx_) * inverse_)};
    }
    float at(const Linear& value, int column, int row) const {
        return value.first + value.right * static_cast<float>(column + 0.5 - x_[0]) +
               value.up * static_cast<float>(row + 0.5 - y_[0]);
    }
    /// First row whose middle is inside, and one past the last.
    std::array<int, 2> rows() const {
        const auto [low, high] = std::minmax({y_[0], y_[1], y_[2]});
        return {static_cast<int>(std::ceil(low - 0.5)), static_cast<int>(std::ceil(high - 0.5))};
    }
    /// Of a row, half open, so that neighbours share no pixel.
    std::array<int, 2> columns(int row, int width_px) const {
        double from = 1e300, to = -1e300;
        for (std::size_t s = 0; s < 3; ++s) {
            const std::size_t a = s, b = (s + 1) % 3;
            if ((y_[a] <= row + 0.5) == (y_[b] <= row + 0.5)) continue;
            // From the lower end, so that both neighbours compute the same.
            const std::size_t below = y_[a] < y_[b] ? a : b, above = y_[a] < y_[b] ? b : a;
            const double x = x_[below] + (row + 0.5 - y_[below]) * (x_[above] - x_[below]) /
                                             (y_[above] - y_[below]);
            from = std::min(from, x);
            to = std::max(to, x);
        }
        if (!(from < to)) return {0, 0};
        from = std::clamp(from, -1.0, width_px + 1.0);
        to = std::clamp(to, -1.0, width_px + 1.0);
        return {std::max(0, static_cast<int>(std::ceil(from - 0.5))),
                std::min(width_px, static_cast<int>(std::ceil(to - 0.5)))};
    }

   private:
    double x_[3], y_[3], ax_, ay_, bx_, by_, inverse_;
};

/// A rim over a triangle.
struct PlacedRim {
    const RimGroup* group = nullptr;
    Linear w;
    float per_ramp = 0.0F;  ///< 1 over the change of w along the picture's own rim

    /// Share of the pixel inside, as the picture has it.
    float covered(float at) const { return std::clamp(0.5F + at * per_ramp, 0.0F, 1.0F); }
};

PlacedRim placed(const RungMesh& mesh, const RimAt& rim, const Placed& triangle,
                 const RungCanvas& canvas) {
    PlacedRim result;
    result.group = &mesh.groups[rim.group];
    result.w = triangle.linear(rim.w);
    const float slope = std::abs(result.w.right) + std::abs(result.w.up);
    result.per_ramp =
        1.0F / std::max(slope * static_cast<float>(mesh.rim_px * canvas.size.scale), 1e-9F);
    return result;
}

void put(const RungCanvas& canvas, std::size_t pixel, float light, const RimColor& change) {
    canvas.irradiance[canvas.irradiance_step * pixel] += light * change[rim_channels - 1];
    if (canvas.rgb == nullptr) return;
    float* rgb = canvas.rgb + canvas.rgb_step * pixel;
    for (std::size_t c = 0; c < 3; ++c) rgb[c] += light * change[c];
}

/// The part of a row where one rim's profile and the picture's differ.
std::array<int, 2> within_reach(const PlacedRim& rim, float w, std::array<int, 2> columns) {
    const RimProfile& profile = rim.group->profile;
    const float ramp = 0.5F / rim.per_ramp;
    const float low = -std::max(profile.shadow, ramp), high = std::max(profile.light, ramp);
    if (std::abs(rim.w.right) < 1e-6F) {
        if (w < low || w > high) return {0, 0};
        return columns;
    }
    const float a = (low - w) / rim.w.right, b = (high - w) / rim.w.right;
    const float count = static_cast<float>(columns[1] - columns[0]);
    const float from = std::clamp(std::min(a, b), 0.0F, count);
    const float to = std::clamp(std::max(a, b) + 1.0F, 0.0F, count);
    return {columns[0] + static_cast<int>(from), columns[0] + static_cast<int>(std::ceil(to))};
}

/// Most pixels that fringes change lie at one rim alone.
void draw_one_rim(const RungMesh& mesh, const Placed& triangle, const PlacedRim& rim,
                  const Linear& light, const RungCanvas& canvas, int row,
                  std::array<int, 2> columns) {
    const auto [first, last] = within_reach(rim, triangle.at(rim.w, columns[0], row), columns);
    if (first >= last) return;
    const float w = triangle.at(rim.w, first, row), l = triangle.at(light, first, row);
    const std::size_t pixel = idx(row) * idx(canvas.size.width_px) + idx(first);
    for (int k = 0; k < last - first; ++k) {
        const auto step = static_cast<float>(k);
        const float at = w + step * rim.w.right;
        RimColor change = rim.group->profile.at(at);
        const float covered = rim.covered(at);
        for (std::size_t c = 0; c < rim_channels; ++c)
            change[c] = mesh.color[c] * (change[c] - covered);
        put(canvas, pixel + idx(k), l + step * light.right, change);
    }
}

/// Of a mask that is propagated: its light, in the ghost's colours.
RimColor masked_color(const RungMesh& mesh, float u, float v) {
    RimColor color{};
    for (std::size_t p = 0; p < mesh.masks->size(); ++p) {
        const auto irradiance =
            static_cast<float>((*mesh.masks)[p].at(static_cast<double>(u), static_cast<double>(v)));
        for (std::size_t c = 0; c < rim_channels; ++c)
            color[c] += mesh.mask_shares[p][c] * irradiance;
    }
    return color;
}

}  // namespace

RungCanvas canvas_of(std::vector<float>& values, int channels, const RasterSize& size) {
    RungCanvas canvas;
    canvas.size = size;
    canvas.irradiance = values.data() + channels - 1;
    canvas.irradiance_step = idx(channels);
    if (channels == rim_channels) {
        canvas.rgb = values.data();
        canvas.rgb_step = rim_channels;
    }
    return canvas;
}

std::vector<std::vector<std::uint32_t>> sorted_by_band(const RungMesh& mesh, const RasterSize& size,
                                                       int band_rows) {
    std::vector<std::vector<std::uint32_t>> bands(
        idx((size.height_px + band_rows - 1) / band_rows));
    const double most = size.height_px - 0.5;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& row = mesh.triangles[t].row;
        const auto [low, high] = std::minmax({row[0], row[1], row[2]});
        auto band_of = [&](float at) {
            const double own = static_cast<double>(at) * size.scale + size.margin_px;
            return static_cast<int>(std::clamp(own, 0.0, most)) / band_rows;
        };
        for (int b = band_of(low); b <= band_of(high); ++b) bands[idx(b)].push_back(t);
    }
    return bands;
}

void draw_rung(const RungMesh& mesh, std::span<const std::uint32_t> triangles,
               const RungCanvas& canvas, int first_row, int last_row) {
    std::vector<PlacedRim> rims;
    for (const std::uint32_t t : triangles) {
        const RungTriangle& own = mesh.triangles[t];
        const Placed triangle(own, canvas);
        if (triangle.is_thin()) continue;
        rims.clear();
        for (std::uint32_t r = 0; r < own.rim_count; ++r)
            rims.push_back(placed(mesh, mesh.rims[own.first_rim + r], triangle, canvas));
        const bool one_rim = mesh.masks == nullptr && rims.size() == 1;
        const Linear light = triangle.linear(own.light);
        const Linear u = triangle.linear(own.u), v = triangle.linear(own.v);
        const auto [low, high] = triangle.rows();
        for (int row = std::max(first_row, low); row < std::min(last_row, high); ++row) {
            const auto columns = triangle.columns(row, canvas.size.width_px);
            if (one_rim) {
                draw_one_rim(mesh, triangle, rims.front(), light, canvas, row, columns);
                continue;
            }
            for (int column = columns[0]; column < columns[1]; ++column) {
                RimColor change = mesh.color;
                if (mesh.masks != nullptr)
                    change = masked_color(mesh, triangle.at(u, column, row),
                                          triangle.at(v, column, row));
                float covered = 1.0F;
                for (const PlacedRim& rim : rims) {
                    const float at = triangle.at(rim.w, column, row);
                    const float own_cover = rim.covered(at);
                    covered *= own_cover;
                    if (rim.group->kind == RimKind::fringed) {
                        const RimColor profile = rim.group->profile.at(at);
                        for (std::size_t c = 0; c < rim_channels; ++c) change[c] *= profile[c];
                    } else if (rim.group->kind == RimKind::sharp) {
                        for (std::size_t c = 0; c < rim_channels; ++c) change[c] *= own_cover;
                    }
                }
                for (std::size_t c = 0; c < rim_channels; ++c) change[c] -= mesh.color[c] * covered;
                put(canvas, idx(row) * idx(canvas.size.width_px) + idx(column),
                    triangle.at(light, column, row), change);
            }
        }
    }
}

}  // namespace ghostlight
