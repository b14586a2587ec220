#pragma once

#include <string>
#include <vector>

#include "core/ghosts/ghost_table.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// Part of the ghosts' light that goes by one surface, or between two elements.
struct GhostSum {
    double flux_mm2 = 0.0;
    double on_sensor_mm2 = 0.0;
    std::size_t ghosts = 0;
    GhostSum& operator+=(const GhostRow& row);
};

/// All ghosts of the table.
GhostSum sum_of(const GhostTable& table);

struct SurfaceSum {
    std::size_t surface = 0;  ///< row from 0; the count of surfaces for the sensor
    GhostSum sum;
};
/// The flux that each surface feeds: of every ghost that turns there, however often. A ghost counts
/// at each of its surfaces, so that the sums add up to more than all. Largest flux first.
std::vector<SurfaceSum> sums_by_surface(const GhostTable& table);

/// Each row's element, numbered from 1 from the front, a cemented surface's "2+3"; empty for a row
/// that bounds none; then "sensor".
std::vector<std::string> elements_of(const Prescription& lens);

struct ElementSum {
    std::string first, second;  ///< of the later and the earlier surface in a ghost's name
    GhostSum sum;
};
/// Ghosts of two reflections by the elements they turn at, largest flux first. They add up to all.
std::vector<ElementSum> sums_by_element(const GhostTable& table, const Prescription& lens);

}  // namespace ghostlight
