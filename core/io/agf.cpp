#include "core/io/agf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include "core/io/read_text.h"
#include "core/io/same_name.h"
#include "core/io/word_lines.h"
#include "core/optics/dispersion_formula.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr std::size_t longest_excerpt = 60;
constexpr std::size_t most_glasses = 100'000;  // the largest makers have some hundreds

/// A glass on its way, and whether it is still any good.
struct Draft {
    CataloguedGlass glass;
    AgfGlass formula;
    bool usable = true;
};

class Reader {
   public:
    explicit Reader(const std::filesystem::path& file) {
        result_.file = file;
        result_.name = upper_case(file.stem().string());
    }

    GlassFile read(std::string_view text) {
        WordLines lines(text);
        for (WordLine line; lines.next(line);) take(line);
        finish_glass();
        if (glasses_seen_ == 0)
            throw Error({.problem = "this is no AGF glass catalogue",
                         .file = result_.file.string(),
                         .where = {},
                         .found = "no line that begins with NM",
                         .expected = "glasses as 'NM name formula code nd vd …'"});
        return std::move(result_);
    }

   private:
    void take(const WordLine& line) {
        const std::string key = upper_case(line.words.front());
        if (key == "NM") return begin_glass(line);
        if (key.starts_with("!") || key == "CC" || !draft_) return;
        if (key == "GC") {
            draft_->glass.comment = std::string(line.rest(1));
        } else if (key == "CD") {
            read_coefficients(line);
        } else if (key == "LD") {
            read_range(line);
        } else if (key == "IT") {
            read_transmittance(line);
        } else if (key != "ED" && key != "TD" && key != "OD" && key != "MD" && key != "BD") {
            warn(line, fmt::format("'{}' is not a known line", shown(line)), Note::Fate::left_out,
                 false);
        }
    }

    void begin_glass(const WordLine& line) {
        finish_glass();
        if (++glasses_seen_ > most_glasses)
            throw Error({.problem = "the catalogue has too many glasses",
                         .file = result_.file.string(),
                         .where = line.where(),
                         .found = {},
                         .expected = fmt::format("at most {}", most_glasses)});
        draft_.emplace();
        // A name may hold blanks; the formula's number is the first word that is one and is
        // followed by the code.
        std::size_t formula = 2;
        while (formula < line.words.size() && !parse_number(line.words[formula])) ++formula;
        if (formula >= line.words.size())
            return drop(line, fmt::format("'{}' has no formula", shown(line)));
        std::string& name = draft_->glass.medium.name;
        for (std::size_t i = 1; i < formula; ++i)
            name += (i > 1 ? " " : "") + std::string(line.words[i]);
        draft_->glass.where = line.where();
        draft_->glass.catalog = result_.name;
        const double number = *parse_number(line.words[formula]);
        if (number != std::floor(number) || number < 1.0 || number > last_agf_formula)
            return drop(
                line, fmt::format("{}: dispersion formula {} is not known; expected 1 to {}", name,
                                  line.words[formula], last_agf_formula));
        draft_->formula.formula = static_cast<int>(number);
        auto optional = [&](std::size_t word) {
            return word < line.words.size() ? parse_number(line.words[word]) : std::nullopt;
        };
        // 1 and 0 stand for "not given".
        if (const auto nd = optional(formula + 2); nd && *nd > 1.0) draft_->glass.listed_nd = nd;
        if (const auto vd = optional(formula + 3); vd && *vd > 0.0) draft_->glass.listed_vd = vd;
        if (const auto status = optional(formula + 5);
            status && *status >= 0.0 && *status <= 4.0 && *status == std::floor(*status))
            draft_->glass.status = static_cast<GlassStatus>(static_cast<int>(*status));
    }

    void read_coefficients(const WordLine& line) {
        if (!draft_->usable) return;
        const std::size_t most = agf_coefficient_count(draft_->formula.formula);
        for (std::size_t i = 1; i < line.words.size(); ++i) {
            const auto value = parse_number(line.words[i]);
            if (!value)
                return drop(line, fmt::format("{}: coefficient '{}' is not a number",
                                              draft_->glass.medium.name, excerpt(line.words[i])));
            if (draft_->formula.coefficients.size() < most) {
                draft_->formula.coefficients.push_back(*value);
            } else if (*value != 0.0) {
                warn(line,
                     fmt::format(
                         "{}: formula {} ({}) has {} coefficients; those beyond are not used",
                         draft_->glass.medium.name, draft_->formula.formula,
                         agf_formula_name(draft_->formula.formula), most),
                     Note::Fate::left_out, true);
                return;
            }
        }
    }

    void read_range(const WordLine& line) {
        if (line.words.size() < 3) return;
        const auto least = parse_number(line.words[1]), most = parse_number(line.words[2]);
        if (!least || !most || !(*least >= 0.0) || !(*most > *least))
            return warn(line,
                        fmt::format("{}: '{}' is not a range of wavelengths",
                                    draft_->glass.medium.name, shown(line)),
                        Note::Fate::left_out, false);
        draft_->formula.min_nm = nm_from_um(*least);
        draft_->formula.max_nm = nm_from_um(*most);
    }

    void read_transmittance(const WordLine& line) {
        if (line.words.size() < 4) return;
        const auto um = parse_number(line.words[1]), share = parse_number(line.words[2]),
                   mm = parse_number(line.words[3]);
        const bool usable =
            um && share && mm && *um > 0.0 && *share >= 0.0 && *share <= 1.0 && *mm > 0.0;
        if (usable) draft_->glass.medium.transmittance.push_back({nm_from_um(*um), *share, *mm});
        // Makers write '-' for what they did not measure.
        else if (line.words[2] != "-")
            warn(line,
                 fmt::format("{}: '{}' is not a transmittance", draft_->glass.medium.name,
                             shown(line)),
                 Note::Fate::left_out, false);
    }

    void finish_glass() {
        if (!draft_) return;
        Draft draft = std::move(*draft_);
        draft_.reset();
        CataloguedGlass& glass = draft.glass;
        if (!draft.usable) return;
        if (draft.formula.coefficients.empty()) {
            note(glass.where,
                 fmt::format("{} has no coefficients and is left out", glass.medium.name),
                 Note::Fate::left_out, true);
            return;
        }
        std::ranges::sort(glass.medium.transmittance, {}, [](const InternalTransmittance& at) {
            return std::tuple(at.wavelength_nm, at.thickness_mm);
        });
        glass.medium.dispersion = std::move(draft.formula);
        complete_glass(glass);
        if (glass.nd && glass.listed_nd && std::abs(*glass.nd - *glass.listed_nd) > index_agreement)
            add_note(result_.notes, index_disagreement(glass));
        result_.glasses.push_back(std::move(glass));
    }

    void drop(const WordLine& line, const std::string& why) {
        warn(line, why + "; the glass is left out", Note::Fate::left_out, true);
        draft_->usable = false;
    }

    void warn(const WordLine& line, const std::string& text, Note::Fate fate, bool matters) {
        note(line.where(), text, fate, matters);
    }
    void note(const std::string& where, const std::string& text, Note::Fate fate, bool matters) {
        add_note(result_.notes, {Note::Severity::warning, where, text, fate, matters, {}});
    }

    static std::string excerpt(std::string_view text) {
        return std::string(text.substr(0, longest_excerpt));
    }
    static std::string shown(const WordLine& line) { return excerpt(line.text); }

    GlassFile result_;
    std::optional<Draft> draft_;
    std::size_t glasses_seen_ = 0;
};

}  // namespace

GlassFile agf_from_text(std::string_view text, const std::filesystem::path& file) {
    return Reader(file).read(text);
}

GlassFile read_agf(const std::filesystem::path& file) {
    return agf_from_text(utf8_text(read_text(file)), file);
}

}  // namespace ghostlight
