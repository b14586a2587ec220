#include "app/cli/options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/io/coating_csv.h"
#include "core/io/coating_words.h"
#include "core/io/lens_file.h"
#include "core/io/same_name.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight::cli {
namespace {

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// Digits after the decimal point of a plain decimal; none for one with an exponent.
std::optional<int> decimals(std::string_view text) {
    if (text.find_first_of("eE") != std::string_view::npos) return std::nullopt;
    const auto point = text.find('.');
    return point == std::string_view::npos ? 0 : static_cast<int>(text.size() - point - 1);
}

// 0:1:0.1 has to contain 0.3, not 0.30000000000000004: values get the decimals of A and STEP.
double rounded_to(double value, int digits) {
    const std::string text = fmt::format("{:.{}f}", value, digits);
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

void append_range(std::vector<double>& values, std::string_view first_text,
                  std::string_view last_text, std::string_view step_text, const auto& fail) {
    const auto first = parse_number(first_text), last = parse_number(last_text),
               step = parse_number(step_text);
    if (!first || !last || !step) throw fail();
    if (*step == 0.0 || (*last - *first) / *step < 0.0)
        throw fail("a step that is not zero and leads from the start to the end");
    // A step that divides the range only up to rounding still reaches the end.
    const double steps = std::floor((*last - *first) / *step * (1.0 + 1e-12) + 1e-9);
    if (!(steps < static_cast<double>(max_list_values - values.size())))
        throw fail(fmt::format("at most {} values", max_list_values));
    const auto digits_first = decimals(trimmed(first_text)),
               digits_step = decimals(trimmed(step_text));
    for (double i = 0.0; i <= steps; i += 1.0) {
        double value = *first + i * *step;
        if (std::abs(value - *last) <= 1e-9 * std::abs(*step))
            value = *last;
        else if (digits_first && digits_step)
            value = rounded_to(value, std::max(*digits_first, *digits_step));
        values.push_back(value);
    }
}

void override_stop(Prescription& lens, const LensOptions& options) {
    if (!options.f_number.empty()) {
        lens.stop.f_number =
            number_value("--f-number", options.f_number, "a number above 0, at most 1e6",
                         [](double n) { return n > 0.0 && n <= 1e6; });
        lens.stop.semi_diameter_mm.reset();
    }
    if (!options.stop_semi_diameter.empty()) {
        lens.stop.semi_diameter_mm =
            number_value("--stop-semi-diameter", options.stop_semi_diameter,
                         "a length in mm above 0", [](double mm) { return mm > 0.0; });
        lens.stop.f_number.reset();
    }
}

void override_sensor(Sensor& sensor, std::string_view text) {
    constexpr std::string_view expected = "width x height in mm, both above 0, such as 36x24";
    const auto parts = split(text, 'x');
    const auto width = parse_number(parts.front()), height = parse_number(parts.back());
    if (parts.size() != 2 || !width || !height || *width <= 0.0 || *height <= 0.0)
        throw bad_value("--sensor", text, expected);
    sensor.width_mm = *width;
    sensor.height_mm = *height;
}

void override_sensor_reflectance(Sensor& sensor, std::string_view text) {
    if (text == "none") {
        sensor.reflectance.reset();
        return;
    }
    const auto share = parse_number(text);
    if (!share || *share < 0.0 || *share > 1.0)
        throw bad_value("--sensor-reflectance", text, "a share from 0 to 1, or none");
    sensor.reflectance = UniformReflectance{*share};
}

void override_internal_transmittance(LoadedLens& loaded, std::string_view text) {
    if (text != "on" && text != "off")
        throw bad_value("--internal-transmittance", text, "on or off");
    loaded.lens.internal_transmittance = text == "on";
    const bool is_known = std::ranges::any_of(loaded.lens.surfaces, [](const Surface& surface) {
        return !surface.medium_after.transmittance.empty();
    });
    if (text == "on" && !is_known)
        loaded.notes.push_back({Note::Severity::warning, "--internal-transmittance",
                                "no glass of this lens has a table of internal transmittance: all "
                                "are lossless"});
}

// The stop opens no further than the lens lets it: say so when that is less than was asked for.
void note_capped_stop(const Prescription& lens, Notes& notes) {
    const double clear = lens.surfaces.at(lens.stop.surface).semi_diameter_mm;
    if (lens.stop.semi_diameter_mm && *lens.stop.semi_diameter_mm > clear) {
        notes.push_back({Note::Severity::warning, "--stop-semi-diameter",
                         fmt::format("the stop opens to {:.6g} mm only", clear)});
    } else if (lens.stop.f_number) {
        const double reached = first_order(compile(lens, d_line_nm)).f_number;
        if (std::isfinite(reached) && reached > *lens.stop.f_number * (1.0 + 1e-6))
            notes.push_back({Note::Severity::warning, "--f-number",
                             fmt::format("the stop opens to f/{:.6g} only", reached)});
    }
}

}  // namespace

std::filesystem::path find_lens(const std::string& text) {
    std::error_code ignored;
    if (std::filesystem::exists(text, ignored) && !std::filesystem::is_directory(text, ignored))
        return text;
    std::vector<std::string> names;
    try {
        for (const BundledLens& lens : bundled_lenses()) {
            names.push_back(short_name(lens));
            if (text == names.back() || text == lens.name) return lens.file;
        }
    } catch (const Error&) {
        // Without the bundled lenses the answer is the same: there is no such file.
    }
    throw Error({.problem = "no such lens file",
                 .file = {},
                 .where = "LENS",
                 .found = "'" + text + "'",
                 .expected = names.empty() ? "the path of a lens file"
                                           : fmt::format("the path of a lens file or one of {}",
                                                         joined(names, ", "))});
}

Error bad_value(std::string_view option, std::string_view found, std::string_view expected) {
    return Error({.problem = "bad value",
                  .file = {},
                  .where = std::string(option),
                  .found = fmt::format("'{}'", found),
                  .expected = std::string(expected)});
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const auto at = text.find(separator);
        parts.push_back(trimmed(text.substr(0, at)));
        if (at == std::string_view::npos) return parts;
        text.remove_prefix(at + 1);
    }
}

std::string short_name(const BundledLens& lens) { return lens.file.stem().string(); }

std::string joined(const std::vector<std::string>& texts, std::string_view separator) {
    std::string all;
    for (const std::string& text : texts) {
        if (!all.empty()) all += separator;
        all += text;
    }
    return all;
}

std::optional<double> parse_number(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

double number_value(std::string_view option, std::string_view text, std::string_view expected,
                    bool (*accepts)(double)) {
    const auto value = parse_number(text);
    if (!value || !accepts(*value)) throw bad_value(option, text, expected);
    return *value;
}

long integer_value(std::string_view option, std::string_view text, std::string_view expected,
                   long least, long most) {
    const std::string_view digits = trimmed(text);
    long value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || value < least ||
        value > most)
        throw bad_value(option, text, expected);
    return value;
}

bool is_usable_wavelength(double nm) { return nm >= 100.0 && nm <= 1e5; }

double wavelength_value(std::string_view option, std::string_view text) {
    return number_value(option, text, "a wavelength in nm from 100 to 100000",
                        is_usable_wavelength);
}

std::vector<double> list_value(std::string_view option, std::string_view text,
                               std::string_view expected, bool (*accepts)(double)) {
    const auto fail = [&](std::string_view instead = {}) {
        return bad_value(option, text,
                         instead.empty()
                             ? fmt::format("{} as A:B:STEP, one number or a comma list", expected)
                             : std::string(instead));
    };
    std::vector<double> values;
    for (const std::string_view item : split(text, ',')) {
        const auto parts = split(item, ':');
        if (parts.size() == 3) {
            append_range(values, parts[0], parts[1], parts[2], fail);
        } else if (const auto value = parse_number(item)) {
            values.push_back(*value);
        } else {
            throw fail();
        }
    }
    for (const double value : values)
        if (!accepts(value)) throw fail();
    return values;
}

CLI::Option* add_text(CLI::App& command, const std::string& name, std::string& value,
                      const std::string& type, const std::string& description) {
    return command.add_option(name, value, description)
        ->type_name(type)
        ->check(CLI::Validator(
            [](std::string& text) { return text.empty() ? "is empty" : std::string(); }, ""));
}

CLI::Option* add_lens(CLI::App& command, LensOptions& options, const std::string& name) {
    constexpr auto group = "Overrides of the lens, for this run";
    auto* lens = add_text(command, name, options.lens, name == "LENS" ? "" : "LENS",
                          "a lens file, or the name of a bundled lens (see: lenses)");
    add_text(command, "--config", options.config, "NAME", "zoom or focus position")->group(group);
    auto* f_number = add_text(command, "--f-number", options.f_number, "N",
                              "close the stop to f/N; it opens no further than the lens lets it");
    f_number->group(group);
    add_text(command, "--stop-semi-diameter", options.stop_semi_diameter, "MM",
             "the stop's radius, mm")
        ->excludes(f_number)
        ->group(group);
    add_stop(command, options.stop, group);
    add_text(command, "--sensor", options.sensor, "WxH", "size of the sensor, mm, such as 36x24")
        ->group(group);
    add_text(
        command, "--sensor-reflectance", options.sensor_reflectance, "R|none",
        "share of the light that the sensor sends back, 0 to 1, at every angle and\n"
        "wavelength; none: the sensor is not a ghost's surface; default: as the\nlens file says")
        ->group(group);
    add_text(command, "--coating", options.coating, "none|qw:NM[:INDEX]|NAME|FILE.csv",
             "on every surface with air on exactly one side, none elsewhere: a quarter-wave\n"
             "layer centred at NM nm (without INDEX of MgF2), a coating of the library, or\n"
             "measured reflectances; default: as the lens file says")
        ->group(group);
    add_text(command, "--internal-transmittance", options.internal_transmittance, "on|off",
             "whether glasses absorb as their catalogue says; default: as the lens file says")
        ->group(group);
    return lens;
}

void refuse_unfinished(const LoadedLens& loaded) {
    for (const Note& note : loaded.notes)
        if (note.severity == Note::Severity::error)
            throw Error({.problem = note.text + (note.proposal.empty() ? "" : ": ") + note.proposal,
                         .file = loaded.file.string(),
                         .where = note.where,
                         .found = {},
                         .expected = {}});
}

LoadedLens load_lens(const LensOptions& options) {
    LoadedLens loaded;
    loaded.file = find_lens(options.lens);
    auto [lens, notes] = read_lens(loaded.file);
    loaded.notes = std::move(notes);
    if (!options.takes_unfinished) refuse_unfinished(loaded);
    for (const Configuration& configuration : lens.configurations)
        loaded.configurations.push_back(configuration.name);
    loaded.configuration = options.config;
    loaded.lens =
        read_option("--config", [&, &listed = lens] { return configured(listed, options.config); });
    override_stop(loaded.lens, options);
    override_stop_shape(loaded.lens.stop, options.stop);
    if (!options.sensor.empty()) override_sensor(loaded.lens.sensor, options.sensor);
    if (!options.sensor_reflectance.empty())
        override_sensor_reflectance(loaded.lens.sensor, options.sensor_reflectance);
    if (!options.coating.empty())
        loaded.lens = with_air_coating(loaded.lens, parse_coating(options.coating));
    if (!options.internal_transmittance.empty())
        override_internal_transmittance(loaded, options.internal_transmittance);
    validate(loaded.lens);
    if (!options.f_number.empty() || !options.stop_semi_diameter.empty())
        note_capped_stop(loaded.lens, loaded.notes);
    return loaded;
}

std::vector<std::string> configurations_of(const LensOptions& options) {
    if (options.config.empty()) return {""};
    LensOptions listed = options;
    listed.config.clear();
    listed.f_number.clear();
    const std::vector<std::string> known = load_lens(listed).configurations;
    if (std::ranges::find(known, options.config) != known.end()) return {options.config};
    if (options.config == "all") return known.empty() ? std::vector<std::string>{""} : known;
    std::vector<std::string> names;
    for (const std::string_view name : split(options.config, ',')) names.emplace_back(name);
    return names;
}

Coating parse_coating(std::string_view text) {
    if (const auto known = coating_in_words(text)) return *known;
    if (is_same_name(std::filesystem::path(text).extension().string(), ".csv"))
        return read_measured_csv(text);
    throw bad_value("--coating", text, coating_words() + ", or a table of reflectances FILE.csv");
}

CLI::Option* add_light(CLI::App& command, LightOptions& options) {
    auto* field = add_text(command, "--field", options.field, "DEG",
                           "angle of the light from the axis, degrees, -90 to 90");
    add_text(command, "--azimuth", options.azimuth, "DEG",
             "direction of the field around the axis, degrees; 90 is +y")
        ->capture_default_str();
    return field;
}

LightDirection light_direction(const LightOptions& options) {
    LightDirection light;
    light.field_deg = number_value("--field", options.field, "an angle in degrees from -90 to 90",
                                   [](double deg) { return deg >= -90.0 && deg <= 90.0; });
    light.azimuth_deg = number_value("--azimuth", options.azimuth, "an angle in degrees",
                                     [](double) { return true; });
    return light;
}

}  // namespace ghostlight::cli
