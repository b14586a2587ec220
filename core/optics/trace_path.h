#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "core/ghosts/ghost_path.h"
#include "core/optics/film_angles.h"
#include "core/optics/optical_system.h"
#include "core/optics/thin_film.h"

namespace ghostlight {

/// One event of a path, flattened: all that the trace needs, on the scalar T.
template <class T>
struct TraceStep {
    T gap_mm;  ///< previous vertex z minus this one's: added to the ray's z
    T curvature, conic;
    T inverse_clear;                            ///< 1 / semi-diameter
    T inverse_half_width, inverse_half_height;  ///< instead, where `rectangular`
    T uniform_r, uniform_t;                     ///< amplitudes, where `uniform`
    T n_in, n_out;        ///< along travel; n_out is the far side's also where the ray reflects
    T eta;                ///< n_in / n_out
    T sense;              ///< nominal direction of travel before the event, ±1
    T absorption_per_mm;  ///< −ln τ of the medium that leads here
    int first_aspheric, aspheric_count;
    int first_layer, layer_count;
    const AngleAt<T>* angles;  ///< of a film whose shares are given instead of layers, else null
    int angle_count;
    int surface;
    bool reflects, at_stop, absorbing, invisible;
    bool spherical;    ///< or plane: the normal comes out with unit length
    bool rectangular;  ///< the sensor's face: clear inside its rectangle
    bool uniform;      ///< reflects the same at every angle and polarisation
};

/// A lens unfolded along one path, ready to trace.
template <class T>
struct TracePath {
    std::vector<TraceStep<T>> steps;
    std::vector<T> aspheric;  ///< coefficients A4, A6, … of all aspheric steps
    std::vector<LayerAt<T>> layers;
    /// What the steps' `angles` point to: copies of a path share it, so that they stay valid.
    std::vector<std::shared_ptr<const std::vector<AngleAt<T>>>> angles;
    T sensor_gap_mm{};  ///< last vertex z minus the sensor's
    T sensor_absorption_per_mm{};
    bool absorbs = false;  ///< in one of its media
    int stop_crossings = 0;
};

/// The given shares of a film on the scalar T.
template <class T>
std::vector<AngleAt<T>> angles_at(const Film& film) {
    std::vector<AngleAt<T>> angles;
    for (const FilmAngle& at : film.angles)
        angles.push_back({T(at.cos_thin), T(at.shares.r_s), T(at.shares.r_p), T(at.shares.t_s),
                          T(at.shares.t_p)});
    return angles;
}

template <class T>
TracePath<T> trace_path(const OpticalSystem& system, const GhostPath& ghost) {
    TracePath<T> path;
    double z = 0.0;
    const std::vector<PathEvent> met = events(ghost, system.surfaces.size());
    path.steps.reserve(met.size());
    for (const PathEvent& event : met) {
        const SurfaceAt& surface = surface_at(system, event.surface);
        // Not reversed(film): a path is unfolded several times for each ghost of each picture.
        const Film& film = surface.film;
        const double n_in = event.forward ? film.n_in : film.n_out;
        const double n_out = event.forward ? film.n_out : film.n_in;
        TraceStep<T> step{};
        step.gap_mm = T(z - surface.vertex_z_mm);
        z = surface.vertex_z_mm;
        step.curvature = T(surface.curvature_per_mm);
        step.conic = T(surface.conic);
        step.inverse_clear = T(1.0 / surface.semi_diameter_mm);
        step.n_in = T(n_in);
        step.n_out = T(n_out);
        step.eta = T(n_in / n_out);
        step.spherical = surface.conic == 0.0 && surface.aspheric.empty();
        step.sense = T(event.forward ? 1.0 : -1.0);
        step.absorption_per_mm =
            T(event.forward ? surface.absorption_before_per_mm : surface.absorption_after_per_mm);
        if (step.absorption_per_mm > T(0)) path.absorbs = true;
        step.first_aspheric = static_cast<int>(path.aspheric.size());
        step.aspheric_count = static_cast<int>(surface.aspheric.size());
        for (const double a : surface.aspheric) path.aspheric.push_back(T(a));
        step.first_layer = static_cast<int>(path.layers.size());
        step.layer_count = static_cast<int>(film.layers.size());
        for (std::size_t k = 0; k < film.layers.size(); ++k) {
            const FilmLayer& layer = film.layers[event.forward ? k : film.layers.size() - 1 - k];
            path.layers.push_back(
                {T(layer.n * layer.n - layer.k * layer.k), T(2.0 * layer.n * layer.k),
                 T(2.0 * std::numbers::pi / film.wavelength_nm * layer.thickness_nm)});
        }
        if (!film.angles.empty()) {
            path.angles.push_back(
                std::make_shared<const std::vector<AngleAt<T>>>(angles_at<T>(film)));
            step.angles = path.angles.back()->data();
            step.angle_count = static_cast<int>(film.angles.size());
        }
        step.surface = static_cast<int>(event.surface);
        step.reflects = event.reflects;
        step.at_stop = event.surface == system.stop;
        step.rectangular = event.surface == system.surfaces.size();
        step.inverse_half_width = T(2.0 / system.sensor_width_mm);
        step.inverse_half_height = T(2.0 / system.sensor_height_mm);
        step.uniform = surface.uniform_reflectance.has_value();
        step.uniform_r = T(std::sqrt(surface.uniform_reflectance.value_or(0.0)));
        step.uniform_t = T(std::sqrt(1.0 - surface.uniform_reflectance.value_or(0.0)));
        if (step.at_stop) ++path.stop_crossings;
        step.absorbing = is_absorbing(film);
        step.invisible = !step.uniform && is_invisible(film);
        path.steps.push_back(step);
    }
    path.sensor_gap_mm = T(z - system.sensor_z_mm);
    path.sensor_absorption_per_mm = T(system.surfaces.back().absorption_after_per_mm);
    if (path.sensor_absorption_per_mm > T(0)) path.absorbs = true;
    return path;
}

}  // namespace ghostlight
