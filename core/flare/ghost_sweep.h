#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/flare/flare_image.h"
#include "core/ghosts/ghost_table.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// A number that is run through while ghosts are watched.
struct SweepParameter {
    enum class Kind {
        field,      ///< of the light, degrees
        azimuth,    ///< of the light, degrees
        f_number,   ///< of the stop
        position,   ///< configurations by number from 1; between two of them everything is linear
        radius,     ///< of a surface, mm
        curvature,  ///< of a surface, 1/mm
        thickness,  ///< behind a surface, mm
        semi_diameter,  ///< of a surface, mm
        coating         ///< a surface's layers, all times this factor
    };
    Kind kind = Kind::field;
    std::size_t surface = 0;  ///< row from 0, for those that belong to one
    bool operator==(const SweepParameter&) const = default;
};

/// "field", "azimuth", "f-number", "position", "radius 3", "curvature 3", "thickness 5",
/// "semi-diameter 2", "coating 4"; surfaces from 1. Throws Error naming what was expected.
SweepParameter parse_sweep_parameter(std::string_view text, const Prescription& lens);
/// The reverse.
std::string name(const SweepParameter& parameter);
/// "°", "mm", "1/mm", or nothing.
const char* unit_of(const SweepParameter& parameter);
/// Of tables: "field_deg", "thickness_mm".
const char* column_of(const SweepParameter& parameter);

/// Lens and light at one value.
struct SweepState {
    Prescription lens;  ///< configured
    LightDirection light;
};
/// `lens` as its file has it, seen in `configuration`. Throws Error for a value that does not do.
SweepState at_value(const Prescription& lens, std::string_view configuration,
                    const LightDirection& light, const SweepParameter& parameter, double value);
/// Where the parameter stands now.
double present_value(const Prescription& lens, std::string_view configuration,
                     const LightDirection& light, const SweepParameter& parameter);

struct SweepRequest {
    SweepParameter parameter;
    std::vector<double> values;
    std::string configuration;
    GhostTableRequest table;   ///< the light where the parameter is not the light's
    int picture_width_px = 0;  ///< 0: no pictures
    double picture_tolerance = 0.1;
};

/// One value of a sweep. A lens that cannot be traced there has no table, and why.
struct SweepPoint {
    double value = 0.0;
    std::shared_ptr<const GhostTable> table;
    std::shared_ptr<const FlareImage> picture;
    std::string failure;
};

/// The points in order of the values. `done` is called after each, on the calling thread.
/// Nothing when stopped.
std::optional<std::vector<SweepPoint>> sweep(
    const Prescription& lens, const SweepRequest& request, std::stop_token stop = {},
    const std::function<void(const SweepPoint&)>& done = {});

/// What of a ghost a curve shows.
enum class SweepQuantity { flux, on_sensor_flux, peak };
double value_of(const GhostRow& row, SweepQuantity quantity);

/// One ghost through a sweep.
struct GhostCurve {
    GhostPath path;
    std::vector<double> values;  ///< by point; NaN where the lens cannot be traced
    std::size_t worst = 0;       ///< the point of the largest value
    double largest() const { return values.empty() ? 0.0 : values[worst]; }
};
/// The ghosts by their largest value, largest first.
std::vector<GhostCurve> curves_of(const std::vector<SweepPoint>& points, SweepQuantity quantity);

}  // namespace ghostlight
