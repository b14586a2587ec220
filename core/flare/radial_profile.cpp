#include "core/flare/radial_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/flare/color_raster.h"

namespace ghostlight {
namespace {

constexpr int bins_per_px = 16;
constexpr double bin_px = 1.0 / bins_per_px;
constexpr double pi = std::numbers::pi;
/// A ring thinner than this has no usable area, px².
constexpr double least_area_px2 = 1e-9;
/// Nearer to the axis arcs are too bent for pixels' means along the radius, px.
constexpr int near_px = 5;
constexpr int near_angles = 512;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }
double bin_area_px2(std::size_t bin) {
    return pi * bin_px * bin_px * (2.0 * static_cast<double>(bin) + 1.0);
}

/// Shares of a triangle of half-breadth 1/√2 px in bins about its middle bin.
std::vector<double> triangle_shares() {
    constexpr double half = std::numbers::sqrt2 / 2.0 * bins_per_px;
    // The integral of the triangle up to x.
    const auto up_to = [](double x) {
        const double t = std::clamp(x / half, -1.0, 1.0);
        return 0.5 + t - 0.5 * t * std::abs(t);
    };
    std::vector<double> shares;
    const int reach = static_cast<int>(std::ceil(half));
    for (int k = -reach; k <= reach; ++k) shares.push_back(up_to(k + 0.5) - up_to(k - 0.5));
    return shares;
}

}  // namespace

template <int C>
RadialProfile<C>::RadialProfile(const PixelFrame& frame)
    : frame_(frame), reach_px_(0.5 * std::hypot(frame.width_px, frame.height_px) + 1.0) {
    const auto bins = static_cast<std::size_t>(std::ceil(reach_px_ * bins_per_px));
    now_.assign(bins * C, 0.0);
    level_.assign((bins + 1) * C, 0.0);
}

template <int C>
void RadialProfile<C>::step(double radius_px, const std::array<double, C>& value) {
    if (!(radius_px < reach_px_)) return;
    const std::size_t bins = now_.size() / C;
    const std::size_t bin = std::min(static_cast<std::size_t>(radius_px * bins_per_px), bins - 1);
    const double end = static_cast<double>(bin + 1) * bin_px;
    const double area = pi * std::max(0.0, end * end - radius_px * radius_px);
    for (std::size_t c = 0; c < C; ++c) {
        now_[bin * C + c] += area * value[c];
        level_[(bin + 1) * C + c] += value[c];
    }
}

template <int C>
void RadialProfile<C>::add(double radius_px, double other_px, const std::array<double, C>& flux) {
    const double low = std::min(radius_px, other_px), high = std::max(radius_px, other_px);
    const double area = pi * (high * high - low * low);
    if (area < least_area_px2) {
        if (!(high < reach_px_)) return;
        const std::size_t bin =
            std::min(static_cast<std::size_t>(high * bins_per_px), now_.size() / C - 1);
        for (std::size_t c = 0; c < C; ++c) now_[bin * C + c] += flux[c];
        return;
    }
    std::array<double, C> value;
    for (std::size_t c = 0; c < C; ++c) value[c] = flux[c] / area;
    step(low, value);
    for (double& v : value) v = -v;
    step(high, value);
}

template <int C>
void RadialProfile<C>::add(const RadialProfile& other) {
    for (std::size_t k = 0; k < now_.size(); ++k) now_[k] += other.now_[k];
    for (std::size_t k = 0; k < level_.size(); ++k) level_[k] += other.level_[k];
}

template <int C>
typename RadialProfile<C>::Filtered RadialProfile<C>::filtered() const {
    const std::size_t bins = now_.size() / C;
    std::vector<double> flux(now_.size()), density(now_.size());
    std::array<double, C> level{};
    for (std::size_t b = 0; b < bins; ++b)
        for (std::size_t c = 0; c < C; ++c) {
            level[c] += level_[b * C + c];
            flux[b * C + c] = now_[b * C + c] + level[c] * bin_area_px2(b);
            density[b * C + c] = flux[b * C + c] / bin_area_px2(b);
        }
    Filtered result;
    result.frame = frame_;
    result.box.assign(now_.size(), 0.0F);
    result.triangle.assign(now_.size(), 0.0F);
    const std::vector<double> triangle = triangle_shares();
    const int reach = static_cast<int>(triangle.size()) / 2;
    const auto at = [&](int bin, std::size_t c) {
        // Beyond the axis the other side lies.
        const int there = bin < 0 ? -1 - bin : std::min(bin, static_cast<int>(bins) - 1);
        return density[idx(there) * C + c];
    };
    for (int b = 0; b < static_cast<int>(bins); ++b)
        for (std::size_t c = 0; c < C; ++c) {
            // Of a box about the bin's middle: half a bin at either end.
            double box = 0.5 * (at(b - bins_per_px / 2, c) + at(b + bins_per_px / 2, c));
            for (int k = 1 - bins_per_px / 2; k < bins_per_px / 2; ++k) box += at(b + k, c);
            double along = 0.0;
            for (int k = -reach; k <= reach; ++k) along += triangle[idx(k + reach)] * at(b + k, c);
            result.box[idx(b) * C + c] = static_cast<float>(box * bin_px);
            result.triangle[idx(b) * C + c] = static_cast<float>(along);
        }

    const double middle_x = -frame_.left_mm / frame_.pitch_mm;
    const double middle_y = -frame_.bottom_mm / frame_.pitch_mm;
    result.near_px = near_px;
    result.near.assign(idx(4 * near_px * near_px) * C, 0.0F);
    std::vector<double> sums(result.near.size(), 0.0);
    const int left = static_cast<int>(std::floor(middle_x)) - near_px;
    const int bottom = static_cast<int>(std::floor(middle_y)) - near_px;
    for (int b = 0; b < std::min(static_cast<int>(bins), 2 * near_px * bins_per_px); ++b)
        for (int k = 0; k < near_angles; ++k) {
            const double turn = 2.0 * pi * (k + 0.5) / near_angles, r = (b + 0.5) * bin_px;
            const int i = static_cast<int>(std::floor(middle_x + r * std::cos(turn))) - left;
            const int j = static_cast<int>(std::floor(middle_y + r * std::sin(turn))) - bottom;
            if (i < 0 || j < 0 || i >= 2 * near_px || j >= 2 * near_px) continue;
            for (std::size_t c = 0; c < C; ++c)
                sums[idx(j * 2 * near_px + i) * C + c] += flux[idx(b) * C + c] / near_angles;
        }
    std::ranges::transform(sums, result.near.begin(),
                           [](double sum) { return static_cast<float>(sum); });
    return result;
}

template <int C>
void RadialProfile<C>::Filtered::draw_row(int row, std::span<float> pixels) const {
    const double middle_x = -frame.left_mm / frame.pitch_mm;
    const double middle_y = -frame.bottom_mm / frame.pitch_mm;
    const int left = static_cast<int>(std::floor(middle_x)) - near_px;
    const int bottom = static_cast<int>(std::floor(middle_y)) - near_px;
    const auto y = static_cast<float>(row + 0.5 - middle_y);
    const auto last = static_cast<int>(box.size() / C) - 2;
    for (int i = 0; i * C < static_cast<int>(pixels.size()); ++i) {
        float* to = pixels.data() + i * C;
        const auto x = static_cast<float>(i + 0.5 - middle_x);
        const float r2 = x * x + y * y;
        if (row >= bottom && row < bottom + 2 * near_px && i >= left && i < left + 2 * near_px) {
            const float* from = near.data() + ((row - bottom) * 2 * near_px + i - left) * C;
            std::copy_n(from, C, to);
            continue;
        }
        const float r = std::sqrt(r2);
        const float place = (r + 1.0F / (24.0F * r)) * bins_per_px - 0.5F;
        const int bin = std::clamp(static_cast<int>(place), 0, last);
        const float share = std::clamp(place - static_cast<float>(bin), 0.0F, 1.0F);
        const float turned = 2.0F * x * y / r2, diagonal = turned * turned;
        const float *b = box.data() + bin * C, *t = triangle.data() + bin * C;
        for (int c = 0; c < C; ++c) {
            const float along_box = b[c] + share * (b[C + c] - b[c]);
            const float along_triangle = t[c] + share * (t[C + c] - t[c]);
            to[c] = along_box + diagonal * (along_triangle - along_box);
        }
    }
}

template class RadialProfile<gray_channels>;
template class RadialProfile<color_channels>;

}  // namespace ghostlight
