#pragma once

#include <string>
#include <variant>

#include "core/flare/spectrum.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// All light from one direction.
struct PointSize {
    bool operator==(const PointSize&) const = default;
};
/// Mean angular diameter of the sun, degrees.
inline constexpr double sun_diameter_deg = 0.533;
/// A disc, evenly bright.
struct DiscSize {
    double diameter_deg = sun_diameter_deg;
    bool operator==(const DiscSize&) const = default;
};
/// As bright as a picture's luminance, upright as a camera sees it.
struct PictureSize {
    std::string file;
    double width_deg = 1.0;
    bool operator==(const PictureSize&) const = default;
};
using LightSize = std::variant<PointSize, DiscSize, PictureSize>;

/// Beyond this a light is a scene, not a light.
inline constexpr double largest_light_deg = 20.0;

/// "point", "sun", "disc 2.5", "picture lamp.exr 3": sizes in degrees.
std::string name(const LightSize& size);
/// Reads those names. Throws Error listing them.
LightSize parse_light_size(std::string_view text);

/// A distant light.
struct Light {
    std::string name;  ///< what its owner calls it; may be empty
    LightDirection direction{10.0, 90.0};
    Spectrum spectrum = StandardLight{Illuminant::d65};
    LightSize size = PointSize{};
    /// Stops over the irradiance E0 that all pictures are relative to.
    double intensity_ev = 0.0;
    bool on = true;
    bool operator==(const Light&) const = default;
};

/// Stops that an intensity or a gain may have.
inline constexpr double most_ev = 40.0;

/// 2 to the power of an intensity or a gain in stops.
double gain_of_ev(double ev);

}  // namespace ghostlight
