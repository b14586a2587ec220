#include "core/flare/rim_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/flare/fresnel.h"

namespace ghostlight {
namespace {

constexpr double pi = std::numbers::pi;
/// How far the profile is followed into the light before the taper ends, in Fresnel's w. Colours
/// have run into one another by then; of one wavelength more of it shows.
constexpr double into_light = 6.0, into_light_gray = 14.0;
/// Fringes finer than a pixel lie beyond w = 2 × pixels per w.
constexpr double finest_fringe_px = 1.0;
constexpr double tapered_share = 0.35;  ///< of the depth in the light

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// straight_edge() over w, read often.
class EdgeTable {
   public:
    EdgeTable() {
        for (int k = 0; k <= count; ++k) values_.push_back(straight_edge(first + k * step));
    }
    double at(double w) const {
        const double place = (w - first) / step;
        if (place <= 0.0) return 0.0;
        if (place >= count) return 1.0;
        const int k = static_cast<int>(place);
        return std::lerp(values_[idx(k)], values_[idx(k) + 1], place - k);
    }

   private:
    static constexpr double first = -4.0, step = 0.01;
    static constexpr int count = 2400;  // up to w = 20
    std::vector<double> values_;
};
const EdgeTable& edge_table() {
    static const EdgeTable table;
    return table;
}

}  // namespace

RimColor EdgeChange::at(double depth) const {
    const double place = (depth + shadow) / (shadow + light) * steps;
    if (place <= 0.0) return RimColor{};
    if (place >= steps) return RimColor{1.0F, 1.0F, 1.0F, 1.0F};
    const int k = static_cast<int>(place);
    const auto part = static_cast<float>(place - k);
    RimColor value;
    for (std::size_t c = 0; c < rim_channels; ++c)
        value[c] = profile[idx(k)][c] + part * (profile[idx(k) + 1][c] - profile[idx(k)][c]);
    return value;
}

ColorShares color_shares(const FlareScene& scene, const std::vector<double>& spectrum) {
    ColorShares shares(scene.samples.size());
    double whole = 0.0;
    for (std::size_t w = 0; w < shares.size(); ++w) whole += scene.samples[w].weight * spectrum[w];
    for (std::size_t w = 0; w < shares.size(); ++w) {
        const double part = whole > 0.0 ? scene.samples[w].weight * spectrum[w] / whole : 0.0;
        const bool gray = scene.is_gray();
        shares[w] = {part * (gray ? 1.0 : scene.colors[w].r),
                     part * (gray ? 1.0 : scene.colors[w].g),
                     part * (gray ? 1.0 : scene.colors[w].b), part};
    }
    return shares;
}

EdgeChange edge_change(const FlareScene& scene, const ColorShares& shares, double fresnel_number,
                       double px_per_w, bool round) {
    const double main_nm = scene.system().wavelength_nm;
    const double per_depth = std::sqrt(2.0 * fresnel_number);
    EdgeChange change;
    change.shadow = into_shadow / per_depth;
    const double most = scene.is_gray() ? into_light_gray : into_light;
    change.light = std::min(0.9, std::min(most, 2.0 * px_per_w / finest_fringe_px) / per_depth);
    change.profile.resize(EdgeChange::steps + 1);
    const double step = (change.shadow + change.light) / EdgeChange::steps;
    std::array<double, rim_channels> sum{}, room{}, whole{};
    std::vector<double> scales;
    for (std::size_t w = 0; w < shares.size(); ++w) {
        scales.push_back(std::sqrt(main_nm / scene.samples[w].wavelength_nm));
        for (std::size_t c = 0; c < rim_channels; ++c) whole[c] += shares[w][c];
    }
    auto taper = [&](double depth) {
        const double part = depth >= 0.0 ? (change.light - depth) / (tapered_share * change.light)
                                         : (change.shadow + depth) / (0.5 * change.shadow);
        const double t = std::clamp(part, 0.0, 1.0);
        return t * t * (3.0 - 2.0 * t);
    };
    // A bump in the light takes what keeps the sum at zero; a rim that is round has less of each
    // depth than of the one before.
    auto bump = [&](double depth) {
        const double t = std::clamp(depth / change.light, 0.0, 1.0);
        return t * t * (1.0 - t) * (1.0 - t);
    };
    for (int k = 0; k <= EdgeChange::steps; ++k) {
        const double depth = k * step - change.shadow;
        const double kept = taper(depth), length = round ? 1.0 - depth : 1.0;
        const double lit = depth > 0.0 ? 1.0 : 0.0;
        std::array<double, rim_channels> values{};
        for (std::size_t w = 0; w < shares.size(); ++w) {
            const double step_of_w = edge_table().at(depth * per_depth * scales[w]) - lit;
            for (std::size_t c = 0; c < rim_channels; ++c) values[c] += shares[w][c] * step_of_w;
        }
        for (std::size_t c = 0; c < rim_channels; ++c) {
            const double changed = whole[c] != 0.0 ? kept * values[c] / whole[c] : 0.0;
            change.profile[idx(k)][c] = static_cast<float>(lit + changed);
            sum[c] += changed * length;
            room[c] += bump(depth) * length;
        }
    }
    for (int k = 0; k <= EdgeChange::steps; ++k) {
        const double depth = k * step - change.shadow;
        for (std::size_t c = 0; c < rim_channels; ++c)
            change.profile[idx(k)][c] -= static_cast<float>(bump(depth) * sum[c] / room[c]);
    }
    return change;
}

std::vector<EdgeLine> edge_lines(const StopMask& stop) {
    if (stop.blades < 3) return {EdgeLine{}};
    std::vector<EdgeLine> lines;
    const double half = pi / stop.blades;
    for (int edge = 0; edge < stop.blades; ++edge) {
        const double middle = stop.rotation_rad + half * (2 * edge + 1);
        EdgeLine line{std::cos(middle), std::sin(middle), std::cos(half), 0.0, 1.0, true};
        if (stop.blade_curvature > 0.0) {
            line.is_straight = false;
            line.radius = 1.0 / stop.blade_curvature;
            line.back =
                std::sqrt(line.radius * line.radius - std::pow(std::sin(half), 2)) - std::cos(half);
        }
        lines.push_back(line);
    }
    return lines;
}

EdgeDepth edge_at(const EdgeLine& line, double u, double v) {
    if (line.is_straight) return {line.distance - u * line.nx - v * line.ny, -line.nx, -line.ny};
    const double x = u + line.back * line.nx, y = v + line.back * line.ny, r = std::hypot(x, y);
    return {line.radius - r, r > 0.0 ? -x / r : 0.0, r > 0.0 ? -y / r : 0.0};
}

}  // namespace ghostlight
