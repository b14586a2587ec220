#include "core/flare/film_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/flare/film_tables_kernel.h"
#include "core/instruction_set.h"
#include "core/optics/hullin_2011.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

constexpr int nodes = 257;  ///< of cos θ from 0 to 1
constexpr std::size_t padded_nodes = (nodes + film_padding - 1) / film_padding * film_padding;
constexpr std::size_t tables_per_surface = 4;  ///< from either side, reflected or transmitted

void curve(const FilmCurveView& view) { GHOSTLIGHT_DISPATCH(film_curve, view); }

/// Cosines where n sin θ is what it is at `cosines` in an index of `main_n`.
std::vector<float> cosines_in(double n, double main_n, const std::vector<float>& cosines) {
    if (n == main_n) return cosines;
    std::vector<float> own;
    for (const float cosine : cosines) {
        const auto c = static_cast<double>(cosine);
        const double square = 1.0 - (main_n / n) * (main_n / n) * (1.0 - c * c);
        own.push_back(static_cast<float>(std::sqrt(std::max(square, 0.0))));
    }
    return own;
}

/// Along one path: a table for each step, `wavelengths` values a ray to be written.
SpectralWeightsView view_of(const Bundle<float>& rays, const std::vector<const float*>& tables,
                            std::size_t wavelengths, std::vector<float>& values) {
    return {.cosines = rays.cosines.data(),
            .stride = rays.cosine_stride,
            .step_count = tables.size(),
            .count = rays.size(),
            .tables = tables.data(),
            .nodes = nodes,
            .wavelengths = wavelengths,
            .weights = values.data()};
}

}  // namespace

FilmTables::FilmTables(const std::vector<OpticalSystem>& systems, unsigned threads,
                       CoatingModel model, const OpticalSystem* main)
    : stride_(systems.size() == 1
                  ? 1
                  : (systems.size() + film_padding - 1) / film_padding * film_padding),
      surfaces_(turning_count(systems.front())) {
    const std::size_t table_size = static_cast<std::size_t>(nodes) * stride_;
    values_.assign(surfaces_ * tables_per_surface * table_size, 0.0F);
    s_shares_.assign(values_.size(), 1.0F);
    most_.assign(surfaces_ * 2 * static_cast<std::size_t>(nodes), 0.0F);
    keep_absorption(systems);
    invisible_.assign(surfaces_, true);
    for (std::size_t s = 0; s < surfaces_; ++s)
        for (const OpticalSystem& system : systems)
            if (surface_at(system, s).uniform_reflectance ||
                !is_invisible(surface_at(system, s).film))
                invisible_[s] = false;
    std::vector<float> cosines(padded_nodes, 1.0F);
    for (int i = 0; i < nodes; ++i)
        cosines[static_cast<std::size_t>(i)] = static_cast<float>(i) / (nodes - 1);
    parallel_for(surfaces_ * 2, threads, {}, [&](std::size_t task) {
        const std::size_t surface = task / 2;
        const bool forward = task % 2 == 0;
        if (invisible_[surface]) return;
        std::vector<float> r(padded_nodes), t(padded_nodes), most(padded_nodes);
        std::vector<float> s_reflected(padded_nodes), s_passed(padded_nodes);
        float* most_here = &most_[task * static_cast<std::size_t>(nodes)];
        std::vector<LayerAt<float>> layers;
        for (std::size_t w = 0; w < systems.size(); ++w) {
            const SurfaceAt& at = surface_at(systems[w], surface);
            const Film& own = at.film;
            const Film film = forward ? own : reversed(own);
            layers.clear();
            for (const FilmLayer& layer : film.layers)
                layers.push_back({static_cast<float>(layer.n * layer.n - layer.k * layer.k),
                                  static_cast<float>(2.0 * layer.n * layer.k),
                                  static_cast<float>(2.0 * std::numbers::pi / film.wavelength_nm *
                                                     layer.thickness_nm)});
            const std::vector<AngleAt<float>> angles = angles_at<float>(film);
            double main_n = film.n_in;
            if (main != nullptr) {
                const Film& traced = surface_at(*main, surface).film;
                main_n = forward ? traced.n_in : traced.n_out;
            }
            const std::vector<float> own_cosines = cosines_in(film.n_in, main_n, cosines);
            curve({.n_in = static_cast<float>(film.n_in),
                   .n_out = static_cast<float>(film.n_out),
                   .layers = layers.data(),
                   .layer_count = static_cast<int>(layers.size()),
                   .absorbing = is_absorbing(film),
                   .angles = angles.empty() ? nullptr : angles.data(),
                   .angle_count = static_cast<int>(angles.size()),
                   .count = padded_nodes,
                   .cosines = own_cosines.data(),
                   .reflectance = r.data(),
                   .transmittance = t.data(),
                   .s_reflected = s_reflected.data(),
                   .s_passed = s_passed.data(),
                   .most_reflected = most.data()});
            if (model == CoatingModel::hullin_2011) {
                std::ranges::fill(t, 1.0F);
                for (std::size_t i = 0; i < padded_nodes && film.layers.size() == 1; ++i)
                    r[i] = static_cast<float>(hullin_2011_reflectance(
                        static_cast<double>(own_cosines[i]), film.wavelength_nm,
                        film.layers.front().thickness_nm, film.n_in, film.layers.front().n,
                        film.n_out));
                // Its mean of s and p is all it gives; the larger is at most twice that.
                std::ranges::transform(r, most.begin(), [](float mean) { return 2.0F * mean; });
            }
            if (at.uniform_reflectance) {
                std::ranges::fill(r, static_cast<float>(*at.uniform_reflectance));
                std::ranges::fill(t, static_cast<float>(1.0 - *at.uniform_reflectance));
                most = r;
                std::ranges::fill(s_reflected, 1.0F);
                std::ranges::fill(s_passed, 1.0F);
            }
            for (const bool reflects : {false, true}) {
                const std::size_t first = table(surface, forward, reflects) + w;
                for (std::size_t i = 0; i < static_cast<std::size_t>(nodes); ++i) {
                    values_[first + i * stride_] = reflects ? r[i] : t[i];
                    s_shares_[first + i * stride_] = reflects ? s_reflected[i] : s_passed[i];
                }
            }
            for (std::size_t i = 0; i < static_cast<std::size_t>(nodes); ++i)
                most_here[i] = std::max(most_here[i], most[i]);
        }
        for (std::size_t i = static_cast<std::size_t>(nodes) - 1; i-- > 0;)
            most_here[i] = std::max(most_here[i], most_here[i + 1]);
    });
}

void FilmTables::keep_absorption(const std::vector<OpticalSystem>& systems) {
    std::vector<float> per_mm(surfaces_ * 2 * stride_, 0.0F);
    bool any = false;
    for (std::size_t s = 0; s < surfaces_; ++s)
        for (std::size_t w = 0; w < systems.size(); ++w) {
            const SurfaceAt& at = surface_at(systems[w], s);
            per_mm[(s * 2) * stride_ + w] = static_cast<float>(at.absorption_before_per_mm);
            per_mm[(s * 2 + 1) * stride_ + w] = static_cast<float>(at.absorption_after_per_mm);
            any = any || at.absorption_before_per_mm > 0.0 || at.absorption_after_per_mm > 0.0;
        }
    if (any) absorption_per_mm_ = std::move(per_mm);
}

void FilmTables::absorb(const TracePath<float>& path, const Bundle<float>& rays,
                        std::vector<float>& weights) const {
    std::vector<const float*> per_mm;
    for (const TraceStep<float>& step : path.steps) {
        const auto side = static_cast<std::size_t>(step.surface) * 2 + (step.sense > 0.0F ? 0 : 1);
        per_mm.push_back(absorption_per_mm_.data() + side * stride_);
    }
    // What follows the last row; a sensor that reflects is no row.
    const auto last = static_cast<std::size_t>(path.steps.back().surface);
    per_mm.push_back(absorption_per_mm_.data() + (last * 2 + 1) * stride_);
    std::vector<float> depth(stride_);
    for (std::size_t ray = 0; ray < rays.size(); ++ray) {
        std::ranges::fill(depth, 0.0F);
        for (std::size_t step = 0; step < per_mm.size(); ++step) {
            const float length_mm = rays.lengths_mm[step * rays.cosine_stride + ray];
            for (std::size_t w = 0; w < stride_; ++w) depth[w] += per_mm[step][w] * length_mm;
        }
        for (std::size_t w = 0; w < stride_; ++w)
            weights[ray * stride_ + w] *= passed_share(depth[w]);
    }
}

std::size_t FilmTables::table(std::size_t surface, bool forward, bool reflects) const {
    const std::size_t which =
        surface * tables_per_surface + (forward ? 0U : 2U) + (reflects ? 1U : 0U);
    return which * static_cast<std::size_t>(nodes) * stride_;
}

std::vector<const float*> FilmTables::tables_of(const TracePath<float>& path,
                                                const std::vector<float>& values) const {
    std::vector<const float*> tables;
    tables.reserve(path.steps.size());
    for (const TraceStep<float>& step : path.steps) {
        const auto surface = static_cast<std::size_t>(step.surface);
        tables.push_back(invisible_[surface]
                             ? nullptr
                             : values.data() + table(surface, step.sense > 0.0F, step.reflects));
    }
    return tables;
}

double FilmTables::most_reflected(std::size_t surface, bool forward, double least_cosine) const {
    const auto node = static_cast<std::size_t>(std::clamp(least_cosine, 0.0, 1.0) * (nodes - 1));
    return static_cast<double>(
        most_[(surface * 2 + (forward ? 0U : 1U)) * static_cast<std::size_t>(nodes) + node]);
}

void FilmTables::weights(const TracePath<float>& path, const Bundle<float>& rays,
                         std::vector<float>& weights) const {
    const std::vector<const float*> tables = tables_of(path, values_);
    weights.resize(rays.size() * stride_);
    const SpectralWeightsView view = view_of(rays, tables, stride_, weights);
    GHOSTLIGHT_DISPATCH(spectral_weights, view);
    if (path.absorbs && !absorption_per_mm_.empty() && !rays.lengths_mm.empty())
        absorb(path, rays, weights);
}

void FilmTables::polarisation(const TracePath<float>& path, const Bundle<float>& rays,
                              std::vector<float>& factors) const {
    const std::vector<const float*> tables = tables_of(path, s_shares_);
    factors.resize(rays.size() * stride_);
    const SpectralWeightsView view = view_of(rays, tables, stride_, factors);
    GHOSTLIGHT_DISPATCH(spectral_states, view);
}

}  // namespace ghostlight
