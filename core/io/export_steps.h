#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/optics/prescription.h"

namespace ghostlight {

// What the writers of foreign formats share.

/// A glass as numbers, where its dispersion allows: nd and Vd; Vd nothing for a constant index.
struct ExportedGlass {
    bool catalogued = false;  ///< the name alone says it all
    bool model = false;       ///< nd and Vd (or a constant index) say it all
    std::optional<double> nd, vd;
    std::string catalog;  ///< that has it
};
ExportedGlass exported_glass(const Medium& medium);

/// A name without what separates words in files: blanks become "_".
std::string one_word(std::string_view name);
/// Without line ends and quotes.
std::string one_line(std::string_view text);

/// Digits that read back to the same number.
std::string exact(double value);

/// Notes for what no foreign format holds: coatings, blades, what the source states, fields that
/// are not known, where the radius of the stop comes from.
void note_left_behind(const Prescription& lens, std::string_view format, Notes& notes);

/// Half of the field that the sensor's corner sees at d; the source's where the sensor tells none.
double exported_half_field_deg(const Prescription& lens);

/// EPD that gives the stop its working radius, mm; nothing without an entrance pupil.
std::optional<double> entrance_pupil_diameter_mm(const Prescription& lens);

/// The stop's radius at the working f-number; its row's where that cannot be worked out.
double working_stop_radius_mm(const Prescription& lens);

/// True where configurations state the stop's width rather than f-numbers; then what is written is
/// an entrance pupil for each.
bool by_entrance_pupils(const Prescription& lens);

/// Distance from the last vertex to the sensor, mm, at the focus where it stands there.
double sensor_distance_mm(const Prescription& lens);

}  // namespace ghostlight
