#include "core/optics/coating.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/report.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

struct CoatingOptions {
    LensOptions lens;
    std::string surface, stack, wavelengths, angles, direction;
    OutputOptions output;
};

// Exact at both ends: 1 at normal incidence, 0 at grazing.
double cos_deg(double angle_deg) {
    return angle_deg <= 45.0 ? std::cos(rad_from_deg(angle_deg))
                             : std::sin(rad_from_deg(90.0 - angle_deg));
}

using FilmAt = std::function<Film(double wavelength_nm)>;

bool is_backward(const std::string& direction) {
    if (!direction.empty() && direction != "forward" && direction != "backward")
        throw bad_value("--direction", direction, "forward or backward");
    return direction == "backward";
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
            const Reflectances found = reflectances(film, cos_deg(angle_deg));
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
    if (options.stack.empty() == options.lens.lens.empty())
        throw Error("coating needs either LENS with --surface, or --stack");

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
    stack->excludes(lens);
    stack->excludes(surface);
    stack->excludes(direction);
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
      --wavelengths 550 --angles 0,30,60 --coating qw:550:1.38 --csv)");
    command->callback([options] { run(*options); });
}

}  // namespace ghostlight::cli
