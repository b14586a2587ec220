#include "core/flare/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/flare/spectrum.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

using Plane = std::vector<float>;

// ---- Filters: all of FLIP's are sums of products of a row's and a column's.

/// Taps from −radius to radius.
struct Taps {
    std::vector<float> values;
    int radius() const { return static_cast<int>(values.size() / 2); }
};

template <class Value>
Taps taps_of(int radius, Value value) {
    Taps taps;
    for (int x = -radius; x <= radius; ++x) taps.values.push_back(static_cast<float>(value(x)));
    return taps;
}

/// Positive taps sum to 1, negative ones to −1.
Taps normalised(Taps taps) {
    double above = 0.0, below = 0.0;
    for (const float v : taps.values) (v > 0.0F ? above : below) += static_cast<double>(v);
    for (float& v : taps.values) v /= static_cast<float>(v > 0.0F ? above : -below);
    return taps;
}

/// Rows filtered by one, columns by the other; the outermost pixels go on for ever.
Plane filtered(const Plane& plane, int width, const Taps& along_row, const Taps& along_column) {
    const int height = static_cast<int>(plane.size()) / width;
    Plane rows(plane.size()), result(plane.size(), 0.0F);
    const int reach = along_row.radius();
    std::vector<float> line(static_cast<std::size_t>(width + 2 * reach));
    for (int y = 0; y < height; ++y) {
        const float* row = plane.data() + static_cast<std::ptrdiff_t>(y) * width;
        for (int x = -reach; x < width + reach; ++x)
            line[static_cast<std::size_t>(x + reach)] = row[std::clamp(x, 0, width - 1)];
        float* out = rows.data() + static_cast<std::ptrdiff_t>(y) * width;
        std::fill(out, out + width, 0.0F);
        for (std::size_t t = 0; t < along_row.values.size(); ++t)
            for (int x = 0; x < width; ++x)
                out[x] += along_row.values[t] * line[t + static_cast<std::size_t>(x)];
    }
    for (int y = 0; y < height; ++y) {
        float* out = result.data() + static_cast<std::ptrdiff_t>(y) * width;
        for (int t = -along_column.radius(); t <= along_column.radius(); ++t) {
            const float tap =
                along_column.values[static_cast<std::size_t>(t + along_column.radius())];
            const float* row =
                rows.data() + static_cast<std::ptrdiff_t>(std::clamp(y + t, 0, height - 1)) * width;
            for (int x = 0; x < width; ++x) out[x] += tap * row[x];
        }
    }
    return result;
}

/// One term of a contrast sensitivity, a √(π/b) exp(−π² z²/b) with z in degrees.
struct Sensitivity {
    double a = 0.0, b = 1.0;
};
constexpr Sensitivity achromatic[] = {{1.0, 0.0047}};
constexpr Sensitivity red_green[] = {{1.0, 0.0053}};
constexpr Sensitivity blue_yellow[] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double widest = 0.04;  ///< of the b above: all filters reach as far as its three sigma

template <std::size_t N>
Plane as_seen(const Plane& plane, int width, const Sensitivity (&terms)[N],
              double pixels_per_degree) {
    constexpr double pi = std::numbers::pi;
    const int radius =
        static_cast<int>(std::ceil(3.0 * std::sqrt(widest / (2.0 * pi * pi)) * pixels_per_degree));
    Plane result(plane.size(), 0.0F);
    Taps taps[N];
    double volumes[N], volume = 0.0;
    for (std::size_t n = 0; n < N; ++n) {
        taps[n] = taps_of(radius, [&](int x) {
            const double z = x / pixels_per_degree;
            return std::exp(-pi * pi * z * z / terms[n].b);
        });
        double sum = 0.0;
        for (const float v : taps[n].values) sum += static_cast<double>(v);
        volumes[n] = terms[n].a * std::sqrt(pi / terms[n].b) * sum * sum;
        volume += volumes[n];
        taps[n] = normalised(std::move(taps[n]));
    }
    for (std::size_t n = 0; n < N; ++n) {
        const auto part = static_cast<float>(volumes[n] / volume);
        const Plane term = filtered(plane, width, taps[n], taps[n]);
        for (std::size_t i = 0; i < result.size(); ++i) result[i] += part * term[i];
    }
    return result;
}

// ---- Colours: X, Y and Z over those of white.

struct Color {
    float x = 0.0F, y = 0.0F, z = 0.0F;
};

// IEC 61966-2-1: the primaries of Rec. 709 with D65.
constexpr double to_xyz[3][3] = {{0.4124564, 0.3575761, 0.1804375},
                                 {0.2126729, 0.7151522, 0.0721750},
                                 {0.0193339, 0.1191920, 0.9503041}};
constexpr double white[3] = {0.95047, 1.0, 1.08883};
Color color_of(float r, float g, float b) {
    auto row = [&](int k) {
        return static_cast<float>(to_xyz[k][0] / white[k]) * r +
               static_cast<float>(to_xyz[k][1] / white[k]) * g +
               static_cast<float>(to_xyz[k][2] / white[k]) * b;
    };
    return {row(0), row(1), row(2)};
}

/// The nearest that a screen shows.
Color shown(const Color& color) {
    const Rgb rgb = linear_rec709({static_cast<double>(color.x) * white[0],
                                   static_cast<double>(color.y) * white[1],
                                   static_cast<double>(color.z) * white[2]});
    auto clamped = [](double v) { return static_cast<float>(std::clamp(v, 0.0, 1.0)); };
    return color_of(clamped(rgb.r), clamped(rgb.g), clamped(rgb.b));
}

/// CIE 1976 L*a*b* (CIE 15), the chromatic parts less where it is dark, as Hunt found.
struct Lab {
    float lightness = 0.0F, a = 0.0F, b = 0.0F;
};
Lab hunt_lab(const Color& color) {
    auto f = [](float t) {
        constexpr float delta = 6.0F / 29.0F;
        return t > delta * delta * delta ? std::cbrt(t) : t / (3.0F * delta * delta) + 4.0F / 29.0F;
    };
    const float fx = f(color.x), fy = f(color.y), fz = f(color.z);
    const float lightness = 116.0F * fy - 16.0F;
    return {lightness, 0.01F * lightness * 500.0F * (fx - fy),
            0.01F * lightness * 200.0F * (fy - fz)};
}

/// Differences of lightness and of colour, added.
float hyab(const Lab& one, const Lab& other) {
    return std::abs(one.lightness - other.lightness) + std::hypot(one.a - other.a, one.b - other.b);
}

constexpr float color_power = 0.7F;     ///< q_c of the paper
constexpr float small_share = 0.4F;     ///< p_c: differences below that of the largest …
constexpr float small_becomes = 0.95F;  ///< p_t: … take up so much of the scale
constexpr float feature_power = 0.5F;   ///< q_f

float color_difference(const Lab& one, const Lab& other) {
    static const float largest =
        std::pow(hyab(hunt_lab(color_of(0, 1, 0)), hunt_lab(color_of(0, 0, 1))), color_power);
    const float difference = std::pow(hyab(one, other), color_power);
    const float knee = small_share * largest;
    return difference < knee
               ? difference * small_becomes / knee
               : small_becomes + (difference - knee) / (largest - knee) * (1.0F - small_becomes);
}

// ---- A picture, made ready

struct Seen {
    std::vector<Lab> colors;
    Plane edges, points;  ///< how strong
};

Plane lengths(const Plane& x, const Plane& y) {
    Plane result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) result[i] = std::hypot(x[i], y[i]);
    return result;
}

Seen seen(const Plane& rgb, int width, double pixels_per_degree) {
    const std::size_t count = rgb.size() / 3;
    Plane y(count), cx(count), cz(count);
    for (std::size_t i = 0; i < count; ++i) {
        auto channel = [&](std::size_t c) { return std::clamp(rgb[3 * i + c], 0.0F, 1.0F); };
        const Color color = color_of(channel(0), channel(1), channel(2));
        y[i] = color.y;
        cx[i] = color.x - color.y;  // YCxCz but for constants, which averaging leaves alone
        cz[i] = color.y - color.z;
    }
    Seen result;
    constexpr double edge_width_deg = 0.082;  // w of the paper
    const double sigma_px = 0.5 * edge_width_deg * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma_px));
    auto bell = [&](int x) { return std::exp(-x * x / (2.0 * sigma_px * sigma_px)); };
    const Taps smooth = normalised(taps_of(radius, bell));
    const Taps slope = normalised(taps_of(radius, [&](int x) { return -x * bell(x); }));
    const Taps bend = normalised(
        taps_of(radius, [&](int x) { return (x * x / (sigma_px * sigma_px) - 1.0) * bell(x); }));
    result.edges = lengths(filtered(y, width, slope, smooth), filtered(y, width, smooth, slope));
    result.points = lengths(filtered(y, width, bend, smooth), filtered(y, width, smooth, bend));

    y = as_seen(y, width, achromatic, pixels_per_degree);
    cx = as_seen(cx, width, red_green, pixels_per_degree);
    cz = as_seen(cz, width, blue_yellow, pixels_per_degree);
    result.colors.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        result.colors[i] = hunt_lab(shown({cx[i] + y[i], y[i], y[i] - cz[i]}));
    return result;
}

// ---- Exposures

/// Narkowicz's fit to the ACES curve, its exposure of 0.6 included.
constexpr double k0 = 0.6 * 0.6 * 2.51, k1 = 0.6 * 0.03, k3 = 0.6 * 0.6 * 2.43, k4 = 0.6 * 0.59,
                 k5 = 0.14;
constexpr double bright = 0.85;  ///< on the curve
constexpr double most_stops = 16.0;

float toned(float x) {
    const double v = std::max(0.0, static_cast<double>(x));
    return static_cast<float>(std::min(1.0, v * (k0 * v + k1) / (v * (k3 * v + k4) + k5)));
}

/// What the curve takes to `bright`.
double bright_input() {
    const double a = k0 - bright * k3, b = k1 - bright * k4, c = -bright * k5;
    return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

std::vector<double> exposures(const Plane& truth) {
    std::vector<float> lit;
    for (std::size_t i = 0; i < truth.size(); i += 3) {
        const float luminance = static_cast<float>(to_xyz[1][0]) * truth[i] +
                                static_cast<float>(to_xyz[1][1]) * truth[i + 1] +
                                static_cast<float>(to_xyz[1][2]) * truth[i + 2];
        if (luminance > 0.0F) lit.push_back(luminance);
    }
    if (lit.empty()) return {};
    const auto middle = lit.begin() + static_cast<std::ptrdiff_t>(lit.size() / 2);
    std::ranges::nth_element(lit, middle);
    const auto median = static_cast<double>(*middle);
    const auto most = static_cast<double>(*std::ranges::max_element(lit));
    const double first = std::log2(bright_input() / most);
    const double span = std::min(most_stops, std::log2(most / median));
    const int count = std::max(2, static_cast<int>(std::ceil(span)));
    std::vector<double> stops;
    for (int i = 0; i < count; ++i) stops.push_back(first + span * i / (count - 1));
    return stops;
}

Plane exposed(const Plane& picture, double stops) {
    const auto factor = static_cast<float>(std::exp2(stops));
    Plane result(picture.size());
    std::ranges::transform(picture, result.begin(), [=](float v) { return toned(factor * v); });
    return result;
}

}  // namespace

std::vector<float> ldr_flip(const std::vector<float>& picture, const std::vector<float>& truth,
                            int width_px, double pixels_per_degree) {
    const Seen one = seen(picture, width_px, pixels_per_degree);
    const Seen other = seen(truth, width_px, pixels_per_degree);
    std::vector<float> error(one.colors.size());
    for (std::size_t i = 0; i < error.size(); ++i) {
        const float feature = std::max(std::abs(one.edges[i] - other.edges[i]),
                                       std::abs(one.points[i] - other.points[i]));
        const float of_features =
            std::pow(std::numbers::sqrt2_v<float> * 0.5F * feature, feature_power);
        error[i] = std::pow(color_difference(one.colors[i], other.colors[i]), 1.0F - of_features);
    }
    return error;
}

double hdr_flip(const std::vector<float>& picture, const std::vector<float>& truth, int width_px,
                unsigned threads, double pixels_per_degree) {
    const std::vector<double> stops = exposures(truth);
    if (stops.empty()) return 0.0;
    std::vector<std::vector<float>> errors(stops.size());
    parallel_for(stops.size(), threads, {}, [&](std::size_t i) {
        errors[i] = ldr_flip(exposed(picture, stops[i]), exposed(truth, stops[i]), width_px,
                             pixels_per_degree);
    });
    double sum = 0.0;
    for (std::size_t p = 0; p < errors.front().size(); ++p) {
        float worst = 0.0F;
        for (const auto& error : errors) worst = std::max(worst, error[p]);
        sum += static_cast<double>(worst);
    }
    return sum / static_cast<double>(errors.front().size());
}

}  // namespace ghostlight
