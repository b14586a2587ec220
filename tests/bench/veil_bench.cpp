// The veil: its cost against the number of ghosts, beside summing their Gaussians at the same
// points. One thread.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/elapsed.h"
#include "core/flare/picture_levels.h"
#include "core/flare/veil_picture.h"

namespace ghostlight::bench {
namespace {

constexpr int width_px = 1280, height_px = 720;
constexpr double width_mm = 36.0, height_mm = 36.0 * height_px / width_px;
constexpr int repetitions = 15;

std::vector<GhostSpot> made(int count) {
    std::mt19937_64 random(1);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 11) * 0x1.0p-53;
    };
    std::vector<GhostSpot> ghosts;
    for (int k = 0; k < count; ++k) {
        GhostSpot ghost;
        const double flux = between(0.0, 1.0);
        ghost.flux_mm2 = {flux, 0.9 * flux, 0.8 * flux, flux};
        ghost.x_mm = between(-16.0, 16.0);
        ghost.y_mm = between(-9.0, 9.0);
        ghost.xx_mm2 = std::pow(between(2.0, 6.0), 2);
        ghost.yy_mm2 = std::pow(between(2.0, 6.0), 2);
        ghost.xy_mm2 = 0.3 * std::sqrt(ghost.xx_mm2 * ghost.yy_mm2);
        ghosts.push_back(ghost);
    }
    return ghosts;
}

template <class Work>
double least_ms(Work work) {
    double least = 1e300;
    for (int k = 0; k < repetitions; ++k) {
        const auto began = Clock::now();
        work();
        least = std::min(least, ms_since(began));
    }
    return least;
}

/// Every ghost's Gaussian at every point of a grid, in four channels.
std::vector<float> direct(const std::vector<GhostSpot>& ghosts, const std::vector<double>& x_mm,
                          const std::vector<double>& y_mm) {
    std::vector<float> values(x_mm.size() * y_mm.size() * 4, 0.0F);
    for (const GhostSpot& ghost : ghosts) {
        const double det = ghost.xx_mm2 * ghost.yy_mm2 - ghost.xy_mm2 * ghost.xy_mm2;
        const auto a = static_cast<float>(-0.5 * ghost.yy_mm2 / det);
        const auto b = static_cast<float>(ghost.xy_mm2 / det);
        const auto c = static_cast<float>(-0.5 * ghost.xx_mm2 / det);
        const double scale = 1.0 / (2.0 * std::numbers::pi * std::sqrt(det));
        float flux[4];
        for (std::size_t k = 0; k < 4; ++k) flux[k] = static_cast<float>(scale * ghost.flux_mm2[k]);
        float* to = values.data();
        for (const double y : y_mm)
            for (const double x : x_mm) {
                const auto dx = static_cast<float>(x - ghost.x_mm);
                const auto dy = static_cast<float>(y - ghost.y_mm);
                const float value = std::exp(a * dx * dx + b * dx * dy + c * dy * dy);
                for (std::size_t k = 0; k < 4; ++k) to[k] += flux[k] * value;
                to += 4;
            }
    }
    return values;
}

void print() {
    const PixelFrame frame = pixel_frame(width_mm, height_mm, width_px);
    constexpr double narrowest_mm = 2.0;
    const int level = veil_level(narrowest_mm, frame);
    const RasterSize coarse = level_size(frame, level);
    std::vector<double> x_mm, y_mm;
    for (int i = 0; i < coarse.width_px; ++i)
        x_mm.push_back(frame.left_mm + (i - 0.5) * frame.pitch_mm / coarse.scale);
    for (int j = 0; j < coarse.height_px; ++j)
        y_mm.push_back(frame.bottom_mm + (j - 0.5) * frame.pitch_mm / coarse.scale);
    fmt::print("{} x {}, evaluated at 1/{} of the size ({} x {} points); ms, least of {}\n",
               width_px, height_px, 1 << level, coarse.width_px, coarse.height_px, repetitions);
    fmt::print("{:>8}{:>8}{:>10}{:>12}{:>12}{:>14}{:>14}\n", "ghosts", "orders", "sum up",
               "evaluate", "directly", "whole picture", "two threads");
    FlareImage image;  // as a caller has it that draws frame after frame
    image.rgb.assign(3 * std::size_t{width_px} * height_px, 0.0F);
    image.irradiance.assign(std::size_t{width_px} * height_px, 0.0F);
    double evaluate_ms = 0.0, one_ms = 1e300;
    for (const int count : {5, 50, 200, 1000}) {
        const auto ghosts = made(count);
        const VeilSize size = veil_size(ghosts, width_mm, height_mm);
        VeilSeries series(size.period_mm, size.orders);
        const double add_ms = least_ms([&] {
            series = VeilSeries(size.period_mm, size.orders);
            for (const GhostSpot& ghost : ghosts) series.add(ghost, VeilKernel::gaussian);
        });
        std::vector<float> keep;
        evaluate_ms = least_ms([&] { keep = series.grid(x_mm, y_mm); });
        const double direct_ms = least_ms([&] { keep = direct(ghosts, x_mm, y_mm); });
        one_ms = std::min(one_ms, direct_ms / count);
        const double whole_ms = least_ms([&] { draw_veil(series, narrowest_mm, frame, 1, image); });
        const double both_ms = least_ms([&] { draw_veil(series, narrowest_mm, frame, 2, image); });
        fmt::print("{:>8}{:>8}{:>10.3f}{:>12.3f}{:>12.3f}{:>14.2f}{:>14.2f}\n", count, size.orders,
                   add_ms, evaluate_ms, direct_ms, whole_ms, both_ms);
    }
    fmt::print("break-even, once summed up: {:.0f} ghosts\n", evaluate_ms / one_ms);
}

}  // namespace
}  // namespace ghostlight::bench

int main() { ghostlight::bench::print(); }
