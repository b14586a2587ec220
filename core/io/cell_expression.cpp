#include "core/io/cell_expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/units.h"

namespace ghostlight {

namespace {

/// More than anybody types; brackets recurse, and text comes from clipboards.
constexpr std::size_t most_characters = 1000;
constexpr int most_depth = 64;

/// A value in the cell's units of length and of angle, and its dimension.
struct Quantity {
    double value = 0.0;
    int length = 0;  ///< power of a length
    int angle = 0;
    double literal = 0.0;  ///< of a number with a unit behind it: the number, and the unit's size
    double unit = 0.0;
    bool is_bare() const { return length == 0 && angle == 0; }
};

/// A unit as a ratio, so that 0.5in is 12.7 to the last bit.
struct UnitSize {
    std::string_view name;
    double size = 1.0;  ///< nm, or degrees
    bool is_angle = false;
};
constexpr std::array units = {
    UnitSize{"nm", 1.0},
    UnitSize{"um", 1e3},
    UnitSize{"mm", 1e6},
    UnitSize{"cm", 1e7},
    UnitSize{"m", 1e9},
    UnitSize{"mil", 25.4e3},
    UnitSize{"in", 25.4e6},
    UnitSize{"\"", 25.4e6},
    UnitSize{"ft", 304.8e6},
    UnitSize{"deg", 1.0, true},
    UnitSize{"rad", 180.0 / std::numbers::pi, true},
};

using Function = double (*)(double);
/// Of bare numbers; angles are degrees.
constexpr std::array<std::pair<std::string_view, Function>, 8> functions = {{
    {"sqrt", [](double x) { return std::sqrt(x); }},
    {"abs", [](double x) { return std::abs(x); }},
    {"sin", [](double x) { return std::sin(rad_from_deg(x)); }},
    {"cos", [](double x) { return std::cos(rad_from_deg(x)); }},
    {"tan", [](double x) { return std::tan(rad_from_deg(x)); }},
    {"asin", [](double x) { return deg_from_rad(std::asin(x)); }},
    {"acos", [](double x) { return deg_from_rad(std::acos(x)); }},
    {"atan", [](double x) { return deg_from_rad(std::atan(x)); }},
}};

/// The signs that people and spreadsheets write, in ASCII.
std::string plain_text(std::string_view text) {
    static constexpr std::pair<std::string_view, std::string_view> signs[] = {
        {"−", "-"},   {"–", "-"},  {"×", "*"},   {"·", "*"},  {"÷", "/"},      {"µm", "um"},
        {"μm", "um"}, {"″", "\""}, {"°", "deg"}, {"π", "pi"}, {"\u00a0", " "}, {"\u2009", " "}};
    std::string plain(text);
    for (const auto& [sign, ascii] : signs) {
        for (auto at = plain.find(sign); at != std::string::npos;
             at = plain.find(sign, at + ascii.size()))
            plain.replace(at, sign.size(), ascii);
    }
    if (plain.find('.') == std::string::npos) std::ranges::replace(plain, ',', '.');
    return plain;
}

class Reader {
   public:
    Reader(std::string text, CellUnit unit, std::string_view expected)
        : text_(std::move(text)), unit_(unit), expected_(expected) {}

    double run() {
        if (text_.size() > most_characters) refuse("too long an expression");
        skip_blanks();
        take('=');
        const Quantity result = sum();
        skip_blanks();
        if (at_ != text_.size()) refuse(fmt::format("cannot read '{}'", text_.substr(at_)));
        if (!result.is_bare() && !is_cells_own(result)) refuse("the unit is of another kind");
        if (!std::isfinite(result.value)) refuse("the result is not a finite number");
        return result.value;
    }

   private:
    [[noreturn]] void refuse(const std::string& problem) const {
        throw Error({problem,
                     {},
                     {},
                     text_.substr(0, 60),
                     fmt::format("{}, or arithmetic as =2*13.2, 0.5in, 1/3", expected_)});
    }

    bool is_cells_own(const Quantity& of) const {
        const int length = unit_ == CellUnit::mm || unit_ == CellUnit::nm ? 1
                           : unit_ == CellUnit::per_mm                    ? -1
                                                                          : 0;
        return of.length == length && of.angle == (unit_ == CellUnit::deg ? 1 : 0);
    }

    void skip_blanks() {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    }
    bool take(char sign) {
        skip_blanks();
        if (at_ >= text_.size() || text_[at_] != sign) return false;
        ++at_;
        return true;
    }

    Quantity sum() {
        Quantity left = product();
        for (;;) {
            const bool adds = take('+');
            if (!adds && !take('-')) return left;
            Quantity right = product();
            // A bare number beside a length is one in the cell's unit, as if it stood alone.
            const bool adopts =
                (left.is_bare() && is_cells_own(right)) || (right.is_bare() && is_cells_own(left));
            if (!adopts && (left.length != right.length || left.angle != right.angle))
                refuse("adds what has not the same unit");
            if (left.is_bare()) std::swap(left.length, right.length);
            if (left.angle == 0) std::swap(left.angle, right.angle);
            left = {adds ? left.value + right.value : left.value - right.value, left.length,
                    left.angle};
        }
    }

    Quantity product() {
        Quantity left = power();
        for (;;) {
            if (take('*')) {
                const Quantity right = power();
                left = {left.value * right.value, left.length + right.length,
                        left.angle + right.angle};
            } else if (take('/')) {
                const Quantity right = power();
                if (right.value == 0.0) refuse("divides by 0");
                const bool is_length_cell = unit_ == CellUnit::mm || unit_ == CellUnit::nm;
                if (is_length_cell && left.is_bare() && right.length == 1 && right.unit > 0.0)
                    left = {left.value * right.unit / right.literal, 1, 0};
                else
                    left = {left.value / right.value, left.length - right.length,
                            left.angle - right.angle};
            } else {
                return left;
            }
        }
    }

    /// −2^2 is −4, and 2^3^2 is 2^9, as in mathematics.
    Quantity power() {
        const Deeper guard(*this);
        if (take('-')) {
            const Quantity of = power();
            return {-of.value, of.length, of.angle, -of.literal, of.unit};
        }
        if (take('+')) return power();
        const Quantity base = primary();
        if (!take('^')) return base;
        const Quantity exponent = power();
        if (!exponent.is_bare()) refuse("an exponent has no unit");
        if (base.is_bare()) return {std::pow(base.value, exponent.value)};
        if (exponent.value != std::floor(exponent.value) || std::abs(exponent.value) > 9.0)
            refuse("a length takes whole exponents");
        const int whole = static_cast<int>(exponent.value);
        return {std::pow(base.value, whole), base.length * whole, base.angle * whole};
    }

    Quantity primary() {
        if (take('(')) return with_unit(in_brackets());
        skip_blanks();
        const std::string word = next_word();
        if (word == "pi") {
            at_ += word.size();
            return with_unit({std::numbers::pi});
        }
        for (const auto& [name, function] : functions) {
            if (word != name) continue;
            at_ += word.size();
            if (!take('(')) refuse(fmt::format("{} needs brackets", name));
            const Quantity of = in_brackets();
            if (of.length != 0) refuse(fmt::format("{} takes a number without a length", name));
            const double value = function(of.value);
            if (!std::isfinite(value)) refuse(fmt::format("{} has no value there", name));
            return with_unit({value});
        }
        if (!word.empty()) refuse(fmt::format("'{}' is not known here", word));
        double value = 0.0;
        const char* end = text_.data() + text_.size();
        const auto read = std::from_chars(text_.data() + at_, end, value);
        if (read.ec != std::errc{})
            refuse(at_ == text_.size() ? "a number is missing at the end"
                                       : fmt::format("cannot read '{}'", text_.substr(at_)));
        at_ = static_cast<std::size_t>(read.ptr - text_.data());
        return with_unit({value});
    }

    Quantity in_brackets() {
        const Quantity inside = sum();
        if (!take(')')) refuse("a bracket is not closed");
        return {inside.value, inside.length, inside.angle};
    }

    Quantity with_unit(Quantity of) {
        skip_blanks();
        const std::string word = next_word();
        if (word.empty()) return of;
        const auto known = std::ranges::find(units, word, &UnitSize::name);
        if (known == units.end()) refuse(fmt::format("'{}' is not a known unit", word));
        if (!of.is_bare()) refuse("two units for one number");
        at_ += word.size();
        const double own = unit_ == CellUnit::nm ? 1.0 : 1e6;  // nm
        // The larger over the smaller is a whole number or a short decimal.
        const double value = known->is_angle      ? of.value * known->size
                             : known->size >= own ? of.value * (known->size / own)
                                                  : of.value / (own / known->size);
        return {value, known->is_angle ? 0 : 1, known->is_angle ? 1 : 0, of.value,
                known->is_angle ? known->size : known->size / own};
    }

    std::string next_word() const {
        if (at_ < text_.size() && text_[at_] == '"') return "\"";
        std::size_t end = at_;
        while (end < text_.size() && std::isalpha(static_cast<unsigned char>(text_[end]))) ++end;
        return text_.substr(at_, end - at_);
    }

    struct Deeper {
        explicit Deeper(Reader& of) : reader(of) {
            if (++reader.depth_ > most_depth) reader.refuse("too many brackets");
        }
        ~Deeper() { --reader.depth_; }
        Deeper(const Deeper&) = delete;
        Deeper& operator=(const Deeper&) = delete;
        Reader& reader;
    };

    std::string text_;
    CellUnit unit_;
    std::string_view expected_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

}  // namespace

double read_cell_expression(std::string_view text, CellUnit unit, std::string_view expected) {
    return Reader(plain_text(text), unit, expected).run();
}

}  // namespace ghostlight
