#pragma once

#include <string>
#include <vector>

#include "core/fit/flare_fit.h"

namespace ghostlight {

/// A lens with fitted numbers in it. They were fitted to the lens as `configuration` has it: gaps
/// and the stop's size go where that configuration keeps its own. Kinds of coating are those of
/// `found`, the lens as the fit left it.
Prescription with_fitted(const Prescription& lens, const std::string& configuration,
                         const std::vector<FittedNumber>& numbers, const Prescription& found);

}  // namespace ghostlight
