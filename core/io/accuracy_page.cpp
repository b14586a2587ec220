#include "core/io/accuracy_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/chart_svg.h"
#include "core/io/html_page.h"

namespace ghostlight {
namespace {

const AccuracyPoint* point_of(const AccuracyReport& report, const std::string& method,
                              double setting) {
    for (const AccuracyPoint& point : report.points)
        if (point.method == method && (point.setting == setting || std::isnan(setting)))
            return &point;
    return nullptr;
}

std::string title_of(const AccuracyCase& one) {
    std::string title = fmt::format("{}, {:.4g}°", one.heading, one.field_deg);
    if (one.closed_stops > 0.0) title += fmt::format(", closed {:.3g} stops", one.closed_stops);
    return title;
}

std::string percent(double share) {
    if (!std::isfinite(share)) return "–";
    return fmt::format("{:.3g}", 100.0 * share);
}

std::string point_cell(const AccuracyReport& report, const std::string& method, double setting,
                       bool with_time) {
    const AccuracyPoint* point = point_of(report, method, setting);
    if (point == nullptr) return "–";
    std::string text = (point->resolved ? "" : "< ") +
                       percent(point->resolved ? point->errors.relative_l1
                                               : resolved_above * report.reference_error);
    if (with_time) text += fmt::format(" in {:.3g} ms", point->median_ms);
    return text;
}

std::string flip_cell(const AccuracyReport& report, const std::string& method, double setting) {
    const AccuracyPoint* point = point_of(report, method, setting);
    return point == nullptr ? "–" : fmt::format("{:.3f}", point->errors.flip);
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

const std::vector<std::pair<std::string, std::string>>& shortcut_names() {
    static const std::vector<std::pair<std::string, std::string>> names = {
        {"averaged polarisation", "R and T averaged over s and p at each surface"},
        {"reflections only", "transmissions left out too, as the 2011 shader does"},
        {"planned, hullin-2011 coating", "that paper's coating formula"},
        {"single precision", "everything in float"},
    };
    return names;
}

/// Times with each economy off over the plan's own at equal errors, medians over a lens's settings.
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

std::vector<std::string> ablations_of(const AccuracyRun& run) {
    std::vector<std::string> methods;
    for (const AccuracyCase& one : run.cases)
        for (const AccuracyPoint& point : one.report.points)
            if (point.is_ablation && std::ranges::find(methods, point.method) == methods.end())
                methods.push_back(point.method);
    return methods;
}

}  // namespace

Table accuracy_rows(const AccuracyRun& run) {
    Table table;
    table.columns = {
        "lens",      "configuration", "field_deg",       "closed_stops",    "method",
        "knob",      "setting",       "cold_ms",         "median_ms",       "p95_ms",
        "repeats",   "rays",          "relative_l1",     "energy",          "smape",
        "log_stops", "flip",          "plan_bound",      "resolved",        "on_front",
        "shortcut",  "ablation",      "reference_error", "reference_bound", "reference_ms"};
    auto word = [](bool yes) { return std::string(yes ? "yes" : "no"); };
    for (const AccuracyCase& one : run.cases)
        for (const AccuracyPoint& p : one.report.points)
            table.rows.push_back({one.short_name,
                                  one.configuration,
                                  one.field_deg,
                                  one.closed_stops,
                                  p.method,
                                  p.knob,
                                  std::isnan(p.setting) ? Cell() : Cell(p.setting),
                                  p.cold_ms,
                                  p.median_ms,
                                  p.p95_ms,
                                  static_cast<std::int64_t>(p.repeats),
                                  static_cast<std::int64_t>(p.rays),
                                  p.errors.relative_l1,
                                  p.errors.energy,
                                  p.errors.smape,
                                  p.errors.log_stops,
                                  p.errors.flip,
                                  std::isnan(p.plan_bound) ? Cell() : Cell(p.plan_bound),
                                  word(p.resolved),
                                  word(p.on_front),
                                  word(p.is_shortcut),
                                  word(p.is_ablation),
                                  one.report.reference_error,
                                  one.report.reference_bound,
                                  one.report.reference_ms});
    return table;
}

Table ghost_accuracy_rows(const AccuracyRun& run) {
    Table table;
    table.columns = {"lens",   "field_deg",  "closed_stops",      "ghost",
                     "method", "flux_error", "centroid_shift_px", "size_error"};
    for (const AccuracyCase& one : run.cases)
        for (const GhostAccuracy& g : one.report.by_ghost)
            table.rows.push_back({one.short_name, one.field_deg, one.closed_stops,
                                  name(g.path, one.surfaces), g.method, g.flux_error,
                                  g.centroid_shift_px, g.size_error});
    return table;
}

LogChart error_time_chart(const AccuracyCase& one) {
    LogChart chart{.title = title_of(one),
                   .x_title = "time of a frame, ms (median)",
                   .y_title = "relative L1 error of the ghost layer, %",
                   .series = {},
                   .band_y = 100.0 * resolved_above * one.report.reference_error,
                   .band_name = "within 3 × the reference's own error: not resolved",
                   .diagonal = false,
                   .ring_name = "nothing is faster and closer",
                   .hollow_name = "not resolved"};
    for (const AccuracyPoint& point : one.report.points) {
        if (point.is_shortcut || point.is_ablation) continue;
        auto series = std::ranges::find(chart.series, point.method, &LogSeries::name);
        if (series == chart.series.end()) {
            chart.series.push_back(
                {.name = point.method, .color = chart_color(chart.series.size()), .marks = {}});
            series = chart.series.end() - 1;
        }
        std::string label;
        if (!point.resolved)
            label.clear();  // they lie close together
        else if (point.knob == "tolerance" || point.knob == "share")
            label = fmt::format("{:.3g} %", 100.0 * point.setting);
        else if (!point.knob.empty())
            label = fmt::format("{:.4g}", point.setting);
        series->marks.push_back({.x = point.median_ms,
                                 .y = 100.0 * point.errors.relative_l1,
                                 .label = label,
                                 .hollow = !point.resolved,
                                 .ringed = point.on_front});
    }
    return chart;
}

LogChart promise_chart(const AccuracyRun& run) {
    LogChart chart{.title = "What the plan was asked, and what it did",
                   .x_title = "tolerance asked, %",
                   .y_title = "relative L1 error, %",
                   .series = {},
                   .band_y = {},
                   .band_name = {},
                   .diagonal = true,
                   .ring_name = {},
                   .hollow_name = "not resolved"};
    for (const AccuracyCase& one : run.cases) {
        auto series = std::ranges::find(chart.series, one.short_name, &LogSeries::name);
        if (series == chart.series.end()) {
            chart.series.push_back({.name = one.short_name,
                                    .color = chart_color(chart.series.size()),
                                    .marks = {},
                                    .joined = false});
            series = chart.series.end() - 1;
        }
        for (const AccuracyPoint& point : one.report.points)
            if (point.method == "planned")
                series->marks.push_back({.x = 100.0 * point.setting,
                                         .y = 100.0 * point.errors.relative_l1,
                                         .label = {},
                                         .hollow = !point.resolved});
    }
    return chart;
}

Promises promises_of(const AccuracyRun& run) {
    Promises promises;
    for (const AccuracyCase& one : run.cases)
        for (const AccuracyPoint& point : one.report.points) {
            if (point.method != "planned") continue;
            ++(!point.resolved                             ? promises.unresolved
               : point.errors.relative_l1 <= point.setting ? promises.kept
                                                           : promises.broken);
            if (std::isnan(point.plan_bound)) continue;
            ++promises.counted;
            if (point.errors.relative_l1 <= point.plan_bound + one.report.reference_error)
                ++promises.accounted;
        }
    return promises;
}

double time_within_ms(const AccuracyReport& report, const std::string& method, double error) {
    double least = std::numeric_limits<double>::infinity();
    for (const AccuracyPoint& point : report.points)
        if (point.method == method && point.errors.relative_l1 <= error)
            least = std::min(least, point.median_ms);
    return least;
}

std::string chart_file(const AccuracyCase& one) {
    std::string file = fmt::format("accuracy_{}_{:.3g}deg", one.short_name, one.field_deg);
    if (one.closed_stops > 0.0) file += fmt::format("_closed{:.3g}", one.closed_stops);
    return file + ".svg";
}

std::string accuracy_html(const AccuracyRun& run) {
    const Promises promises = promises_of(run);
    std::string html = fmt::format(
                           "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                           "<title>Accuracy of the flare</title><style>{}</style></head>"
                           "<body>\n",
                           html_style) +
                       fmt::format(
                           "<h1>Error against run time</h1>\n<p class=\"lead\">{}. {}. {}.</p>\n"
                           "<p>The error is Σ|picture − reference| / Σ reference over the ghosts' "
                           "irradiance on the sensor, the image itself not among it. The reference "
                           "is refined until two samplings that share no ray agree; below three "
                           "times what they still differ by, a point says nothing and is drawn "
                           "hollow. A frame's time is the median after one cold frame, which has a "
                           "column of its own.</p>\n",
                           xml_text(run.date), xml_text(run.machine), xml_text(run.spectrum));
    html += fmt::format(
        "<h2>Promised and achieved</h2>\n{}\n<p>Of {} settings where it can be told, the error was "
        "within the tolerance asked in {}; {} are not resolved.</p>\n",
        log_chart_svg(promise_chart(run)), promises.kept + promises.broken, promises.kept,
        promises.unresolved);
    for (const AccuracyCase& one : run.cases) {
        const AccuracyReport& report = one.report;
        html += fmt::format(
            "<h2>{}</h2>\n<p class=\"lead\">{} ghosts, {} × {} pixels, light on the sensor {:.4g} "
            "mm² × E0. Reference: asked {} %, its ghosts' errors add up to {} %, its two pictures "
            "differ by {} %{}; {:.3g} s.</p>\n{}\n",
            xml_text(title_of(one)), report.ghosts, report.width_px, report.height_px,
            report.flux_on_sensor_mm2, percent(report.reference_tolerance),
            percent(report.reference_bound), percent(report.reference_error),
            report.reference_converged ? "" : " (not converged)", 1e-3 * report.reference_ms,
            log_chart_svg(error_time_chart(one)));
        const AccuracyRun alone{run.command, run.spectrum, run.machine, run.date, {one}};
        html += html_table(accuracy_rows(alone), {{"method", "method"},
                                                  {"knob", "knob"},
                                                  {"setting", "setting"},
                                                  {"cold_ms", "cold<br>ms"},
                                                  {"median_ms", "median<br>ms"},
                                                  {"p95_ms", "p95<br>ms"},
                                                  {"repeats", "frames"},
                                                  {"relative_l1", "L1<br>%", 100.0},
                                                  {"energy", "energy<br>%", 100.0},
                                                  {"smape", "SMAPE<br>%", 100.0},
                                                  {"log_stops", "log<br>stops"},
                                                  {"flip", "HDR-FLIP"},
                                                  {"resolved", "resolved"},
                                                  {"on_front", "front"}});
        if (std::isfinite(report.four_reflections))
            html += fmt::format(
                "<p>The {} strongest ghosts of four reflections would add {} % of the light of "
                "those of two.</p>\n",
                report.four_reflections_traced, percent(report.four_reflections));
        if (!report.by_ghost.empty())
            html +=
                "<h3>The strongest ghosts</h3>\n" +
                html_table(ghost_accuracy_rows(alone), {{"ghost", "ghost"},
                                                        {"method", "method"},
                                                        {"flux_error", "flux<br>%", 100.0},
                                                        {"centroid_shift_px", "centroid<br>pixels"},
                                                        {"size_error", "RMS size<br>%", 100.0}});
    }
    html += "<h2>Lenses and settings</h2>\n<pre>" + xml_text(run.command) + "\n";
    for (const AccuracyCase& one : run.cases)
        html += fmt::format("\n{}: {}", xml_text(one.short_name), xml_text(one.file));
    html += fmt::format("\n{}\nprogram: ghostlight-cli " GHOSTLIGHT_VERSION "</pre>\n",
                        xml_text(run.machine));
    return html + "</body></html>\n";
}

std::string accuracy_markdown(const AccuracyRun& run, const std::string& chart_folder) {
    const Promises promises = promises_of(run);
    std::string text = fmt::format(
        "# Accuracy\n\nMade by `{}` on {}; {}. {}. Nothing here is written by hand.\n\n"
        "The error is Σ|picture − reference| / Σ reference over the ghosts' irradiance on the "
        "sensor, without the\nimage itself. The reference is refined until two samplings that "
        "share no ray agree; below three times what\nthey still differ by, an error is written as "
        "\"<\". Times are medians of a frame after the first, and mean\nsomething only beside "
        "each other.\n\n",
        run.command, run.date, run.machine, run.spectrum);
    text += "## What to choose\n\n";
    text +=
        "`planned` takes an error; there is no grid to choose. Its time, and how many times as "
        "long "
        "the others take for\nthe same error (medians over the cases):\n\n"
        "| error | planned, ms | uniform grids | paraxial |\n| --- | --- | --- | --- |\n";
    for (const double error : {0.2, 0.1, 0.05, 0.02, 0.01}) {
        std::vector<double> times;
        for (const AccuracyCase& one : run.cases) {
            const double ms = time_within_ms(one.report, "planned", error);
            if (std::isfinite(ms)) times.push_back(ms);
        }
        text += fmt::format("| {} % | {:.3g} | {} | {} |\n", percent(error), median(times),
                            advantage(run, "uniform", error), advantage(run, "paraxial", error));
    }
    text += fmt::format(
        "\n- While a light is dragged: `planned` at 4 to 10 %.\n"
        "- For a picture to keep: `planned` at 0.5 to 1 %.\n"
        "- To measure something against: `reference`, at the error that matters.\n"
        "- `paraxial` shows where ghosts are, not what they look like; `uniform` is there to "
        "compare with the\n  2011 paper.\n\n"
        "## Promised and achieved\n\n![asked against achieved]({}/accuracy_promised.svg)\n\n"
        "In {} of {} cases where it can be told ({:.3g} %) the error is within the tolerance "
        "asked; {} more are below\nwhat the reference resolves. What the plan itself accounts for, "
        "the "
        "bounds of what it leaves out and twice its\nestimates of the rest, covers the error in {} "
        "of "
        "{} (the reference's own error granted).\n",
        chart_folder, promises.kept, promises.kept + promises.broken,
        100.0 * static_cast<double>(promises.kept) /
            static_cast<double>(std::max<std::size_t>(1, promises.kept + promises.broken)),
        promises.unresolved, promises.accounted, promises.counted);
    if (promises.broken > 0) {
        text += "Beyond it:\n\n| lens | asked, % | error, % |\n| --- | --- | --- |\n";
        for (const AccuracyCase& one : run.cases)
            for (const AccuracyPoint& point : one.report.points)
                if (point.method == "planned" && point.resolved &&
                    point.errors.relative_l1 > point.setting)
                    text += fmt::format("| {} | {} | {} |\n", title_of(one), percent(point.setting),
                                        percent(point.errors.relative_l1));
    }
    text +=
        "\n## Error and time\n\n| lens | ghosts | reference ± % | planned 10 % | planned 2 % | "
        "planned 0.5 % | uniform 32 | uniform 128 | paraxial |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const AccuracyCase& one : run.cases)
        text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", title_of(one),
                            one.report.ghosts, percent(one.report.reference_error),
                            point_cell(one.report, "planned", 0.1, true),
                            point_cell(one.report, "planned", 0.02, true),
                            point_cell(one.report, "planned", 0.005, true),
                            point_cell(one.report, "uniform", 32, true),
                            point_cell(one.report, "uniform", 128, true),
                            point_cell(one.report, "paraxial", NAN, true));
    text +=
        "\n## What the eye sees\n\nHDR-FLIP, 0 to 1: what somebody who flips between the picture "
        "and the reference sees, at the worst of the\nexposures that bring the flare's brightest "
        "to "
        "its median up, averaged over the pixels (67 of them a degree).\n\n"
        "| lens | planned 10 % | planned 5 % | planned 2 % | planned 1 % | uniform 16 | uniform 32 "
        "| "
        "uniform 128 | paraxial |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const AccuracyCase& one : run.cases) {
        text += "| " + title_of(one);
        for (const double tolerance : {0.1, 0.05, 0.02, 0.01})
            text += " | " + flip_cell(one.report, "planned", tolerance);
        for (const double grid : {16.0, 32.0, 128.0})
            text += " | " + flip_cell(one.report, "uniform", grid);
        text += " | " + flip_cell(one.report, "paraxial", NAN) + " |\n";
    }
    text += "\n## What each simplification costs\n\nErrors in percent:\n\n";
    for (const auto& [method, meaning] : shortcut_names())
        text += fmt::format("- *{}*: {}\n", method, meaning);
    text +=
        "- *20 %, 40 % culled*: so many of the ghosts, the weakest, not drawn (uniform grids of "
        "64)\n- *four reflections*: light of the strongest of them over that of two, left out\n\n"
        "| lens | averaged polarisation | reflections only | hullin-2011 coating | single "
        "precision | 20 % culled | 40 % culled | four reflections |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const AccuracyCase& one : run.cases) {
        text += "| " + title_of(one);
        for (const auto& each : shortcut_names())
            text += " | " + point_cell(one.report, each.first, NAN, false);
        for (const double share : {0.2, 0.4})
            text += " | " + point_cell(one.report, "uniform, weakest culled", share, false);
        text += " | " + percent(one.report.four_reflections) + " |\n";
    }
    if (const auto ablations = ablations_of(run); !ablations.empty()) {
        text +=
            "\n## What each economy is worth\n\nThe time of a frame without it, over that of the "
            "plan "
            "with all of them for the same error (between its own\nsettings, linear in both "
            "logarithms; medians over 5, 2 and 1 %, where resolved):\n\n| lens";
        std::string rule = "\n| ---";
        for (const std::string& method : ablations) {
            text += " | " + method.substr(method.find(", ") + 2);
            rule += " | ---";
        }
        text += " |" + rule + " |\n";
        for (const AccuracyCase& one : run.cases) {
            text += "| " + title_of(one);
            for (const std::string& method : ablations)
                text += " | " + cost_without(one.report, method);
            text += " |\n";
        }
    }
    text += "\n## Charts\n";
    for (const AccuracyCase& one : run.cases)
        text += fmt::format("\n![{}]({}/{})\n", title_of(one), chart_folder, chart_file(one));
    return text;
}

}  // namespace ghostlight
