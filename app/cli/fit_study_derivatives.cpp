// Slopes of the model's picture against differences of whole pictures.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "app/cli/fit_study_cases.h"
#include "core/fit/ghost_weights.h"
#include "core/fit/photo_model.h"
#include "core/flare/spectrum.h"
#include "core/io/lens_file.h"

namespace ghostlight::cli {
namespace {

constexpr int across = 48;
constexpr std::size_t most_ghosts = 12;
const Spectrum daylight = StandardLight{};

/// Some ghosts of a lens, spread over the list.
std::vector<GhostPath> some_ghosts(const FitScene& scene) {
    std::vector<GhostPath> some;
    const std::size_t step = std::max<std::size_t>(1, scene.ghosts.size() / most_ghosts);
    for (std::size_t g = 0; g < scene.ghosts.size(); g += step) some.push_back(scene.ghosts[g]);
    return some;
}

struct Look {
    FitScene scene;
    std::vector<GhostBasis> bases;
    std::vector<const GhostBasis*> all;
    Look(const FittedLens& lens, const LightDirection& light, const PixelFrame& frame,
         const FitPlace& place)
        : scene(fit_scene(lens, daylight, 7)) {
        scene.ghosts = some_ghosts(scene);
        bases = ghost_bases(scene, light, frame, place, true, 0, {});
        for (const GhostBasis& basis : bases) all.push_back(&basis);
    }
    std::vector<double> picture(const PixelFrame& frame) const {
        const GhostWeights weights(scene, all, {}, 0);
        return ghost_picture(bases, weights, frame, 0, false, 0).values;
    }
};

/// |a − b| over |b|, root mean squares.
double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = 0.0, size = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        difference += (a[k] - b[k]) * (a[k] - b[k]);
        size += b[k] * b[k];
    }
    return size > 0.0 ? std::sqrt(difference / size) : std::sqrt(difference);
}

std::vector<double> slope_between(const std::vector<double>& more, const std::vector<double>& less,
                                  double width) {
    std::vector<double> slope(more.size());
    for (std::size_t k = 0; k < slope.size(); ++k) slope[k] = (more[k] - less[k]) / width;
    return slope;
}

FittedLens moved(const Prescription& lens, const FitParameter& parameter, double to) {
    FittedLens at{lens, {}};
    set(at, parameter, to);
    return at;
}

/// A coating with layers, or of constant reflectance, on the first surface that has one.
Prescription coated(Prescription lens, const std::string& kind) {
    for (Surface& surface : lens.surfaces) {
        if (!std::holds_alternative<QuarterWave>(surface.coating)) continue;
        if (kind == "reflectance")
            surface.coating = ConstantReflectance{.reflectance = 0.01, .transmittance = 0.99};
        else
            surface.coating = LayerStack{
                .layers = {{.medium = {.name = "low", .dispersion = ConstantIndex{1.38}},
                            .thickness_nm = 95.0},
                           {.medium = {.name = "high", .dispersion = ConstantIndex{2.05}},
                            .thickness_nm = 120.0}},
                .from_air = true};
        break;
    }
    return lens;
}

/// By ceres::Jet and the chain differentiated backwards, against a difference of two pictures.
double coating_difference(const Prescription& lens, const FitParameter& parameter,
                          const LightDirection& light, const PixelFrame& frame) {
    const Look look({lens, {}}, light, frame, {});
    GhostWeights weights(look.scene, look.all, {parameter}, 0);
    weights.update({parameter.start}, true);
    const ModelPicture picture = ghost_picture(look.bases, weights, frame, 1, true, 0);
    std::vector<double> slope;
    for (std::size_t k = 1; k < picture.values.size(); k += 2) slope.push_back(picture.values[k]);
    const double step = 0.01 * parameter.prior;
    auto at = [&](double value) {
        weights.update({value}, false);
        return ghost_picture(look.bases, weights, frame, 1, false, 0).values;
    };
    return relative_difference(
        slope, slope_between(at(parameter.start + step), at(parameter.start - step), 2.0 * step));
}

/// As the fit takes it, against half its step: what a difference of smooth pictures is good to.
double geometry_difference(const Prescription& lens, const FitParameter& parameter,
                           const LightDirection& light, const PixelFrame& frame) {
    auto slope = [&](double step) {
        auto at = [&](double value) {
            return Look(moved(lens, parameter, value), light, frame, {}).picture(frame);
        };
        return slope_between(at(parameter.start + step), at(parameter.start - step), 2.0 * step);
    };
    constexpr double of_fit = 0.3;
    return relative_difference(slope(of_fit * parameter.prior),
                               slope(0.5 * of_fit * parameter.prior));
}

/// Shift and rotation, differentiated under the integral, against a difference of two pictures.
std::array<double, 3> place_differences(const Prescription& lens, const LightDirection& light,
                                        const PixelFrame& frame) {
    const Look look({lens, {}}, light, frame, {});
    const GhostWeights weights(look.scene, look.all, {}, 0);
    const std::size_t values =
        3 * static_cast<std::size_t>(frame.width_px) * static_cast<std::size_t>(frame.height_px);
    std::array<std::vector<double>, 3> slopes;
    for (auto& each : slopes) each.assign(values, 0.0);
    for (const GhostBasis& basis : look.bases) {
        std::vector<double> coefficients;
        weights.coefficients(basis, coefficients, nullptr);
        add_place_slopes(look.scene, basis, light, frame, {}, coefficients, slopes);
    }
    std::array<double, 3> found{};
    const double steps[3] = {0.01, 0.01, 0.0005};
    for (std::size_t k = 0; k < 3; ++k) {
        auto at = [&](double by) {
            FitPlace place;
            (k == 0 ? place.shift_x_mm : k == 1 ? place.shift_y_mm : place.rotation_rad) = by;
            return Look({lens, {}}, light, frame, place).picture(frame);
        };
        found[k] = relative_difference(slopes[k],
                                       slope_between(at(steps[k]), at(-steps[k]), 2.0 * steps[k]));
    }
    return found;
}

}  // namespace

StudySection study_derivatives(const StudyRequest& request) {
    StudySection section{
        .key = "derivatives",
        .title = "Derivatives",
        .text = {},
        .table = {.columns = {"lens", "kind", "number", "relative_difference"}, .rows = {}},
        .pictures = {}};
    std::map<std::string, double> worst;
    auto lenses = bundled_lenses();
    if (request.quick) lenses.resize(std::min<std::size_t>(2, lenses.size()));
    double done = 0.0;
    for (const BundledLens& each : lenses) {
        const Prescription lens = read_lens(each.file).lens;
        const LightDirection light{4.0, 90.0};
        const PixelFrame frame = pixel_frame(lens.sensor.width_mm, lens.sensor.height_mm, across);
        auto note = [&](const std::string& kind, const std::string& number, double difference) {
            section.table.rows.push_back({each.file.stem().string(), kind, number, difference});
            worst[kind] = std::max(worst[kind], difference);
        };
        for (const std::string kind :
             {"center", "thickness", "layer.1", "layer-index.1", "reflectance", "radius", "gap",
              "index", "semi-diameter", "stop-size", "stop-x", "stop-y", "stop-rotation"}) {
            const bool own = kind == "center" || kind == "thickness";
            const bool film = kind.starts_with("layer") || kind == "reflectance";
            Prescription with = film ? coated(lens, kind) : lens;
            // Blades, where the lens lists none: a hexagon.
            if (kind == "stop-rotation" && with.stop.blades < 3) with.stop.blades = 6;
            std::vector<FitParameter> parameters;
            try {
                parameters = parse_vary(kind.starts_with("stop") ? kind : kind + "@all", with);
            } catch (const Error&) {
                continue;  // no surface of this lens has that
            }
            const FitParameter& parameter = parameters.front();
            note(kind, name(parameter),
                 own || film ? coating_difference(with, parameter, light, frame)
                             : geometry_difference(with, parameter, light, frame));
        }
        const auto place = place_differences(lens, light, frame);
        note("shift", "shift x", place[0]);
        note("shift", "shift y", place[1]);
        note("rotation", "rotation", place[2]);
        if (request.progress) request.progress(++done / static_cast<double>(lenses.size()));
    }
    section.text = fmt::format(
        "Slopes of the model's picture ({} samples across, up to {} ghosts, 4°) on {} bundled "
        "lenses, against central differences of pictures, relative root mean square. Coatings and "
        "places: exact slopes against a difference. Geometry, whose slopes are differences in the "
        "fit: its step against half of it.\n\n| kind | largest difference |\n| --- | --- |\n",
        across, most_ghosts, lenses.size());
    for (const auto& [kind, difference] : worst)
        section.text += fmt::format("| `{}` | {:.2g} |\n", kind, difference);
    return section;
}

}  // namespace ghostlight::cli
