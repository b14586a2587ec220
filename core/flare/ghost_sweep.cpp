#include "core/flare/ghost_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/error.h"
#include "core/optics/between_configurations.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight {
namespace {

using Kind = SweepParameter::Kind;

struct KindName {
    Kind kind;
    const char* words;
    const char* unit;
    const char* column;  ///< of tables
    bool of_surface;
};
constexpr std::array kinds = {
    KindName{Kind::field, "field", "°", "field_deg", false},
    KindName{Kind::azimuth, "azimuth", "°", "azimuth_deg", false},
    KindName{Kind::f_number, "f-number", "", "f_number", false},
    KindName{Kind::position, "position", "", "position", false},
    KindName{Kind::radius, "radius", "mm", "radius_mm", true},
    KindName{Kind::curvature, "curvature", "1/mm", "curvature_per_mm", true},
    KindName{Kind::thickness, "thickness", "mm", "thickness_mm", true},
    KindName{Kind::semi_diameter, "semi-diameter", "mm", "semi_diameter_mm", true},
    KindName{Kind::coating, "coating", "", "coating_factor", true},
};

const KindName& kind_of(const SweepParameter& parameter) {
    return *std::ranges::find(kinds, parameter.kind, &KindName::kind);
}

struct ScaleLayers {
    double factor;
    std::size_t surface;
    void operator()(QuarterWave& quarter) const { quarter.thickness_factor *= factor; }
    void operator()(LayerStack& stack) const {
        for (Layer& layer : stack.layers) layer.thickness_nm *= factor;
        stack.name.clear();
    }
    template <class Other>
    void operator()(Other&) const {
        throw Error({"no layers to sweep",
                     {},
                     fmt::format("surface {}", surface + 1),
                     {},
                     "a coating of layers on that surface"});
    }
};

/// The lens at a place between its positions, which count from 1.
Prescription at_position(const Prescription& lens, double value) {
    const auto count = static_cast<double>(lens.configurations.size());
    if (!(value >= 1.0 && value <= count))
        throw Error({"no such position",
                     {},
                     {},
                     fmt::format("{}", value),
                     fmt::format("1 to {} (the configurations)", lens.configurations.size())});
    const auto first = static_cast<std::size_t>(std::min(std::floor(value), count - 1.0)) - 1;
    const double share = value - 1.0 - static_cast<double>(first);
    if (lens.configurations.size() == 1 || share == 0.0)
        return configured(lens, lens.configurations[first].name);
    Prescription with = lens;
    Configuration between = between_configurations(lens, lens.configurations[first].name,
                                                   lens.configurations[first + 1].name, share);
    between.name = "between";
    while (std::ranges::find(with.configurations, between.name, &Configuration::name) !=
           with.configurations.end())
        between.name += "'";
    with.configurations.push_back(between);
    return configured(with, between.name);
}

}  // namespace

SweepParameter parse_sweep_parameter(std::string_view text, const Prescription& lens) {
    const auto refuse = [&](std::string expected) {
        throw Error(
            {"not a parameter to sweep", {}, {}, fmt::format("'{}'", text), std::move(expected)});
    };
    while (text.ends_with(' ')) text.remove_suffix(1);
    const std::size_t blank = text.find(' ');
    const std::string_view word = text.substr(0, blank);
    for (const KindName& kind : kinds) {
        if (word != kind.words) continue;
        SweepParameter parameter{kind.kind, 0};
        if (kind.kind == Kind::position && lens.configurations.empty())
            refuse("a lens with configurations, to sweep its position");
        if (!kind.of_surface) {
            if (blank != std::string_view::npos) refuse(fmt::format("'{}' alone", kind.words));
            return parameter;
        }
        const std::string number(blank == std::string_view::npos ? "" : text.substr(blank + 1));
        char* end = nullptr;
        const long surface = std::strtol(number.c_str(), &end, 10);
        if (number.empty() || *end != '\0' || surface < 1 ||
            surface > static_cast<long>(lens.surfaces.size()))
            refuse(fmt::format("'{} N' with a surface from 1 to {}", kind.words,
                               lens.surfaces.size()));
        parameter.surface = static_cast<std::size_t>(surface) - 1;
        return parameter;
    }
    refuse(
        "field, azimuth, f-number, position, or radius, curvature, thickness, semi-diameter or "
        "coating and a surface");
    return {};
}

std::string name(const SweepParameter& parameter) {
    const KindName& kind = kind_of(parameter);
    return kind.of_surface ? fmt::format("{} {}", kind.words, parameter.surface + 1) : kind.words;
}

const char* unit_of(const SweepParameter& parameter) { return kind_of(parameter).unit; }

const char* column_of(const SweepParameter& parameter) { return kind_of(parameter).column; }

SweepState at_value(const Prescription& lens, std::string_view configuration,
                    const LightDirection& light, const SweepParameter& parameter, double value) {
    SweepState state{{}, light};
    state.lens = parameter.kind == Kind::position ? at_position(lens, value)
                                                  : configured(lens, configuration);
    Surface& surface = state.lens.surfaces.at(parameter.surface);
    switch (parameter.kind) {
        case Kind::field:
            if (!(std::abs(value) < 90.0))
                throw Error({"not a field angle",
                             {},
                             {},
                             fmt::format("{}", value),
                             "an angle from -90 to 90 degrees"});
            state.light.field_deg = value;
            break;
        case Kind::azimuth:
            state.light.azimuth_deg = value;
            break;
        case Kind::f_number:
            state.lens.stop.f_number = value;
            break;
        case Kind::position:
            break;
        case Kind::radius:
            surface.curve = Radius{value};
            break;
        case Kind::curvature:
            surface.curve = Curvature{value};
            break;
        case Kind::thickness:
            surface.thickness_mm = value;
            break;
        case Kind::semi_diameter:
            surface.semi_diameter_mm = value;
            break;
        case Kind::coating:
            std::visit(ScaleLayers{value, parameter.surface}, surface.coating);
            break;
    }
    validate(state.lens);
    return state;
}

double present_value(const Prescription& lens, std::string_view configuration,
                     const LightDirection& light, const SweepParameter& parameter) {
    const Prescription now = configured(lens, configuration);
    const Surface& surface = now.surfaces.at(parameter.surface);
    switch (parameter.kind) {
        case Kind::field:
            return light.field_deg;
        case Kind::azimuth:
            return light.azimuth_deg;
        case Kind::f_number:
            return first_order(compile(now, d_line_nm)).f_number;
        case Kind::position: {
            const auto found =
                std::ranges::find(lens.configurations, configuration, &Configuration::name);
            return found == lens.configurations.end()
                       ? 1.0
                       : 1.0 + static_cast<double>(found - lens.configurations.begin());
        }
        case Kind::radius:
            return 1.0 / curvature_per_mm(surface.curve);
        case Kind::curvature:
            return curvature_per_mm(surface.curve);
        case Kind::thickness:
            return surface.thickness_mm;
        case Kind::semi_diameter:
            return surface.semi_diameter_mm;
        case Kind::coating:
            break;
    }
    return 1.0;
}

std::optional<std::vector<SweepPoint>> sweep(const Prescription& lens, const SweepRequest& request,
                                             std::stop_token stop,
                                             const std::function<void(const SweepPoint&)>& done) {
    std::vector<SweepPoint> points;
    for (const double value : request.values) {
        if (stop.stop_requested()) return std::nullopt;
        SweepPoint point;
        point.value = value;
        try {
            const SweepState state = at_value(lens, request.configuration, request.table.light,
                                              request.parameter, value);
            if (request.picture_width_px > 0) {
                FlareRequest picture;
                picture.light = state.light;
                picture.spectrum = request.table.spectrum;
                picture.tolerance = request.picture_tolerance;
                picture.width_px = request.picture_width_px;
                picture.threads = request.table.threads;
                auto image = render_flare(state.lens, picture, stop);
                if (!image) return std::nullopt;
                point.picture = std::make_shared<const FlareImage>(std::move(*image));
            }
            GhostTableRequest wanted = request.table;
            wanted.light = state.light;
            auto table = ghost_table(state.lens, wanted, stop);
            if (!table) return std::nullopt;
            point.table = std::make_shared<const GhostTable>(std::move(*table));
        } catch (const Error& error) {
            point.failure = error.what();
        }
        if (done) done(point);
        points.push_back(std::move(point));
    }
    return points;
}

double value_of(const GhostRow& row, SweepQuantity quantity) {
    switch (quantity) {
        case SweepQuantity::on_sensor_flux:
            return row.flux_mm2 * row.on_sensor;
        case SweepQuantity::peak:
            return row.peak_per_e0;
        case SweepQuantity::flux:
            break;
    }
    return row.flux_mm2;
}

std::vector<GhostCurve> curves_of(const std::vector<SweepPoint>& points, SweepQuantity quantity) {
    std::map<GhostPath, std::size_t> place;
    std::vector<GhostCurve> curves;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (!points[p].table) continue;
        for (const GhostRow& row : points[p].table->ghosts) {
            const auto [at, is_new] = place.try_emplace(row.path, curves.size());
            if (is_new)
                curves.push_back(
                    {row.path,
                     std::vector<double>(points.size(), std::numeric_limits<double>::quiet_NaN()),
                     p});
            GhostCurve& curve = curves[at->second];
            curve.values[p] = value_of(row, quantity);
            if (!(curve.values[p] <= curve.values[curve.worst])) curve.worst = p;
        }
    }
    std::ranges::stable_sort(curves, std::ranges::greater{}, &GhostCurve::largest);
    return curves;
}

}  // namespace ghostlight
