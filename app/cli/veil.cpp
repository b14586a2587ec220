#include <fmt/format.h>

#include <memory>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/report.h"
#include "app/cli/spectrum_option.h"
#include "core/flare/veiling_index.h"

namespace ghostlight::cli {
namespace {

struct VeilOptions {
    LensOptions lens;
    SpectrumOptions spectrum;
    std::string last = "88", fields = "44", scatter = "0";
    OutputOptions output;
};

void run(const VeilOptions& options) {
    VeilingIndexRequest request;
    request.spectrum = spectrum_of(options.spectrum);
    request.last_deg = number_value("--surround", options.last, "an angle in degrees from 1 to 89",
                                    [](double deg) { return deg >= 1.0 && deg <= 89.0; });
    request.fields = static_cast<int>(
        integer_value("--rings", options.fields, "a whole number from 4 to 500", 4, 500));
    request.spread.share = number_value("--scatter", options.scatter, "a share from 0 to 1",
                                        [](double share) { return share >= 0.0 && share <= 1.0; });
    const LoadedLens loaded = load_lens(options.lens);
    ProgressLine progress("veiling glare");
    const VeilingIndex index =
        *veiling_index(loaded.lens, request, {}, [&](double share) { progress(share); });
    Report report;
    report.lens = lens_fields(loaded);
    report.request = {{"command", json_string("veil")},
                      {"spectrum", json_string(name(request.spectrum))},
                      {"surround_deg", json_value(request.last_deg)},
                      {"scatter", json_value(request.spread.share)},
                      {"index", json_value(index.index())},
                      {"center_index", json_value(index.center_index())},
                      {"glare_sr", json_value(index.glare_sr)},
                      {"direct_sr", json_value(index.direct_sr)},
                      {"center_glare_sr", json_value(index.center_glare_sr)},
                      {"center_direct_sr", json_value(index.center_direct_sr)},
                      {"outside_share", json_value(index.outside_share)}};
    report.heading = fmt::format(
        "{}\nveiling glare index {:.3g} %, at the middle {:.3g} %; {:.2g} % of the glare comes "
        "from "
        "beyond the picture\n",
        lens_heading(loaded), 100.0 * index.index(), 100.0 * index.center_index(),
        100.0 * index.outside_share);
    report.table.columns = {"field_deg",     "solid_angle_sr", "ghosts_mm2",
                            "center_per_e0", "direct_mm2",     "glare_share"};
    const double area_mm2 = loaded.lens.sensor.width_mm * loaded.lens.sensor.height_mm;
    for (const VeilingRing& ring : index.rings)
        report.table.rows.push_back(
            {ring.field_deg, ring.solid_angle_sr, ring.ghosts_mm2, ring.center_per_e0,
             ring.direct_mm2,
             index.glare_sr > 0.0
                 ? Cell(ring.solid_angle_sr * ring.ghosts_mm2 / area_mm2 / index.glare_sr)
                 : Cell()});
    write_report(report, options.output);
    print_notes(loaded.notes, Note::Severity::warning);
}

}  // namespace

void add_veil(CLI::App& program) {
    const auto options = std::make_shared<VeilOptions>();
    CLI::App* command = program.add_subcommand(
        "veil", "the veiling glare index: a black spot in an evenly bright surround");
    add_lens(*command, options->lens)->required();
    add_spectrum(*command, options->spectrum);
    add_text(*command, "--surround", options->last, "DEG",
             "how far from the axis the surround is bright")
        ->capture_default_str();
    add_text(*command, "--rings", options->fields, "N", "of it, each a row of the table")
        ->capture_default_str();
    add_text(*command, "--scatter", options->scatter, "SHARE",
             "of the direct light that the lens scatters evenly over the picture")
        ->capture_default_str();
    add_output(*command, options->output);
    command->footer(R"(Examples:
  ghostlight-cli veil tessar_brendel_100_f2.8
  ghostlight-cli veil tessar_brendel_100_f2.8 --coating none --surround 20 --json)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
