#pragma once

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/stop_options.h"
#include "core/error.h"
#include "core/io/lens_file.h"
#include "core/optics/prescription.h"
#include "core/optics/trace.h"

namespace ghostlight::cli {

// Values stay text until a command runs, so that one reader, with one wording, says what is wrong
// with any of them, whatever the locale.

/// The value of an option that does not do: which option, what was found, what was expected.
Error bad_value(std::string_view option, std::string_view found, std::string_view expected);

/// What the core says of an option's value, with the option's name in front.
template <typename Read>
auto read_option(std::string_view option, const Read& read) {
    try {
        return read();
    } catch (const Error& error) {
        Error::Parts parts = error.parts();
        parts.where = std::string(option) + (parts.where.empty() ? "" : ": " + parts.where);
        throw Error(std::move(parts));
    }
}

/// "a, b, c"
std::string joined(const std::vector<std::string>& texts, std::string_view separator);

/// The parts between separators, spaces around them gone.
std::vector<std::string_view> split(std::string_view text, char separator);

/// A finite number in C notation without anything around it but spaces.
std::optional<double> parse_number(std::string_view text);

/// The option's finite number, if it is one that `accepts`; throws bad_value otherwise.
double number_value(std::string_view option, std::string_view text, std::string_view expected,
                    bool (*accepts)(double));

/// The option's whole number from `least` to `most`.
long integer_value(std::string_view option, std::string_view text, std::string_view expected,
                   long least, long most);

/// Beyond 100 to 100000 nm a model glass has no meaning, and soon no number either.
bool is_usable_wavelength(double nm);
double wavelength_value(std::string_view option, std::string_view text);

/// Numbers written "A:B:STEP" (the end included, within rounding), one number, or several of
/// either, separated by commas. Throws bad_value, also for more than `max_list_values`.
std::vector<double> list_value(std::string_view option, std::string_view text,
                               std::string_view expected, bool (*accepts)(double));
inline constexpr std::size_t max_list_values = 1'000'000;

/// An option that takes one text, which must not be empty; `type` is how help shows it.
CLI::Option* add_text(CLI::App& command, const std::string& name, std::string& value,
                      const std::string& type, const std::string& description);

/// LENS and what overrides it for one run.
struct LensOptions {
    std::string lens, config, f_number, stop_semi_diameter, sensor, sensor_reflectance, coating,
        internal_transmittance;
    StopOptions stop;
    bool takes_unfinished = false;  ///< also lenses that cannot be traced before they are mended
};
/// `name` is "LENS", or an option's.
CLI::Option* add_lens(CLI::App& command, LensOptions& options, const std::string& name = "LENS");

/// What may follow --coating. Throws Error.
Coating parse_coating(std::string_view text);

/// What to type for a bundled lens; its full name works too.
std::string short_name(const BundledLens& lens);

/// The file of LENS: a path, or the name of a bundled lens. Throws Error.
std::filesystem::path find_lens(const std::string& text);

/// The lens to work on: read, in its configuration, with the overrides applied.
struct LoadedLens {
    Prescription lens;
    std::vector<std::string> configurations;  ///< names that --config could have had
    std::string configuration;                ///< the one taken; empty for the lens as listed
    std::filesystem::path file;
    Notes notes;
};
LoadedLens load_lens(const LensOptions& options);
/// Throws Error with what has to be mended before the lens can be traced, such as a glass that
/// nobody knows. load_lens does so unless `takes_unfinished`.
void refuse_unfinished(const LoadedLens& loaded);

/// What `--config` names: one configuration, a comma list of them, or "all"; one empty text for the
/// lens as listed. Names are checked when the lens is loaded.
std::vector<std::string> configurations_of(const LensOptions& options);

/// Where the light comes from.
struct LightOptions {
    std::string field, azimuth = "90";
};
CLI::Option* add_light(CLI::App& command, LightOptions& options);
LightDirection light_direction(const LightOptions& options);

}  // namespace ghostlight::cli
