#include "app/cli/plan_omissions.h"

#include <fmt/format.h>

namespace ghostlight::cli {
namespace {

std::string bound_text(const PlanReport& plan, const Omission& each) {
    if (!each.bound_mm2) return "-";
    if (*each.bound_mm2 == 0.0) return "nothing";
    const double share = plan.flux_mm2 > 0.0 ? *each.bound_mm2 / plan.flux_mm2 : 0.0;
    return fmt::format("{:.2g} %", 100.0 * share);
}

}  // namespace

std::string omissions_text(const PlanReport& plan, const std::optional<MeasuredPlan>& measured) {
    std::string text = "\nNot computed for this scene, and what that can change of the light:\n\n";
    Table table;
    table.columns = {"what", "ghosts", "at_most", "how_known", "why"};
    for (const Omission& each : plan.omissions)
        table.rows.push_back({each.what, static_cast<std::int64_t>(each.ghosts),
                              bound_text(plan, each),
                              std::string(!each.bound_mm2 ? "-"
                                          : each.proven   ? "proven"
                                                          : "estimated"),
                              each.why});
    text += table_text(table);
    const double light_mm2 = plan.flux_mm2 > 0.0 ? plan.flux_mm2 : 1.0;
    text += fmt::format(
        "\nAll of these: {:.2g} % of the light, of which {:.2g} % proven bounds and "
        "the rest estimates.",
        100.0 * plan.bound(), 100.0 * plan.proven_mm2 / light_mm2);
    if (measured)
        text += fmt::format(
            " The true error is {:.2g} %, by a reference whose two samplings differ by {:.2g} %.",
            100.0 * measured->error, 100.0 * measured->reference_error);
    return text + "\n";
}

JsonFields omission_fields(const PlanReport& plan, const std::optional<MeasuredPlan>& measured) {
    Table table;
    table.columns = {"what", "ghosts", "bound_mm2", "proven", "why"};
    for (const Omission& each : plan.omissions)
        table.rows.push_back({each.what, static_cast<std::int64_t>(each.ghosts),
                              each.bound_mm2 ? Cell(*each.bound_mm2) : Cell(),
                              std::string(each.proven ? "yes" : "no"), each.why});
    JsonFields fields = {{"omissions", table_json(table)}, {"bound", json_value(plan.bound())}};
    if (measured) {
        fields.emplace_back("true_error", json_value(measured->error));
        fields.emplace_back("reference_error", json_value(measured->reference_error));
    }
    return fields;
}

}  // namespace ghostlight::cli
