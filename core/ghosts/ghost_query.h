#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/ghosts/ghost_table.h"

namespace ghostlight {

/// What can be asked of a ghost, in the units of the ghost table as people read it: mm, mm²,
/// degrees, and per cent for shares and reflectances.
enum class GhostQuantity {
    flux,
    relative_flux,
    peak,
    x,
    y,
    rms,
    on_sensor,
    reflectance_1,
    reflectance_2,
    angle_1,
    angle_2,
    focus,
    width,
    height,
    area
};

/// One thing that a ghost does or does not.
struct GhostCondition {
    enum class Kind {
        touches,         ///< turns at one of `surfaces`
        is,              ///< turns at all of `surfaces`, in this order
        above,           ///< `quantity` ≥ `value`
        below,           ///< `quantity` ≤ `value`
        focus_within,    ///< |focus from the sensor| ≤ `value` mm
        above_strongest  ///< flux ≥ `value` × the strongest ghost's
    };
    Kind kind = Kind::touches;
    bool negated = false;
    GhostQuantity quantity = GhostQuantity::flux;
    double value = 0.0;
    std::vector<std::size_t> surfaces;  ///< rows from 0; the count of surfaces for the sensor
    bool operator==(const GhostCondition&) const = default;
};

/// Which ghosts of a table are wanted: those that meet all conditions of one of its lists. Without
/// any list, all.
struct GhostQuery {
    std::vector<std::vector<GhostCondition>> any_of;
    bool operator==(const GhostQuery&) const = default;
};

/// Reads a query in words, for a lens of that many surfaces:
///
///     touches surface 7 and above 1e-6
///     focus within 5 mm of the sensor, not touches 3 or 4
///     5-3 or on sensor above 50 %
///     RMS below 2 mm and above 1 % of the strongest
///
/// Conditions are joined by "and" or a comma, alternatives by "or" (of a list of surfaces, "touches
/// 3 or 4" is one condition); "not" turns the one after it around. A number without a quantity is
/// the flux in mm². Case does not matter. Throws Error that quotes the words that are not
/// understood and says what was expected there.
GhostQuery parse_ghost_query(std::string_view text, std::size_t surface_count);

/// The value of a quantity, in the unit that people read.
double value_of(const GhostRow& row, GhostQuantity quantity);

/// Whether a row of a table is wanted.
bool passes(const GhostQuery& query, const GhostRow& row, const GhostTable& table);

}  // namespace ghostlight
