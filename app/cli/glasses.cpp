#include <fmt/format.h>

#include <memory>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/cli/report.h"
#include "core/io/glass_library.h"

namespace ghostlight::cli {
namespace {

struct GlassOptions {
    std::string name, nd, vd, code, count = "10", index;
    OutputOptions output;
};

struct Found {
    CataloguedGlass glass;
    std::optional<double> distance;
};

Cell cell(const std::optional<double>& value) {
    return value ? Cell(*value) : Cell(std::monostate{});
}

std::vector<Found> all_of(std::vector<CataloguedGlass> glasses) {
    std::vector<Found> found;
    for (CataloguedGlass& glass : glasses) found.push_back({std::move(glass), std::nullopt});
    return found;
}

/// The glass of that name, and those of the same name elsewhere that differ.
std::vector<Found> by_name(const GlassOptions& options) {
    const auto match = find_glass(options.name, {});
    if (!match) {
        const auto similar = similar_glasses(options.name);
        throw Error({.problem = "no glass of that name",
                     .file = {},
                     .where = "NAME",
                     .found = "'" + options.name + "'",
                     .expected = similar.empty() ? "a name of a catalogue at hand"
                                                 : "a name of a catalogue at hand, perhaps " +
                                                       joined(similar, ", ")});
    }
    std::vector<CataloguedGlass> glasses{match->glass};
    glasses.insert(glasses.end(), match->homonyms.begin(), match->homonyms.end());
    if (!match->homonyms.empty())
        write_standard_error(fmt::format("warning: {} is in {} other catalogue{} with another nd",
                                         match->glass.medium.name, match->homonyms.size(),
                                         match->homonyms.size() == 1 ? "" : "s"));
    return all_of(std::move(glasses));
}

std::vector<Found> by_distance(const GlassOptions& options) {
    const double nd = number_value("--nd", options.nd, "an index from 1 to 10",
                                   [](double n) { return n >= 1.0 && n <= 10.0; });
    const double vd = number_value("--vd", options.vd, "an Abbe number above 0",
                                   [](double v) { return v > 0.0; });
    const long count = integer_value("--count", options.count, "a number from 1 to 1000", 1, 1000);
    std::vector<Found> found;
    for (GlassNeighbour& each : nearest_glasses(nd, vd, static_cast<std::size_t>(count)))
        found.push_back({std::move(each.glass), each.distance});
    return found;
}

std::vector<Found> by_code(const GlassOptions& options) {
    if (!glass_code(options.code))
        throw bad_value("--code", options.code, "a six-digit code such as 517642");
    return all_of(glasses_by_code(options.code));
}

std::vector<Found> everything() {
    std::vector<Found> found;
    for (const GlassFile& catalog : glass_library()->catalogs)
        for (const CataloguedGlass& glass : catalog.glasses) found.push_back({glass, std::nullopt});
    return found;
}

Cell index_cell(const Medium& medium, double nm) {
    try {
        return refractive_index(medium, nm);
    } catch (const Error&) {
        return std::monostate{};  // beyond the glass's range
    }
}

void run(const GlassOptions& options) {
    const bool near = !options.nd.empty() || !options.vd.empty();
    if ((options.name.empty() ? 0 : 1) + (near ? 1 : 0) + (options.code.empty() ? 0 : 1) > 1)
        throw Error("glasses takes one of NAME, --nd with --vd, and --code");
    if (near && (options.nd.empty() || options.vd.empty()))
        throw Error("--nd and --vd belong together");
    std::vector<double> wavelengths_nm;
    if (!options.index.empty())
        wavelengths_nm = list_value("--index", options.index,
                                    "wavelengths in nm from 100 to 100000", is_usable_wavelength);
    Report report;
    report.request = {{"command", json_string("glasses")}};
    report.table.columns = {"glass",     "catalog", "nd",     "vd",     "listed_nd",
                            "listed_vd", "status",  "min_nm", "max_nm", "distance"};
    for (const double nm : wavelengths_nm)
        report.table.columns.push_back("n_" + exact_text(Cell(nm)));
    const std::vector<Found> found = !options.name.empty()   ? by_name(options)
                                     : near                  ? by_distance(options)
                                     : !options.code.empty() ? by_code(options)
                                                             : everything();
    for (const auto& [glass, distance] : found) {
        const auto range = wavelength_range_nm(glass.medium);
        std::vector<Cell> row{
            glass.medium.name,
            glass.catalog,
            cell(glass.nd),
            cell(glass.vd),
            cell(glass.listed_nd),
            cell(glass.listed_vd),
            glass.status ? Cell(std::string(status_name(*glass.status))) : Cell(std::monostate{}),
            range ? Cell(range->first) : Cell(std::monostate{}),
            range ? Cell(range->second) : Cell(std::monostate{}),
            cell(distance)};
        for (const double nm : wavelengths_nm) row.push_back(index_cell(glass.medium, nm));
        report.table.rows.push_back(std::move(row));
    }
    write_report(report, options.output);
    const auto library = glass_library();
    print_notes(library->notes, Note::Severity::warning);
    // Of a catalogue's own findings, only those on the glasses that were asked about.
    const bool asked = !options.name.empty() || near || !options.code.empty();
    for (const GlassFile& catalog : library->catalogs)
        for (const Note& note : catalog.notes)
            for (const auto& [glass, distance] : found)
                if (asked && glass.catalog == catalog.name && glass.where == note.where)
                    print_notes({note}, Note::Severity::warning);
}

}  // namespace

void add_glasses(CLI::App& program) {
    const auto options = std::make_shared<GlassOptions>();
    CLI::App* command = program.add_subcommand("glasses", "find glasses in the catalogues");
    command->add_option("NAME", options->name, "a glass's name; N-BK7 and NBK7 are the same");
    add_text(*command, "--nd", options->nd, "N", "index at d; with --vd: the nearest glasses");
    add_text(*command, "--vd", options->vd, "V", "Abbe number");
    add_text(*command, "--count", options->count, "N", "how many of the nearest")
        ->capture_default_str();
    add_text(*command, "--code", options->code, "CODE", "six-digit code, such as 517642");
    add_text(*command, "--index", options->index, "A:B:STEP",
             "adds a column with the index at each of these wavelengths, nm");
    add_output(*command, options->output);
    command->footer(R"(Examples:
  ghostlight-cli glasses N-BK7 --index 486.1327,587.5618,656.2725
  ghostlight-cli glasses --nd 1.62 --vd 60 --count 5

Without NAME, --nd or --code all glasses are listed. AGF catalogues in the folders that
GHOSTLIGHT_GLASS_PATH names (separated by colons) come before the bundled ones.)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
