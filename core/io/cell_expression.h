#pragma once

#include <string_view>

namespace ghostlight {

/// What a cell holds: a bare number is in this unit, and other units are converted to it.
enum class CellUnit { none, mm, nm, per_mm, deg };

/// Reads a number as people type it into a cell: "13.2", "=2*13.2", "0.5in", "1/3", "1/50mm" for
/// a curvature, "(12+1/16in)/2", "2*asin(0.1)". Operators + − * / ^ and brackets; pi, sqrt, and
/// sin, cos, tan, asin, acos, atan in degrees; units nm, um, mm, cm, m, mil, in ("), ft, deg (°),
/// rad. A decimal comma is taken where there is no point. A bare number beside one with a unit is
/// in the cell's unit, and in a length cell a unit after a fraction is the fraction's: 3/16in.
/// It is arithmetic alone: nothing is looked up and nothing is run. Throws Error with what is
/// wrong; `expected` names the cell ("a thickness in mm").
double read_cell_expression(std::string_view text, CellUnit unit, std::string_view expected);

}  // namespace ghostlight
