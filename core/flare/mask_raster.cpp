#include "core/flare/mask_raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/error.h"
#include "core/flare/dirt_statistics.h"
#include "core/optics/trace.h"

namespace ghostlight {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double most_specks = 2e5;
/// Ridges of a fingertip are about half a millimetre apart, a print is some 15 by 20 mm.
constexpr double ridge_mm = 0.45, print_width_mm = 15.0, print_height_mm = 20.0;
constexpr int share_across = 1024;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// Numbers that are the same with every standard library.
class Chance {
   public:
    Chance(int seed, int kind) : engine_(static_cast<std::uint64_t>(seed) * 8 + idx(kind)) {}
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
    }
    /// Evenly over the logarithm.
    double ratio_between(double low, double high) {
        return low * std::pow(high / low, between(0.0, 1.0));
    }
    glm::dvec2 in_circle(double radius) {
        const double r = radius * std::sqrt(between(0.0, 1.0)), angle = between(0.0, 2.0 * pi);
        return {r * std::cos(angle), r * std::sin(angle)};
    }

   private:
    std::mt19937_64 engine_;
};
enum Kind { dust_kind, scratch_kind, print_kind };

class Painter {
   public:
    explicit Painter(MaskRaster& raster) : raster_(raster), pitch_(raster.pitch()) {}

    /// Multiplies every pixel near the box by 1 − cover(x, y), coordinates in semi-diameters.
    template <class Cover>
    void darken(double x0, double x1, double y0, double y1, Cover cover) {
        auto first = [&](double x) {
            return std::max(0, static_cast<int>(std::floor((x + 1.0) / pitch_ - 1.0)));
        };
        auto last = [&](double x) {
            return std::min(raster_.across - 1,
                            static_cast<int>(std::ceil((x + 1.0) / pitch_ + 1.0)));
        };
        for (int j = first(y0); j <= last(y1); ++j)
            for (int i = first(x0); i <= last(x1); ++i) {
                const double covered = cover(middle(i), middle(j));
                if (covered > 0.0)
                    raster_.open[idx(j * raster_.across + i)] *=
                        static_cast<float>(1.0 - std::min(1.0, covered));
            }
    }

    /// A thing of a breadth within a pixel's of distance d from its middle line or point; what is
    /// narrower than a pixel covers less of it.
    double across(double d, double breadth) const {
        const double narrow = std::min(breadth, pitch_);
        return std::clamp((0.5 * (breadth + pitch_) - d) / narrow, 0.0, 1.0) * narrow / pitch_;
    }
    double pitch() const { return pitch_; }

   private:
    MaskRaster& raster_;
    double pitch_;
    double middle(int i) const { return (i + 0.5) * pitch_ - 1.0; }
};

void add_dust(const StopDirt& dirt, double a, Painter& painter) {
    if (!(dirt.dust_coverage > 0.0)) return;
    // Specks thrown at random leave exp(−Σ their areas / the circle's) of it free.
    const double small = dirt.dust_smallest_mm, large = dirt.dust_largest_mm;
    const double wanted = -std::log1p(-dirt.dust_coverage) * pi * a * a;
    const double count = expected_specks(dirt, a);
    if (count > most_specks)
        throw Error({.problem = "more specks of dust than can be drawn",
                     .file = {},
                     .where = "stop.dirt",
                     .found = fmt::format("{:.0f} on a stop {:.3g} mm wide", count, 2.0 * a),
                     .expected = fmt::format("at most {:.0f}: larger specks, or less coverage",
                                             most_specks)});
    Chance chance(dirt.seed, dust_kind);
    double left = wanted;
    while (left > 0.0) {
        const double d = chance.ratio_between(small, large);
        const glm::dvec2 at = chance.in_circle(a + 0.5 * large) / a;
        // The last one, and those over the rim, count by what they cover on average.
        left -= 0.25 * pi * d * d * a * a / ((a + 0.5 * large) * (a + 0.5 * large));
        const double radius = 0.5 * d / a, pitch = painter.pitch();
        if (radius < pitch) {
            // Its area, shared by the nearest pixels.
            const double share = pi * radius * radius / (pitch * pitch);
            painter.darken(at.x - pitch, at.x + pitch, at.y - pitch, at.y + pitch,
                           [&](double x, double y) {
                               return share * std::max(0.0, 1.0 - std::abs(x - at.x) / pitch) *
                                      std::max(0.0, 1.0 - std::abs(y - at.y) / pitch);
                           });
            continue;
        }
        painter.darken(at.x - radius, at.x + radius, at.y - radius, at.y + radius,
                       [&](double x, double y) {
                           const double away = std::hypot(x - at.x, y - at.y);
                           return std::clamp(0.5 + (radius - away) / pitch, 0.0, 1.0);
                       });
    }
}

void add_scratches(const StopDirt& dirt, double a, Painter& painter) {
    Chance chance(dirt.seed, scratch_kind);
    for (int n = 0; n < dirt.scratches; ++n) {
        const glm::dvec2 middle = chance.in_circle(1.0);
        const double half_length = 0.5 * chance.between(0.1, 1.0);
        const double angle = chance.between(0.0, pi);
        const double breadth =
            chance.ratio_between(dirt.scratch_thinnest_mm, dirt.scratch_widest_mm) / a;
        const glm::dvec2 along(std::cos(angle), std::sin(angle));
        const double reach_x = std::abs(along.x) * half_length + breadth + painter.pitch();
        const double reach_y = std::abs(along.y) * half_length + breadth + painter.pitch();
        painter.darken(middle.x - reach_x, middle.x + reach_x, middle.y - reach_y,
                       middle.y + reach_y, [&](double x, double y) {
                           const double dx = x - middle.x, dy = y - middle.y;
                           const double t = dx * along.x + dy * along.y;
                           if (std::abs(t) > half_length) return 0.0;
                           return painter.across(std::abs(dx * along.y - dy * along.x), breadth);
                       });
    }
}

void add_fingerprint(const StopDirt& dirt, double a, Painter& painter) {
    if (!(dirt.fingerprint > 0.0)) return;
    Chance chance(dirt.seed, print_kind);
    const glm::dvec2 middle = chance.in_circle(0.5);
    const double angle = chance.between(0.0, 2.0 * pi);
    const double c = std::cos(angle), s = std::sin(angle);
    painter.darken(-1.0, 1.0, -1.0, 1.0, [&](double x, double y) {
        const double dx = (x - middle.x) * a, dy = (y - middle.y) * a;
        const double u = (c * dx + s * dy) / (0.5 * print_width_mm);
        const double v = (c * dy - s * dx) / (0.5 * print_height_mm);
        const double r = std::hypot(u, v);
        if (r >= 1.0) return 0.0;
        // A whorl: rings about the middle, drawn out along the finger and wavering.
        const double turn = std::atan2(v, u);
        const double way_mm =
            0.5 * print_width_mm * r * (1.0 + 0.12 * std::sin(3.0 * turn + 4.0 * r)) +
            0.1 * ridge_mm * turn;
        const double fade = std::min(1.0, 4.0 * (1.0 - r));
        return dirt.fingerprint * fade * (0.5 + 0.5 * std::cos(2.0 * pi * way_mm / ridge_mm));
    });
}

/// Distance inside of what is open, in semi-diameters: the least of its edges'.
class Opening {
   public:
    Opening(const StopMask& mask, const ApertureOutline* beam) {
        if (mask.blades >= 3) {
            // As stop_margin() has them: lines, or arcs through two corners.
            const double half = pi / mask.blades;
            const bool curved = mask.blade_curvature > 0.0;
            const double radius = curved ? 1.0 / mask.blade_curvature : 0.0;
            const double back =
                curved ? std::sqrt(radius * radius - std::pow(std::sin(half), 2)) - std::cos(half)
                       : 0.0;
            for (int edge = 0; edge < mask.blades; ++edge) {
                const double middle = mask.rotation_rad + half * (2 * edge + 1);
                const double nx = std::cos(middle), ny = std::sin(middle);
                if (curved)
                    arcs_.push_back({-back * nx, -back * ny, radius});
                else
                    lines_.push_back({nx, ny, std::cos(half)});
            }
            whole_within_ = std::cos(half);
        }
        for (std::size_t e = 0; beam != nullptr && e < beam->corners.size(); ++e) {
            const glm::dvec2 from = beam->corners[e];
            const glm::dvec2 d = beam->corners[(e + 1) % beam->corners.size()] - from;
            const double length = std::hypot(d.x, d.y);
            if (!(length > 0.0)) continue;
            const double nx = d.y / length, ny = -d.x / length;
            lines_.push_back({nx, ny, from.x * nx + from.y * ny});
            whole_within_ = std::min(whole_within_, lines_.back().distance);
        }
    }

    double inside(double x, double y, double pitch) const {
        const double r = std::sqrt(x * x + y * y);
        double least = 1.0 - r;
        if (r < whole_within_ - pitch || least < -pitch) return least;
        for (const Line& line : lines_)
            least = std::min(least, line.distance - x * line.nx - y * line.ny);
        for (const Arc& arc : arcs_) {
            const double dx = x - arc.x, dy = y - arc.y;
            least = std::min(least, arc.radius - std::sqrt(dx * dx + dy * dy));
        }
        return least;
    }

   private:
    struct Line {
        double nx, ny, distance;
    };
    struct Arc {
        double x, y, radius;
    };
    std::vector<Line> lines_;
    std::vector<Arc> arcs_;
    double whole_within_ = 1.0;  ///< of the middle nothing but the circle can be near
};

MaskRaster clean_raster(const StopMask& mask, int across, const ApertureOutline* beam) {
    MaskRaster raster{across, std::vector<float>(idx(across) * idx(across), 0.0F)};
    const Opening opening(mask, beam);
    const double pitch = raster.pitch();
    const double c = std::cos(mask.rotation_rad), s = std::sin(mask.rotation_rad);
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < across; ++i) {
            const double x = (i + 0.5) * pitch - 1.0, y = (j + 0.5) * pitch - 1.0;
            double open = std::clamp(0.5 + opening.inside(x, y, pitch) / pitch, 0.0, 1.0);
            if (open > 0.0 && mask.picture)
                open *= mask.picture->open_at(c * x + s * y, c * y - s * x);
            raster.open[idx(j * across + i)] = static_cast<float>(open);
        }
    return raster;
}

void add_dirt(const StopMask& mask, const StopDirt& dirt, MaskRaster& raster) {
    Painter painter(raster);
    add_dust(dirt, mask.semi_diameter_mm, painter);
    add_scratches(dirt, mask.semi_diameter_mm, painter);
    add_fingerprint(dirt, mask.semi_diameter_mm, painter);
}

}  // namespace

double MaskRaster::area() const {
    double sum = 0.0;
    for (const float each : open) sum += static_cast<double>(each);
    return sum * pitch() * pitch();
}

MaskRaster mask_raster(const StopMask& mask, const StopDirt& dirt, int across,
                       const ApertureOutline* beam) {
    MaskRaster raster = clean_raster(mask, across, beam);
    add_dirt(mask, dirt, raster);
    return raster;
}

double clear_share(const StopMask& mask, const StopDirt& dirt) {
    if (dirt.is_clean()) return 1.0;
    MaskRaster raster = clean_raster(mask, share_across, nullptr);
    const double clean = raster.area();
    add_dirt(mask, dirt, raster);
    return clean > 0.0 ? raster.area() / clean : 1.0;
}

}  // namespace ghostlight
