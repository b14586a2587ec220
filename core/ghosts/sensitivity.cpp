#include "core/ghosts/sensitivity.h"

#include <ceres/jet.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/ghosts/flux_quadrature.h"
#include "core/optics/optical_system.h"
#include "core/optics/trace_steps.h"

namespace ghostlight {
namespace {

constexpr int parameters_at_once = 8;
using Jet = ceres::Jet<double, parameters_at_once>;

/// A parameter's relative step for the derivative of a film's layers. Thicknesses are linear in it;
/// of an index at λ0 the error is its square.
constexpr double relative_step = 1e-4;

/// Wavelengths of an integral over a continuous light: films of a few layers are smooth on 300/16
/// nm.
constexpr int spectral_nodes = 17;

double nominal_thickness_nm(const QuarterWave& film, const Medium& before, const Medium& after) {
    QuarterWave nominal = film;
    nominal.thickness_factor = 1.0;
    const Film at_center = film_at(nominal, before, after, film.center_nm);
    return at_center.layers.empty() ? 0.0 : at_center.layers.front().thickness_nm;
}

/// The film of a surface with one parameter at another value, seen from the incoming side.
Film film_with(const Prescription& lens, const CoatingParameter& parameter, double value,
               double wavelength_nm, double n_before_sensor) {
    using Kind = CoatingParameter::Kind;
    if (parameter.surface == lens.surfaces.size()) {
        SensorFilms films = std::get<SensorFilms>(*lens.sensor.reflectance);
        films.stack.layers[parameter.layer].thickness_nm = value;
        return film_at(films.stack, {"", ConstantIndex{n_before_sensor}}, films.substrate,
                       wavelength_nm);
    }
    const Medium& before = medium_before(lens, parameter.surface);
    const Medium& after = lens.surfaces[parameter.surface].medium_after;
    Coating coating = lens.surfaces[parameter.surface].coating;
    if (auto* film = std::get_if<QuarterWave>(&coating)) {
        if (parameter.kind == Kind::center)
            film->center_nm = value;
        else
            film->thickness_factor = value / nominal_thickness_nm(*film, before, after);
    } else {
        std::get<LayerStack>(coating).layers[parameter.layer].thickness_nm = value;
    }
    return film_at(coating, before, after, wavelength_nm);
}

/// Writes the derivatives of a surface's layers by one parameter into the path's.
void seed(TracePath<Jet>& path, const Prescription& lens, const OpticalSystem& system,
          const CoatingParameter& parameter, int slot) {
    if (parameter.kind == CoatingParameter::Kind::reflectance) return;
    const double step = relative_step * std::max(parameter.value, 1.0);
    auto at = [&](double value) {
        return film_with(lens, parameter, value, system.wavelength_nm,
                         system.surfaces.back().n_after);
    };
    const Film now = at(parameter.value), less = at(parameter.value - step),
               more = at(parameter.value + step);
    if (less.layers.size() != now.layers.size() || more.layers.size() != now.layers.size()) return;
    for (TraceStep<Jet>& each : path.steps) {
        if (static_cast<std::size_t>(each.surface) != parameter.surface) continue;
        const std::size_t count = now.layers.size();
        for (std::size_t k = 0; k < count; ++k) {
            // Layers of light that goes back are in reverse order.
            const std::size_t place = each.sense.a > 0.0 ? k : count - 1 - k;
            LayerAt<Jet>& layer = path.layers[static_cast<std::size_t>(each.first_layer) + place];
            auto slope = [&](auto value) {
                return (value(more.layers[k]) - value(less.layers[k])) / (2.0 * step);
            };
            layer.n2_re.v[slot] = slope([](const FilmLayer& l) { return l.n * l.n - l.k * l.k; });
            layer.n2_im.v[slot] = slope([](const FilmLayer& l) { return 2.0 * l.n * l.k; });
            layer.k0_d.v[slot] = slope([](const FilmLayer& l) { return l.thickness_nm; }) *
                                 layer.k0_d.a / now.layers[k].thickness_nm;
        }
    }
}

/// Way along the ray from `start`, which was relative to the surface before, mm.
double length_of(const Vec3<Jet>& start, double gap_mm, const RayAt<Jet>& ray) {
    const Vec3<Jet>& end = ray.position;
    return (end.x.a - start.x.a) * ray.direction.x.a + (end.y.a - start.y.a) * ray.direction.y.a +
           (end.z.a - start.z.a - gap_mm) * ray.direction.z.a;
}

/// The weight of a ray with its derivatives by up to eight parameters.
Jet weight_of(const TracePath<Jet>& path, const BeamFrame& frame, double u_mm, double v_mm,
              const std::vector<CoatingParameter>& parameters, std::size_t first) {
    const glm::dvec3 origin = u_mm * frame.e1 + v_mm * frame.e2;
    const glm::dvec3& d = frame.direction;
    RayAt<Jet> ray{{Jet(origin.x), Jet(origin.y), Jet(origin.z)}, {Jet(d.x), Jet(d.y), Jet(d.z)}};
    JonesState<Jet> jones =
        jones_start<Jet>(Vec3<Jet>(Jet(frame.e1.x), Jet(frame.e1.y), Jet(frame.e1.z)));
    double by_reflectance[parameters_at_once] = {};
    double depth = 0.0;
    for (const TraceStep<Jet>& step : path.steps) {
        const Vec3<Jet> start = ray.position;
        const Meeting<Jet> meeting = meet(step, path.aspheric.data(), Jet(1.0), ray);
        depth += step.absorption_per_mm.a * length_of(start, step.gap_mm.a, ray);
        const Vec3<Jet> before = ray.direction;
        turn(step, meeting, ray);
        if (step.invisible) continue;
        const auto film = amplitudes(step, path.layers.data(), meeting.cos_incidence);
        apply(film, step.reflects, meeting, before, jones);
        const double share = step.reflects ? 0.5 * (norm(film.r_s).a + norm(film.r_p).a)
                                           : -0.5 * (norm(film.t_s).a + norm(film.t_p).a);
        for (std::size_t k = 0; k < parameters_at_once && first + k < parameters.size(); ++k) {
            const CoatingParameter& parameter = parameters[first + k];
            if (parameter.kind == CoatingParameter::Kind::reflectance &&
                parameter.surface == static_cast<std::size_t>(step.surface) && share != 0.0)
                by_reflectance[k] += 1.0 / share;
        }
    }
    const Jet to_sensor = -(ray.position.z + path.sensor_gap_mm) / ray.direction.z;
    depth += path.sensor_absorption_per_mm.a * to_sensor.a;
    Jet weight = 0.5 * passed_share(depth) * (jones.intensity(0) + jones.intensity(1));
    for (int k = 0; k < parameters_at_once; ++k) weight.v[k] += weight.a * by_reflectance[k];
    return weight;
}

/// Of one wavelength: the flux and its derivatives, not yet over the flux.
struct FluxSlopes {
    double flux_mm2 = 0.0;
    std::vector<double> slopes;
};

FluxSlopes flux_slopes(const Prescription& lens, double wavelength_nm, const BeamFrame& frame,
                       const GhostPath& ghost, const std::vector<CoatingParameter>& parameters) {
    const OpticalSystem system = compile(lens, wavelength_nm);
    const PathQuadrature quadrature(system, ghost, frame);
    const std::vector<BeamPart> parts = quadrature.parts(quadrature.start());
    FluxSlopes sum{0.0, std::vector<double>(parameters.size(), 0.0)};
    for (std::size_t first = 0; first < parameters.size(); first += parameters_at_once) {
        TracePath<Jet> path = trace_path<Jet>(system, ghost);
        const std::size_t end = std::min(parameters.size(), first + parameters_at_once);
        for (std::size_t k = first; k < end; ++k)
            seed(path, lens, system, parameters[k], static_cast<int>(k - first));
        sum.flux_mm2 = 0.0;
        for (const BeamPart& part : parts) {
            const Jet weight = weight_of(path, frame, part.u_mm, part.v_mm, parameters, first);
            if (!std::isfinite(weight.a)) continue;
            sum.flux_mm2 += part.area_mm2 * weight.a;
            for (std::size_t k = first; k < end; ++k)
                sum.slopes[k] += part.area_mm2 * weight.v[static_cast<int>(k - first)];
        }
    }
    return sum;
}

}  // namespace

std::string name(const CoatingParameter& parameter) {
    switch (parameter.kind) {
        case CoatingParameter::Kind::layer_thickness:
            return fmt::format("thickness of layer {}", parameter.layer + 1);
        case CoatingParameter::Kind::center:
            return "center";
        case CoatingParameter::Kind::reflectance:
            return "reflectance";
    }
    return {};
}

std::string unit(const CoatingParameter& parameter) {
    return parameter.kind == CoatingParameter::Kind::reflectance ? "1" : "nm";
}

std::vector<CoatingParameter> coating_parameters(const Prescription& lens, double wavelength_nm) {
    using Kind = CoatingParameter::Kind;
    const OpticalSystem system = compile(lens, wavelength_nm);
    std::vector<CoatingParameter> all;
    auto add_layers = [&](std::size_t row, const LayerStack& stack) {
        for (std::size_t k = 0; k < stack.layers.size(); ++k)
            if (stack.layers[k].thickness_nm > 0.0)
                all.push_back({row, Kind::layer_thickness, k, stack.layers[k].thickness_nm});
    };
    for (std::size_t row = 0; row < turning_count(system); ++row) {
        const SurfaceAt& surface = surface_at(system, row);
        if (!surface.reflects) continue;
        if (row == system.surfaces.size()) {
            if (const auto* films = std::get_if<SensorFilms>(&*lens.sensor.reflectance))
                add_layers(row, films->stack);
        } else if (const auto* film = std::get_if<QuarterWave>(&lens.surfaces[row].coating)) {
            const double nominal = nominal_thickness_nm(*film, medium_before(lens, row),
                                                        lens.surfaces[row].medium_after);
            if (nominal * film->thickness_factor > 0.0) {
                all.push_back({row, Kind::layer_thickness, 0, nominal * film->thickness_factor});
                all.push_back({row, Kind::center, 0, film->center_nm});
            }
        } else if (const auto* stack = std::get_if<LayerStack>(&lens.surfaces[row].coating)) {
            add_layers(row, *stack);
        }
        all.push_back({row, Kind::reflectance, 0,
                       surface.uniform_reflectance.value_or(reflectances(surface.film, 1.0).r())});
    }
    return all;
}

std::vector<double> flux_sensitivities(const Prescription& lens, const Spectrum& spectrum,
                                       const LightDirection& light, const GhostPath& ghost,
                                       const std::vector<CoatingParameter>& parameters) {
    const BeamFrame frame = beam_frame(light);
    std::vector<double> slopes(parameters.size(), 0.0);
    double flux_mm2 = 0.0;
    for (const SpectralSample& sample : nested_samples(spectrum, spectral_nodes)) {
        const FluxSlopes at = flux_slopes(lens, sample.wavelength_nm, frame, ghost, parameters);
        flux_mm2 += sample.weight * at.flux_mm2;
        for (std::size_t k = 0; k < slopes.size(); ++k) slopes[k] += sample.weight * at.slopes[k];
    }
    for (double& slope : slopes) slope = flux_mm2 > 0.0 ? slope / flux_mm2 : 0.0;
    return slopes;
}

}  // namespace ghostlight
