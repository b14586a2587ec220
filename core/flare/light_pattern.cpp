#include "core/flare/light_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/error.h"
#include "core/units.h"

namespace ghostlight {
namespace {

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

void normalise(LightPattern& pattern) {
    double sum = 0.0;
    for (const float share : pattern.shares) sum += static_cast<double>(share);
    for (float& share : pattern.shares) share = static_cast<float>(share / sum);
}

/// The travelling direction of a light, and unit vectors across it: where a camera that is held
/// upright sees right and up. It looks along −z; what it sees to the right travels to the left.
struct SeenFrame {
    glm::dvec3 d, right, up;
};
SeenFrame seen_frame(const LightDirection& light) {
    const glm::dvec3 d = beam_frame(light).direction;
    // Upright at the middle of the picture; across the beam everywhere.
    const glm::dvec3 right = glm::normalize(glm::dvec3(1.0, 0.0, 0.0) - d.x * d);
    return {d, right, glm::cross(d, right)};
}

}  // namespace

double LightPattern::radius_rad() const { return 0.5 * cell_rad * std::hypot(width, height); }

LightPattern disc_pattern(double diameter_deg) {
    constexpr int across = most_pattern_cells;
    constexpr int parts = 8;  // of a cell, each way
    LightPattern disc{across, across, rad_from_deg(diameter_deg) / across, {}};
    disc.shares.assign(idx(across * across), 0.0F);
    for (int j = 0; j < across * parts; ++j)
        for (int i = 0; i < across * parts; ++i) {
            const double x = (i + 0.5) / (0.5 * across * parts) - 1.0;
            const double y = (j + 0.5) / (0.5 * across * parts) - 1.0;
            if (x * x + y * y <= 1.0) disc.shares[idx(j / parts * across + i / parts)] += 1.0F;
        }
    normalise(disc);
    return disc;
}

LightPattern picture_pattern(const std::vector<float>& luminance, int width, int height,
                             double width_deg) {
    const int step =
        std::max(1, (std::max(width, height) + most_pattern_cells - 1) / most_pattern_cells);
    LightPattern pattern{(width + step - 1) / step,
                         (height + step - 1) / step,
                         rad_from_deg(width_deg) * step / width,
                         {}};
    std::vector<double> sums(idx(pattern.width * pattern.height), 0.0);
    double all = 0.0;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            const double value = static_cast<double>(luminance[idx(j * width + i)]);
            if (!(value > 0.0) || !std::isfinite(value)) continue;
            sums[idx(j / step * pattern.width + i / step)] += value;
            all += value;
        }
    if (!(all > 0.0))
        throw Error({.problem = "a light's picture is dark",
                     .file = {},
                     .where = {},
                     .found = fmt::format("{} × {} pixels without light", width, height),
                     .expected = "a pixel above 0"});
    for (const double sum : sums) pattern.shares.push_back(static_cast<float>(sum / all));
    normalise(pattern);
    return pattern;
}

std::vector<PatternPatch> patches(const LightPattern& pattern, const LightDirection& light,
                                  int across) {
    std::vector<PatternPatch> parts;
    if (pattern.is_point()) return {{pattern, 1.0, light}};
    for (int b = 0; b < across; ++b)
        for (int a = 0; a < across; ++a) {
            const int left = pattern.width * a / across, right = pattern.width * (a + 1) / across;
            const int top = pattern.height * b / across, bottom = pattern.height * (b + 1) / across;
            PatternPatch patch{{right - left, bottom - top, pattern.cell_rad, {}}, 0.0, {}};
            for (int j = top; j < bottom; ++j)
                for (int i = left; i < right; ++i) {
                    const float share = pattern.shares[idx(j * pattern.width + i)];
                    patch.pattern.shares.push_back(share);
                    patch.share += static_cast<double>(share);
                }
            if (!(patch.share > 0.0)) continue;
            normalise(patch.pattern);
            const double middle_right = 0.5 * (left + right - pattern.width) * pattern.cell_rad;
            const double middle_up = 0.5 * (pattern.height - top - bottom) * pattern.cell_rad;
            patch.light = across == 1 ? light : offset_light(light, middle_right, middle_up);
            parts.push_back(std::move(patch));
        }
    return parts;
}

LightDirection offset_light(const LightDirection& light, double right_rad, double up_rad) {
    const SeenFrame seen = seen_frame(light);
    const glm::dvec3 d =
        glm::normalize(seen.d - std::tan(right_rad) * seen.right - std::tan(up_rad) * seen.up);
    const double across = std::hypot(d.x, d.y);
    if (across == 0.0) return {0.0, light.azimuth_deg};
    // Keeps the sign of the field, so that a light that moves does not jump by 180°.
    const double azimuth_deg = deg_from_rad(std::atan2(d.y, d.x));
    const double field_deg = deg_from_rad(std::atan2(across, d.z));
    return light.field_deg < 0.0 ? LightDirection{-field_deg, azimuth_deg + 180.0}
                                 : LightDirection{field_deg, azimuth_deg};
}

FieldOffset field_offset(const LightDirection& light, double right_rad, double up_rad) {
    const SeenFrame seen = seen_frame(light);
    const glm::dvec3 step = -right_rad * seen.right - up_rad * seen.up;
    const double theta = rad_from_deg(light.field_deg), phi = rad_from_deg(light.azimuth_deg);
    const glm::dvec3 along(std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi),
                           -std::sin(theta));
    const glm::dvec3 across(-std::sin(phi), std::cos(phi), 0.0);
    return {glm::dot(step, along), glm::dot(step, across)};
}

}  // namespace ghostlight
