#include "core/flare/glare_spread.h"

#include <cmath>
#include <numbers>

#include "core/flare/ghost_mesh.h"
#include "core/parallel.h"
#include "core/units.h"

namespace ghostlight {

double glare_per_e0(const GlareSpread& spread, double flux_mm2, double core_mm, double r_mm) {
    const double half = 0.5 * spread.exponent;
    const double peak = (half - 1.0) / (std::numbers::pi * core_mm * core_mm);
    return spread.share * flux_mm2 * peak *
           std::pow(1.0 + r_mm * r_mm / (core_mm * core_mm), -half);
}

void add_glare_spread(const GlareSpread& spread, const std::array<double, 4>& flux_mm2, double x_mm,
                      double y_mm, double efl_mm, unsigned threads, FlareImage& image) {
    const PixelFrame frame =
        pixel_frame(image.sensor_width_mm, image.sensor_height_mm, image.width_px);
    const double core_mm =
        std::max(1e-6, std::abs(efl_mm) * std::tan(rad_from_deg(spread.core_deg)));
    /// Within so many cores the profile bends within a pixel.
    constexpr double near_cores = 4.0;
    constexpr int parts = 8;
    const double near_mm = near_cores * core_mm + frame.pitch_mm;
    const auto width = static_cast<std::size_t>(image.width_px);
    parallel_for(static_cast<std::size_t>(image.height_px), threads, {}, [&](std::size_t row) {
        for (std::size_t column = 0; column < width; ++column) {
            const double x =
                frame.left_mm + (static_cast<double>(column) + 0.5) * frame.pitch_mm - x_mm;
            const double y =
                frame.bottom_mm + (static_cast<double>(row) + 0.5) * frame.pitch_mm - y_mm;
            double value = 0.0;
            if (x * x + y * y > near_mm * near_mm) {
                value = glare_per_e0(spread, 1.0, core_mm, std::hypot(x, y));
            } else {
                for (int q = 0; q < parts; ++q)
                    for (int p = 0; p < parts; ++p)
                        value += glare_per_e0(
                            spread, 1.0, core_mm,
                            std::hypot(x + ((p + 0.5) / parts - 0.5) * frame.pitch_mm,
                                       y + ((q + 0.5) / parts - 0.5) * frame.pitch_mm));
                value /= parts * parts;
            }
            const std::size_t i = row * width + column;
            for (std::size_t c = 0; c < 3; ++c)
                image.rgb[3 * i + c] += static_cast<float>(flux_mm2[c] * value);
            image.irradiance[i] += static_cast<float>(flux_mm2[3] * value);
        }
    });
}

}  // namespace ghostlight
