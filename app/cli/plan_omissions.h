#pragma once

#include <optional>
#include <string>

#include "app/cli/report.h"
#include "core/flare/plan_report.h"

namespace ghostlight::cli {

/// What a picture leaves out, as a table for people, and the true error beside the sum of its
/// bounds where it was measured.
std::string omissions_text(const PlanReport& plan, const std::optional<MeasuredPlan>& measured);

/// The same in JSON's `request`: "omissions", "bound", and where it was measured "true_error" and
/// "reference_error".
JsonFields omission_fields(const PlanReport& plan, const std::optional<MeasuredPlan>& measured);

}  // namespace ghostlight::cli
