#pragma once

#include "core/optics/prescription.h"

namespace ghostlight::bench {

/// A train of weak lenses, positive and negative by turns, with the stop in the middle: light gets
/// through however long it is, and every surface reflects.
Prescription train(int surfaces);
inline constexpr double train_field_deg = 3.0;

}  // namespace ghostlight::bench
