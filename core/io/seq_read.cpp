#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/io/import_notes.h"
#include "core/io/imported_asphere.h"
#include "core/io/imported_fields.h"
#include "core/io/json_value.h"
#include "core/io/seq_commands.h"
#include "core/io/seq_contents.h"
#include "core/io/seq_glass.h"
#include "core/io/text_lines.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// Say nothing about where light goes in the lens as it stands: settings, labels, optimisation,
/// tolerances, solves whose result is in the file.
constexpr std::array bookkeeping = {
    "LEN", "INI", "TEM", "PRE", "CLS", "CCY", "THC", "CUM", "THM", "DER", "WTW",
    "WTF", "PIK", "GLC", "CCC", "KC",  "AC",  "BC",  "CC",  "DC",  "EC",  "FC",
    "GC",  "HC",  "JC",  "DOR", "UID", "CRS", "GL1", "VLX", "SPH", "INC", "DLT",
    "DLF", "DLR", "DLN", "TIR", "BTX", "BTY", "DSX", "DSY", "CMP", "CAN", "IN",
    "OUT", "DDM", "SRF", "CNF", "MNT", "TRA", "DAR", "REV", "RET", "GO",  "VER",
};

/// Shift, tilt or bend the axis.
constexpr std::array displacing = {"XDE", "YDE", "ZDE", "ADE", "BDE", "CDE"};
/// Not of revolution, diffractive, or with an index that varies: refused.
struct Refused {
    std::string_view word, meaning;
};
constexpr std::array refused = {
    Refused{"BEN", "a bent axis (a fold mirror)"},
    Refused{"CYL", "a cylinder"},
    Refused{"YTO", "a toroid"},
    Refused{"XTO", "a toroid"},
    Refused{"AAS", "an anamorphic asphere"},
    Refused{"SPS", "a special surface"},
    Refused{"SPL", "a spline surface"},
    Refused{"UDS", "a surface that the user's own code defines"},
    Refused{"DIF", "a diffractive surface"},
    Refused{"DOE", "a diffractive surface"},
    Refused{"GRT", "a diffraction grating"},
    Refused{"HOE", "a hologram"},
    Refused{"GRI", "a gradient index"},
    Refused{"MOD", "an ideal lens module"},
    Refused{"NSS", "a non-sequential range"},
    Refused{"ARR", "an array"},
};

/// Coefficients of aspheres: r⁴ is A, …, r²⁰ is J; there is no I.
constexpr std::string_view coefficient_letters = "ABCDEFGHJ";

constexpr double far_away_mm = 1e8;

class SeqReader {
   public:
    explicit SeqReader(const FormatSource& source) : text_(source.text) {
        read_.file = source.file.string();
    }

    SeqContents run() {
        read_private_glasses();
        bool in_private = false;
        for_each_seq_command(text_, [&](const SeqCommand& command) {
            where_ = command.where;
            if (command.name == "PRV") {
                in_private = true;
            } else if (in_private) {
                in_private = command.name != "END";
            } else {
                run(command);
            }
        });
        return std::move(read_);
    }

   private:
    Place place() const { return {read_.file, where_}; }
    Notes& notes() { return read_.imported.notes; }

    void read_private_glasses() {
        bool inside = false;
        for_each_seq_command(text_, [&](const SeqCommand& command) {
            if (command.name == "PRV")
                inside = true;
            else if (command.name == "END")
                inside = false;
            else if (inside)
                read_.private_glasses.add(command, notes());
        });
    }

    std::vector<double> numbers(const SeqCommand& command, std::size_t from) const {
        std::vector<double> all;
        for (std::size_t i = from; i < command.words.size(); ++i) {
            const auto value = parse_number(command.words[i].text);
            if (!value) break;
            all.push_back(*value);
        }
        return all;
    }
    double number(const SeqCommand& command, std::size_t index, std::string_view expected) const {
        return place().number(
            index < command.words.size() ? std::string_view(command.words[index].text) : "",
            expected);
    }

    void run(const SeqCommand& command) {
        const std::string& name = command.name;
        if (!surface_row(command) && !system_word(command) && !surface_word(command)) {
            if (const auto found = std::ranges::find(refused, name, &Refused::word);
                found != refused.end())
                refuse_kind(command, found->meaning);
            if (std::ranges::find(bookkeeping, name) != bookkeeping.end())
                read_.skipped.insert(name);
            else
                read_.unused.add(name, where_);
        }
    }

    /// "GRT" and the like switch something off with N.
    void refuse_kind(const SeqCommand& command, std::string_view meaning) {
        for (const SeqWord& word : command.words)
            if (is_same_name(word.text, "N")) return;
        place().refuse(
            fmt::format("{} ({}): its ghosts would be wrong here", meaning, command.name),
            fmt::format("surface {}", read_.rows.size() - 1),
            "refracting surfaces of revolution about one axis");
    }

    /// SO, S, S3, SI: curve, thickness, glass.
    bool surface_row(const SeqCommand& command) {
        const std::string& name = command.name;
        const bool is_next = name == "S" || name == "SO" || name == "SI" || is_numbered(name);
        if (!is_next) return false;
        constexpr std::size_t most_rows = 5000;
        if (read_.rows.size() >= most_rows)
            place().refuse("too many surfaces", fmt::format("more than {}", most_rows), "a lens");
        if (name == "SO" || name == "S0") {
            if (!read_.rows.empty())
                place().refuse("a second object surface", name, "one SO, before the surfaces");
        } else if (read_.rows.empty()) {
            read_.rows.emplace_back();  // no SO: an object far away
            read_.rows.front().thickness = 2.0 * far_away_mm;
        }
        if (name == "SI") read_.has_image = true;
        read_.rows.emplace_back();
        SeqSurface& row = read_.rows.back();
        row.where = fmt::format("S{} ({})",
                                name == "SI" ? "I" : std::to_string(read_.rows.size() - 1), where_);
        current_ = read_.rows.size() - 1;
        if (!command.words.empty()) row.first = number(command, 0, "a radius or curvature");
        if (command.words.size() > 1) row.thickness = number(command, 1, "a thickness");
        if (command.words.size() > 2) {
            row.glass = command.words[2].text;
            row.glass_where = where_;
            if (command.words.size() > 3 && parse_number(row.glass))
                row.glass_vd = parse_number(command.words[3].text);
            else
                for (std::size_t i = 3; i < command.words.size(); ++i)
                    read_.unused.add(command.words[i].text, where_);
        }
        return true;
    }

    /// "S4" as the fourth surface of a list.
    bool is_numbered(const std::string& name) const {
        if (name.size() < 2 || name[0] != 'S') return false;
        const auto value = parse_number(std::string_view(name).substr(1));
        return value && *value == static_cast<double>(std::max<std::size_t>(read_.rows.size(), 1));
    }

    /// The surface that a command's first word names, else the one last begun; `next` is where the
    /// values begin.
    std::optional<std::size_t> surface_of(const SeqCommand& command, std::size_t& next) const {
        next = 0;
        if (command.words.empty() || command.words[0].quoted) return current_;
        const std::string word = upper_case(command.words[0].text);
        if (word.size() < 2 || word[0] != 'S') return current_;
        next = 1;
        if (word == "SO") return 0;
        if (word == "SI") return read_.rows.size() - 1;
        const auto value = parse_number(std::string_view(word).substr(1));
        if (!value || *value < 0.0 || *value >= static_cast<double>(read_.rows.size()) ||
            *value != std::floor(*value))
            return std::nullopt;
        return static_cast<std::size_t>(*value);
    }

    bool system_word(const SeqCommand& command) {
        const std::string& name = command.name;
        const auto value = [&] { return number(command, 0, "a number"); };
        if (name == "RDM") {
            const bool no = !command.words.empty() && is_same_name(command.words[0].text, "N");
            read_.radius_mode = !no;
        } else if (name == "TITLE" || name == "TIT") {
            read_title(command);
        } else if (name == "DIM") {
            read_dimension(command);
        } else if (name == "EPD" || name == "FNO" || name == "NA" || name == "NAO") {
            if (zoomed(command)) return true;
            read_.aperture = name;
            read_.aperture_value = value();
            read_.aperture_where = where_;
        } else if (name == "WL") {
            read_.wavelengths_nm = numbers(command, 0);
            note_left_out(notes(), where_,
                          "wavelengths " + joined(read_.wavelengths_nm) +
                              " nm: lights choose their own here");
        } else if (name == "XAN" || name == "YAN" || name == "XOB" || name == "YOB" ||
                   name == "XIM" || name == "YIM" || name == "XRI" || name == "YRI") {
            if (zoomed(command)) return true;
            read_.field_kind = name.substr(1);
            (name[0] == 'X' ? read_.fields.x : read_.fields.y) = numbers(command, 0);
            if (name[0] == 'Y') read_.fields.where = where_;
        } else if (name == "VUY" || name == "VLY" || name == "VUX") {
            if (zoomed(command)) return true;
            (name == "VUY"   ? read_.fields.cut_upper
             : name == "VLY" ? read_.fields.cut_lower
                             : read_.fields.cut_sides) = numbers(command, 0);
        } else if (name == "REF") {
            read_.reference = parse_number(command.words.empty() ? "" : command.words[0].text);
        } else if (name == "PIM") {
            read_.paraxial_image = true;
        } else if (name == "ZOO" || name == "ZOOM") {
            read_zoom(command);
        } else {
            return false;
        }
        return true;
    }

    static std::string joined(const std::vector<double>& values) {
        std::string text;
        for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 24); ++i)
            text += (i > 0 ? ", " : "") + format_number(values[i]);
        return text;
    }

    /// "EPD Z2 5": a value of one zoom position alone.
    bool zoomed(const SeqCommand& command) {
        for (const SeqWord& word : command.words)
            if (!word.quoted && zoom_number(word.text)) {
                read_.zoom_left_out.emplace(command.name, where_);
                return true;
            }
        return false;
    }

    static std::optional<std::size_t> zoom_number(std::string_view word) {
        if (word.size() < 2 || (word[0] != 'Z' && word[0] != 'z')) return std::nullopt;
        const auto value = parse_number(word.substr(1));
        constexpr double most = 1000.0;
        if (!value || *value < 1.0 || *value > most || *value != std::floor(*value))
            return std::nullopt;
        return static_cast<std::size_t>(*value);
    }

    void read_title(const SeqCommand& command) {
        if (command.words.empty()) return;
        if (const auto zoom = zoom_number(command.words[0].text);
            zoom && !command.words[0].quoted && command.words.size() > 1)
            read_.zoom_names[*zoom] = clipped(command.words[1].text, 60);
        else
            read_.imported.lens.name = clipped(command.words[0].text, 300);
    }

    void read_dimension(const SeqCommand& command) {
        const std::string word =
            command.words.empty() ? "" : upper_case(command.words[0].text).substr(0, 1);
        if (word != "M" && word != "C" && word != "I")
            place().refuse("not a known unit", word.empty() ? "nothing" : in_quotes(word),
                           "DIM M (mm), C (cm) or I (inches)");
        read_.mm = word == "C" ? 10.0 : word == "I" ? 25.4 : 1.0;
        if (read_.mm != 1.0)
            note_converted(notes(), where_,
                           fmt::format("lengths in {}: times {} to mm",
                                       word == "C" ? "cm" : "inches", read_.mm));
    }

    bool surface_word(const SeqCommand& command) {
        const std::string& name = command.name;
        std::size_t next = 0;
        const bool is_coefficient =
            name.size() == 1 && coefficient_letters.find(name[0]) != std::string_view::npos;
        static const std::set<std::string, std::less<>> words = {
            "STO", "SLB", "CIR", "CON", "ASP", "K",   "THI", "RDY", "CUY",
            "GLA", "GL2", "RMD", "REX", "REY", "ELX", "ELY", "ADX", "ADY",
            "CUF", "IC",  "RFR", "RDX", "CUX", "HWL", "HOR", "HCT", "HCO"};
        const bool displaces = std::ranges::find(displacing, name) != displacing.end();
        if (!is_coefficient && !displaces && !words.contains(name)) return false;
        if (read_.rows.empty()) {
            read_.unused.add(name, where_);
            return true;
        }
        const auto which = surface_of(command, next);
        if (!which) {
            note_left_out(notes(), where_,
                          fmt::format("{} of a surface that is named otherwise than by its number: "
                                      "{}",
                                      name, in_quotes(command.words[0].text)),
                          true);
            return true;
        }
        SeqSurface& row = read_.rows[*which];
        const std::string surface_text = fmt::format("surface {}", *which);
        const auto value = [&](std::string_view expected) {
            return number(command, next, expected);
        };
        if (is_coefficient) {
            const int power = 4 + 2 * static_cast<int>(coefficient_letters.find(name[0]));
            row.terms[power] = value("a coefficient");
            row.is_asphere = true;
        } else if (displaces) {
            if (value("a number") != 0.0) read_.displaced.emplace_back(*which, name, where_);
        } else if (name == "STO") {
            if (read_.imported_stop && *read_.imported_stop != *which)
                note_noticed(notes(), where_, "a second stop: the later one is used", true);
            read_.imported_stop = *which;
        } else if (name == "SLB") {
            if (next < command.words.size()) row.label = clipped(command.words[next].text, 300);
        } else if (name == "CIR") {
            read_circle(command, next, row, surface_text);
        } else if (name == "K") {
            row.conic = value("a conic constant");
        } else if (name == "CON" || name == "ASP" || name == "RFR") {
            // Kinds alone; what shapes the surface follows.
        } else if (name == "THI") {
            if (const auto zoom = zoom_value(command, next); zoom) {
                read_.zoom_thickness[*which][zoom->first] = zoom->second;
            } else if (next < command.words.size() && parse_number(command.words[next].text)) {
                row.thickness = value("a thickness");
            } else {
                read_.skipped.insert("THI … (a solve)");
            }
        } else if (name == "RDY") {
            const double radius = value("a radius");
            row.curvature = radius == 0.0 ? 0.0 : 1.0 / radius;
        } else if (name == "CUY") {
            row.curvature = value("a curvature");
        } else if (name == "GLA") {
            row.glass = next < command.words.size() ? command.words[next].text : "";
            row.glass_where = where_;
        } else if (name == "RMD") {
            if (next < command.words.size() &&
                upper_case(command.words[next].text).starts_with("REFL"))
                place().refuse("a mirror: lenses with mirrors cannot be traced here", surface_text,
                               "refracting surfaces");
        } else if (name == "CUF") {
            if (value("a curvature") != 0.0)
                place().refuse("a Fresnel surface (CUF): its ghosts would be wrong here",
                               surface_text, "refracting surfaces of revolution");
        } else if (name == "RDX" || name == "CUX") {
            place().refuse("a surface with another curvature in x: its ghosts would be wrong here",
                           surface_text, "refracting surfaces of revolution");
        } else if (name.starts_with("H")) {
            place().refuse("a diffractive surface (" + name + "): its ghosts would be wrong here",
                           surface_text, "refracting surfaces of revolution");
        } else {
            note_left_out(notes(), where_,
                          fmt::format("{}: {} of the opening: the clear edge is a circle about the "
                                      "axis here",
                                      surface_text,
                                      name == "ADX" || name == "ADY" ? "decentre"
                                      : name[0] == 'R'               ? "rectangle"
                                                                     : "ellipse"),
                          true);
        }
        return true;
    }

    std::optional<std::pair<std::size_t, double>> zoom_value(const SeqCommand& command,
                                                             std::size_t next) const {
        if (next + 1 >= command.words.size()) return std::nullopt;
        const auto zoom = zoom_number(command.words[next].text);
        const auto value = parse_number(command.words[next + 1].text);
        if (!zoom || !value) return std::nullopt;
        return std::pair{*zoom, *value};
    }

    /// CIR [Sk] [EDG|OBS|HOL|CLR] [L'label'] radius
    void read_circle(const SeqCommand& command, std::size_t next, SeqSurface& row,
                     const std::string& surface_text) {
        std::string modifier;
        for (; next < command.words.size() && !parse_number(command.words[next].text); ++next)
            if (!upper_case(command.words[next].text).starts_with("L'"))
                modifier = upper_case(command.words[next].text);
        const double radius = number(command, next, "a radius");
        if (modifier.empty() || modifier == "CLR") {
            row.semi_diameter = radius;
        } else if (modifier == "EDG") {
            note_left_out(notes(), where_, surface_text + ": the edge of the glass (CIR EDG)");
        } else {
            note_left_out(notes(), where_,
                          fmt::format("{}: {} (CIR {})", surface_text,
                                      modifier == "OBS"   ? "a central obstruction"
                                      : modifier == "HOL" ? "a hole"
                                                          : "an opening of a kind not known",
                                      modifier),
                          true);
        }
    }

    /// ZOO n | ZOO TIT | ZOO THI S5 v1 v2 … | ZOO FNO v1 v2 …
    void read_zoom(const SeqCommand& command) {
        if (command.words.empty()) return;
        const std::string what = upper_case(command.words[0].text);
        if (const auto count = parse_number(what)) {
            // CODE V itself has fewer; each becomes a configuration that is checked by itself.
            constexpr double most = 100.0;
            if (!(*count >= 1.0 && *count <= most))
                place().refuse("not a usable number of zoom positions", in_quotes(what),
                               "1 to 100");
            read_.positions = static_cast<std::size_t>(*count);
            return;
        }
        if (what == "TIT" || what == "THC") return;
        if (what == "EPD") {
            const std::vector<double> values = numbers(command, 1);
            for (std::size_t i = 0; i < values.size(); ++i) read_.zoom_pupil[i + 1] = values[i];
            return;
        }
        if (what == "FNO" || (what == "THI" && command.words.size() > 2)) {
            const std::vector<double> values = numbers(command, what == "FNO" ? 1 : 2);
            if (what == "FNO") {
                for (std::size_t i = 0; i < values.size(); ++i)
                    read_.zoom_f_number[i + 1] = values[i];
                return;
            }
            SeqCommand of_surface = command;
            of_surface.words.erase(of_surface.words.begin());
            std::size_t next = 0;
            if (const auto which = surface_of(of_surface, next); which && next == 1) {
                for (std::size_t i = 0; i < values.size(); ++i)
                    read_.zoom_thickness[*which][i + 1] = values[i];
                return;
            }
        }
        read_.zoom_left_out.emplace("ZOO " + what, where_);
    }

    std::string where_;
    std::string_view text_;
    std::size_t current_ = 0;
    SeqContents read_;
};

}  // namespace

SeqContents seq_contents(const FormatSource& source) { return SeqReader(source).run(); }

}  // namespace ghostlight
