#include "core/optics/coating.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/report.h"
#include "core/io/coating_library.h"
#include "core/io/glass_library.h"
#include "core/io/same_name.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

struct CoatingOptions {
    LensOptions lens;
    std::string surface, stack, library, substrate, wavelengths, angles, direction;
    OutputOptions output;
};

using FilmAt = std::function<Film(double wavelength_nm)>;

bool is_backward(const std::string& direction) {
    if (!direction.empty() && direction != "forward" && direction != "backward")
        throw bad_value("--direction", direction, "forward or backward");
    return direction == "backward";
}

/// What the coating lies on: a glass's name or an index; what it was designed for by default.
Medium substrate_of(const CoatingOptions& options) {
    constexpr double crown = 1.52;
    if (options.substrate.empty()) {
        for (const LibraryCoating& each : coating_library())
            if (is_same_name(each.name, options.library) && each.substrate_index > 0.0)
                return {{}, ConstantIndex{each.substrate_index}};
        return {{}, ConstantIndex{crown}};
    }
    if (const auto index = parse_number(options.substrate);
        index && *index >= 1.0 && *index <= 10.0)
        return {{}, ConstantIndex{*index}};
    if (const auto glass = find_glass(options.substrate, {})) return glass->glass.medium;
    throw bad_value("--substrate", options.substrate, "a glass's name, or an index from 1 to 10");
}

std::string substrate_text(const Medium& substrate) {
    return substrate.name.empty()
               ? exact_text(Cell(std::get<ConstantIndex>(substrate.dispersion).n))
               : substrate.name;
}

FilmAt film_of_surface(const LoadedLens& loaded, const CoatingOptions& options, std::size_t row) {
    const bool backward = is_backward(options.direction);
    return [&loaded, row, backward](double wavelength_nm) {
        const Surface& surface = loaded.lens.surfaces[row];
        const Film film = film_at(surface.coating, medium_before(loaded.lens, row),
                                  surface.medium_after, wavelength_nm);
        return backward ? reversed(film) : film;
    };
}

Table reflectance_table(const FilmAt& film_at_wavelength, const std::vector<double>& wavelengths_nm,
                        const std::vector<double>& angles_deg) {
    if (wavelengths_nm.size() * angles_deg.size() > max_list_values)
        throw Error({.problem = "too many rows",
                     .file = {},
                     .where = "--wavelengths, --angles",
                     .found = fmt::format("{} x {}", wavelengths_nm.size(), angles_deg.size()),
                     .expected = fmt::format("at most {} together", max_list_values)});
    Table table;
    table.columns = {"wavelength_nm", "angle_deg", "r_s", "r_p", "r", "t_s", "t_p", "t"};
    for (const double wavelength_nm : wavelengths_nm) {
        const Film film = film_at_wavelength(wavelength_nm);
        for (const double angle_deg : angles_deg) {
            const Reflectances found = reflectances(film, cos_from_deg(angle_deg));
            if (!std::isfinite(found.r() + found.t()))
                throw Error(
                    fmt::format("no reflectance at {} nm and {} degrees: an index or a "
                                "thickness is beyond what numbers can hold",
                                wavelength_nm, angle_deg));
            table.rows.push_back({wavelength_nm, angle_deg, found.r_s, found.r_p, found.r(),
                                  found.t_s, found.t_p, found.t()});
        }
    }
    return table;
}

void run(const CoatingOptions& options) {
    const auto wavelengths_nm =
        list_value("--wavelengths", options.wavelengths, "wavelengths in nm from 100 to 100000",
                   is_usable_wavelength);
    const auto angles_deg = list_value("--angles", options.angles, "angles in degrees from 0 to 90",
                                       [](double deg) { return deg >= 0.0 && deg <= 90.0; });
    Report report;
    report.request = {{"command", json_string("coating")}};
    if ((options.stack.empty() ? 0 : 1) + (options.library.empty() ? 0 : 1) +
            (options.lens.lens.empty() ? 0 : 1) !=
        1)
        throw Error("coating needs one of LENS with --surface, --stack, and --library");
    if (!options.substrate.empty() && options.library.empty())
        throw Error("--substrate belongs to --library");

    if (!options.stack.empty()) {
        report.request.emplace_back("stack", json_string(options.stack));
        report.heading = fmt::format("{}, angle in the first medium", options.stack);
        report.table = reflectance_table(
            [&](double nm) {
                return read_option("--stack", [&] { return parse_stack(options.stack, nm); });
            },
            wavelengths_nm, angles_deg);
        write_report(report, options.output);
        return;
    }
    if (!options.library.empty()) {
        const bool backward = is_backward(options.direction);
        const Coating coating =
            read_option("--library", [&] { return parse_coating(options.library); });
        const Medium substrate = substrate_of(options);
        report.request.emplace_back("library", json_string(options.library));
        report.request.emplace_back("substrate", json_string(substrate_text(substrate)));
        report.request.emplace_back("direction", json_string(backward ? "backward" : "forward"));
        report.heading = fmt::format("{} on {}, angle in {}", options.library,
                                     substrate_text(substrate), backward ? "the glass" : "air");
        report.table = reflectance_table(
            [&](double nm) {
                const Film film = film_at(coating, Medium{}, substrate, nm);
                return backward ? reversed(film) : film;
            },
            wavelengths_nm, angles_deg);
        write_report(report, options.output);
        return;
    }
    const LoadedLens loaded = load_lens(options.lens);
    const auto count = static_cast<long>(loaded.lens.surfaces.size());
    if (options.surface.empty()) throw Error("--surface is required with LENS");
    const long surface = integer_value("--surface", options.surface,
                                       fmt::format("a surface's number, 1 to {}", count), 1, count);
    const auto row = static_cast<std::size_t>(surface - 1);
    const std::string direction = options.direction.empty() ? "forward" : options.direction;
    report.lens = lens_fields(loaded);
    report.request.emplace_back("surface", fmt::format("{}", surface));
    report.request.emplace_back("direction", json_string(direction));
    report.heading = fmt::format("{}: surface {}, {}, {}; angle in the medium the light comes from",
                                 lens_heading(loaded), surface,
                                 describe(loaded.lens.surfaces[row].coating), direction);
    report.table =
        reflectance_table(film_of_surface(loaded, options, row), wavelengths_nm, angles_deg);
    write_report(report, options.output);
    print_notes(loaded.notes, Note::Severity::warning);
}

}  // namespace

void add_coating(CLI::App& program) {
    const auto options = std::make_shared<CoatingOptions>();
    CLI::App* command =
        program.add_subcommand("coating", "reflectance and transmittance of one interface");
    CLI::Option* lens = add_lens(*command, options->lens);
    CLI::Option* surface = add_text(*command, "--surface", options->surface, "K",
                                    "surface of the lens, counted from 1");
    CLI::Option* stack =
        add_text(*command, "--stack", options->stack, "MEDIA",
                 "instead of a lens: \"n0 | n:nm | ... | n2\", layers as index[,k]:thickness");
    CLI::Option* direction = add_text(*command, "--direction", options->direction,
                                      "forward|backward", "which side the light comes from");
    CLI::Option* library = add_text(*command, "--library", options->library, "NAME|FILE.csv",
                                    "instead of a lens: a coating of the library, or measured\n"
                                    "reflectances, between air and --substrate");
    add_text(*command, "--substrate", options->substrate, "GLASS|INDEX",
             "what the coating lies on; default: what it was designed for, or 1.52");
    stack->excludes(lens);
    stack->excludes(surface);
    stack->excludes(direction);
    library->excludes(lens);
    library->excludes(surface);
    library->excludes(stack);
    add_text(*command, "--wavelengths", options->wavelengths, "A:B:STEP",
             "wavelengths, nm; also one number or a comma list")
        ->required();
    add_text(*command, "--angles", options->angles, "A:B:STEP",
             "angles of incidence in the medium the light comes from, degrees, 0 to 90")
        ->required();
    add_output(*command, options->output);
    command->footer(R"(Examples:
  ghostlight-cli coating --stack "1.0 | 1.38:96.4 | 1.5" --wavelengths 400:700:10 --angles 0:80:20
  ghostlight-cli coating tessar_brendel_100_f2.8 --surface 3 --direction backward \
      --wavelengths 550 --angles 0,30,60 --coating qw:550:1.38 --csv
  ghostlight-cli coating --library v-coat --substrate N-BK7 --wavelengths 400:700:20 --angles 0)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
