#include "core/flare/draw_rung.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/flare/rung_kernel.h"

namespace ghostlight {
namespace {

/// Below this area (twice, px²) a triangle has no middle of a pixel to speak of.
constexpr double thin_px2 = 1e-9;
/// Slower than this per pixel, w does not change along a row.
constexpr float least_step_w = 1e-6F;
/// A row no longer than this is drawn as it is: finding where nothing changes costs more.
constexpr int short_row_px = 8;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// Pixels of a row, the last not included.
struct Range {
    int first, last;
    bool empty() const { return first >= last; }
};

/// Where a value that is `a` at the first of them, and goes by 1/`per_step`, is above `least`, a
/// pixel more rather than one less; `per_step` 0: it stays.
Range where_above(float a, float per_step, float least, const Range& of) {
    if (per_step == 0.0F) return a > least ? of : Range{of.first, of.first};
    const auto at = static_cast<float>(of.first) + (least - a) * per_step;
    const int here = static_cast<int>(
        std::clamp(at, static_cast<float>(of.first) - 1.0F, static_cast<float>(of.last) + 1.0F));
    return per_step > 0.0F ? Range{std::max(of.first, here), of.last}
                           : Range{of.first, std::min(of.last, here + 1)};
}

/// The same, a pixel less rather than one more.
Range well_above(float a, float per_step, float least, const Range& of) {
    Range range = where_above(a, per_step, least, of);
    const bool from_first = a > least, to_last = range.last == of.last && range.first < of.last;
    if (per_step > 0.0F && !from_first) range.first += 2;
    if (per_step < 0.0F && !to_last) range.last -= 2;
    return range;
}

/// Values of a table for each step of a profile: read without interpolation, they are off by no
/// more than a quarter of a step's slope.
constexpr int finer = 2;

/// A profile's means over 2 · half_steps of its steps, what a pixel has that spans so many; from
/// half_steps before its first value to as many after its last.
std::vector<RimColor> means_of(const RimProfile& profile, int half_steps) {
    const int count = static_cast<int>(profile.values.size());
    const float step_w = 1.0F / profile.steps_per_w;
    const auto mean = [&](int k) {
        if (half_steps == 0) return profile.values[idx(k)];
        const int beyond = std::max(0, k - (count - 1));
        const RimColor& high = profile.below[idx(std::min(k, count - 1))];
        const RimColor& low = profile.below[idx(std::max(0, k - 2 * half_steps))];
        RimColor value;
        for (std::size_t c = 0; c < rim_channels; ++c)
            value[c] = (high[c] + static_cast<float>(beyond) * step_w - low[c]) /
                       (2.0F * static_cast<float>(half_steps) * step_w);
        return value;
    };
    const int last = count + 2 * half_steps - 1;
    std::vector<RimColor> means(idx(finer * last + 1));
    for (int k = 0; k <= last; ++k) means[idx(finer * k)] = mean(k);
    for (std::size_t k = 1; k + 1 < means.size(); k += finer)
        for (std::size_t c = 0; c < rim_channels; ++c)
            means[k][c] = 0.5F * (means[k - 1][c] + means[k + 1][c]);
    return means;
}

/// Of a mask that is propagated: its light, in the ghost's colours.
RimColor masked_color(const RungMesh& mesh, float u, float v) {
    RimColor color{};
    for (std::size_t p = 0; p < mesh.masks->size(); ++p) {
        const auto light =
            static_cast<float>((*mesh.masks)[p].at(static_cast<double>(u), static_cast<double>(v)));
        for (std::size_t c = 0; c < rim_channels; ++c) color[c] += mesh.mask_shares[p][c] * light;
    }
    return color;
}

/// A row's pixels as a kernel adds to them: where they lie side by side, in place.
class RowOf {
   public:
    RowOf(const RungCanvas& canvas, int row, int first) {
        const std::size_t pixel = idx(row) * idx(canvas.size.width_px) + idx(first);
        irradiance_ = canvas.irradiance + canvas.irradiance_step * pixel;
        irradiance_step_ = canvas.irradiance_step;
        if (canvas.rgb == nullptr) return;
        rgb_ = canvas.rgb + canvas.rgb_step * pixel;
        rgb_step_ = canvas.rgb_step;
        together_ = canvas.rgb_step == rim_channels;
    }
    float* begin(std::size_t count) {
        begun_ = true;
        if (together_) return rgb_;
        std::fill_n(apart_.begin(), count * rim_channels, 0.0F);
        return apart_.data();
    }
    /// Takes over what was added to `count` pixels, and goes on behind them.
    void end(std::size_t count) {
        for (std::size_t k = 0; begun_ && !together_ && k < count; ++k) {
            irradiance_[k * irradiance_step_] += apart_[rim_channels * k + rim_channels - 1];
            for (std::size_t c = 0; rgb_ != nullptr && c < 3; ++c)
                rgb_[k * rgb_step_ + c] += apart_[rim_channels * k + c];
        }
        irradiance_ += count * irradiance_step_;
        if (rgb_ != nullptr) rgb_ += count * rgb_step_;
        begun_ = false;
    }

   private:
    float *irradiance_ = nullptr, *rgb_ = nullptr;
    std::size_t irradiance_step_ = 1, rgb_step_ = 0;
    bool together_ = false, begun_ = false;
    std::array<float, rung_chunk * rim_channels> apart_;
};

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

RungDrawing::RungDrawing(const RungMesh& mesh, const RungCanvas& canvas, int band_rows)
    : mesh_(&mesh), canvas_(canvas), band_rows_(band_rows) {
    triangles_.reserve(mesh.triangles.size());
    rims_.reserve(mesh.rims.size());
    for (const RungTriangle& triangle : mesh.triangles) place(triangle);
    sort_by_band();
}

void RungDrawing::place(const RungTriangle& triangle) {
    double x[3], y[3];
    for (std::size_t n = 0; n < 3; ++n) {
        x[n] = static_cast<double>(triangle.column[n]) * canvas_.size.scale +
               canvas_.size.margin_px - canvas_.left_px;
        y[n] = static_cast<double>(triangle.row[n]) * canvas_.size.scale + canvas_.size.margin_px -
               canvas_.bottom_px;
    }
    const auto [low, high] = std::minmax({y[0], y[1], y[2]});
    Placed placed;
    // Rows whose middles are inside.
    const auto row_of = [&](double at) {
        return static_cast<int>(std::ceil(std::clamp(at, 0.0, canvas_.size.height_px + 1.0) - 0.5));
    };
    placed.first_row = row_of(low);
    placed.last_row = std::min(canvas_.size.height_px, row_of(high));
    const double a[2] = {x[1] - x[0], y[1] - y[0]}, b[2] = {x[2] - x[0], y[2] - y[0]};
    const double twice_px2 = a[0] * b[1] - a[1] * b[0];
    if (!(std::abs(twice_px2) > thin_px2) || placed.first_row >= placed.last_row) return;
    placed.x = x[0];
    placed.y = y[0];
    std::array<std::size_t, 3> up{0, 1, 2};
    std::ranges::sort(up, {}, [&](std::size_t n) { return y[n]; });
    const auto side = [&](std::size_t from, std::size_t to) {
        const double rise = y[to] - y[from];
        return Side{y[from], x[from], rise > 0.0 ? (x[to] - x[from]) / rise : 0.0};
    };
    placed.long_side = side(up[0], up[2]);
    placed.low_side = side(up[0], up[1]);
    placed.high_side = side(up[1], up[2]);
    placed.middle = y[up[1]];
    const double inverse = 1.0 / twice_px2;
    const auto linear = [&](const float(&at)[3]) {
        const double d1 = static_cast<double>(at[1] - at[0]);
        const double d2 = static_cast<double>(at[2] - at[0]);
        return Linear{at[0], static_cast<float>((d1 * b[1] - d2 * a[1]) * inverse),
                      static_cast<float>((d2 * a[0] - d1 * b[0]) * inverse)};
    };
    placed.light = linear(triangle.light);
    if (mesh_->masks != nullptr) {
        placed.u = linear(triangle.u);
        placed.v = linear(triangle.v);
    }
    placed.first_rim = static_cast<std::uint32_t>(rims_.size());
    placed.rim_count = triangle.rim_count;
    for (std::uint32_t r = 0; r < placed.rim_count; ++r) {
        const RimAt& at = mesh_->rims[triangle.first_rim + r];
        rims_.push_back(rim_of(at.group, linear(at.w)));
    }
    triangles_.push_back(placed);
}

RungDrawing::Rim RungDrawing::rim_of(std::uint32_t group, const Linear& w) {
    const RimProfile& profile = mesh_->groups[group].profile;
    Rim rim;
    rim.group = group;
    rim.kind = mesh_->groups[group].kind;
    rim.w = w;
    const float slope = std::abs(w.right) + std::abs(w.up);
    rim.per_ramp =
        1.0F / std::max(slope * static_cast<float>(mesh_->rim_px * canvas_.size.scale), 1e-9F);
    if (std::abs(w.right) >= least_step_w) rim.per_step = 1.0F / w.right;
    float half_w = 0.0F;
    if (rim.kind == RimKind::fringed) {
        // No pixel of a ghost spans more than its whole profile.
        const float span_w = std::sqrt(w.right * w.right + w.up * w.up);
        const auto most = static_cast<float>(profile.values.size());
        const int half_steps =
            static_cast<int>(std::min(0.5F * span_w * profile.steps_per_w + 0.5F, most));
        auto& table = tables_[{group, half_steps}];
        if (table.empty()) table = means_of(profile, half_steps);
        rim.table = &table;
        rim.first_step =
            finer * (profile.shadow * profile.steps_per_w + static_cast<float>(half_steps)) + 0.5F;
        half_w = static_cast<float>(half_steps) / profile.steps_per_w;
    }
    const float ramp = 0.5F / rim.per_ramp;
    rim.dark = std::max(profile.shadow + half_w, ramp);
    rim.light = std::max(profile.light + half_w, ramp);
    return rim;
}

void RungDrawing::sort_by_band() {
    const int bands = (canvas_.size.height_px + band_rows_ - 1) / band_rows_;
    first_of_band_.assign(idx(bands) + 1, 0);
    for (const Placed& triangle : triangles_)
        for (int b = triangle.first_row / band_rows_; b <= (triangle.last_row - 1) / band_rows_;
             ++b)
            ++first_of_band_[idx(b) + 1];
    for (std::size_t b = 1; b < first_of_band_.size(); ++b)
        first_of_band_[b] += first_of_band_[b - 1];
    by_band_.resize(first_of_band_.back());
    std::vector<std::uint32_t> next(first_of_band_.begin(), first_of_band_.end() - 1);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
        for (int b = triangles_[t].first_row / band_rows_;
             b <= (triangles_[t].last_row - 1) / band_rows_; ++b)
            by_band_[next[idx(b)]++] = t;
}

void RungDrawing::draw(int band) const {
    if (mesh_ == nullptr) return;
    const int from = band * band_rows_, to = from + band_rows_;
    std::vector<RungRimView> rims;
    for (std::uint32_t k = first_of_band_[idx(band)]; k < first_of_band_[idx(band) + 1]; ++k) {
        const Placed& triangle = triangles_[by_band_[k]];
        const int last_row = std::min(to, triangle.last_row);
        for (int row = std::max(from, triangle.first_row); row < last_row; ++row) {
            const double middle = row + 0.5;
            const double one = triangle.long_side.at(middle);
            const double other = middle < triangle.middle ? triangle.low_side.at(middle)
                                                          : triangle.high_side.at(middle);
            const double left = std::min(one, other), right = std::max(one, other);
            // Half open, so that neighbours share no pixel.
            const double most = canvas_.size.width_px + 1.0;
            const int first = static_cast<int>(std::ceil(std::clamp(left, 0.0, most) - 0.5));
            const int last = static_cast<int>(std::ceil(std::clamp(right, 0.0, most) - 0.5));
            draw_row(triangle, row, first, std::min(last, canvas_.size.width_px), rims);
        }
    }
}

void RungDrawing::draw_row(const Placed& triangle, int row, int first, int last,
                           std::vector<RungRimView>& rims) const {
    if (last - first <= short_row_px) {
        draw_piece(triangle, row, first, last, rims);
        return;
    }
    Range bright{first, last}, lit{first, last};
    const auto right = static_cast<float>(first + 0.5 - triangle.x);
    const auto up = static_cast<float>(row + 0.5 - triangle.y);
    for (std::uint32_t r = 0; r < triangle.rim_count; ++r) {
        const Rim& rim = rims_[triangle.first_rim + r];
        const float w = rim.w.first + rim.w.right * right + rim.w.up * up;
        const Range all{first, last};
        if (rim.kind != RimKind::masked) {
            const Range own = where_above(w, rim.per_step, -rim.dark, all);
            bright = {std::max(bright.first, own.first), std::min(bright.last, own.last)};
        }
        const Range own = well_above(w, rim.per_step, rim.light, all);
        lit = {std::max(lit.first, own.first), std::min(lit.last, own.last)};
    }
    if (mesh_->masks != nullptr || lit.empty()) {
        draw_piece(triangle, row, bright.first, bright.last, rims);
        return;
    }
    draw_piece(triangle, row, bright.first, std::min(bright.last, lit.first), rims);
    draw_piece(triangle, row, std::max(bright.first, lit.last), bright.last, rims);
}

void RungDrawing::draw_piece(const Placed& triangle, int row, int first, int last,
                             std::vector<RungRimView>& rims) const {
    if (first >= last) return;
    const auto up = static_cast<float>(row + 0.5 - triangle.y);
    RowOf pixels(canvas_, row, first);
    std::array<float, rung_chunk * rim_channels> mask;
    for (int at = first; at < last;) {
        const int count = std::min(last - at, static_cast<int>(rung_chunk));
        const auto right = static_cast<float>(at + 0.5 - triangle.x);
        const auto value = [&](const Linear& of) {
            return of.first + of.right * right + of.up * up;
        };
        RungRowView view{};
        rims.clear();
        for (std::uint32_t r = 0; r < triangle.rim_count; ++r) {
            const Rim& rim = rims_[triangle.first_rim + r];
            const float w = value(rim.w), w_end = w + static_cast<float>(count - 1) * rim.w.right;
            // Light all along: nothing changes by it.
            if (w >= rim.light && w_end >= rim.light) continue;
            RungRimView& own = rims.emplace_back(
                RungRimView{nullptr, 0.0F, 0.0F, 0.0F, 0.5F + w * rim.per_ramp,
                            rim.w.right * rim.per_ramp, rim.kind == RimKind::sharp});
            if (rim.table == nullptr) continue;
            const float per_w = finer * mesh_->groups[rim.group].profile.steps_per_w;
            own.profile = rim.table->front().data();
            own.place = rim.first_step + w * per_w;
            own.place_step = rim.w.right * per_w;
            own.last = static_cast<float>(rim.table->size()) - 0.5F;
        }
        view.rims = rims.data();
        view.rim_count = rims.size();
        view.light = value(triangle.light);
        view.light_step = triangle.light.right;
        view.color = mesh_->color.data();
        view.count = idx(count);
        if (mesh_->masks != nullptr) {
            for (int k = 0; k < count; ++k) {
                const auto along = static_cast<float>(k);
                const RimColor color =
                    masked_color(*mesh_, value(triangle.u) + along * triangle.u.right,
                                 value(triangle.v) + along * triangle.v.right);
                std::ranges::copy(color, mask.begin() + rim_channels * k);
            }
            view.mask = mask.data();
        }
        if (view.rim_count > 0 || view.mask != nullptr) {
            view.pixels = pixels.begin(view.count);
            GHOSTLIGHT_DISPATCH(add_fringes, view);
        }
        pixels.end(view.count);
        at += count;
    }
}

}  // namespace ghostlight
