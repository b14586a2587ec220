#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/fit/fit_kinds.h"
#include "core/optics/optical_system.h"
#include "core/units.h"

namespace ghostlight {
namespace {

std::string kind_list() {
    std::string list;
    for (const FitKindData& each : fit_kinds())
        list += fmt::format("{}{}{}", list.empty() ? "" : ", ", each.key, each.layered ? ".N" : "");
    return list;
}

[[noreturn]] void refuse(std::string_view item, std::string problem, std::string expected) {
    throw Error({.problem = std::move(problem),
                 .file = {},
                 .where = {},
                 .found = fmt::format("'{}'", item),
                 .expected = std::move(expected)});
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return text;
}

std::optional<double> number(std::string_view text) {
    text = trimmed(text);
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

double amount(std::string_view text, double of, std::string_view item) {
    text = trimmed(text);
    const bool percent = text.ends_with('%');
    if (percent) text.remove_suffix(1);
    const auto value = number(text);
    if (!value)
        refuse(item, "a bound or a prior cannot be read",
               "numbers, as in center@3=450..650~40 or radius@2~0.2%");
    return percent ? 0.01 * *value * std::abs(of) : *value;
}

}  // namespace

std::string vary_item(const FitParameter& parameter) {
    const FitKindData& kind = data_of(parameter.kind);
    std::string text(kind.key);
    if (kind.layered) text += fmt::format(".{}", parameter.layer + 1);
    for (std::size_t i = 0; i < parameter.rows.size(); ++i)
        text += fmt::format("{}{}", i == 0 ? "@" : "+", parameter.rows[i] + 1);
    return text + fmt::format("={}..{}~{}", parameter.lower, parameter.upper, parameter.prior);
}

std::vector<FitParameter> parse_vary(std::string_view text, const Prescription& lens) {
    std::vector<FitParameter> parameters;
    auto add = [&](FitParameter p, std::string_view bounds, std::string_view prior,
                   std::string_view item) {
        set_defaults(p);
        if (!bounds.empty()) {
            const auto dots = bounds.find("..");
            if (dots == std::string_view::npos)
                refuse(item, "bounds cannot be read", "LOWER..UPPER, as in center@3=450..650");
            p.lower = amount(bounds.substr(0, dots), p.start, item);
            p.upper = amount(bounds.substr(dots + 2), p.start, item);
            if (!(p.lower < p.upper))
                refuse(item, "the lower bound is not below the upper one",
                       fmt::format("bounds about {:.6g}, as in {}..{}", p.start,
                                   p.start == 0.0 ? -1.0 : 0.8 * p.start,
                                   p.start == 0.0 ? 1.0 : 1.2 * p.start));
            if (p.start < p.lower || p.start > p.upper)
                refuse(item, "the lens's own value is outside of the bounds",
                       fmt::format("bounds that contain {:.6g}", p.start));
        }
        if (!prior.empty()) {
            p.prior = amount(prior, p.start, item);
            if (!(p.prior > 0.0)) refuse(item, "the prior has no width", "a number above 0");
        }
        for (const FitParameter& other : parameters)
            if (other.kind == p.kind && other.layer == p.layer)
                for (const std::size_t row : p.rows)
                    if (p.rows.empty() || std::ranges::find(other.rows, row) != other.rows.end())
                        refuse(item, fmt::format("{} is varied twice", name(other)),
                               "each number once");
        parameters.push_back(std::move(p));
    };
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string_view item = trimmed(text.substr(begin, end - begin));
        begin = end + 1;
        if (item.empty()) {
            if (text.empty() || begin > text.size()) break;
            continue;
        }
        std::string_view rest = item, bounds, prior;
        if (const auto at = rest.find('~'); at != std::string_view::npos) {
            prior = trimmed(rest.substr(at + 1));
            rest = rest.substr(0, at);
        }
        if (const auto at = rest.find('='); at != std::string_view::npos) {
            bounds = trimmed(rest.substr(at + 1));
            rest = rest.substr(0, at);
        }
        std::string_view rows;
        if (const auto at = rest.find('@'); at != std::string_view::npos) {
            rows = trimmed(rest.substr(at + 1));
            rest = rest.substr(0, at);
        }
        std::string_view key = trimmed(rest);
        std::size_t layer = 0;
        if (const auto dot = key.find('.'); dot != std::string_view::npos) {
            const auto which = number(key.substr(dot + 1));
            if (!which || *which < 1.0 || *which != std::floor(*which))
                refuse(item, "no such layer", "a layer's number from 1, as in layer.2@5");
            layer = static_cast<std::size_t>(*which) - 1;
            key = key.substr(0, dot);
        }
        const auto kind = std::ranges::find(fit_kinds(), key, &FitKindData::key);
        if (kind == fit_kinds().end())
            refuse(item, "unknown kind of variable",
                   fmt::format("KIND@ROWS with KIND one of {}", kind_list()));
        if (kind->of_stop) {
            const auto value = value_in(lens, kind->kind, lens.stop.surface, 0);
            if (!value) refuse(item, "this cannot be varied", why_not(lens, kind->kind, 0));
            add({.kind = kind->kind,
                 .rows = {},
                 .layer = 0,
                 .start = *value,
                 .lower = 0,
                 .upper = 0,
                 .prior = 0},
                bounds, prior, item);
            continue;
        }
        if (rows.empty())
            refuse(item, "it is not said on which surface",
                   fmt::format("{}@ROWS, as in {}@3, {}@2+5 (one common value) or {}@all", key, key,
                               key, key));
        if (rows == "all") {
            bool any = false;
            const OpticalSystem system = compile(lens, d_line_nm);
            for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
                const auto value = value_in(lens, kind->kind, row, layer);
                if (!value || (is_coating(kind->kind) && !system.surfaces[row].reflects)) continue;
                any = true;
                add({.kind = kind->kind,
                     .rows = {row},
                     .layer = layer,
                     .start = *value,
                     .lower = 0,
                     .upper = 0,
                     .prior = 0},
                    bounds, prior, item);
            }
            if (!any)
                refuse(
                    item, "no surface of this lens has that",
                    fmt::format("{}; give the lens coatings first (on the command line --coating "
                                "qw:550)",
                                why_not(lens, kind->kind, lens.surfaces.size())));
            continue;
        }
        FitParameter p{.kind = kind->kind,
                       .rows = {},
                       .layer = layer,
                       .start = 0,
                       .lower = 0,
                       .upper = 0,
                       .prior = 0};
        std::size_t from = 0;
        while (from <= rows.size()) {
            const std::size_t to = std::min(rows.find('+', from), rows.size());
            const auto row = number(rows.substr(from, to - from));
            from = to + 1;
            if (!row || *row < 1.0 || *row > static_cast<double>(lens.surfaces.size()) ||
                *row != std::floor(*row))
                refuse(item, "there is no such surface",
                       fmt::format("surfaces 1 to {} of this lens", lens.surfaces.size()));
            const auto index = static_cast<std::size_t>(*row) - 1;
            const auto value = value_in(lens, p.kind, index, layer);
            if (!value)
                refuse(item, fmt::format("surface {} cannot be varied so", index + 1),
                       why_not(lens, p.kind, index));
            if (p.rows.empty()) p.start = *value;
            p.rows.push_back(index);
        }
        add(std::move(p), bounds, prior, item);
    }
    if (parameters.empty())
        throw Error(
            {.problem = "nothing is to be varied",
             .file = {},
             .where = {},
             .found = "''",
             .expected = "a list such as center@all, or center@1,center@3+4,radius@5~0.2%"});
    return parameters;
}

}  // namespace ghostlight
