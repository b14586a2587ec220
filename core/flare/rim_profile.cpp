#include "core/flare/rim_profile.h"

#include <algorithm>
#include <cmath>

#include "core/flare/fresnel.h"

namespace ghostlight {
namespace {

/// How far the profile is followed into the light before the taper ends, in Fresnel's w. Colours
/// have run into one another by then (what is left of white light's fringes is below 2 % of the
/// light); of one wavelength more of it shows.
constexpr double into_light = 3.6, into_light_gray = 14.0;
/// Fringes finer than a pixel lie beyond w = 2 × pixels per w.
constexpr double finest_fringe_px = 1.0;
constexpr double tapered_share = 0.35;  ///< of the depth in the light
/// A fringe at w is 2/w wide: at least six steps, but for one wavelength's last.
constexpr double steps_per_w = 40.0;

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
        const double low = values_[idx(k)], high = values_[idx(k) + 1];
        return low + (place - k) * (high - low);
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

RimProfile rim_profile(const FlareScene& scene, const ColorShares& shares, double fresnel_number,
                       double px_per_w, bool round) {
    const double main_nm = scene.system().wavelength_nm;
    const double w_per_depth = std::sqrt(2.0 * fresnel_number);
    const double most = scene.is_gray() ? into_light_gray : into_light;
    const double light = std::min({0.9 * w_per_depth, most, 2.0 * px_per_w / finest_fringe_px});
    const double shadow = into_shadow;
    RimProfile profile;
    const int steps = static_cast<int>(std::ceil((shadow + light) * steps_per_w));
    const double step = (shadow + light) / steps;
    profile.shadow = static_cast<float>(shadow);
    profile.light = static_cast<float>(light);
    profile.steps_per_w = static_cast<float>(1.0 / step);
    profile.values.resize(idx(steps) + 1);
    std::array<double, rim_channels> sum{}, room{}, whole{};
    std::vector<double> scales;
    for (std::size_t w = 0; w < shares.size(); ++w) {
        scales.push_back(std::sqrt(main_nm / scene.samples[w].wavelength_nm));
        for (std::size_t c = 0; c < rim_channels; ++c) whole[c] += shares[w][c];
    }
    auto taper = [&](double w) {
        const double part =
            w >= 0.0 ? (light - w) / (tapered_share * light) : (shadow + w) / (0.5 * shadow);
        const double t = std::clamp(part, 0.0, 1.0);
        return t * t * (3.0 - 2.0 * t);
    };
    // A bump in the light takes what keeps the sum at zero; a rim that is round has less of each
    // depth than of the one before.
    auto bump = [&](double w) {
        const double t = std::clamp(w / light, 0.0, 1.0);
        return t * t * (1.0 - t) * (1.0 - t);
    };
    for (int k = 0; k <= steps; ++k) {
        const double at = k * step - shadow;
        const double kept = taper(at), length = round ? 1.0 - at / w_per_depth : 1.0;
        const double lit = at > 0.0 ? 1.0 : 0.0;
        std::array<double, rim_channels> values{};
        for (std::size_t w = 0; w < shares.size(); ++w) {
            const double change = edge_table().at(at * scales[w]) - lit;
            for (std::size_t c = 0; c < rim_channels; ++c) values[c] += shares[w][c] * change;
        }
        for (std::size_t c = 0; c < rim_channels; ++c) {
            const double changed = whole[c] != 0.0 ? kept * values[c] / whole[c] : 0.0;
            profile.values[idx(k)][c] = static_cast<float>(lit + changed);
            sum[c] += changed * length;
            room[c] += bump(at) * length;
        }
    }
    for (int k = 0; k <= steps; ++k)
        for (std::size_t c = 0; c < rim_channels; ++c)
            profile.values[idx(k)][c] -=
                static_cast<float>(bump(k * step - shadow) * sum[c] / room[c]);
    profile.below.resize(profile.values.size());
    for (std::size_t k = 1; k < profile.values.size(); ++k)
        for (std::size_t c = 0; c < rim_channels; ++c)
            profile.below[k][c] =
                profile.below[k - 1][c] +
                0.5F * (profile.values[k - 1][c] + profile.values[k][c]) / profile.steps_per_w;
    return profile;
}

}  // namespace ghostlight
