#include "core/io/zmx_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "core/io/import_notes.h"
#include "core/io/text_lines.h"

namespace ghostlight {
namespace {

/// Words that say nothing about where light goes in the lens as it stands: the program's settings,
/// drawing, optimisation, tolerances, solves whose result is in the file.
const std::unordered_set<std::string_view> bookkeeping = {
    "PFIL", "LANG", "GFAC", "RAIM", "PUSH", "SDMA", "ROPD", "PICB", "POLS", "GLRS",
    "GSTD", "NSCD", "TOL",  "FWGN", "FWGT", "WWGT", "WWGN", "HIDE", "MIRR", "SLAB",
    "POPS", "VDSZ", "VPAR", "VCUR", "PZUP", "MOFF", "FCOM", "BLNK", "SCOL", "RSCE",
    "RWRE", "OMMA", "HYPR", "FIMP", "COCO", "VANN", "VCON", "CGTT", "PPAR", "CCUR",
    "DMFS", "MEMA", "VXDA", "USAP", "PARX", "BBND", "RTOL", "TOLS", "GRPH",
};

/// Operands of the multi-configuration editor.
const std::unordered_set<std::string_view> configuration_words = {
    "THIC", "CRVT", "GLSS", "CONN", "PRAM", "PAR1", "PAR2", "PAR3", "PAR4", "PAR5", "PAR6", "PAR7",
    "PAR8", "EDVA", "APER", "YFIE", "XFIE", "FTYP", "WAVE", "WLWT", "FLWT", "FVCY", "FVCX", "FVDY",
    "FVDX", "FVAN", "LTTL", "SDIA", "PRWV", "STPS", "IGNR", "IGNM", "MOFF", "COTN", "TEMP", "PRES",
    "MIND", "MABB", "MDPG", "HOLD", "MCOM", "CATN", "APMX", "APMN", "APTP", "APDX", "APDY", "TELE",
    "SATP", "CSP1", "CSP2", "CSP3", "CROR", "RAAM", "CWGT", "LWAV", "GPEX", "GPEY", "NPAR", "NPOS",
    "SRTS", "TSP1", "TSP2", "TSP3", "TCEX", "MOFF", "PSP1", "PSP2", "PSP3", "UDAF", "PXAR", "SWCN",
};

/// What is in the quotes, or what stands without any.
std::string unquoted(std::string_view text) {
    text = trimmed(text);
    const std::size_t begin = text.find('"');
    if (begin == text.npos) return std::string(text);
    const std::size_t end = text.find('"', begin + 1);
    return std::string(text.substr(begin + 1, end == text.npos ? text.npos : end - begin - 1));
}

class ZmxReader {
   public:
    ZmxReader(std::string_view text, const std::string& file, Notes& notes)
        : text_(text), place_{file, {}}, notes_(notes) {}

    ZmxFile run() {
        for (const TextLine& line : text_lines(text_)) {
            words_ = words(line.text);
            if (words_.empty()) continue;
            place_.where = fmt::format("line {}", line.number);
            const std::string word = upper_case(words_.front());
            rest_ = trimmed(trimmed(line.text).substr(words_.front().size()));
            if (word == "SURF") {
                start_surface();
            } else if (!surface_record(word) && !system_record(word) && !operand(word)) {
                if (bookkeeping.contains(word))
                    ++skipped_[word];
                else
                    unused_.add(word, place_.where);
            }
        }
        if (!skipped_.empty()) {
            std::string list;
            for (const auto& [word, count] : skipped_) list += (list.empty() ? "" : " ") + word;
            note_left_out(notes_, {},
                          "settings, drawing and solves, which do not change the lens as it "
                          "stands: " +
                              list);
        }
        unused_.report(notes_);
        return std::move(file_);
    }

   private:
    double number(std::size_t index, std::string_view expected) {
        return place_.number(index < words_.size() ? words_[index] : std::string_view{}, expected);
    }
    std::optional<double> maybe(std::size_t index) const {
        return index < words_.size() ? parse_number(words_[index]) : std::nullopt;
    }
    int whole(std::size_t index, std::string_view expected) {
        constexpr double largest = 1e6;
        const double value = number(index, expected);
        if (value != std::floor(value) || std::abs(value) > largest)
            place_.refuse("not a whole number", in_quotes(words_[index]), expected);
        return static_cast<int>(value);
    }
    std::optional<int> maybe_whole(std::size_t index) const {
        const auto value = maybe(index);
        if (!value || *value != std::floor(*value) || std::abs(*value) > 1e6) return std::nullopt;
        return static_cast<int>(*value);
    }
    /// All numbers from a word on, up to the first that is none.
    std::vector<double> numbers(std::size_t from) const {
        std::vector<double> all;
        for (std::size_t i = from; i < words_.size(); ++i) {
            const auto value = parse_number(words_[i]);
            if (!value) break;
            all.push_back(*value);
        }
        return all;
    }

    void start_surface() {
        constexpr std::size_t most_surfaces = 5000;
        if (file_.surfaces.size() == most_surfaces)
            place_.refuse("too many surfaces", fmt::format("more than {}", most_surfaces),
                          "a lens");
        ZmxSurface surface;
        surface.where = fmt::format("SURF {} ({})", file_.surfaces.size(), place_.where);
        const auto listed = maybe_whole(1);
        if (!listed || *listed != static_cast<int>(file_.surfaces.size()))
            note_noticed(
                notes_, place_.where,
                fmt::format("SURF {} where SURF {} was due: surfaces are taken in the "
                            "order of the file",
                            in_quotes(words_.size() > 1 ? words_[1] : ""), file_.surfaces.size()),
                true);
        file_.surfaces.push_back(std::move(surface));
        in_surface_ = true;
    }

    bool surface_record(const std::string& word) {
        if (!in_surface_) return false;
        ZmxSurface& surface = file_.surfaces.back();
        if (word == "TYPE") {
            surface.type = words_.size() > 1 ? upper_case(words_[1]) : "STANDARD";
        } else if (word == "CURV") {
            surface.curvature = number(1, "a curvature");
        } else if (word == "DISZ") {
            if (words_.size() > 1 && upper_case(words_[1]).starts_with("INF"))
                surface.infinite = true;
            else
                surface.thickness = number(1, "a thickness or INFINITY");
        } else if (word == "CONI") {
            surface.conic = number(1, "a conic constant");
        } else if (word == "STOP") {
            surface.stop = true;
        } else if (word == "DIAM") {
            surface.diameter =
                ZmxDiameter{number(1, "a semi-diameter"), maybe(2).value_or(0.0) != 0.0};
        } else if (word == "GLAS") {
            read_glass(surface);
        } else if (word == "PARM" || word == "XDAT") {
            auto& values = word == "PARM" ? surface.parameters : surface.extra;
            values[whole(1, "a parameter's number")] = number(2, "a parameter's value");
        } else if (word == "COMM") {
            surface.comment = std::string(rest_);
        } else if (word == "COAT") {
            surface.coating = words_.size() > 1 ? std::string(words_[1]) : "";
            surface.coating_where = place_.where;
        } else if (word == "CLAP" || word == "FLAP" || word == "OBSC" || word == "SQAP" ||
                   word == "SQOB" || word == "ELAP" || word == "ELOB" || word == "OBDC" ||
                   word == "SPID" || word == "UDAD" || word == "UDOB") {
            surface.apertures.push_back({word, place_.where, numbers(1)});
        } else if (word == "TCOM" || word == "TOLE") {
            auto& solve = word == "TCOM" ? surface.complement : surface.position;
            if (const auto from = maybe_whole(1), total = from; from && maybe(2))
                solve = std::pair{*total, *maybe(2)};
        } else if (word == "MAZH") {
            surface.at_paraxial_focus =
                maybe(1).value_or(0.0) == 0.0 && maybe(2).value_or(0.0) == 0.0;
            ++skipped_[word];
        } else {
            return false;
        }
        return true;
    }

    void read_glass(ZmxSurface& surface) {
        ZmxGlass glass;
        glass.where = place_.where;
        glass.name = words_.size() > 1 ? std::string(words_[1]) : "";
        glass.kind = maybe_whole(2).value_or(0);
        glass.pickup_from = maybe_whole(3).value_or(0);
        glass.nd = maybe(4);
        glass.vd = maybe(5);
        glass.dpgf = maybe(6);
        surface.glass = std::move(glass);
    }

    void aperture(ZmxFile::Aperture kind) {
        file_.aperture = kind;
        file_.aperture_where = place_.where;
        // FLOA has no number of its own.
        if (kind != ZmxFile::Aperture::stop_size) file_.aperture_value = number(1, "a number");
        file_.aperture_flag = maybe_whole(2).value_or(0);
    }

    bool system_record(const std::string& word) {
        using Aperture = ZmxFile::Aperture;
        if (word == "VERS") {
            file_.version = std::string(rest_);
        } else if (word == "MODE") {
            file_.mode = upper_case(rest_);
            file_.mode_where = place_.where;
        } else if (word == "NAME") {
            file_.name = std::string(rest_);
        } else if (word == "NOTE") {
            // NOTE i text; i numbers the pages of the notes.
            std::string_view text = rest_;
            if (maybe(1)) text = trimmed(text.substr(words_[1].size()));
            if (!text.empty()) file_.notes.emplace_back(text);
        } else if (word == "UNIT") {
            file_.unit = words_.size() > 1 ? upper_case(words_[1]) : "MM";
            file_.unit_where = place_.where;
        } else if (word == "ENPD") {
            aperture(Aperture::entrance_pupil);
        } else if (word == "FNUM") {
            aperture(Aperture::f_number);
        } else if (word == "OBNA") {
            aperture(Aperture::object_na);
        } else if (word == "FLOA") {
            aperture(Aperture::stop_size);
        } else if (word == "FTYP" && !(in_surface_ && words_.size() > 3 && file_.field_count)) {
            field_types();
        } else if (word == "XFLN" || word == "XFLD") {
            file_.x_fields = numbers(1);
        } else if (word == "YFLN" || word == "YFLD") {
            file_.y_fields = numbers(1);
            file_.fields_where = place_.where;
        } else if (word == "VDXN" || word == "ZVDX") {
            file_.vdx = numbers(1);
        } else if (word == "VDYN" || word == "ZVDY") {
            file_.vdy = numbers(1);
        } else if (word == "VCXN" || word == "ZVCX") {
            file_.vcx = numbers(1);
        } else if (word == "VCYN" || word == "ZVCY") {
            file_.vcy = numbers(1);
        } else if (word == "WAVM") {
            if (const auto index = maybe_whole(1); index && maybe(2))
                file_.waves_um[*index] = *maybe(2);
        } else if (word == "WAVL" || word == "WAVN") {
            const std::vector<double> waves = numbers(1);
            for (std::size_t i = 0; i < waves.size(); ++i)
                file_.waves_um[static_cast<int>(i) + 1] = waves[i];
        } else if (word == "PWAV") {
            file_.primary_wave = maybe_whole(1);
        } else if (word == "GCAT") {
            for (std::size_t i = 1; i < words_.size(); ++i) file_.catalogs.emplace_back(words_[i]);
        } else if (word == "COFN") {
            // COFN COATING.DAT …, or COFN QF "COATING.DAT" … with names in quotes.
            if (words_.size() > 1 && words_[1] != "QF")
                file_.coating_file = std::string(words_[1]);
            else if (words_.size() > 2)
                file_.coating_file = unquoted(rest_);
        } else if (word == "ENVD") {
            file_.temperature_c = maybe(1).value_or(20.0);
            file_.pressure_atm = maybe(2).value_or(1.0);
            file_.environment_where = place_.where;
        } else if (word == "MNUM") {
            constexpr int most = 1000;
            file_.configurations = std::clamp(maybe_whole(1).value_or(1), 1, most);
            file_.active = maybe_whole(2).value_or(1);
        } else {
            return false;
        }
        return true;
    }

    /// FTYP type telecentric fields waves … afocal.
    void field_types() {
        file_.field_type = maybe_whole(1).value_or(0);
        file_.telecentric = maybe(2).value_or(0.0) != 0.0;
        const auto count = [&](std::size_t index) -> std::optional<std::size_t> {
            const auto value = maybe_whole(index);
            if (!value || *value < 1) return std::nullopt;
            return static_cast<std::size_t>(*value);
        };
        file_.field_count = count(3);
        file_.wave_count = count(4);
        file_.afocal = maybe(7).value_or(0.0) != 0.0;
    }

    /// WORD target configuration value …; text values are in quotes.
    bool operand(const std::string& word) {
        if (!configuration_words.contains(word)) return false;
        const auto target = maybe_whole(1), configuration = maybe_whole(2);
        if (!target || !configuration) return false;
        ZmxOperand read{word, place_.where, *target, *configuration, maybe(3), {}};
        if (!read.value && words_.size() > 3) {
            const std::size_t third = static_cast<std::size_t>(words_[3].data() - rest_.data());
            const std::string_view from = rest_.substr(std::min(third, rest_.size()));
            read.text = from.starts_with('"') ? unquoted(from) : std::string(words_[3]);
        }
        file_.operands.push_back(std::move(read));
        return true;
    }

    std::string_view text_;
    Place place_;
    Notes& notes_;
    ZmxFile file_;
    std::vector<std::string_view> words_;
    std::string_view rest_;
    bool in_surface_ = false;
    std::map<std::string, int> skipped_;
    UnusedWords unused_;
};

}  // namespace

ZmxFile zmx_records(std::string_view text, const std::string& file, Notes& notes) {
    return ZmxReader(text, file, notes).run();
}

}  // namespace ghostlight
