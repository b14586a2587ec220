#include "core/io/accuracy_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/chart_svg.h"
#include "core/io/html_page.h"

namespace ghostlight {

std::string title_of(const AccuracyCase& one) {
    std::string title = fmt::format("{}, {:.4g}°", one.heading, one.field_deg);
    if (one.closed_stops > 0.0) title += fmt::format(", closed {:.3g} stops", one.closed_stops);
    return title;
}

std::string percent_text(double share) {
    if (!std::isfinite(share)) return "–";
    return fmt::format("{:.3g}", 100.0 * share);
}

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
            report.flux_on_sensor_mm2, percent_text(report.reference_tolerance),
            percent_text(report.reference_bound), percent_text(report.reference_error),
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
                report.four_reflections_traced, percent_text(report.four_reflections));
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

}  // namespace ghostlight
