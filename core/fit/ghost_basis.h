#pragma once

#include <array>
#include <cstddef>
#include <stop_token>
#include <vector>

#include "core/fit/film_rays.h"
#include "core/fit/fit_data.h"
#include "core/fit/fit_scene.h"
#include "core/fit/ghost_pieces.h"

namespace ghostlight {

/// Functions of the entrance pupil by which a ghost's weight is written: polynomials of v and u²
/// up to the third degree, since a round lens weighs u and −u alike. u and v go from −1 to 1 over
/// the part of the pupil that arrives on the sensor.
inline constexpr int pupil_terms = 6;
template <class S>
std::array<S, pupil_terms> pupil_functions(const S& u, const S& v) {
    return {S(1.0), v, v * v, v * v * v, u * u, u * u * v};
}

/// What a ghost leaves on the samples of a photograph, for a weight of 1 × each pupil function at
/// each geometry node: Σ dA f(u, v) spline(x − x') spline(y − y') over h². Everything that a
/// coating does not move.
struct GhostBasis {
    std::size_t ghost = 0;                                       ///< index in the scene's list
    int first_column = 0, first_row = 0, columns = 0, rows = 0;  ///< of the patch, samples
    std::size_t nodes = 1;      ///< of geometry: 1 where colours fall together on this scale
    std::vector<float> values;  ///< sample by sample, nodes × pupil_terms each
    std::vector<FilmEvent> events;
    std::vector<FilmRay> rays;
    std::vector<double> projection;  ///< pupil_terms × rays: weights of the rays → coefficients
    GhostGrid grid;                  ///< of its rays
    std::size_t traced = 0;
    bool empty() const { return values.empty(); }
    std::size_t width() const { return nodes * pupil_terms; }
    const float* at(int column, int row) const {
        return &values[width() * static_cast<std::size_t>((row - first_row) * columns + column -
                                                          first_column)];
    }
};

/// Placing of the picture on the sensor: what is not of the lens.
struct FitPlace {
    double shift_x_mm = 0.0, shift_y_mm = 0.0, rotation_rad = 0.0;
};

/// Empty for a ghost that does not land on the frame.
GhostBasis ghost_basis(const FitScene& scene, std::size_t ghost, const LightDirection& light,
                       const PixelFrame& frame, const FitPlace& place, bool main_only = false);

/// On a grid that was found before, for this lens or for one a little different: pictures that
/// differ by the lens alone.
GhostBasis ghost_basis(const FitScene& scene, std::size_t ghost, const LightDirection& light,
                       const PixelFrame& frame, const FitPlace& place, const GhostGrid& grid);

/// Of all ghosts, those that land on the frame. Nothing when stopped.
std::vector<GhostBasis> ghost_bases(const FitScene& scene, const LightDirection& light,
                                    const PixelFrame& frame, const FitPlace& place, bool main_only,
                                    unsigned threads, std::stop_token stop);

}  // namespace ghostlight
