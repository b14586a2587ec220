#include "core/ghosts/ghost_query.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "core/error.h"

namespace ghostlight {
namespace {

using Kind = GhostCondition::Kind;

struct QuantityName {
    const char* words;  ///< as the reader splits them: lower case, one blank between
    GhostQuantity quantity;
};
/// Longer names first where one begins with another.
constexpr std::array quantity_names = {
    QuantityName{"relative flux", GhostQuantity::relative_flux},
    QuantityName{"relative", GhostQuantity::relative_flux},
    QuantityName{"flux", GhostQuantity::flux},
    QuantityName{"peak", GhostQuantity::peak},
    QuantityName{"x", GhostQuantity::x},
    QuantityName{"y", GhostQuantity::y},
    QuantityName{"rms radius", GhostQuantity::rms},
    QuantityName{"rms", GhostQuantity::rms},
    QuantityName{"on sensor", GhostQuantity::on_sensor},
    QuantityName{"r1", GhostQuantity::reflectance_1},
    QuantityName{"r2", GhostQuantity::reflectance_2},
    QuantityName{"angle 1", GhostQuantity::angle_1},
    QuantityName{"angle 2", GhostQuantity::angle_2},
    QuantityName{"focus", GhostQuantity::focus},
    QuantityName{"width", GhostQuantity::width},
    QuantityName{"height", GhostQuantity::height},
    QuantityName{"area", GhostQuantity::area},
};

constexpr const char* expected_condition =
    "a condition such as 'touches 7', 'focus within 5 mm of the sensor', 'above 1e-6', "
    "'on sensor above 50 %' or '5-3'";

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Words in lower case; commas, comparisons and per cent signs are words of their own.
std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    std::string word;
    const auto end_word = [&] {
        if (!word.empty()) words.push_back(std::exchange(word, {}));
    };
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (is_blank(c)) {
            end_word();
        } else if (c == ',' || c == '%' || c == '<' || c == '>') {
            end_word();
            words.emplace_back(1, c);
            if (k + 1 < text.size() && text[k + 1] == '=') ++k;  // >= is >
        } else {
            word += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        }
    }
    end_word();
    return words;
}

std::optional<double> number_in(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

class Reader {
   public:
    Reader(std::string_view text, std::size_t surface_count)
        : words_(words_of(text)), surface_count_(surface_count) {}

    GhostQuery query() {
        GhostQuery query;
        if (words_.empty()) return query;
        query.any_of.emplace_back();
        while (true) {
            query.any_of.back().push_back(condition());
            if (at_end()) return query;
            if (take("or")) {
                query.any_of.emplace_back();
            } else if (take(",") || take("and")) {
                take("and");  // ", and"
            } else {
                refuse("'and', ',' or 'or' between two conditions");
            }
        }
    }

   private:
    std::vector<std::string> words_;
    std::size_t next_ = 0;
    std::size_t surface_count_;

    bool at_end() const { return next_ >= words_.size(); }
    std::string_view peek(std::size_t ahead = 0) const {
        return next_ + ahead < words_.size() ? std::string_view(words_[next_ + ahead])
                                             : std::string_view();
    }
    bool take(std::string_view word) {
        if (peek() != word) return false;
        ++next_;
        return true;
    }
    /// All of some words, or none of them.
    bool take_all(std::string_view phrase) {
        const std::vector<std::string> wanted = words_of(phrase);
        for (std::size_t k = 0; k < wanted.size(); ++k)
            if (peek(k) != wanted[k]) return false;
        next_ += wanted.size();
        return true;
    }
    [[noreturn]] void refuse(const std::string& expected) const {
        throw Error({"this filter is not understood",
                     {},
                     {},
                     at_end() ? std::string("the end") : fmt::format("'{}'", words_[next_]),
                     expected});
    }

    double number(const char* expected) {
        const auto value = number_in(peek());
        if (!value) refuse(expected);
        ++next_;
        return *value;
    }

    bool is_surface(std::string_view word) const {
        const auto number = number_in(word);
        return word == "sensor" || (number && *number == std::floor(*number));
    }
    std::size_t surface() {
        if (take("sensor")) return surface_count_;
        const auto number = number_in(peek());
        if (!number || *number != std::floor(*number) || *number < 1.0 ||
            *number > static_cast<double>(surface_count_))
            refuse(fmt::format("a surface from 1 to {}, or 'sensor'", surface_count_));
        ++next_;
        return static_cast<std::size_t>(*number) - 1;
    }

    GhostCondition touching() {
        GhostCondition condition;
        take("surface") || take("surfaces");
        condition.surfaces.push_back(surface());
        while ((peek() == "or" || peek() == "," || peek() == "and") && is_surface(peek(1))) {
            if (peek() == "and") refuse("'or' between surfaces; or 'and touches' for both");
            ++next_;
            condition.surfaces.push_back(surface());
        }
        return condition;
    }

    /// "5-3", if the next word is one.
    std::optional<GhostCondition> named() {
        const std::string_view word = peek();
        const std::size_t dash = word.find('-');
        if (dash == std::string_view::npos || dash == 0 || number_in(word)) return std::nullopt;
        GhostCondition condition;
        condition.kind = Kind::is;
        std::string_view rest = word;
        while (true) {
            const std::size_t end = rest.find('-');
            const std::string_view part = rest.substr(0, end);
            const auto number = number_in(part);
            if (part == "sensor") {
                condition.surfaces.push_back(surface_count_);
            } else if (number && *number == std::floor(*number) && *number >= 1.0 &&
                       *number <= static_cast<double>(surface_count_)) {
                condition.surfaces.push_back(static_cast<std::size_t>(*number) - 1);
            } else {
                refuse(
                    fmt::format("a ghost such as 5-3, with surfaces from 1 to {}", surface_count_));
            }
            if (end == std::string_view::npos) break;
            rest.remove_prefix(end + 1);
        }
        ++next_;
        return condition;
    }

    GhostCondition focus_within() {
        GhostCondition condition;
        condition.kind = Kind::focus_within;
        condition.quantity = GhostQuantity::focus;
        condition.value = number("a distance in mm");
        take("mm");
        if (take("of")) {
            take("the");
            if (!take("sensor")) refuse("'sensor'");
        }
        return condition;
    }

    GhostCondition comparison(std::optional<GhostQuantity> quantity) {
        GhostCondition condition;
        condition.quantity = quantity.value_or(GhostQuantity::flux);
        if (take("above") || take("over") || take(">")) {
            condition.kind = Kind::above;
        } else if (take("below") || take("under") || take("<")) {
            condition.kind = Kind::below;
        } else {
            refuse(quantity ? "'above' or 'below' and a number" : expected_condition);
        }
        condition.value = number("a number");
        const bool percent = take("%");
        if (take("of")) {
            take("the");
            if (!take("strongest")) refuse("'strongest'");
            if (condition.quantity != GhostQuantity::flux) refuse("a flux, if of the strongest");
            condition.negated = condition.kind == Kind::below;
            condition.kind = Kind::above_strongest;
            condition.value *= percent ? 0.01 : 1.0;
            return condition;
        }
        const bool is_share = condition.quantity == GhostQuantity::on_sensor ||
                              condition.quantity == GhostQuantity::reflectance_1 ||
                              condition.quantity == GhostQuantity::reflectance_2;
        if (condition.quantity == GhostQuantity::relative_flux) {
            condition.value *= percent ? 0.01 : 1.0;
        } else if (percent && !is_share) {
            --next_;
            refuse("'% of the strongest', or a flux in mm2");
        }
        for (const char* unit : {"mm", "mm2", "mm²", "deg", "°", "e0"}) take(unit);
        return condition;
    }

    GhostCondition condition() {
        const bool negated = take("not") || take("except");
        GhostCondition read = plain_condition();
        read.negated = read.negated != negated;
        return read;
    }
    GhostCondition plain_condition() {
        if (take("touches") || take("touch") || take("touching")) return touching();
        if (take("surface") || take("surfaces")) return touching();
        if (take("is") || take("ghost")) {
            if (auto ghost = named()) return *ghost;
            refuse("a ghost such as 5-3");
        }
        if (auto ghost = named()) return *ghost;
        if (take_all("focus within") || take_all("focused within")) return focus_within();
        if (take_all("on the sensor"))
            return {Kind::above, false, GhostQuantity::on_sensor, 1e-9, {}};
        for (const QuantityName& name : quantity_names)
            if (take_all(name.words)) return comparison(name.quantity);
        return comparison(std::nullopt);
    }
};

bool meets(const GhostCondition& condition, const GhostRow& row, const GhostTable& table) {
    const auto& turns = row.path.reflections;
    switch (condition.kind) {
        case Kind::touches:
            return std::ranges::any_of(condition.surfaces, [&](std::size_t surface) {
                return std::ranges::find(turns, surface) != turns.end();
            });
        case Kind::is:
            return turns == condition.surfaces;
        case Kind::above:
            return value_of(row, condition.quantity) >= condition.value;
        case Kind::below:
            return value_of(row, condition.quantity) <= condition.value;
        case Kind::focus_within:
            return std::abs(value_of(row, GhostQuantity::focus)) <= condition.value;
        case Kind::above_strongest:
            break;
    }
    return !table.ghosts.empty() && row.flux_mm2 >= condition.value * table.ghosts.front().flux_mm2;
}

}  // namespace

GhostQuery parse_ghost_query(std::string_view text, std::size_t surface_count) {
    return Reader(text, surface_count).query();
}

double value_of(const GhostRow& row, GhostQuantity quantity) {
    constexpr double percent = 100.0;
    switch (quantity) {
        case GhostQuantity::flux:
            return row.flux_mm2;
        case GhostQuantity::relative_flux:
            return row.relative_flux;
        case GhostQuantity::peak:
            return row.peak_per_e0;
        case GhostQuantity::x:
            return row.centroid_x_mm;
        case GhostQuantity::y:
            return row.centroid_y_mm;
        case GhostQuantity::rms:
            return row.rms_radius_mm;
        case GhostQuantity::on_sensor:
            return percent * row.on_sensor;
        case GhostQuantity::reflectance_1:
            return percent * row.turns[0].reflectance;
        case GhostQuantity::reflectance_2:
            return percent * row.turns[1].reflectance;
        case GhostQuantity::angle_1:
            return row.turns[0].incidence_deg;
        case GhostQuantity::angle_2:
            return row.turns[1].incidence_deg;
        case GhostQuantity::focus:
            return row.paraxial.focus_from_sensor_mm;
        case GhostQuantity::width:
            return row.box.empty() ? 0.0 : row.box.x1_mm - row.box.x0_mm;
        case GhostQuantity::height:
            return row.box.empty() ? 0.0 : row.box.y1_mm - row.box.y0_mm;
        case GhostQuantity::area:
            break;
    }
    return row.area_mm2;
}

bool passes(const GhostQuery& query, const GhostRow& row, const GhostTable& table) {
    if (query.any_of.empty()) return true;
    return std::ranges::any_of(query.any_of, [&](const std::vector<GhostCondition>& all_of) {
        return std::ranges::all_of(all_of, [&](const GhostCondition& condition) {
            return meets(condition, row, table) != condition.negated;
        });
    });
}

}  // namespace ghostlight
