#include "core/io/oslo_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/io/import_notes.h"

namespace ghostlight {
namespace {

constexpr std::size_t most_surfaces = 1002;  // with object and image
constexpr int highest_power = 60;

/// Surface commands that change what light does in a way that is not traced here.
struct Refused {
    std::string_view word, problem;
};
constexpr std::string_view not_centred = "a tilted or decentred surface: its ghosts would be wrong";
constexpr std::string_view not_round =
    "a surface that is not one of revolution: its ghosts would be wrong";
constexpr std::string_view diffractive = "a diffractive surface: its ghosts would be wrong";
constexpr std::string_view graded = "a medium of varying index: its rays would be wrong";
constexpr auto refused = std::to_array<Refused>({
    {"RFL", "a mirror: only lenses are traced, and its ghosts would be wrong"},
    {"RFH", "a mirror: only lenses are traced, and its ghosts would be wrong"},
    {"PFL", "a perfect lens has no surfaces that reflect: it has no ghosts"},
    {"TLA", not_centred},
    {"TLB", not_centred},
    {"TLC", not_centred},
    {"DCX", not_centred},
    {"DCY", not_centred},
    {"DCZ", not_centred},
    {"BEN", not_centred},
    {"GC", not_centred},
    {"CVX", not_round},
    {"RDX", not_round},
    {"CVY", not_round},
    {"CCX", not_round},
    {"DFR", diffractive},
    {"DOR", diffractive},
    {"DWV", diffractive},
    {"DF0", diffractive},
    {"DF1", diffractive},
    {"DF2", diffractive},
    {"GSP", diffractive},
    {"GOR", diffractive},
    {"HOR", diffractive},
    {"GRT", graded},
    {"GRC", graded},
    {"GRD", graded},
    {"LMO", "a group that is not sequential: its ghosts would be wrong"},
    {"FRN", "a Fresnel surface: its ghosts would be wrong"},
});

/// Only told apart from the unknown: they change nothing for flare.
constexpr auto harmless = std::to_array<std::string_view>(
    {"DRW", "TCE",  "DES", "SNO", "LNO", "PFM", "WW",     "APN",  "DT",  "NAT",  "GIH",
     "AMO", "TELE", "IMD", "AFO", "WRS", "EVZ", "DESIGN", "SDAD", "CLR", "XARM", "EC"});

double first_number(const OsloCommand& command, std::string_view expected) {
    return command.place.number(command.parts.empty() ? std::string_view{} : command.parts[0],
                                expected);
}

/// "AS12" → 12 after the prefix "AS"; nothing for anything else.
std::optional<int> number_after(std::string_view word, std::string_view prefix) {
    if (!word.starts_with(prefix) || word.size() == prefix.size()) return std::nullopt;
    word.remove_prefix(prefix.size());
    int value = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (status != std::errc{} || end != word.data() + word.size() || value < 0 || value > 10000)
        return std::nullopt;
    return value;
}

struct Reader {
    const std::string& file;
    Notes& notes;
    OsloText text = {};
    OsloSurface current = {};
    UnusedWords unused = {};
    bool begun = false, ended = false, in_object = true;
    std::size_t after_end = 0;

    void read(const OsloCommand& command);
    void begin(const OsloCommand& command);
    bool read_system(const OsloCommand& command);
    bool read_surface(const OsloCommand& command);
    bool read_asphere(const OsloCommand& command);
    void read_wavelengths(const OsloCommand& command);
    void read_aperture(const OsloCommand& command);
    void pick_up(const OsloCommand& command);
    void next_surface();
};

void Reader::begin(const OsloCommand& command) {
    begun = true;
    std::vector<double> numbers;
    for (std::size_t i = 1; i < command.parts.size(); ++i) {
        const auto number = parse_number(command.parts[i]);
        if (number)
            numbers.push_back(*number);
        else if (text.name.empty())
            text.name = clipped(command.parts[i], 200);
    }
    if (!numbers.empty()) text.efl = numbers[0];
}

void Reader::next_surface() {
    if (text.surfaces.size() >= most_surfaces)
        current.place.refuse("the lens has too many surfaces", "a further NXT", "at most 1000");
    text.surfaces.push_back(std::move(current));
    current = {};
}

void Reader::read_wavelengths(const OsloCommand& command) {
    // WV 0.58756 0.48613, or one at a time: WV2 0.48613.
    const auto index = number_after(command.word, "WV");
    std::vector<double> values;
    for (const std::string& part : command.parts)
        values.push_back(command.place.number(part, "a wavelength in µm"));
    for (const double value : values)
        if (!(value > 0.05 && value < 50.0))
            command.place.refuse("not a usable wavelength", fmt::format("{}", value),
                                 "a wavelength in µm");
    auto& all = text.wavelengths_um;
    if (!index) {
        if (!values.empty()) all = std::move(values);
    } else if (!values.empty() && *index >= 1 && *index <= 100) {
        if (all.size() < static_cast<std::size_t>(*index))
            all.resize(static_cast<std::size_t>(*index), values[0]);
        all[static_cast<std::size_t>(*index) - 1] = values[0];
    }
}

bool Reader::read_system(const OsloCommand& command) {
    const auto number = [&](std::string_view expected) { return first_number(command, expected); };
    const std::string& word = command.word;
    if (word == "EBR")
        text.beam_radius = number("the entrance beam's radius");
    else if (word == "NAO" || word == "NA")
        text.object_na = number("an aperture from 0 to 1");
    else if (word == "FNO" || word == "FNB")
        text.f_number = number("an f-number");
    else if (word == "ANG")
        text.field_deg = number("a field angle in degrees");
    else if (word == "OBH")
        text.object_height = number("an object height");
    else if (word == "GIH")
        text.image_height = number("an image height");
    else if (word == "UNI") {
        text.unit_mm = number("the millimetres of one lens unit");
        text.has_unit = true;
        if (!(text.unit_mm > 0.0 && text.unit_mm <= 1e6))
            command.place.refuse("not a usable unit", fmt::format("{}", text.unit_mm),
                                 "the millimetres of one lens unit, above 0");
    } else if (word.starts_with("WV"))
        read_wavelengths(command);
    else
        return false;
    return true;
}

void Reader::read_aperture(const OsloCommand& command) {
    current.aperture_place = command.place;
    std::string_view value;
    for (const std::string& part : command.parts) {
        if (is_same_name(part, "CHK"))
            current.aperture_checked = true;
        else if (value.empty())
            value = part;
    }
    if (value.empty() && current.aperture_checked) return;
    current.aperture = command.place.number(value, "a radius");
}

bool Reader::read_asphere(const OsloCommand& command) {
    constexpr std::array<std::string_view, 4> short_terms = {"AD", "AE", "AF", "AG"};
    if (const auto at = std::ranges::find(short_terms, command.word); at != short_terms.end()) {
        const int power = 4 + 2 * static_cast<int>(at - short_terms.begin());
        current.terms[power] = first_number(command, "a coefficient");
        return true;
    }
    if (command.word == "ASP") {
        const std::string kind = command.parts.empty() ? "" : upper_case(command.parts[0]);
        if (kind != "ASR" && kind != "ARA")
            command.place.refuse("an asphere of another kind: its shape is not known here",
                                 kind.empty() ? "nothing" : in_quotes(kind),
                                 "ASR (even powers) or ARA (all powers)");
        current.asphere = kind;
        return true;
    }
    if (const auto index = number_after(command.word, "AS")) {
        const double term = first_number(command, "a coefficient");
        // ASR: AS1 r², AS2 r⁴, …; ARA: AS1 r, AS2 r², ….
        const int power = current.asphere == "ARA" ? *index : 2 * *index;
        if (term == 0.0) return true;
        if (power == 0 || power > highest_power)
            command.place.refuse(power == 0 ? "an asphere with an offset" : "a power beyond use",
                                 command.word, "terms from the first to r^60");
        current.terms[power] = term;
        return true;
    }
    return false;
}

/// PK CV 3, PK THM -2 0.5: an earlier surface's value, or minus it, and a number added. Below 0 the
/// surface is counted back from this one.
void Reader::pick_up(const OsloCommand& command) {
    const std::string what = command.parts.empty() ? "" : upper_case(command.parts[0]);
    constexpr std::string_view expected =
        "CV, CVM, TH, THM, GLA or AP, an earlier surface and at most one number to add";
    const bool known = what == "CV" || what == "CVM" || what == "TH" || what == "THM" ||
                       what == "GLA" || what == "AP";
    const auto here = static_cast<double>(text.surfaces.size());
    double from = command.parts.size() < 2 ? here : parse_number(command.parts[1]).value_or(here);
    if (from < 0.0) from += here;
    if (!known || command.parts.size() > 3 || !(from >= 0.0 && from < here) ||
        from != std::floor(from))
        command.place.refuse("a pickup that is not done here", in_quotes(what), expected);
    const double added =
        command.parts.size() < 3 ? 0.0 : command.place.number(command.parts[2], expected);
    const OsloSurface& source = text.surfaces[static_cast<std::size_t>(from)];
    const double sign = what.ends_with('M') ? -1.0 : 1.0;
    if (what.starts_with("CV")) {
        double c = source.curvature.value_or(0.0);
        if (source.radius && *source.radius != 0.0) c = 1.0 / *source.radius;
        current.radius.reset();
        current.curvature = sign * c + added;
        current.conic = source.conic;
        current.asphere = source.asphere;
        for (const auto& [power, term] : source.terms) current.terms[power] = sign * term;
    } else if (what.starts_with("TH")) {
        current.thickness = sign * source.thickness.value_or(0.0) + added;
    } else if (what == "GLA") {
        current.glass = source.glass;
        current.glass_place = source.glass_place;
        current.glass_wavelengths_um = source.glass_wavelengths_um;
    } else {
        current.aperture = source.aperture;
        current.aperture_place = command.place;
        current.aperture_checked = source.aperture_checked;
    }
    note_converted(notes, command.place.where,
                   fmt::format("{} picked up from surface {}", what, from));
}

bool Reader::read_surface(const OsloCommand& command) {
    const std::string& word = command.word;
    if (word == "AIR")
        current.glass.clear();
    else if (word == "GLA") {
        if (command.parts.empty())
            command.place.refuse("no glass is named", "nothing", "a glass or indices");
        current.glass = command.parts;
        current.glass_place = command.place;
        current.glass_wavelengths_um = text.wavelengths_um;
    } else if (word == "RD")
        current.radius = first_number(command, "a radius, 0 for a plane");
    else if (word == "CV")
        current.curvature = first_number(command, "a curvature");
    else if (word == "TH")
        current.thickness = first_number(command, "a thickness");
    else if (word == "CC")
        current.conic = first_number(command, "a conic constant");
    else if (word == "AP")
        read_aperture(command);
    else if (word == "AST")
        current.is_stop = true;
    else if (word == "PY")
        current.height_solve = first_number(command, "a ray height");
    else if (word == "PU")
        current.slope_solve = first_number(command, "a ray slope");
    else if (word == "PK")
        pick_up(command);
    else if (word == "NOT" || word == "LNT")
        current.note = command.parts.empty() ? "" : clipped(command.parts[0], 200);
    else
        return read_asphere(command);
    return true;
}

void Reader::read(const OsloCommand& command) {
    if (ended) {
        ++after_end;
        return;
    }
    if (!begun) {
        if (command.word == "LEN")
            begin(command);
        else
            unused.add(command.word, command.place.where);
        return;
    }
    if (current.place.file.empty()) current.place = command.place;
    if (command.word == "NXT") {
        next_surface();
        return;
    }
    if (command.word == "END") {
        next_surface();
        ended = true;
        return;
    }
    const auto forbidden = std::ranges::find(refused, command.word, &Refused::word);
    if (forbidden != refused.end()) {
        const auto value = command.parts.empty() ? std::nullopt : parse_number(command.parts[0]);
        if (value != 0.0)
            command.place.refuse(forbidden->problem, command.word,
                                 "centred surfaces of revolution between glasses");
        return;
    }
    if (read_system(command) || read_surface(command)) return;
    const bool is_harmless = std::ranges::any_of(harmless, [&](std::string_view word) {
        return command.word == word || number_after(command.word, word).has_value();
    });
    if (is_harmless) return;
    unused.add(command.word, command.place.where);
}

}  // namespace

void for_each_oslo_command(std::string_view text, const std::string& file,
                           const std::function<void(const OsloCommand&)>& work) {
    for (const TextLine& line : text_lines(text)) {
        OsloCommand command{{file, fmt::format("line {}", line.number)}, {}, {}};
        std::string part;
        bool in_quotes_now = false, any = false;
        const auto end_part = [&] {
            if (any && command.word.empty())
                command.word = upper_case(part);
            else if (any)
                command.parts.push_back(part);
            part.clear();
            any = false;
        };
        const auto end_command = [&] {
            end_part();
            if (!command.word.empty()) work(command);
            command.word.clear();
            command.parts.clear();
        };
        for (std::size_t i = 0; i < line.text.size(); ++i) {
            const char c = line.text[i];
            if (in_quotes_now) {
                if (c == '"')
                    in_quotes_now = false;
                else
                    part += c;
            } else if (c == '"') {
                in_quotes_now = any = true;
            } else if (c == '/' && line.text.substr(i, 2) == "//") {
                break;
            } else if (c == ';') {
                end_command();
            } else if (c == ' ' || c == '\t') {
                end_part();
            } else {
                part += c;
                any = true;
            }
        }
        end_command();
    }
}

OsloText read_oslo_text(std::string_view text, const std::string& file, Notes& notes) {
    Reader reader{file, notes};
    for_each_oslo_command(text, file, [&](const OsloCommand& command) { reader.read(command); });
    if (!reader.begun) Place{file, {}}.refuse("not an OSLO lens", "no LEN", "LEN NEW \"name\" …");
    if (!reader.ended) {
        note_noticed(notes, {}, "the file ends without END: it may be cut short", true,
                     "compare the number of surfaces");
        reader.next_surface();
    }
    if (reader.text.surfaces.size() < 3)
        Place{file, {}}.refuse("the lens has no surfaces",
                               fmt::format("{} blocks", reader.text.surfaces.size()),
                               "object, surfaces and image, separated by NXT");
    if (reader.after_end > 0)
        note_left_out(notes, {},
                      fmt::format("{} commands after END (variables, operands, zoom positions)",
                                  reader.after_end));
    reader.unused.report(notes);
    return std::move(reader.text);
}

}  // namespace ghostlight
