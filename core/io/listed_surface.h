#pragma once

#include <optional>
#include <string>

#include "core/io/imported_lens.h"
#include "core/io/text_lines.h"

namespace ghostlight {

/// A surface as a listing gives it.
struct ListedSurface {
    Place place = {};
    double radius_mm = 0.0;  ///< 0 or infinite is a plane
    double thickness_mm = 0.0;
    Medium medium_after = {};
    std::optional<double> semi_diameter_mm = {};  ///< none, 0 and less: to be sized
    Coating coating = Uncoated{};
    std::string comment = {};
};

/// Appends it to the lens. Throws Error for what cannot be meant: a
/// length beyond 1e6 mm, more than 1000 surfaces. A negative thickness is left to
/// complete_import().
void append_surface(ImportedLens& lens, const ListedSurface& listed);

/// A line of the report for each surface, as it stands now.
void note_surfaces(ImportedLens& lens);

/// What the last thickness says of the sensor: its distance, or nothing (then it goes to the
/// paraxial focus). Throws Error when there is no surface.
void place_sensor(ImportedLens& lens, std::optional<double> distance_mm, const std::string& file);

}  // namespace ghostlight
