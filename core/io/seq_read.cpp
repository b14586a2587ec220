#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/io/import_notes.h"
#include "core/io/imported_asphere.h"
#include "core/io/imported_fields.h"
#include "core/io/json_value.h"
#include "core/io/seq.h"
#include "core/io/seq_commands.h"
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

struct SeqSurface {
    std::string where;
    std::optional<double> first;      ///< of the S row: radius or curvature
    std::optional<double> curvature;  ///< by RDY or CUY, per unit
    double thickness = 0.0;
    std::string glass, glass_where, label;
    std::optional<double> glass_vd;  ///< S radius thickness nd vd
    double conic = 0.0;
    bool is_asphere = false;
    std::map<int, double> terms;
    std::optional<double> semi_diameter;
};

class SeqImport {
   public:
    explicit SeqImport(const FormatSource& source)
        : file_(source.file.string()), commands_(seq_commands(source.text)) {}

    ImportedLens run() {
        read_private_glasses();
        bool in_private = false;
        for (const SeqCommand& command : commands_) {
            where_ = command.where;
            if (command.name == "PRV") {
                in_private = true;
            } else if (in_private) {
                in_private = command.name != "END";
            } else {
                run(command);
            }
        }
        return finish();
    }

   private:
    Place place() const { return {file_, where_}; }
    Notes& notes() { return imported_.notes; }

    void read_private_glasses() {
        bool inside = false;
        for (const SeqCommand& command : commands_) {
            if (command.name == "PRV")
                inside = true;
            else if (command.name == "END")
                inside = false;
            else if (inside)
                private_.add(command, notes());
        }
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
                skipped_.insert(name);
            else
                unused_.add(name, where_);
        }
    }

    /// "GRT" and the like switch something off with N.
    void refuse_kind(const SeqCommand& command, std::string_view meaning) {
        for (const SeqWord& word : command.words)
            if (same_word(word.text, "N")) return;
        place().refuse(
            fmt::format("{} ({}): its ghosts would be wrong here", meaning, command.name),
            fmt::format("surface {}", rows_.size() - 1),
            "refracting surfaces of revolution about one axis");
    }

    /// SO, S, S3, SI: curve, thickness, glass.
    bool surface_row(const SeqCommand& command) {
        const std::string& name = command.name;
        const bool is_next = name == "S" || name == "SO" || name == "SI" || is_numbered(name);
        if (!is_next) return false;
        constexpr std::size_t most_rows = 5000;
        if (rows_.size() >= most_rows)
            place().refuse("too many surfaces", fmt::format("more than {}", most_rows), "a lens");
        if (name == "SO" || name == "S0") {
            if (!rows_.empty())
                place().refuse("a second object surface", name, "one SO, before the surfaces");
        } else if (rows_.empty()) {
            rows_.emplace_back();  // no SO: an object far away
            rows_.front().thickness = 2.0 * far_away_mm;
        }
        if (name == "SI") has_image_ = true;
        rows_.emplace_back();
        SeqSurface& row = rows_.back();
        row.where =
            fmt::format("S{} ({})", name == "SI" ? "I" : std::to_string(rows_.size() - 1), where_);
        current_ = rows_.size() - 1;
        if (!command.words.empty()) row.first = number(command, 0, "a radius or curvature");
        if (command.words.size() > 1) row.thickness = number(command, 1, "a thickness");
        if (command.words.size() > 2) {
            row.glass = command.words[2].text;
            row.glass_where = where_;
            if (command.words.size() > 3 && parse_number(row.glass))
                row.glass_vd = parse_number(command.words[3].text);
            else
                for (std::size_t i = 3; i < command.words.size(); ++i)
                    unused_.add(command.words[i].text, where_);
        }
        return true;
    }

    /// "S4" as the fourth surface of a list.
    bool is_numbered(const std::string& name) const {
        if (name.size() < 2 || name[0] != 'S') return false;
        const auto value = parse_number(std::string_view(name).substr(1));
        return value && *value == static_cast<double>(std::max<std::size_t>(rows_.size(), 1));
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
        if (word == "SI") return rows_.size() - 1;
        const auto value = parse_number(std::string_view(word).substr(1));
        if (!value || *value < 0.0 || *value >= static_cast<double>(rows_.size()) ||
            *value != std::floor(*value))
            return std::nullopt;
        return static_cast<std::size_t>(*value);
    }

    bool system_word(const SeqCommand& command) {
        const std::string& name = command.name;
        const auto value = [&] { return number(command, 0, "a number"); };
        if (name == "RDM") {
            const bool no = !command.words.empty() && same_word(command.words[0].text, "N");
            radius_mode_ = !no;
        } else if (name == "TITLE" || name == "TIT") {
            read_title(command);
        } else if (name == "DIM") {
            read_dimension(command);
        } else if (name == "EPD" || name == "FNO" || name == "NA" || name == "NAO") {
            if (zoomed(command)) return true;
            aperture_ = name;
            aperture_value_ = value();
            aperture_where_ = where_;
        } else if (name == "WL") {
            wavelengths_nm_ = numbers(command, 0);
            note_left_out(
                notes(), where_,
                "wavelengths " + joined(wavelengths_nm_) + " nm: lights choose their own here");
        } else if (name == "XAN" || name == "YAN" || name == "XOB" || name == "YOB" ||
                   name == "XIM" || name == "YIM" || name == "XRI" || name == "YRI") {
            if (zoomed(command)) return true;
            field_kind_ = name.substr(1);
            (name[0] == 'X' ? fields_.x : fields_.y) = numbers(command, 0);
            if (name[0] == 'Y') fields_.where = where_;
        } else if (name == "VUY" || name == "VLY" || name == "VUX") {
            if (zoomed(command)) return true;
            (name == "VUY"   ? fields_.cut_upper
             : name == "VLY" ? fields_.cut_lower
                             : fields_.cut_sides) = numbers(command, 0);
        } else if (name == "REF") {
            reference_ = parse_number(command.words.empty() ? "" : command.words[0].text);
        } else if (name == "PIM") {
            paraxial_image_ = true;
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
                zoom_left_out_.emplace(command.name, where_);
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
            zoom_names_[*zoom] = clipped(command.words[1].text, 60);
        else
            imported_.lens.name = clipped(command.words[0].text, 300);
    }

    void read_dimension(const SeqCommand& command) {
        const std::string word =
            command.words.empty() ? "" : upper_case(command.words[0].text).substr(0, 1);
        if (word != "M" && word != "C" && word != "I")
            place().refuse("not a known unit", word.empty() ? "nothing" : in_quotes(word),
                           "DIM M (mm), C (cm) or I (inches)");
        mm_ = word == "C" ? 10.0 : word == "I" ? 25.4 : 1.0;
        if (mm_ != 1.0)
            note_converted(
                notes(), where_,
                fmt::format("lengths in {}: times {} to mm", word == "C" ? "cm" : "inches", mm_));
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
        if (rows_.empty()) {
            unused_.add(name, where_);
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
        SeqSurface& row = rows_[*which];
        const std::string surface_text = fmt::format("surface {}", *which);
        const auto value = [&](std::string_view expected) {
            return number(command, next, expected);
        };
        if (is_coefficient) {
            const int power = 4 + 2 * static_cast<int>(coefficient_letters.find(name[0]));
            row.terms[power] = value("a coefficient");
            row.is_asphere = true;
        } else if (displaces) {
            if (value("a number") != 0.0) displaced_.emplace_back(*which, name, where_);
        } else if (name == "STO") {
            if (imported_stop_ && *imported_stop_ != *which)
                note_noticed(notes(), where_, "a second stop: the later one is used", true);
            imported_stop_ = *which;
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
                zoom_thickness_[*which][zoom->first] = zoom->second;
            } else if (next < command.words.size() && parse_number(command.words[next].text)) {
                row.thickness = value("a thickness");
            } else {
                skipped_.insert("THI … (a solve)");
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
            constexpr double most = 1000.0;
            positions_ = static_cast<std::size_t>(std::clamp(*count, 1.0, most));
            return;
        }
        if (what == "TIT" || what == "THC") return;
        if (what == "EPD") {
            const std::vector<double> values = numbers(command, 1);
            for (std::size_t i = 0; i < values.size(); ++i) zoom_pupil_[i + 1] = values[i];
            return;
        }
        if (what == "FNO" || (what == "THI" && command.words.size() > 2)) {
            const std::vector<double> values = numbers(command, what == "FNO" ? 1 : 2);
            if (what == "FNO") {
                for (std::size_t i = 0; i < values.size(); ++i) zoom_f_number_[i + 1] = values[i];
                return;
            }
            SeqCommand of_surface = command;
            of_surface.words.erase(of_surface.words.begin());
            std::size_t next = 0;
            if (const auto which = surface_of(of_surface, next); which && next == 1) {
                for (std::size_t i = 0; i < values.size(); ++i)
                    zoom_thickness_[*which][i + 1] = values[i];
                return;
            }
        }
        zoom_left_out_.emplace("ZOO " + what, where_);
    }

    ImportedLens finish();
    bool decide_radius_mode();
    bool is_reference_d_line() const;
    void build_row(std::size_t number);
    void set_aperture(std::optional<double> object_mm);
    void set_zoom();
    void check_displacements();

    std::string file_, where_;
    std::vector<SeqCommand> commands_;
    ImportedLens imported_;
    PrivateGlasses private_;
    std::vector<SeqSurface> rows_;  ///< 0 is the object
    std::size_t current_ = 0;
    bool has_image_ = false, paraxial_image_ = false;
    std::optional<bool> radius_mode_;
    double mm_ = 1.0;
    std::string aperture_, aperture_where_;
    double aperture_value_ = 0.0;
    std::vector<double> wavelengths_nm_;
    std::optional<double> reference_;
    std::string field_kind_;
    ListedFields fields_;
    std::optional<std::size_t> imported_stop_;
    std::vector<std::tuple<std::size_t, std::string, std::string>> displaced_;
    std::size_t positions_ = 1;
    std::map<std::size_t, std::string> zoom_names_;
    std::map<std::size_t, std::map<std::size_t, double>> zoom_thickness_;  ///< surface → zoom
    std::map<std::size_t, double> zoom_f_number_, zoom_pupil_;
    std::map<std::string, std::string> zoom_left_out_;
    std::set<std::string> skipped_;
    UnusedWords unused_;
};

/// Without RDM the format's default is curvatures, but files of other programs mean radii: what
/// can only be one of them decides, else their size.
bool SeqImport::decide_radius_mode() {
    bool radii_possible = true, curvatures_possible = true, all_small = true, any_large = false;
    std::size_t curved = 0;
    const double pupil = aperture_ == "EPD" ? 0.5 * aperture_value_ : 0.0;
    for (std::size_t i = 1; i < rows_.size(); ++i) {
        const double value = std::abs(rows_[i].first.value_or(0.0));
        if (value == 0.0) continue;
        ++curved;
        const double height = rows_[i].semi_diameter.value_or(pupil);
        // No sphere is wider than its radius. 0.7: heights inside the lens are a little smaller
        // than in the pupil.
        if (value < 0.7 * height) radii_possible = false;
        if (1.0 / value < 0.7 * height) curvatures_possible = false;
        all_small = all_small && value < 0.2;
        any_large = any_large || value > 2.0;
    }
    if (curved == 0) return true;
    bool radii = any_large;
    std::string why =
        any_large ? "some are far too large for curvatures" : "which is the format's default";
    if (radii_possible != curvatures_possible) {
        radii = radii_possible;
        why = radii ? "as curvatures the surfaces would be too small for the beam"
                    : "as radii the surfaces would be too small for the beam";
    } else if (all_small) {
        radii = false;
        why = "all are below 0.2";
    }
    note_assumed(notes(), {},
                 fmt::format("the file does not say whether its surfaces are given by radius or "
                             "curvature (RDM): they are taken as {} ({})",
                             radii ? "radii" : "curvatures", why),
                 true,
                 "check the focal length; convert --radii-are-curvatures reads them the other way");
    return radii;
}

bool SeqImport::is_reference_d_line() const {
    constexpr double same_nm = 0.5;
    const double index = reference_.value_or(1.0) - 1.0;
    return index >= 0.0 && index < static_cast<double>(wavelengths_nm_.size()) &&
           std::abs(wavelengths_nm_[static_cast<std::size_t>(index)] - d_line_nm) < same_nm;
}

void SeqImport::build_row(std::size_t number) {
    const SeqSurface& from = rows_[number];
    const std::size_t row = number - 1;
    Surface& made = imported_.lens.surfaces[row];
    imported_.surfaces[row].where = from.where;
    double curvature = from.curvature.value_or(0.0);
    if (!from.curvature && from.first && *from.first != 0.0)
        curvature = *radius_mode_ ? 1.0 / *from.first : *from.first;
    constexpr double flat_radius = 1e15;  // programs write planes as such radii
    if (curvature != 0.0 && std::abs(curvature) > 1.0 / flat_radius) {
        const bool by_radius = !from.curvature && *radius_mode_;
        made.curve = by_radius ? BaseCurve{Radius{*from.first * mm_}}
                               : BaseCurve{Curvature{curvature / mm_}};
    } else {
        curvature = 0.0;
    }
    made.conic = from.conic;
    made.thickness_mm = from.thickness * mm_;
    made.comment = from.label;
    if (!from.glass.empty()) {
        const auto nd = parse_number(from.glass);
        made.medium_after = from.glass_vd && nd
                                ? seq_glass(fmt::format("{}:{}", from.glass, *from.glass_vd),
                                            private_, file_, from.glass_where, notes())
                                : seq_glass(from.glass, private_, file_, from.glass_where, notes());
    }
    RadialSurface radial{curvature / mm_, from.conic, {}};
    for (const auto& [power, value] : from.terms)
        if (value != 0.0) radial.terms[power] = value * std::pow(mm_, 1 - power);
    if (!radial.terms.empty()) set_asphere(imported_, row, radial, {file_, from.where});
}

void SeqImport::set_aperture(std::optional<double> object_mm) {
    if (aperture_.empty()) return;
    if (!(aperture_value_ > 0.0)) {
        note_noticed(notes(), aperture_where_,
                     fmt::format("{} is {}: not used", aperture_, aperture_value_), true);
    } else if (aperture_ == "EPD") {
        imported_.entrance_pupil_diameter_mm = aperture_value_ * mm_;
        note_read(
            notes(), aperture_where_,
            fmt::format("entrance pupil diameter {} mm", format_number(aperture_value_ * mm_)));
    } else if (aperture_ == "FNO" || aperture_ == "NA") {
        imported_.f_number = aperture_ == "FNO" ? aperture_value_ : 0.5 / aperture_value_;
        const std::string text = fmt::format("f-number {:.6g}", *imported_.f_number);
        if (aperture_ == "NA" || object_mm)
            note_converted(notes(), aperture_where_,
                           text + (object_mm ? " at the file's finite distance: taken as that at "
                                               "infinity"
                                             : " from the image-side NA"),
                           object_mm.has_value());
        else
            note_read(notes(), aperture_where_, text);
    } else {
        const auto order = first_order_so_far(imported_);
        if (!object_mm || !order || !(aperture_value_ < 1.0)) {
            note_left_out(notes(), aperture_where_, "object-side NA has no meaning here", true,
                          "set the f-number or the stop's size");
            return;
        }
        imported_.entrance_pupil_diameter_mm = 2.0 *
                                               std::abs(*object_mm + order->entrance_pupil_z_mm) *
                                               std::tan(std::asin(aperture_value_));
        note_converted(
            notes(), aperture_where_,
            fmt::format("object-side NA {}: an entrance pupil {:.6g} mm wide",
                        format_number(aperture_value_), *imported_.entrance_pupil_diameter_mm),
            true);
    }
}

void SeqImport::set_zoom() {
    if (positions_ > 1) {
        const std::size_t count = imported_.lens.surfaces.size();
        std::set<std::string> names;
        for (std::size_t zoom = 1; zoom <= positions_; ++zoom) {
            Configuration made;
            const auto name = zoom_names_.find(zoom);
            if (name != zoom_names_.end()) made.name = name->second;
            if (made.name.empty() || names.contains(made.name))
                made.name = fmt::format("zoom {}", zoom);
            names.insert(made.name);
            for (const auto& [surface, values] : zoom_thickness_)
                if (const auto value = values.find(zoom);
                    value != values.end() && surface >= 1 && surface <= count)
                    made.thickness_mm[surface - 1] = value->second * mm_;
            if (const auto f = zoom_f_number_.find(zoom);
                f != zoom_f_number_.end() && f->second > 0.0)
                made.f_number = f->second;
            if (const auto pupil = zoom_pupil_.find(zoom);
                pupil != zoom_pupil_.end() && pupil->second > 0.0)
                imported_.configuration_pupils_mm[made.name] = pupil->second * mm_;
            imported_.lens.configurations.push_back(std::move(made));
        }
        note_read(notes(), {}, fmt::format("{} zoom positions", positions_));
        if (zoom_thickness_.contains(0)) zoom_left_out_.emplace("THI of the object", "");
    }
    for (const auto& [word, where] : zoom_left_out_) {
        const bool of_rays = word.find("VU") != word.npos || word.find("VL") != word.npos ||
                             word.find("AN") != word.npos || word.find("WT") != word.npos;
        note_left_out(notes(), where,
                      fmt::format("{} changes with the zoom position", in_quotes(word)), !of_rays);
    }
}

void SeqImport::check_displacements() {
    std::size_t last_lens = 0;
    for (std::size_t i = 1; i + 1 < rows_.size(); ++i)
        if (!rows_[i].glass.empty() || rows_[i].first.value_or(0.0) != 0.0) last_lens = i;
    for (const auto& [surface, word, where] : displaced_) {
        if (surface <= last_lens)
            Place{file_, where}.refuse(
                "a surface is decentred or tilted: ghosts of a lens off its axis would be wrong "
                "here",
                fmt::format("{} of surface {}", word, surface),
                "refracting surfaces of revolution about one axis");
        note_left_out(notes(), where,
                      fmt::format("{} behind the lens: the sensor stands upright on "
                                  "the axis here",
                                  word),
                      true);
    }
}

ImportedLens SeqImport::finish() {
    if (rows_.size() < 3)
        Place{file_, {}}.refuse("no lens: there is no surface between object and image",
                                fmt::format("{} surfaces", rows_.size()), "SO, at least one S, SI");
    if (!has_image_)
        note_noticed(notes(), rows_.back().where,
                     "the file has no image surface (SI): the last surface is taken for it", true);
    if (!radius_mode_) radius_mode_ = decide_radius_mode();
    check_displacements();
    const std::size_t count = rows_.size() - 2;
    imported_.lens.surfaces.resize(count);
    imported_.surfaces.resize(count);
    for (std::size_t row = 0; row < count; ++row)
        if (rows_[row + 1].semi_diameter)
            imported_.surfaces[row].semi_diameter_mm = *rows_[row + 1].semi_diameter * mm_;
    for (std::size_t number = 1; number <= count; ++number) build_row(number);
    if (!rows_.front().glass.empty() && !same_word(rows_.front().glass, "AIR"))
        note_left_out(notes(), rows_.front().where,
                      "a medium in front of the lens: light comes through air here", true);
    if (imported_stop_ && *imported_stop_ >= 1 && *imported_stop_ <= count) {
        imported_.stop = *imported_stop_ - 1;
    } else if (!imported_stop_) {
        imported_.stop = 0;
        note_assumed(notes(), {}, "no STO: the stop is on surface 1, the format's default", true,
                     "set the stop to the surface where the iris is");
    }
    // The image plane's own thickness is its defocus from where the last one ends.
    const double defocus_mm = rows_.back().thickness * mm_;
    imported_.sensor_distance_mm = rows_[count].thickness * mm_ + defocus_mm;
    // PIM keeps the image at the paraxial focus of the reference wavelength. At another one than d
    // the thickness that it gave says it better.
    if (paraxial_image_ && defocus_mm == 0.0 &&
        (rows_[count].thickness == 0.0 || is_reference_d_line())) {
        imported_.sensor_distance_mm.reset();
        note_read(notes(), rows_[count].where,
                  fmt::format("PIM keeps the image at the paraxial focus, {} mm behind the last "
                              "surface in the file",
                              format_number(rows_[count].thickness * mm_)));
    }
    if (defocus_mm != 0.0)
        note_converted(notes(), rows_.back().where,
                       fmt::format("the image's defocus of {} mm is added to the last thickness",
                                   format_number(defocus_mm)));
    if (rows_.back().first.value_or(0.0) != 0.0)
        note_left_out(notes(), rows_.back().where,
                      "the image surface is curved: the sensor is flat", true);
    const double object_mm = rows_.front().thickness * mm_;
    std::optional<double> finite_object_mm;
    if (std::abs(object_mm) < far_away_mm) {
        finite_object_mm = object_mm;
        note_noticed(notes(), rows_.front().where,
                     fmt::format("the object is {} mm in front of the first surface",
                                 format_number(object_mm)),
                     true,
                     "lights are infinitely far here; the sensor stays where the file focuses");
    }
    set_aperture(finite_object_mm);
    set_zoom();
    using Kind = ListedFields::Kind;
    fields_.kind = field_kind_ == "OB"                          ? Kind::object_height_mm
                   : field_kind_ == "IM" || field_kind_ == "RI" ? Kind::image_height_mm
                                                                : Kind::angle_deg;
    if (fields_.kind != Kind::angle_deg)
        for (auto* values : {&fields_.x, &fields_.y})
            for (double& value : *values) value *= mm_;
    set_fields(imported_, fields_, finite_object_mm);
    if (!skipped_.empty()) {
        std::string list;
        for (const std::string& word : skipped_) list += (list.empty() ? "" : " ") + word;
        note_left_out(
            notes(), {},
            "labels, settings and solves, which do not change the lens as it stands: " + list);
    }
    unused_.report(notes());
    note_read(notes(), {},
              fmt::format("{} surfaces between object and image, numbered as in the file", count));
    return std::move(imported_);
}

}  // namespace

bool is_seq(std::string_view text) {
    bool object = false, surface = false, image = false;
    for (const SeqCommand& command : seq_commands(text.substr(0, 65536))) {
        const std::size_t words = command.words.size();
        object = object || ((command.name == "SO" || command.name == "RDM" ||
                             command.name == "LEN" || command.name == "DIM"));
        surface = surface || ((command.name == "S" || command.name == "S1") && words >= 1 &&
                              parse_number(command.words[0].text));
        image = image || command.name == "SI";
    }
    return surface && (object || image);
}

ImportedLens import_seq(const FormatSource& source) { return SeqImport(source).run(); }

}  // namespace ghostlight
