// What an accuracy run comes to, in words and tables.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/accuracy_page.h"

namespace ghostlight {
namespace {

const AccuracyPoint* point_of(const AccuracyReport& report, const std::string& method,
                              double setting) {
    for (const AccuracyPoint& point : report.points)
        if (point.method == method && (point.setting == setting || std::isnan(setting)))
            return &point;
    return nullptr;
}

std::string point_cell(const AccuracyReport& report, const std::string& method, double setting,
                       bool with_time) {
    const AccuracyPoint* point = point_of(report, method, setting);
    if (point == nullptr) return "–";
    std::string text = (point->resolved ? "" : "< ") +
                       percent_text(point->resolved ? point->errors.relative_l1
                                                    : resolved_above * report.reference_error);
    if (with_time) text += fmt::format(" in {:.3g} ms", point->median_ms);
    return text;
}

std::string flip_cell(const AccuracyReport& report, const std::string& method, double setting) {
    const AccuracyPoint* point = point_of(report, method, setting);
    return point == nullptr ? "–" : fmt::format("{:.3f}", point->errors.flip);
}

std::string row(const std::vector<std::string>& cells) {
    std::string text;
    for (const std::string& cell : cells) text += "| " + cell + " ";
    return text + "|\n";
}

std::string heading(const std::vector<std::string>& cells) {
    return row(cells) + row(std::vector<std::string>(cells.size(), "---"));
}

double median(std::vector<double> values) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::ranges::sort(values);
    return values[values.size() / 2];
}

/// How many times longer a method takes than the plan for the same error, where both get there.
std::string advantage(const AccuracyRun& run, const std::string& method, double error) {
    std::vector<double> ratios;
    std::size_t never = 0;
    for (const AccuracyCase& one : run.cases) {
        const double plan = time_within_ms(one.report, "planned", error);
        const double other = time_within_ms(one.report, method, error);
        if (!std::isfinite(plan)) continue;
        if (std::isfinite(other))
            ratios.push_back(other / plan);
        else
            ++never;
    }
    std::string text = ratios.empty() ? "–" : fmt::format("{:.3g} ×", median(ratios));
    if (never > 0)
        text += fmt::format(" (not reached in {} of {} cases)", never, never + ratios.size());
    return text;
}

std::string what_to_choose(const AccuracyRun& run) {
    std::string text =
        "## What to choose\n\n"
        "`planned` takes an error; there is no grid to choose. Its time, and how many times as "
        "long the others take for\nthe same error (medians over the cases). With the quick search "
        "it looks for ghosts as `uniform` does, while a\nlight is dragged:\n\n" +
        heading({"error", "planned, ms", "with the quick search", "uniform grids", "paraxial"});
    for (const double error : {0.2, 0.1, 0.05, 0.02, 0.01}) {
        std::vector<double> times;
        for (const AccuracyCase& one : run.cases) {
            const double ms = time_within_ms(one.report, "planned", error);
            if (std::isfinite(ms)) times.push_back(ms);
        }
        text += row({percent_text(error) + " %", fmt::format("{:.3g}", median(times)),
                     advantage(run, "planned, quick search", error),
                     advantage(run, "uniform", error), advantage(run, "paraxial", error)});
    }
    return text +
           "\n- While a light is dragged: `planned` at 4 to 10 %.\n"
           "- For a picture to keep: `planned` at 0.5 to 1 %.\n"
           "- To measure something against: `reference`, at the error that matters.\n"
           "- `paraxial` shows where ghosts are, not what they look like; `uniform` is there to "
           "compare with the\n  2011 paper.\n";
}

std::string promised_and_achieved(const AccuracyRun& run, const MarkdownSettings& settings) {
    const Promises promises = promises_of(run);
    const std::size_t told = promises.kept + promises.broken;
    std::string text = fmt::format(
        "\n## Promised and achieved\n\n![asked against achieved]({}/{}_promised.svg)\n\n"
        "In {} of {} cases where it can be told ({:.3g} %) the error is within the tolerance "
        "asked; {} more are below\nwhat the reference resolves. What the plan itself accounts for, "
        "the bounds of what it leaves out and twice its\nestimates of the rest, covers the error "
        "in {} of {} (the reference's own error granted).\n",
        settings.chart_folder, settings.name, promises.kept, told,
        100.0 * static_cast<double>(promises.kept) /
            static_cast<double>(std::max<std::size_t>(1, told)),
        promises.unresolved, promises.accounted, promises.counted);
    if (promises.broken == 0) return text;
    text += "Beyond it:\n\n" + heading({"lens", "asked, %", "error, %"});
    for (const AccuracyCase& one : run.cases)
        for (const AccuracyPoint& point : one.report.points)
            if (point.method == "planned" && point.resolved &&
                point.errors.relative_l1 > point.setting)
                text += row({title_of(one), percent_text(point.setting),
                             percent_text(point.errors.relative_l1)});
    return text;
}

std::string error_and_time(const AccuracyRun& run) {
    std::string text = "\n## Error and time\n\n" +
                       heading({"lens", "ghosts", "reference ± %", "planned 10 %", "planned 2 %",
                                "planned 0.5 %", "uniform 32", "uniform 128", "paraxial"});
    for (const AccuracyCase& one : run.cases)
        text += row({title_of(one), std::to_string(one.report.ghosts),
                     percent_text(one.report.reference_error),
                     point_cell(one.report, "planned", 0.1, true),
                     point_cell(one.report, "planned", 0.02, true),
                     point_cell(one.report, "planned", 0.005, true),
                     point_cell(one.report, "uniform", 32, true),
                     point_cell(one.report, "uniform", 128, true),
                     point_cell(one.report, "paraxial", NAN, true)});
    return text;
}

std::string what_the_eye_sees(const AccuracyRun& run) {
    std::string text =
        "\n## What the eye sees\n\nHDR-FLIP, 0 to 1: what somebody who flips between the picture "
        "and the reference sees, at the worst of the\nexposures that bring the flare's brightest "
        "to its median up, averaged over the pixels (67 of them a degree).\n\n" +
        heading({"lens", "planned 10 %", "planned 5 %", "planned 2 %", "planned 1 %", "uniform 16",
                 "uniform 32", "uniform 128", "paraxial"});
    for (const AccuracyCase& one : run.cases) {
        std::vector<std::string> cells{title_of(one)};
        for (const double tolerance : {0.1, 0.05, 0.02, 0.01})
            cells.push_back(flip_cell(one.report, "planned", tolerance));
        for (const double grid : {16.0, 32.0, 128.0})
            cells.push_back(flip_cell(one.report, "uniform", grid));
        cells.push_back(flip_cell(one.report, "paraxial", NAN));
        text += row(cells);
    }
    return text;
}

std::string simplifications(const AccuracyRun& run) {
    constexpr std::pair<const char*, const char*> shortcuts[] = {
        {"averaged polarisation", "R and T averaged over s and p at each surface"},
        {"reflections only", "transmissions left out too, as the 2011 shader does"},
        {"planned, hullin-2011 coating", "that paper's coating formula"},
        {"single precision", "everything in float"},
    };
    std::string text = "\n## What each simplification costs\n\nErrors in percent:\n\n";
    for (const auto& [method, meaning] : shortcuts)
        text += fmt::format("- *{}*: {}\n", method, meaning);
    text +=
        "- *20 %, 40 % culled*: so many of the ghosts, the weakest, not drawn (uniform grids of "
        "64)\n- *folded 5 %*: ghosts that bring so much of the light in the veil's series instead "
        "(`planned` at 1 %)\n- *four reflections*: light of the strongest of them over that of "
        "two, left out\n\n" +
        heading({"lens", "averaged polarisation", "reflections only", "hullin-2011 coating",
                 "single precision", "20 % culled", "40 % culled", "folded 5 %",
                 "four reflections"});
    for (const AccuracyCase& one : run.cases) {
        std::vector<std::string> cells{title_of(one)};
        for (const auto& each : shortcuts)
            cells.push_back(point_cell(one.report, each.first, NAN, false));
        for (const double share : {0.2, 0.4})
            cells.push_back(point_cell(one.report, "uniform, weakest culled", share, false));
        cells.push_back(point_cell(one.report, "planned, faint ghosts folded", 0.05, true));
        cells.push_back(percent_text(one.report.four_reflections));
        text += row(cells);
    }
    return text;
}

std::vector<std::string> ablations_of(const AccuracyRun& run) {
    std::vector<std::string> methods;
    for (const AccuracyCase& one : run.cases)
        for (const AccuracyPoint& point : one.report.points)
            if (point.is_ablation && std::ranges::find(methods, point.method) == methods.end())
                methods.push_back(point.method);
    return methods;
}

/// Times with an economy off over the plan's own at equal errors, medians over a lens's settings.
std::string cost_without(const AccuracyReport& report, const std::string& method) {
    std::vector<double> ratios;
    for (const AccuracyPoint& point : report.points)
        if (point.method == method && point.resolved) {
            const double plan_ms =
                time_for_error_ms(report.points, "planned", point.errors.relative_l1);
            if (std::isfinite(plan_ms)) ratios.push_back(point.median_ms / plan_ms);
        }
    return ratios.empty() ? "–" : fmt::format("{:.2f}", median(ratios));
}

std::string economies(const AccuracyRun& run) {
    const std::vector<std::string> ablations = ablations_of(run);
    if (ablations.empty()) return {};
    std::string text =
        "\n## What each economy is worth\n\nThe time of a frame without it, over that of the plan "
        "with all of them for the same error (between its own\nsettings, linear in both "
        "logarithms; medians over 5, 2 and 1 %, where resolved):\n\n";
    std::vector<std::string> cells{"lens"};
    for (const std::string& method : ablations)
        cells.push_back(method.substr(method.find(", ") + 2));
    text += heading(cells);
    for (const AccuracyCase& one : run.cases) {
        cells = {title_of(one)};
        for (const std::string& method : ablations)
            cells.push_back(cost_without(one.report, method));
        text += row(cells);
    }
    return text;
}

/// Of light that is not of one wavelength.
std::string wavelengths(const AccuracyRun& run) {
    constexpr std::pair<const char*, const char*> methods[] = {
        {"planned, wavelengths", "planned at 1 %, merged into bands"},
        {"uniform, wavelengths", "uniform 64, each drawn"}};
    const bool any = std::ranges::any_of(run.cases, [&](const AccuracyCase& one) {
        return point_of(one.report, methods[0].first, 3) != nullptr;
    });
    if (!any) return {};
    std::vector<std::string> cells{"lens", "method"};
    for (const int count : {3, 5, 7, 15, 31, 61}) cells.push_back(std::to_string(count));
    std::string text =
        "\n## Number of wavelengths\n\nError in percent and time of a frame, by the wavelengths at "
        "which the light is known:\n\n" +
        heading(cells);
    for (const AccuracyCase& one : run.cases)
        for (const auto& [method, meaning] : methods) {
            cells = {title_of(one), meaning};
            for (const int count : {3, 5, 7, 15, 31, 61})
                cells.push_back(point_cell(one.report, method, count, true));
            text += row(cells);
        }
    return text;
}

}  // namespace

std::string accuracy_markdown(const AccuracyRun& run, const MarkdownSettings& settings) {
    std::string text = fmt::format(
        "# Accuracy\n\nMade by `{}` on {}; {}. {}. Nothing here is written by hand.\n\n"
        "The error is Σ|picture − reference| / Σ reference over the ghosts' irradiance on the "
        "sensor, without the\nimage itself. The reference is refined until two samplings that "
        "share no ray agree; below three times what\nthey still differ by, an error is written as "
        "\"<\". Times are medians of a frame after the first, and mean\nsomething only beside "
        "each other.\n\n",
        run.command, run.date, run.machine, run.spectrum);
    text += what_to_choose(run) + promised_and_achieved(run, settings) + error_and_time(run) +
            what_the_eye_sees(run) + wavelengths(run) + simplifications(run) + economies(run);
    if (!settings.case_charts) return text;
    text += "\n## Charts\n";
    for (const AccuracyCase& one : run.cases)
        text +=
            fmt::format("\n![{}]({}/{})\n", title_of(one), settings.chart_folder, chart_file(one));
    return text;
}

}  // namespace ghostlight
