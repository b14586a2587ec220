#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/optics/prescription.h"

namespace ghostlight {

/// What of a lens may be varied.
enum class FitKind {
    center,           ///< λ0 of a quarter-wave layer, nm
    thickness,        ///< factor on all thicknesses of a coating
    layer_thickness,  ///< of one layer, nm
    layer_index,      ///< added to a layer's index at every wavelength
    reflectance,      ///< of a surface of constant reflectance
    radius,           ///< mm
    gap,              ///< thickness to the next vertex, mm
    index,            ///< added to the index behind a surface at every wavelength
    semi_diameter,    ///< mm
    stop_size,        ///< factor on the stop's semi-diameter
    stop_x,           ///< decentre of the stop, mm
    stop_y,
    stop_rotation,  ///< of the blades, degrees
};
/// True for what moves no ray.
bool is_coating(FitKind kind);

/// One number that is varied, on one surface or, with one common value, on several.
struct FitParameter {
    FitKind kind = FitKind::center;
    std::vector<std::size_t> rows;  ///< from 0; empty for the stop's
    std::size_t layer = 0;
    double start = 0.0;
    double lower = 0.0, upper = 0.0;
    double prior = 0.0;  ///< standard deviation about the start
    bool operator==(const FitParameter&) const = default;
};
/// "λ0 of 3", "thickness of 2+5", "radius of 4".
std::string name(const FitParameter& parameter);
std::string unit(const FitParameter& parameter);

/// What a prescription cannot hold of a stop.
struct StopPlace {
    double x_mm = 0.0, y_mm = 0.0;
    bool operator==(const StopPlace&) const = default;
};
struct FittedLens {
    Prescription lens;
    StopPlace stop;
};
/// The coating with the value of a parameter for which is_coating().
void set_coating(Coating& coating, const FitParameter& parameter, double value);
/// The lens with the parameter's value in it; of kinds that multiply, on top of what is there.
void set(FittedLens& lens, const FitParameter& parameter, double value);

/// Reads what is to be varied: items KIND@ROWS[=LOWER..UPPER][~PRIOR], separated by commas.
/// KIND: center, thickness, layer.N, layer-index.N, reflectance, radius, gap, index,
/// semi-diameter, and without rows stop-size, stop-x, stop-y, stop-rotation. ROWS: a number from
/// 1, several joined by + that share one value, or `all`, each surface where it makes sense on its
/// own. Bounds and the prior's σ are in the parameter's unit, with % of the value; defaults are
/// what a shop keeps. Throws Error naming the item.
std::vector<FitParameter> parse_vary(std::string_view text, const Prescription& lens);

/// One item that parse_vary() reads as this parameter, bounds and prior spelt out.
std::string vary_item(const FitParameter& parameter);

}  // namespace ghostlight
