#include "core/fit/fit_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/optics/optical_system.h"
#include "core/units.h"

namespace ghostlight {
namespace {

struct KindData {
    FitKind kind;
    std::string_view key;    ///< in a list of what to vary
    std::string_view words;  ///< for people
    std::string_view unit;
    bool of_stop, layered;
};
constexpr KindData kinds[] = {
    {FitKind::center, "center", "λ0", "nm", false, false},
    {FitKind::thickness, "thickness", "thickness", "×", false, false},
    {FitKind::layer_thickness, "layer", "layer", "nm", false, true},
    {FitKind::layer_index, "layer-index", "index of layer", "", false, true},
    {FitKind::reflectance, "reflectance", "R", "", false, false},
    {FitKind::radius, "radius", "radius", "mm", false, false},
    {FitKind::gap, "gap", "gap after", "mm", false, false},
    {FitKind::index, "index", "index after", "", false, false},
    {FitKind::semi_diameter, "semi-diameter", "semi-diameter", "mm", false, false},
    {FitKind::stop_size, "stop-size", "stop size", "×", true, false},
    {FitKind::stop_x, "stop-x", "stop x", "mm", true, false},
    {FitKind::stop_y, "stop-y", "stop y", "mm", true, false},
    {FitKind::stop_rotation, "stop-rotation", "blades", "°", true, false},
};

const KindData& data_of(FitKind kind) { return *std::ranges::find(kinds, kind, &KindData::kind); }

std::string kind_list() {
    std::string list;
    for (const KindData& each : kinds)
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

/// Adds to an index at every wavelength of use. A glass's own formula is kept by its table.
void add_index(Medium& medium, double added) {
    if (added == 0.0) return;
    if (auto* constant = std::get_if<ConstantIndex>(&medium.dispersion)) {
        constant->n += added;
        return;
    }
    if (auto* model = std::get_if<ModelGlass>(&medium.dispersion)) {
        // The dispersion nF − nC stays.
        const double spread = (model->nd - 1.0) / model->vd;
        model->nd += added;
        model->vd = (model->nd - 1.0) / spread;
        return;
    }
    if (auto* table = std::get_if<TabulatedGlass>(&medium.dispersion)) {
        for (SpectralValue& each : table->index) each.value += added;
        return;
    }
    TabulatedGlass table;
    const auto range = wavelength_range_nm(medium);
    for (double nm = 380.0; nm <= 780.0; nm += 20.0)
        if (!range || ((range->first == 0.0 || nm >= range->first) &&
                       (range->second == 0.0 || nm <= range->second)))
            table.index.push_back({nm, refractive_index(medium, nm) + added});
    table.held_beyond = true;
    medium.dispersion = table;
    medium.name += fmt::format("{:+.5f}", added);
}

/// The layers of a coating that a kind needs; null where it makes no sense.
Medium* layer_medium(Coating& coating, std::size_t layer) {
    if (auto* film = std::get_if<QuarterWave>(&coating))
        return layer == 0 ? std::get_if<Medium>(&film->layer) : nullptr;
    if (auto* stack = std::get_if<LayerStack>(&coating))
        return layer < stack->layers.size() ? &stack->layers[layer].medium : nullptr;
    return nullptr;
}

/// The value that stands in the lens, or nothing where the parameter makes no sense.
std::optional<double> value_in(const Prescription& lens, FitKind kind, std::size_t row,
                               std::size_t layer) {
    Surface surface = row < lens.surfaces.size() ? lens.surfaces[row] : Surface{};
    switch (kind) {
        case FitKind::center:
            if (const auto* film = std::get_if<QuarterWave>(&surface.coating))
                return film->center_nm;
            return std::nullopt;
        case FitKind::thickness:
            if (const auto* film = std::get_if<QuarterWave>(&surface.coating))
                return film->thickness_factor;
            if (std::holds_alternative<LayerStack>(surface.coating)) return 1.0;
            return std::nullopt;
        case FitKind::layer_thickness:
            if (const auto* stack = std::get_if<LayerStack>(&surface.coating))
                if (layer < stack->layers.size()) return stack->layers[layer].thickness_nm;
            return std::nullopt;
        case FitKind::layer_index:
            if (layer_medium(surface.coating, layer)) return 0.0;
            return std::nullopt;
        case FitKind::reflectance:
            if (const auto* fixed = std::get_if<ConstantReflectance>(&surface.coating))
                return fixed->reflectance;
            return std::nullopt;
        case FitKind::radius: {
            const double c = curvature_per_mm(surface.curve);
            if (c == 0.0) return std::nullopt;
            return 1.0 / c;
        }
        case FitKind::gap:
            if (row + 1 == lens.surfaces.size() && lens.sensor.at_paraxial_focus)
                return std::nullopt;
            return surface.thickness_mm;
        case FitKind::index:
            if (is_air(surface.medium_after)) return std::nullopt;
            return 0.0;
        case FitKind::semi_diameter:
            return surface.semi_diameter_mm;
        case FitKind::stop_size:
            return 1.0;
        case FitKind::stop_x:
        case FitKind::stop_y:
            return 0.0;
        case FitKind::stop_rotation:
            return lens.stop.blades > 2 ? std::optional(lens.stop.rotation_deg) : std::nullopt;
    }
    return std::nullopt;
}

std::string why_not(const Prescription& lens, FitKind kind, std::size_t row) {
    const std::string coating =
        row < lens.surfaces.size() ? describe(lens.surfaces[row].coating) : "";
    switch (kind) {
        case FitKind::center:
            return fmt::format("a quarter-wave coating there (it has {})",
                               coating.empty() ? "none" : coating);
        case FitKind::thickness:
        case FitKind::layer_thickness:
        case FitKind::layer_index:
            return fmt::format("a coating of such layers there (it has {})",
                               coating.empty() ? "none" : coating);
        case FitKind::reflectance:
            return "a coating of constant reflectance there";
        case FitKind::radius:
            return "a surface that is not plane";
        case FitKind::gap:
            return "a sensor that is not put at the paraxial focus";
        case FitKind::index:
            return "glass behind that surface";
        case FitKind::stop_rotation:
            return "a stop with blades";
        default:
            return "a surface of the lens";
    }
}

/// What is left to chance in a shop, or where a coating may be centred; bounds wide of it.
void set_defaults(FitParameter& p) {
    auto around = [&](double sigma, double reach) {
        p.prior = sigma;
        p.lower = p.start - reach;
        p.upper = p.start + reach;
    };
    switch (p.kind) {
        case FitKind::center:
            // Anywhere in the visible range: what makers choose is not published.
            p.prior = 80.0;
            p.lower = 350.0;
            p.upper = 900.0;
            return;
        case FitKind::thickness:
            around(0.05, 0.4);
            return;
        case FitKind::layer_thickness:
            around(0.05 * p.start, 0.8 * p.start);
            return;
        case FitKind::layer_index:
            around(0.02, 0.15);
            return;
        case FitKind::reflectance:
            p.prior = 0.01;
            p.lower = 0.0;
            p.upper = std::max(0.2, 4.0 * p.start);
            return;
        case FitKind::radius:
            around(0.002 * std::abs(p.start), 0.02 * std::abs(p.start));
            return;
        case FitKind::gap:
            around(0.03, 0.5);
            return;
        case FitKind::index:
            around(5e-4, 5e-3);
            return;
        case FitKind::semi_diameter:
            around(0.1, 0.1 * p.start);
            return;
        case FitKind::stop_size:
            around(0.03, 0.3);
            return;
        case FitKind::stop_x:
        case FitKind::stop_y:
            around(0.1, 1.0);
            return;
        case FitKind::stop_rotation:
            around(5.0, 30.0);
            return;
    }
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

bool is_coating(FitKind kind) {
    return kind == FitKind::center || kind == FitKind::thickness ||
           kind == FitKind::layer_thickness || kind == FitKind::layer_index ||
           kind == FitKind::reflectance;
}

std::string name(const FitParameter& parameter) {
    const KindData& data = data_of(parameter.kind);
    if (data.of_stop) return std::string(data.words);
    std::string rows;
    for (const std::size_t row : parameter.rows)
        rows += fmt::format("{}{}", rows.empty() ? "" : "+", row + 1);
    const std::string layer = data.layered ? fmt::format(" {}", parameter.layer + 1) : "";
    const bool after = data.words.ends_with("after");
    return fmt::format("{}{}{}{}", data.words, layer, after ? " " : " of ", rows);
}

std::string unit(const FitParameter& parameter) {
    return std::string(data_of(parameter.kind).unit);
}

void set_coating(Coating& coating, const FitParameter& parameter, double value) {
    auto* stack = std::get_if<LayerStack>(&coating);
    // It is no longer the library's.
    if (stack != nullptr) stack->name.clear();
    switch (parameter.kind) {
        case FitKind::center:
            std::get<QuarterWave>(coating).center_nm = value;
            break;
        case FitKind::thickness:
            if (stack != nullptr)
                for (Layer& layer : stack->layers) layer.thickness_nm *= value;
            else
                std::get<QuarterWave>(coating).thickness_factor = value;
            break;
        case FitKind::layer_thickness:
            stack->layers[parameter.layer].thickness_nm = value;
            break;
        case FitKind::layer_index:
            add_index(*layer_medium(coating, parameter.layer), value);
            break;
        case FitKind::reflectance: {
            auto& fixed = std::get<ConstantReflectance>(coating);
            // What is absorbed stays absorbed.
            const double absorbed = 1.0 - fixed.reflectance - fixed.transmittance;
            fixed.reflectance = value;
            fixed.transmittance = std::max(0.0, 1.0 - absorbed - value);
            break;
        }
        default:
            break;
    }
}

void set(FittedLens& fitted, const FitParameter& parameter, double value) {
    Prescription& lens = fitted.lens;
    switch (parameter.kind) {
        case FitKind::stop_size: {
            if (lens.stop.f_number)
                *lens.stop.f_number /= value;
            else
                lens.stop.semi_diameter_mm =
                    value * lens.stop.semi_diameter_mm.value_or(
                                lens.surfaces[lens.stop.surface].semi_diameter_mm);
            // It is the blades that are varied, not the ring that carries them.
            Surface& row = lens.surfaces[lens.stop.surface];
            row.semi_diameter_mm *= std::max(1.0, value);
            return;
        }
        case FitKind::stop_x:
            fitted.stop.x_mm = value;
            return;
        case FitKind::stop_y:
            fitted.stop.y_mm = value;
            return;
        case FitKind::stop_rotation:
            lens.stop.rotation_deg = value;
            return;
        default:
            break;
    }
    for (const std::size_t row : parameter.rows) {
        Surface& surface = lens.surfaces[row];
        switch (parameter.kind) {
            case FitKind::radius:
                surface.curve = Radius{value};
                break;
            case FitKind::gap:
                surface.thickness_mm = value;
                break;
            case FitKind::index:
                add_index(surface.medium_after, value);
                break;
            case FitKind::semi_diameter:
                surface.semi_diameter_mm = value;
                break;
            default:
                set_coating(surface.coating, parameter, value);
                break;
        }
    }
}

std::string vary_item(const FitParameter& parameter) {
    const KindData& kind = data_of(parameter.kind);
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
        const auto* kind = std::ranges::find(kinds, key, &KindData::key);
        if (kind == std::end(kinds))
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
                refuse(item, "no surface of this lens has that",
                       fmt::format("{}; give the lens coatings first, as with --coating qw:550",
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
