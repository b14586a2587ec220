#pragma once

#include <cstddef>

#include "core/optics/prescription.h"

namespace ghostlight {

/// Changes to the rows of a prescription. The stop and the configurations follow their rows.
/// Rows count from 0. Each throws Error with a reason when it cannot be done.

/// A plane in the middle of the gap after `row`, in the same medium: it changes no ray. Into an
/// empty prescription it puts the first row. Returns the lens; the new row is `row` + 1.
Prescription with_row_inserted_after(Prescription lens, std::size_t row);

/// Not the stop's row, and not the only one.
Prescription with_row_removed(Prescription lens, std::size_t row);

/// The row takes its thickness and medium along, as everything else that is written in it.
Prescription with_row_moved(Prescription lens, std::size_t from, std::size_t to);

Prescription with_stop_at(Prescription lens, std::size_t row);

/// Thickness after a row in a configuration, which may override the listed one.
double thickness_mm(const Prescription& lens, const std::string& configuration, std::size_t row);
bool overrides_thickness(const Prescription& lens, const std::string& configuration,
                         std::size_t row);
/// Writes it where it comes from: the configuration's value if it has one, else the listed one.
Prescription with_thickness(Prescription lens, const std::string& configuration, std::size_t row,
                            double thickness_mm);
/// The configuration has the thickness as its own from now on, or takes the listed one.
/// Throws Error for a configuration that is not the lens's.
Prescription with_own_thickness(Prescription lens, const std::string& configuration,
                                std::size_t row, bool own);
/// with_thickness() for the f-number.
Prescription with_f_number(Prescription lens, const std::string& configuration, double f_number);

}  // namespace ghostlight
