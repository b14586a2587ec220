#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// One surface of a .zmx to be written, in mm.
struct ZmxRow {
    const Surface* surface = nullptr;  ///< shape and glass; null: a plane in air
    double thickness_mm = 0.0;
    bool mirror = false;             ///< GLAS MIRROR instead of the glass
    const Medium* medium = nullptr;  ///< what follows; null: air
    double semi_diameter_mm = 0.0;
    bool sized = false;  ///< the semi-diameter is the program's own
    bool stop = false;
    std::string comment;
};

/// SURF number, and what follows up to the next. `notes` gets what the format lacks.
std::string zmx_surface_text(std::size_t number, const ZmxRow& row, Notes& notes);

/// VERS to WAVM: name, unit, catalogues, an aperture line as given, fields up to an angle, F, d, C.
std::string zmx_header_text(const Prescription& lens, std::string_view aperture_line,
                            double half_field_deg);

/// SURF 0: an object far away.
std::string zmx_object_text();

/// The image, with the sensor's rectangle.
std::string zmx_image_text(std::size_t number, const Sensor& sensor);

}  // namespace ghostlight
