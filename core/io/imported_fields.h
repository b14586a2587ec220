#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/io/imported_lens.h"

namespace ghostlight {

/// Fields as design programs list them. Vignetting factors are the shares of the pupil's radius
/// that are cut off on the upper, lower and lateral sides; missing entries are 0.
struct ListedFields {
    enum class Kind { angle_deg, object_height_mm, image_height_mm };
    Kind kind = Kind::angle_deg;
    std::vector<double> x, y;
    std::vector<double> cut_upper, cut_lower, cut_sides;
    std::string where;
};

/// First-order data of a lens that is not completed yet; nothing when there are none.
struct ImportedOrder {
    double efl_mm = 0.0, entrance_pupil_z_mm = 0.0;
};
std::optional<ImportedOrder> first_order_so_far(const ImportedLens& lens);

/// Puts them into the lens as angles from the axis, the half field or the image height, with notes.
/// `object_distance_mm`, in front of the first surface, is nothing for an object far away.
void set_fields(ImportedLens& lens, const ListedFields& listed,
                std::optional<double> object_distance_mm);

}  // namespace ghostlight
