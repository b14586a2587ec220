// Slopes of the model's picture against differences of whole pictures.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "app/cli/fit_study_cases.h"
#include "core/fit/ghost_weights.h"
#include "core/fit/photo_model.h"
#include "core/fit/picture_slopes.h"
#include "core/flare/spectrum.h"
#include "core/io/lens_file.h"

namespace ghostlight::cli {
namespace {

constexpr int across = 48, spectral_samples = 7;
constexpr std::size_t most_ghosts = 12;
constexpr double field_prior_deg = 0.03;  ///< of a light, as the fit has it
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
        : scene(fit_scene(lens, daylight, spectral_samples)) {
        scene.ghosts = some_ghosts(scene);
        for (GhostBasis& basis : ghost_bases(scene, light, frame, place, true, 0, {})) {
            // Where a cell takes one point more the picture jumps by what points leave: closer
            // together they leave little beside what a small move changes.
            GhostGrid grid = basis.grid;
            grid.point_spacing = 0.15;
            bases.push_back(ghost_basis(scene, basis.ghost, light, frame, place, grid));
        }
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

/// The picture of another lens or light, on rays that were chosen for this one.
std::vector<double> picture_like(const Look& look, const FittedLens& lens,
                                 const LightDirection& light, const PixelFrame& frame) {
    FitScene scene = fit_scene(lens, daylight, spectral_samples);
    scene.ghosts = look.scene.ghosts;
    std::vector<GhostBasis> bases;
    for (const GhostBasis& each : look.bases)
        bases.push_back(ghost_basis(scene, each.ghost, light, frame, {}, each.grid));
    std::erase_if(bases, [](const GhostBasis& basis) { return basis.empty(); });
    std::vector<const GhostBasis*> all;
    for (const GhostBasis& basis : bases) all.push_back(&basis);
    const GhostWeights weights(scene, all, {}, 0);
    return ghost_picture(bases, weights, frame, 0, false, 0).values;
}

/// What a slope is compared by.
struct SlopeCheck {
    std::string number;
    double felt = 0.0;        ///< the slope times the prior over the picture, root mean squares
    double difference = 0.0;  ///< of slope and difference, over the difference
};

double root_of_squares(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double each : values) sum += each * each;
    return std::sqrt(sum);
}

/// Of all numbers of a kind, the one that the picture feels most: ceres::Jet through rays, rims
/// and weights against a difference of two pictures.
SlopeCheck geometry_difference(const Prescription& lens,
                               const std::vector<FitParameter>& parameters,
                               const LightDirection& light, const PixelFrame& frame) {
    const Look look({lens, {}}, light, frame, {});
    const GhostWeights weights(look.scene, look.all, {}, 0);
    LensMoves moves{.film_now = compiled_films(look.scene, lens), .moves = {}};
    constexpr double of_prior = 1e-3;
    for (const FitParameter& each : parameters)
        moves.moves.push_back(lens_move(
            look.scene, moved(lens, each, each.start - of_prior * each.prior),
            moved(lens, each, each.start + of_prior * each.prior), light, 2.0 * of_prior));
    const ModelPicture slopes =
        picture_slopes(look.scene, look.bases, weights, light, frame, {}, moves, 0, {});
    const double size = root_of_squares(look.picture(frame));
    SlopeCheck check;
    std::vector<double> best;
    std::size_t which = 0;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
        std::vector<double> slope;
        for (std::size_t at = place_slopes + k; at < slopes.values.size(); at += slopes.columns)
            slope.push_back(slopes.values[at]);
        const double felt = root_of_squares(slope) / size;
        if (!best.empty() && felt <= check.felt) continue;
        check.felt = felt;
        best = std::move(slope);
        which = k;
    }
    const FitParameter& parameter = parameters[which];
    check.number = name(parameter);
    // Less would show the rounding of rays in single precision.
    const double step = 0.2;
    auto at = [&](double by) {
        return picture_like(look, moved(lens, parameter, parameter.start + by * parameter.prior),
                            light, frame);
    };
    check.difference = relative_difference(best, slope_between(at(step), at(-step), 2.0 * step));
    return check;
}

/// By the light's field angle, a prior's breadth of it.
SlopeCheck field_difference(const Prescription& lens, const LightDirection& light,
                            const PixelFrame& frame) {
    const Look look({lens, {}}, light, frame, {});
    const GhostWeights weights(look.scene, look.all, {}, 0);
    auto turned = [&](double by) {
        return LightDirection{light.field_deg + by * field_prior_deg, light.azimuth_deg};
    };
    constexpr double of_prior = 1e-3, step = 0.2;
    const LensMoves moves{
        .film_now = compiled_films(look.scene, lens),
        .moves = {light_move(look.scene, turned(-of_prior), turned(of_prior), 2.0 * of_prior)}};
    const ModelPicture slopes =
        picture_slopes(look.scene, look.bases, weights, light, frame, {}, moves, 0, {});
    std::vector<double> slope;
    for (std::size_t at = place_slopes; at < slopes.values.size(); at += slopes.columns)
        slope.push_back(slopes.values[at]);
    const auto more = picture_like(look, {lens, {}}, turned(step), frame),
               less = picture_like(look, {lens, {}}, turned(-step), frame);
    return {.number = "field",
            .felt = root_of_squares(slope) / root_of_squares(look.picture(frame)),
            .difference = relative_difference(slope, slope_between(more, less, 2.0 * step))};
}

/// Shift and rotation, differentiated under the integral, against a difference of two pictures.
std::array<double, 3> place_differences(const Prescription& lens, const LightDirection& light,
                                        const PixelFrame& frame) {
    const Look look({lens, {}}, light, frame, {});
    const GhostWeights weights(look.scene, look.all, {}, 0);
    const ModelPicture exact = picture_slopes(look.scene, look.bases, weights, light, frame, {},
                                              {.film_now = {}, .moves = {}}, 0, {});
    std::array<double, 3> found{};
    const double steps[3] = {0.01, 0.01, 0.0005};
    for (std::size_t k = 0; k < 3; ++k) {
        auto at = [&](double by) {
            FitPlace place;
            (k == 0 ? place.shift_x_mm : k == 1 ? place.shift_y_mm : place.rotation_rad) = by;
            return Look({lens, {}}, light, frame, place).picture(frame);
        };
        std::vector<double> slope;
        for (std::size_t from = k; from < exact.values.size(); from += exact.columns)
            slope.push_back(exact.values[from]);
        found[k] =
            relative_difference(slope, slope_between(at(steps[k]), at(-steps[k]), 2.0 * steps[k]));
    }
    return found;
}

}  // namespace

StudySection study_derivatives(const StudyRequest& request) {
    StudySection section{
        .key = "derivatives",
        .title = "Derivatives",
        .text = {},
        .table = {.columns = {"lens", "kind", "number", "felt", "relative_difference"}, .rows = {}},
        .pictures = {}};
    struct Worst {
        double difference = 0.0;
        std::size_t felt = 0;
        std::string lens;
    };
    std::map<std::string, Worst> worst;
    auto lenses = bundled_lenses();
    if (request.quick) lenses.resize(std::min<std::size_t>(2, lenses.size()));
    double done = 0.0;
    for (const BundledLens& each : lenses) {
        const Prescription lens = read_lens(each.file).lens;
        const LightDirection light{4.0, 90.0};
        const PixelFrame frame = pixel_frame(lens.sensor.width_mm, lens.sensor.height_mm, across);
        auto note = [&](const std::string& kind, const SlopeCheck& check) {
            section.table.rows.push_back(
                {each.file.stem().string(), kind, check.number, check.felt, check.difference});
            Worst& sum = worst[kind];
            // What moves the picture by less than a millionth over its prior is not felt.
            if (check.felt < 1e-6) return;
            ++sum.felt;
            if (check.difference <= sum.difference) return;
            sum.difference = check.difference;
            sum.lens = each.file.stem().string();
        };
        for (const std::string kind :
             {"center", "thickness", "layer.1", "layer-index.1", "reflectance", "radius", "gap",
              "index", "semi-diameter", "stop-size", "stop-x", "stop-y", "stop-rotation"}) {
            const bool own = kind == "center" || kind == "thickness";
            const bool film = kind.starts_with("layer") || kind == "reflectance";
            Prescription with = film ? coated(lens, kind) : lens;
            // A stop as wide as its rim hardly cuts a ghost: closed to 0.6 of it.
            if (kind.starts_with("stop")) {
                with.stop.f_number.reset();
                with.stop.semi_diameter_mm =
                    0.6 * with.surfaces[with.stop.surface].semi_diameter_mm;
            }
            // Blades, where the lens lists none: a hexagon.
            if (kind == "stop-rotation" && with.stop.blades < 3) with.stop.blades = 6;
            std::vector<FitParameter> parameters;
            try {
                parameters = parse_vary(kind.starts_with("stop") ? kind : kind + "@all", with);
            } catch (const Error&) {
                continue;  // no surface of this lens has that
            }
            const FitParameter& first = parameters.front();
            note(kind, own || film
                           ? SlopeCheck{.number = name(first),
                                        .felt = 1.0,
                                        .difference = coating_difference(with, first, light, frame)}
                           : geometry_difference(with, parameters, light, frame));
        }
        const auto place = place_differences(lens, light, frame);
        const char* const names[3] = {"shift x", "shift y", "rotation"};
        for (std::size_t k = 0; k < 3; ++k)
            note(k < 2 ? "shift" : "rotation",
                 {.number = names[k], .felt = 1.0, .difference = place[k]});
        note("field", field_difference(lens, light, frame));
        if (request.progress) request.progress(++done / static_cast<double>(lenses.size()));
    }
    section.text = fmt::format(
        "Slopes of the model's picture ({} samples across, up to {} ghosts, 4°) on {} bundled "
        "lenses, by ceres::Jet through films, rays and rims, against central differences of "
        "pictures, relative root mean square. Of geometry the number of each kind that the picture "
        "feels most; a lens whose picture does not feel the kind is not counted.\n\n"
        "| kind | lenses that feel it | largest difference | on |\n| --- | --- | --- | --- |\n",
        across, most_ghosts, lenses.size());
    for (const auto& [kind, sum] : worst)
        section.text +=
            fmt::format("| `{}` | {} | {:.2g} | {} |\n", kind,
                        kind == "shift" ? sum.felt / 2 : sum.felt, sum.difference, sum.lens);
    return section;
}

}  // namespace ghostlight::cli
