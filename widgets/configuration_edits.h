#pragma once

#include <string>
#include <string_view>

#include "widgets/document.h"

namespace ghostlight {

/// Changes to a lens's positions, and to which one is looked at. Each throws Error with a reason
/// when it cannot be done. "as listed" is the lens without a position, named by "".

/// Another position like the one in hand, chosen. From the lens as listed it begins with that
/// lens's thicknesses wherever another position has its own.
DocumentState with_configuration_added(DocumentState state);

DocumentState with_configuration_renamed(DocumentState state, std::string_view from,
                                         std::string_view to);

/// Looked at then is the one before it, or the lens as listed.
DocumentState with_configuration_removed(DocumentState state, std::string_view name);

/// A position between two, chosen; the same pair's former one gives way. Share 0 is the first.
DocumentState with_configuration_between(DocumentState state, std::string_view first,
                                         std::string_view second, double share);
/// Its name: "between wide and tele".
std::string name_between(std::string_view first, std::string_view second);

}  // namespace ghostlight
