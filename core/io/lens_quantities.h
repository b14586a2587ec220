#pragma once

#include <string>
#include <vector>

#include "core/io/table.h"
#include "core/optics/optical_system.h"

namespace ghostlight {

/// One of a lens's first-order data: what tables, reports and panels show of it.
struct LensQuantity {
    std::string name;        ///< for files, with its unit: "efl_mm"
    Cell value;              ///< nothing where the lens has none
    std::string meaning;     ///< in a few words, beside the name
    std::string label;       ///< for people: "Focal length"
    std::string unit;        ///< "mm", "°", "1/mm", "%"; empty for a plain number
    std::string definition;  ///< a sentence or two, with signs and reference points
};

/// First-order data for a far object at the system's wavelength, and what real rays say of
/// aperture and field. Throws Error for a lens without an image.
std::vector<LensQuantity> lens_quantities(const OpticalSystem& system);

}  // namespace ghostlight
