#pragma once

#include <QString>

#include <vector>

#include "core/io/cell_expression.h"
#include "core/optics/coating.h"
#include "core/optics/glass.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// What a prescription's cells say and what may be typed into them. Each read_* takes what its
/// text_of_* writes, and throws Error with what is wrong and what would be taken.

/// "42.970", "plane"; a curve given by its curvature is "c=0.0125".
QString text_of_curve(const BaseCurve& curve);
BaseCurve read_curve(const QString& text);

/// "N-BK7", "1.6910 / 54.8", "1.5"; nothing for air.
QString text_of_medium(const Medium& medium);
Medium read_medium(const QString& text, const GlassCatalog& catalog);

/// "A4=1.2e-05, A6=-3e-08"; nothing for a conic. A plain list starts at A4.
QString text_of_aspheric(const std::vector<double>& terms);
std::vector<double> read_aspheric(const QString& text);

/// "none", "MgF2 λ/4 550", "1.38 λ/4 550 ×1.05", "ideal λ/4 550", "1.38:96.4 | 2.1,0.01:50" from
/// the front, "air | 1.38:96.4" from the air, "R=0.05", or a name of the coating library.
QString text_of_coating(const Coating& coating);
Coating read_coating(const QString& text, const GlassCatalog& catalog);

/// A number or arithmetic with units (core/io/cell_expression.h), or Error naming what it should
/// have been ("a thickness in mm").
double read_number(const QString& text, const QString& expected, CellUnit unit = CellUnit::none);
double read_positive(const QString& text, const QString& expected, CellUnit unit = CellUnit::none);

}  // namespace ghostlight
