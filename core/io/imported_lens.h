#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/io/lens_file.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// What a surface of a foreign file leaves open.
struct ImportedSurface {
    std::optional<double> semi_diameter_mm;  ///< none: to be sized from the direct beam
    std::string where;                       ///< for messages: "line 12", "SURF 5"
};

/// A field whose beam the lens is meant to pass, and the shares of the pupil's radius that are
/// vignetted on its upper, lower and lateral sides (CODE V's VUY, VLY, VUX; Zemax' VCY ± VDY).
struct ImportedField {
    double field_deg = 0.0;
    double cut_upper = 0.0, cut_lower = 0.0, cut_sides = 0.0;
};

/// A lens as a foreign file gives it, before what the file leaves open is worked out. `lens` is
/// complete but for what the members here say.
struct ImportedLens {
    Prescription lens;
    Notes notes;
    std::vector<ImportedSurface> surfaces;     ///< one for each of lens.surfaces
    std::optional<std::size_t> stop;           ///< row from 0; none: the file names no stop
    std::optional<double> sensor_distance_mm;  ///< last vertex to the sensor; none: paraxial focus
    std::optional<double> entrance_pupil_diameter_mm;
    std::map<std::string, double> configuration_pupils_mm;  ///< its diameter, by configuration
    std::optional<double> f_number;
    std::optional<double> half_field_deg;
    std::vector<ImportedField> fields;  ///< for sizing; none: up to the half field, no vignetting
    std::optional<double> image_height_mm;  ///< half diagonal
    std::optional<double> stated_efl_mm;    ///< to notice a wrong unit or scale
    bool has_sensor_size = false;           ///< lens.sensor holds the size that the file states
};

/// Works out what the file leaves open (stop, semi-diameters from the direct beam over the field,
/// sensor distance and size), and checks what commonly goes wrong: diameters taken for
/// semi-diameters, curvature for radius, units off by ten, surfaces out of order. Each finding is
/// a note with a proposal; numbers that the file states are never changed silently. Throws Error
/// when the lens cannot be opened at all.
LensFile complete_import(ImportedLens imported, const std::string& file);

/// Sizes the surfaces that are marked as sized once more, after the lens has been mended. Throws
/// Error for a lens that cannot be.
Prescription sized_again(const Prescription& lens);

}  // namespace ghostlight
