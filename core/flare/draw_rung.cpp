#include "core/flare/draw_rung.h"

#include <Eigen/Core>

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

using Color = Eigen::Array4f;

Color color_of(const RimColor& color) { return Eigen::Map<const Color>(color.data()); }

/// A row of a canvas from some pixel on.
class RowOf {
   public:
    RowOf(const RungCanvas& canvas, int row, int first)
        : rgb_step_(canvas.rgb == nullptr ? 0 : canvas.rgb_step),
          irradiance_step_(canvas.irradiance_step),
          is_together_(canvas.rgb_step == rim_channels && canvas.rgb != nullptr) {
        const std::size_t pixel = idx(row) * idx(canvas.size.width_px) + idx(first);
        rgb_ = canvas.rgb == nullptr ? nullptr : canvas.rgb + rgb_step_ * pixel;
        irradiance_ = canvas.irradiance + irradiance_step_ * pixel;
    }
    /// To the next pixel.
    void add(const Color& change) {
        if (is_together_) {
            Eigen::Map<Color> sum(rgb_);
            sum += change;
            rgb_ += rim_channels;
            return;
        }
        *irradiance_ += change[rim_channels - 1];
        irradiance_ += irradiance_step_;
        if (rgb_ == nullptr) return;
        for (int c = 0; c < 3; ++c) rgb_[c] += change[c];
        rgb_ += rgb_step_;
    }

    void skip() {
        irradiance_ += irradiance_step_;
        if (rgb_ != nullptr) rgb_ += rgb_step_;
    }

   private:
    std::size_t rgb_step_, irradiance_step_;
    bool is_together_;
    float *rgb_, *irradiance_;
};

/// A profile as pixels of a triangle have it.
class PixelProfile {
   public:
    explicit PixelProfile(const PlacedRim& rim)
        : profile_(rim.group->profile),
          half_(0.5F * std::sqrt(rim.w.right * rim.w.right + rim.w.up * rim.w.up)),
          most_(static_cast<float>(profile_.values.size() - 1) * 0.99999F) {}
    Color at(float w) const {
        if (half_ > fine_half_span) return color_of(profile_.mean(w, half_));
        const float place = std::clamp((w + profile_.shadow) * profile_.steps_per_w, 0.0F, most_);
        const int below = static_cast<int>(place);
        const Color low = color_of(profile_.values[idx(below)]);
        const Color high = color_of(profile_.values[idx(below) + 1]);
        return low + (place - static_cast<float>(below)) * (high - low);
    }

   private:
    /// Where a pixel spans no more of w than twice this, the profile at its middle is its mean.
    static constexpr float fine_half_span = 0.06F;
    const RimProfile& profile_;
    float half_, most_;
};

/// A rim along a row.
struct RowRim {
    RimKind kind;
    PixelProfile profile;
    float w, step, per_ramp;
    float dark_to, lit_from;  ///< w of pixels for which it is nothing or all, in the picture too
};

/// Most pixels that fringes change lie at one rim alone.
void draw_one_rim(const RungMesh& mesh, const Placed& triangle, const PlacedRim& rim,
                  const Linear& light, const RungCanvas& canvas, int row,
                  std::array<int, 2> columns) {
    const auto [first, last] = within_reach(rim, triangle.at(rim.w, columns[0], row), columns);
    if (first >= last) return;
    const float w = triangle.at(rim.w, first, row), l = triangle.at(light, first, row);
    const PixelProfile profile(rim);
    const Color color = color_of(mesh.color);
    RowOf pixels(canvas, row, first);
    for (int k = 0; k < last - first; ++k) {
        const auto step = static_cast<float>(k);
        const float at = w + step * rim.w.right;
        pixels.add(((l + step * light.right) * (profile.at(at) - rim.covered(at))) * color);
    }
}

/// Of a mask that is propagated: its light, in the ghost's colours.
Color masked_color(const RungMesh& mesh, float u, float v) {
    Color color = Color::Zero();
    for (std::size_t p = 0; p < mesh.masks->size(); ++p)
        color +=
            color_of(mesh.mask_shares[p]) *
            static_cast<float>((*mesh.masks)[p].at(static_cast<double>(u), static_cast<double>(v)));
    return color;
}

/// At a corner, or of a propagated mask: the product of the rims. `along`: a place to work in.
void draw_rims(const RungMesh& mesh, const Placed& triangle, const std::vector<PlacedRim>& rims,
               const RungTriangle& own, const RungCanvas& canvas, int row,
               std::array<int, 2> columns, std::vector<RowRim>& along) {
    if (columns[0] >= columns[1]) return;
    const Linear light = triangle.linear(own.light);
    const Linear u = triangle.linear(own.u), v = triangle.linear(own.v);
    const Color color = color_of(mesh.color);
    RowOf pixels(canvas, row, columns[0]);
    along.clear();
    for (const PlacedRim& rim : rims)
        along.push_back({rim.group->kind, PixelProfile(rim), triangle.at(rim.w, columns[0], row),
                         rim.w.right, rim.per_ramp,
                         -std::max(rim.group->profile.shadow, 0.5F / rim.per_ramp),
                         std::max(rim.group->profile.light, 0.5F / rim.per_ramp)});
    const float first_light = triangle.at(light, columns[0], row);
    for (int column = columns[0]; column < columns[1]; ++column) {
        const auto step = static_cast<float>(column - columns[0]);
        bool is_dark = false, is_lit = mesh.masks == nullptr;
        for (const RowRim& rim : along) {
            const float at = rim.w + step * rim.step;
            is_dark = is_dark || (rim.kind != RimKind::masked && at <= rim.dark_to);
            is_lit = is_lit && at >= rim.lit_from;
        }
        if (is_dark || is_lit) {
            pixels.skip();
            continue;
        }
        Color change = color;
        if (mesh.masks != nullptr)
            change = masked_color(mesh, triangle.at(u, column, row), triangle.at(v, column, row));
        float covered = 1.0F;
        for (const RowRim& rim : along) {
            const float at = rim.w + step * rim.step;
            if (at >= rim.lit_from) continue;
            const float own_cover = std::clamp(0.5F + at * rim.per_ramp, 0.0F, 1.0F);
            covered *= own_cover;
            if (rim.kind == RimKind::fringed)
                change *= rim.profile.at(at);
            else if (rim.kind == RimKind::sharp)
                change *= own_cover;
        }
        pixels.add((first_light + step * light.right) * (change - color * covered));
    }
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
    std::vector<RowRim> along;
    for (const std::uint32_t t : triangles) {
        const RungTriangle& own = mesh.triangles[t];
        const Placed triangle(own, canvas);
        if (triangle.is_thin()) continue;
        rims.clear();
        for (std::uint32_t r = 0; r < own.rim_count; ++r)
            rims.push_back(placed(mesh, mesh.rims[own.first_rim + r], triangle, canvas));
        const bool one_rim = mesh.masks == nullptr && rims.size() == 1;
        const Linear light = triangle.linear(own.light);
        const auto [low, high] = triangle.rows();
        for (int row = std::max(first_row, low); row < std::min(last_row, high); ++row) {
            const auto columns = triangle.columns(row, canvas.size.width_px);
            if (one_rim)
                draw_one_rim(mesh, triangle, rims.front(), light, canvas, row, columns);
            else
                draw_rims(mesh, triangle, rims, own, canvas, row, columns, along);
        }
    }
}

}  // namespace ghostlight
