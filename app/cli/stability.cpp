#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/report.h"
#include "core/ghosts/extreme_cases.h"
#include "core/ghosts/path_stability.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

struct StabilityOptions {
    std::vector<std::string> lenses;
    std::string config, field = "0,10", azimuth = "90", wavelength, top, markdown;
    bool extremes = false;
    OutputOptions output;
};

constexpr double picture_px = 1280.0;  ///< a sensor's width, for what is said in pixels

/// All ghosts of a lens in one light.
struct StabilityCase {
    std::string lens;
    double field_deg = 0.0, sensor_width_mm = 36.0;
    std::size_t surface_count = 0;
    std::vector<PathStability> ghosts;  ///< those that pass light, worst first

    double px(double mm) const { return mm * picture_px / sensor_width_mm; }
};

StabilityCase measured(const LoadedLens& loaded, const LightDirection& light,
                       double wavelength_nm) {
    const OpticalSystem system = compile(loaded.lens, wavelength_nm);
    StabilityCase one{.lens = loaded.file.stem().string(),
                      .field_deg = light.field_deg,
                      .sensor_width_mm = system.sensor_width_mm,
                      .surface_count = loaded.lens.surfaces.size(),
                      .ghosts = {}};
    ProgressLine progress(fmt::format("{} at {:.4g} deg", one.lens, light.field_deg));
    one.ghosts =
        stability_of(system, light, two_reflection_ghosts(system), 0, {}, [&](double share) {
            progress(share);
        }).value();
    std::erase_if(one.ghosts, [](const PathStability& ghost) { return ghost.rays == 0; });
    std::ranges::stable_sort(one.ghosts, std::ranges::greater{}, &PathStability::position_worst_mm);
    return one;
}

Table rows_of(const std::vector<StabilityCase>& cases, std::size_t top) {
    Table table;
    table.columns = {"lens",
                     "field_deg",
                     "ghost",
                     "rays",
                     "landed",
                     "position_px",
                     "position_rms_px",
                     "predicted_px",
                     "amplification_mm",
                     "weight_worst",
                     "weight_rms",
                     "fates_differ",
                     "averaging_error",
                     "flux_mm2",
                     "ill_conditioned"};
    for (const StabilityCase& one : cases)
        for (std::size_t k = 0; k < one.ghosts.size() && (top == 0 || k < top); ++k) {
            const PathStability& g = one.ghosts[k];
            table.rows.push_back(
                {one.lens, one.field_deg, name(g.path, one.surface_count),
                 static_cast<std::int64_t>(g.rays), static_cast<std::int64_t>(g.landed),
                 one.px(g.position_worst_mm), one.px(g.position_rms_mm),
                 one.px(float_rounding * g.amplification_mm), g.amplification_mm, g.weight_worst,
                 g.weight_rms, g.fates_differ, g.averaging_error, g.flux_mm2,
                 std::string(is_ill_conditioned(g, one.sensor_width_mm) ? "yes" : "no")});
        }
    return table;
}

/// The strongest ghosts' averaging errors and all ghosts' together.
std::string averaging_row(const StabilityCase& one) {
    std::vector<PathStability> strongest = one.ghosts;
    std::ranges::stable_sort(strongest, std::ranges::greater{}, &PathStability::flux_mm2);
    double carried = 0.0, averaged = 0.0;
    for (const PathStability& g : strongest) {
        carried += g.flux_mm2;
        averaged += g.flux_mm2 * (1.0 + g.averaging_error);
    }
    const double floor = 1e-3 * (strongest.empty() ? 0.0 : strongest.front().flux_mm2);
    const PathStability* worst = nullptr;
    for (const PathStability& g : strongest)
        if (g.flux_mm2 > floor &&
            (worst == nullptr || std::abs(g.averaging_error) > std::abs(worst->averaging_error)))
            worst = &g;
    std::string text = fmt::format("| {} | {:.3g} ", one.lens, one.field_deg);
    for (std::size_t k = 0; k < 3; ++k)
        text += k < strongest.size()
                    ? fmt::format("| {} {:+.2f} ", name(strongest[k].path, one.surface_count),
                                  100.0 * strongest[k].averaging_error)
                    : "| – ";
    return text + fmt::format("| {} | {:+.2f} |\n",
                              worst
                                  ? fmt::format("{} {:+.2f}", name(worst->path, one.surface_count),
                                                100.0 * worst->averaging_error)
                                  : "–",
                              carried > 0.0 ? 100.0 * (averaged / carried - 1.0) : 0.0);
}

Table rows_of_extremes() {
    Table table;
    table.columns = {"case",         "physics",     "unit",         "expected",
                     "double_error", "float_error", "double_bound", "holds"};
    for (const ExtremeCase& each : extreme_cases())
        table.rows.push_back({each.name, each.physics, each.unit, each.expected, each.double_error,
                              std::isnan(each.float_error) ? Cell() : Cell(each.float_error),
                              each.double_bound, std::string(each.holds() ? "yes" : "no")});
    return table;
}

std::string extremes_markdown() {
    std::string text =
        "\n## Stiff and extreme cases\n\n"
        "One ray each, against a closed form or a limit, by the trace that pictures and tables "
        "use; *bound* is what rounding\nalone may come to in double precision. Films are worked "
        "out in double precision everywhere but in pictures.\n\n"
        "| case | expected from | unit | value | double, off by | bound | single, off by |\n"
        "| --- | --- | --- | --- | --- | --- | --- |\n";
    for (const ExtremeCase& each : extreme_cases())
        text += fmt::format(
            "| {} | {} | {} | {:.6g} | {:.2g}{} | {:.2g} | {} |\n", each.name, each.physics,
            each.unit, each.expected, each.double_error, each.holds() ? "" : " **beyond**",
            each.double_bound,
            std::isnan(each.float_error) ? "–" : fmt::format("{:.2g}", each.float_error));
    return text +
           "\nPictures of such lenses, by OpenGL and by the CPU, both in single precision, hold "
           "the light of the ghost table to the\ntolerance asked (1 %): radii of ±1e9 mm and of "
           "1.0001 semi-diameters, stops of 0.1 and 0.01 mm, lenses of 1e-3 and\n1e3 times the "
           "size, a ghost in focus on the sensor, gaps of 0 and 1e6 mm, fields of 60° and 85° "
           "(tests `gl.GlExtreme`).\nA focused ghost's flux converges, the pixel on its axis "
           "grows as pitch^(−4/3) for a point source, and has a limit for a\ndisc "
           "(`unit.ExtremeFocus`). Tables of 60 and 200 surfaces: `unit.Traps`. Wavelengths "
           "outside a glass's range, its\npoles among them, are refused (`unit.Glass`).\n";
}

std::string markdown(const std::vector<StabilityCase>& cases, const std::string& command) {
    std::string text = fmt::format(
        "# Stability\n\nMade by `{}`. Nothing here is written by hand.\n\n"
        "## Single against double precision\n\n"
        "The same rays in both, on a grid over where each ghost enters: those that pass, for "
        "positions "
        "those that also land\nwithin the circle around the sensor, in pixels of a sensor 1280 "
        "wide. *Predicted* is 2⁻²⁴ times the largest "
        "amplification: the root of the sum of squares, over all\nmeetings of the path, of the "
        "derivatives of the sensor point by position and direction there (automatic), times\n"
        "their sizes. A ghost is ill-conditioned where either is above {} px.\n\n"
        "| lens | field | ghosts | worst, px | its ghost | predicted for it | median ghost, px | "
        "weight, worst | weight, RMS of the worst | ill-conditioned |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
        command, ill_conditioned_px);
    for (const StabilityCase& one : cases) {
        if (one.ghosts.empty()) continue;
        const PathStability& worst = one.ghosts.front();
        double weight = 0.0, weight_rms = 0.0;
        std::vector<std::string> ill;
        for (const PathStability& g : one.ghosts) {
            weight = std::max(weight, g.weight_worst);
            weight_rms = std::max(weight_rms, g.weight_rms);
            if (is_ill_conditioned(g, one.sensor_width_mm))
                ill.push_back(name(g.path, one.surface_count));
        }
        const std::size_t ill_count = ill.size();
        if (ill.size() > 4) {
            ill.resize(4);
            ill.emplace_back("…");
        }
        text += fmt::format(
            "| {} | {:.3g} | {} | {:.2g} | {} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {}{} |\n",
            one.lens, one.field_deg, one.ghosts.size(), one.px(worst.position_worst_mm),
            name(worst.path, one.surface_count), one.px(float_rounding * worst.amplification_mm),
            one.px(one.ghosts[one.ghosts.size() / 2].position_worst_mm), weight, weight_rms,
            ill_count, ill.empty() ? "" : ": " + joined(ill, " "));
    }
    text +=
        "\n## What averaging the polarisation costs\n\n"
        "Flux with (R_s + R_p)/2 and (T_s + T_p)/2 at every surface over the flux with the "
        "polarisation carried, minus one,\nin percent: of the three strongest ghosts, of the one "
        "that it hurts most among those above 0.1 % of the strongest,\nand of all ghosts "
        "together.\n\n"
        "| lens | field | strongest | second | third | most | all |\n"
        "| --- | --- | --- | --- | --- | --- | --- |\n";
    for (const StabilityCase& one : cases) text += averaging_row(one);
    return text + extremes_markdown();
}

void run_extremes(const StabilityOptions& options) {
    Report report;
    report.request = {{"command", json_string("stability --extremes")}};
    report.heading = "Stiff and extreme cases: one ray each against a closed form or a limit.";
    report.table = rows_of_extremes();
    write_report(report, options.output);
}

void run(const StabilityOptions& options) {
    if (options.extremes) return run_extremes(options);
    if (options.lenses.empty())
        throw Error({.problem = "LENS is missing",
                     .file = {},
                     .where = {},
                     .found = {},
                     .expected = "a lens, or --extremes"});
    const auto fields = list_value("--field", options.field, "angles in degrees from -90 to 90",
                                   [](double deg) { return deg >= -90.0 && deg <= 90.0; });
    LightDirection light;
    light.azimuth_deg = number_value("--azimuth", options.azimuth, "an angle in degrees",
                                     [](double) { return true; });
    const double wavelength_nm = options.wavelength.empty()
                                     ? d_line_nm
                                     : wavelength_value("--wavelength", options.wavelength);
    const bool for_people = !options.output.csv && !options.output.json;
    std::size_t top = for_people ? 10 : 0;
    if (!options.top.empty())
        top = static_cast<std::size_t>(
            integer_value("--top", options.top, "a whole number from 1 to 1000000", 1, 1'000'000));
    std::vector<StabilityCase> cases;
    std::string command = "ghostlight-cli stability", lenses;
    for (const std::string& lens : options.lenses) {
        LensOptions which;
        which.lens = lens;
        which.config = options.config;
        const LoadedLens loaded = load_lens(which);
        print_notes(loaded.notes, Note::Severity::warning);
        lenses += (lenses.empty() ? "" : " ") + loaded.file.stem().string();
        for (const double field : fields) {
            light.field_deg = field;
            cases.push_back(measured(loaded, light, wavelength_nm));
        }
    }
    command += " " + lenses + " --field " + options.field;
    if (!options.markdown.empty()) write_file_safely(options.markdown, markdown(cases, command));
    Report report;
    report.request = {{"command", json_string("stability")},
                      {"lenses", json_string(lenses)},
                      {"azimuth_deg", json_value(light.azimuth_deg)},
                      {"wavelength_nm", json_value(wavelength_nm)}};
    std::size_t ill = 0, all = 0;
    for (const StabilityCase& one : cases)
        for (const PathStability& g : one.ghosts) {
            ++all;
            ill += is_ill_conditioned(g, one.sensor_width_mm) ? 1 : 0;
        }
    report.heading = fmt::format(
        "Single against double precision, pixels of a sensor 1280 wide.\n{} ghosts pass light, {} "
        "are ill-conditioned (above {} px).",
        all, ill, ill_conditioned_px);
    report.table = rows_of(cases, top);
    if (for_people)
        report.table = select_columns(
            report.table, {"lens", "field_deg", "ghost", "position_px", "predicted_px",
                           "weight_worst", "averaging_error", "flux_mm2", "ill_conditioned"});
    write_report(report, options.output);
}

}  // namespace

void add_stability(CLI::App& program) {
    const auto options = std::make_shared<StabilityOptions>();
    CLI::App* command = program.add_subcommand(
        "stability", "what rounding and averaged polarisation do to each ghost");
    command->add_option("LENS", options->lenses, "lens files or names of bundled lenses");
    command->add_flag("--extremes", options->extremes,
                      "instead of a lens, stiff and extreme cases with answers in closed form");
    add_text(*command, "--config", options->config, "NAME", "position of a zoom");
    add_text(*command, "--field", options->field, "LIST", "angles of the light, degrees")
        ->capture_default_str();
    add_text(*command, "--azimuth", options->azimuth, "DEG",
             "direction of the field around the axis, degrees")
        ->capture_default_str();
    add_text(*command, "--wavelength", options->wavelength, "NM", "nm; default 587.5618");
    add_text(*command, "--top", options->top, "N",
             "ghosts shown of each lens and field, those that rounding moves most;\ndefault 10, "
             "all in CSV and JSON");
    add_text(*command, "--markdown", options->markdown, "FILE", "also a summary, by lens");
    add_output(*command, options->output);
    command->footer(R"(Examples:
  ghostlight-cli stability tessar_brendel_100_f2.8
  ghostlight-cli stability --extremes
  ghostlight-cli stability nikkor_z_58_f0.95_noct --field 0:20:5 --csv)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
