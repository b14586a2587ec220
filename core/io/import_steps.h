#pragma once

#include <optional>
#include <string>

#include "core/io/imported_lens.h"
#include "core/optics/paraxial.h"

namespace ghostlight {

// The steps of complete_import(), in order. Each leaves the lens a little more complete and says
// in a note what it chose.

/// Index that stands in for a glass that nobody knows while beams are sized; never kept.
inline constexpr double stand_in_index = 1.6;

/// The lens with what cannot be worked with replaced: glasses nobody knows, films, the f-number.
Prescription traceable(const Prescription& lens);

/// First-order data at d of a traceable lens; nothing when there are none.
std::optional<FirstOrder> first_order_of(const Prescription& lens);

/// A surface at which nothing happens: the same medium before and behind it.
bool is_dummy(const Prescription& lens, std::size_t row);

/// Negative thicknesses: surfaces without glass are merged into the gap they lie in; a stop that
/// is placed where light does not come is moved to where its image is real. Throws Error when
/// surfaces of glass are out of order.
void settle_order(ImportedLens& imported, const std::string& file);

/// What commonly goes wrong, each finding a note with a proposal.
void check_import(const ImportedLens& imported, Notes& notes);

}  // namespace ghostlight
