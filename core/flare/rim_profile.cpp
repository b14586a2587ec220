#include "core/flare/rim_profile.h"

#include <algorithm>
#include <cmath>

#include "core/flare/fresnel.h"

namespace ghostlight {
namespace {

/// How far the profile is followed into the light before the taper ends, in Fresnel's w. Colours
/// have run into one another by then (what is left of white light's fringes is below 2 % of the
/// light); of one wavelength more of it shows.
constexpr double most_into_light = 3.6, into_light_gray = 14.0;
/// Fringes finer than a pixel lie beyond w = 2 × pixels per w.
constexpr double finest_fringe_px = 1.0;
constexpr double tapered_share = 0.35;  ///< of the depth in the light
/// A fringe at w is 2/w wide: at least six steps, but for one wavelength's last.
constexpr double steps_per_w = 40.0;
constexpr int shadow_steps = static_cast<int>(into_shadow * steps_per_w + 0.5);
/// Pixels per w for which changes are known: from 1/2 up, by half octaves.
constexpr int px_octaves = 8;

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

EdgeFringes::EdgeFringes(const FlareScene& scene)
    : into_light_(scene.is_gray() ? into_light_gray : most_into_light),
      samples_(scene.samples.size()) {
    const double main_nm = scene.system().wavelength_nm;
    double whole = 0.0;
    for (const SpectralSample& sample : scene.samples) whole += sample.weight;
    const int steps = static_cast<int>(std::ceil(into_light_ * steps_per_w)) + shadow_steps;
    std::vector<double> white;  // the light's own
    for (int k = 0; k <= steps; ++k) {
        const double w = (k - shadow_steps) / steps_per_w, lit = w > 0.0 ? 1.0 : 0.0;
        double mean = lit;
        for (const SpectralSample& sample : scene.samples) {
            const double change =
                edge_table().at(w * std::sqrt(main_nm / sample.wavelength_nm)) - lit;
            changes_.push_back(static_cast<float>(change));
            if (whole > 0.0) mean += sample.weight / whole * change;
        }
        white.push_back(mean);
    }
    // A pixel's means by sums, beyond both ends with nothing and with all of the light.
    std::vector<double> below{0.0};
    for (std::size_t k = 1; k < white.size(); ++k)
        below.push_back(below.back() + 0.5 * (white[k - 1] + white[k]) / steps_per_w);
    const auto integral = [&](double w) {
        const double place = w * steps_per_w + shadow_steps;
        if (place <= 0.0) return 0.0;
        const double beyond = place - steps;
        if (beyond >= 0.0) return below.back() + beyond / steps_per_w;
        const auto k = static_cast<std::size_t>(place);
        return below[k] + (place - static_cast<double>(k)) * (below[k + 1] - below[k]);
    };
    for (int octave = 0; octave < 2 * px_octaves; ++octave) {
        const double half = 0.5 / std::exp2(0.5 * octave - 1.0);
        double changed = 0.0;
        for (int k = 0; k <= steps; ++k) {
            const double w = (k - shadow_steps) / steps_per_w;
            const double mean = (integral(w + half) - integral(w - half)) / (2.0 * half);
            const double sharp = std::clamp(0.5 + 0.5 * w / half, 0.0, 1.0);
            changed += std::abs(mean - sharp) / steps_per_w;
        }
        changed_w_.push_back(changed);
    }
}

double EdgeFringes::changed_w(double px_per_w) const {
    const double place =
        std::clamp(2.0 * (std::log2(std::max(px_per_w, 1e-9)) + 1.0), 0.0, 2.0 * px_octaves - 1.0);
    const auto k = std::min(static_cast<std::size_t>(place), changed_w_.size() - 2);
    return std::lerp(changed_w_[k], changed_w_[k + 1], place - static_cast<double>(k));
}

RimProfile rim_profile(const EdgeFringes& edge, const ColorShares& shares, double fresnel_number,
                       double px_per_w, bool round) {
    const double w_per_depth = std::sqrt(2.0 * fresnel_number);
    const double deepest =
        std::min({0.9 * w_per_depth, edge.into_light(), 2.0 * px_per_w / finest_fringe_px});
    const int lit_steps = std::max(2, static_cast<int>(deepest * steps_per_w));
    const int steps = shadow_steps + lit_steps;
    const double light = lit_steps / steps_per_w, shadow = into_shadow;
    RimProfile profile;
    profile.shadow = static_cast<float>(shadow);
    profile.light = static_cast<float>(light);
    profile.steps_per_w = static_cast<float>(steps_per_w);
    profile.values.resize(idx(steps) + 1);
    RimColor whole{};
    std::vector<RimColor> share(shares.size());
    for (std::size_t w = 0; w < shares.size(); ++w)
        for (std::size_t c = 0; c < rim_channels; ++c) {
            share[w][c] = static_cast<float>(shares[w][c]);
            whole[c] += share[w][c];
        }
    for (float& each : whole) each = each != 0.0F ? 1.0F / each : 0.0F;
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
    std::array<double, rim_channels> sum{};
    double room = 0.0;
    for (int k = 0; k <= steps; ++k) {
        const double at = (k - shadow_steps) / steps_per_w;
        const double length = round ? 1.0 - at / w_per_depth : 1.0;
        const float lit = at > 0.0 ? 1.0F : 0.0F, kept = static_cast<float>(taper(at));
        const float* change = edge.changes().data() + idx(k) * shares.size();
        RimColor value{};
        for (std::size_t w = 0; w < shares.size(); ++w)
            for (std::size_t c = 0; c < rim_channels; ++c) value[c] += share[w][c] * change[w];
        for (std::size_t c = 0; c < rim_channels; ++c) {
            value[c] *= kept * whole[c];
            sum[c] += static_cast<double>(value[c]) * length;
            value[c] += lit;
        }
        profile.values[idx(k)] = value;
        room += bump(at) * length;
    }
    for (int k = shadow_steps; k <= steps; ++k)
        for (std::size_t c = 0; c < rim_channels; ++c)
            profile.values[idx(k)][c] -=
                static_cast<float>(bump((k - shadow_steps) / steps_per_w) * sum[c] / room);
    profile.below.resize(profile.values.size());
    for (std::size_t k = 1; k < profile.values.size(); ++k)
        for (std::size_t c = 0; c < rim_channels; ++c)
            profile.below[k][c] =
                profile.below[k - 1][c] +
                0.5F * (profile.values[k - 1][c] + profile.values[k][c]) / profile.steps_per_w;
    return profile;
}

}  // namespace ghostlight
