#include "core/fit/ghost_weights.h"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/optics/trace_steps.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

constexpr int most_parameters = 6;  ///< of one surface
using Jet = ceres::Jet<double, most_parameters>;

/// A parameter's step for the derivative of a film's layers, which are linear in thicknesses and
/// smooth in indices: the error is the step squared.
double layer_step(FitKind kind, double value) {
    switch (kind) {
        case FitKind::center:
            return 0.02;
        case FitKind::layer_thickness:
            return 1e-4 * std::max(1.0, std::abs(value));
        case FitKind::layer_index:
            return 1e-5;
        case FitKind::reflectance:
            return 1e-7;
        default:
            return 1e-5;
    }
}

/// Writes value and slope of a film into jets.
struct JetFilm {
    std::vector<LayerAt<Jet>> layers;
    std::vector<AngleAt<Jet>> angles;
    TraceStep<Jet> step{};
};

JetFilm jets_of(const Interface& interface, bool forward) {
    const Film film = forward ? interface.film : reversed(interface.film);
    JetFilm jets;
    for (const FilmLayer& layer : film.layers)
        jets.layers.push_back(
            {Jet(layer.n * layer.n - layer.k * layer.k), Jet(2.0 * layer.n * layer.k),
             Jet(2.0 * std::numbers::pi / film.wavelength_nm * layer.thickness_nm)});
    jets.angles = angles_at<Jet>(film);
    jets.step.n_in = Jet(film.n_in);
    jets.step.n_out = Jet(film.n_out);
    jets.step.layer_count = static_cast<int>(jets.layers.size());
    jets.step.absorbing = is_absorbing(film);
    jets.step.uniform = interface.uniform_reflectance.has_value();
    jets.step.uniform_r = Jet(std::sqrt(interface.uniform_reflectance.value_or(0.0)));
    jets.step.uniform_t = Jet(std::sqrt(1.0 - interface.uniform_reflectance.value_or(0.0)));
    return jets;
}

void add_slopes(JetFilm& jets, const JetFilm& less, const JetFilm& more, double step, int slot) {
    if (less.layers.size() != jets.layers.size() || more.layers.size() != jets.layers.size() ||
        less.angles.size() != jets.angles.size() || more.angles.size() != jets.angles.size())
        return;
    auto slope = [&](Jet& to, const Jet& a, const Jet& b) {
        to.v[slot] = (b.a - a.a) / (2.0 * step);
    };
    for (std::size_t k = 0; k < jets.layers.size(); ++k) {
        slope(jets.layers[k].n2_re, less.layers[k].n2_re, more.layers[k].n2_re);
        slope(jets.layers[k].n2_im, less.layers[k].n2_im, more.layers[k].n2_im);
        slope(jets.layers[k].k0_d, less.layers[k].k0_d, more.layers[k].k0_d);
    }
    for (std::size_t k = 0; k < jets.angles.size(); ++k) {
        slope(jets.angles[k].r_s, less.angles[k].r_s, more.angles[k].r_s);
        slope(jets.angles[k].r_p, less.angles[k].r_p, more.angles[k].r_p);
        slope(jets.angles[k].t_s, less.angles[k].t_s, more.angles[k].t_s);
        slope(jets.angles[k].t_p, less.angles[k].t_p, more.angles[k].t_p);
    }
}

}  // namespace

Interface interface_at(const Prescription& lens, const OpticalSystem& system, std::size_t row,
                       double wavelength_nm) {
    if (row < lens.surfaces.size())
        return {film_at(lens.surfaces[row].coating, medium_before(lens, row),
                        lens.surfaces[row].medium_after, wavelength_nm),
                std::nullopt};
    const OpticalSystem at =
        system.wavelength_nm == wavelength_nm ? system : compile(lens, wavelength_nm);
    return {at.sensor_face->film, at.sensor_face->uniform_reflectance};
}

GhostWeights::GhostWeights(const FitScene& scene, const std::vector<const GhostBasis*>& bases,
                           const std::vector<FitParameter>& coatings, unsigned threads)
    : scene_(scene), coatings_(coatings), threads_(threads) {
    tables_.resize(2 * (scene.system().surfaces.size() + 1));
    const std::size_t waves = scene.samples.size();
    for (const GhostBasis* basis : bases)
        for (const FilmRay& ray : basis->rays)
            for (std::size_t e = 0; e < basis->events.size(); ++e) {
                const FilmEvent& event = basis->events[e];
                Table& table = tables_[2 * event.surface + (event.forward ? 1 : 0)];
                for (std::size_t k = 0; k < waves; ++k) {
                    const double cosine = ray.cosines[e * waves + k];
                    table.low = std::min(table.low, cosine);
                    table.high = std::max(table.high, cosine);
                }
            }
    for (std::size_t t = 0; t < tables_.size(); ++t) {
        Table& table = tables_[t];
        if (table.low > table.high) continue;
        // Cosines end at 1; a table needs some width.
        const double middle = 0.5 * (table.low + table.high);
        const double half = std::max(0.5 * (table.high - table.low), 1e-4);
        table.low = middle - half;
        table.high = middle + half;
        if (table.high > 1.0) {
            table.low -= table.high - 1.0;
            table.high = 1.0;
        }
        for (std::size_t p = 0; p < coatings_.size(); ++p)
            if (std::ranges::find(coatings_[p].rows, t / 2) != coatings_[p].rows.end())
                table.parameters.push_back(p);
        if (table.parameters.size() > most_parameters)
            throw Error({.problem = "too many variables on one coating",
                         .file = {},
                         .where = {},
                         .found = std::to_string(table.parameters.size()) + " on surface " +
                                  std::to_string(t / 2 + 1),
                         .expected = "at most " + std::to_string(most_parameters)});
        table.values.assign(2 * waves * table_nodes * table.stride(), 0.0);
    }
    std::vector<double> start;
    for (const FitParameter& each : coatings_) start.push_back(each.start);
    parallel_for(tables_.size(), threads_, {},
                 [&](std::size_t t) { fill(t, scene_.lens, start, false); });
}

void GhostWeights::fill(std::size_t which, const FittedLens& lens,
                        const std::vector<double>& values, bool slopes) {
    Table& table = tables_[which];
    if (table.values.empty()) return;
    const std::size_t row = which / 2, waves = scene_.samples.size(), stride = table.stride();
    const bool forward = which % 2 == 1;
    for (std::size_t k = 0; k < waves; ++k) {
        const double nm = scene_.samples[k].wavelength_nm;
        JetFilm jets = jets_of(interface_at(lens.lens, scene_.system(), row, nm), forward);
        if (slopes)
            for (std::size_t l = 0; l < table.parameters.size(); ++l) {
                const FitParameter& parameter = coatings_[table.parameters[l]];
                const double value = values[table.parameters[l]];
                const double step = layer_step(parameter.kind, value);
                auto at = [&](double moved) {
                    // Everything else of this row stays as it is.
                    Coating coating = scene_.lens.lens.surfaces[row].coating;
                    for (const std::size_t p : table.parameters)
                        set_coating(coating, coatings_[p],
                                    p == table.parameters[l] ? moved : values[p]);
                    const Prescription& listed = scene_.lens.lens;
                    return jets_of({film_at(coating, medium_before(listed, row),
                                            listed.surfaces[row].medium_after, nm),
                                    std::nullopt},
                                   forward);
                };
                add_slopes(jets, at(value - step), at(value + step), step, static_cast<int>(l));
            }
        jets.step.angles = jets.angles.empty() ? nullptr : jets.angles.data();
        jets.step.angle_count = static_cast<int>(jets.angles.size());
        for (int node = 0; node < table_nodes; ++node) {
            const double cosine =
                std::lerp(table.low, table.high, static_cast<double>(node) / (table_nodes - 1));
            auto write = [&](std::size_t reflected, const auto& s, const auto& p) {
                double* to = &table.values[((reflected * waves + k) * table_nodes +
                                            static_cast<std::size_t>(node)) *
                                           stride];
                auto put = [&](std::size_t i, const auto& value) {
                    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Jet>) {
                        // Beyond the critical angle, and at grazing, nothing passes whatever the
                        // coating: the root of a jet that is 0 has no slope but 0/0.
                        const bool nothing = reflected == 0 && value.a == 0.0;
                        to[i] = value.a;
                        for (std::size_t l = 0; l < table.parameters.size(); ++l)
                            to[4 * (l + 1) + i] =
                                nothing && !std::isfinite(value.v[static_cast<int>(l)])
                                    ? 0.0
                                    : value.v[static_cast<int>(l)];
                    } else {
                        to[i] = value;
                    }
                };
                put(0, s.re);
                put(1, s.im);
                put(2, p.re);
                put(3, p.im);
            };
            if (slopes && !table.parameters.empty()) {
                const auto film = amplitudes(jets.step, jets.layers.data(), Jet(cosine));
                write(0, film.t_s, film.t_p);
                write(1, film.r_s, film.r_p);
            } else {
                TraceStep<double> step{};
                step.n_in = jets.step.n_in.a;
                step.n_out = jets.step.n_out.a;
                step.layer_count = jets.step.layer_count;
                step.absorbing = jets.step.absorbing;
                step.uniform = jets.step.uniform;
                step.uniform_r = jets.step.uniform_r.a;
                step.uniform_t = jets.step.uniform_t.a;
                std::vector<LayerAt<double>> layers;
                for (const auto& layer : jets.layers)
                    layers.push_back({layer.n2_re.a, layer.n2_im.a, layer.k0_d.a});
                std::vector<AngleAt<double>> angles;
                for (const auto& a : jets.angles)
                    angles.push_back({a.cos_thin.a, a.r_s.a, a.r_p.a, a.t_s.a, a.t_p.a});
                step.angles = angles.empty() ? nullptr : angles.data();
                step.angle_count = static_cast<int>(angles.size());
                const auto film = amplitudes(step, layers.data(), cosine);
                write(0, film.t_s, film.t_p);
                write(1, film.r_s, film.r_p);
            }
        }
    }
}

bool GhostWeights::update(const std::vector<double>& values, bool slopes, std::stop_token stop) {
    FittedLens lens = scene_.lens;
    for (std::size_t p = 0; p < coatings_.size(); ++p) set(lens, coatings_[p], values[p]);
    return parallel_for(tables_.size(), threads_, std::move(stop), [&](std::size_t t) {
        if (!tables_[t].parameters.empty()) fill(t, lens, values, slopes);
    });
}

}  // namespace ghostlight
