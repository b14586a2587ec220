#pragma once

#include <array>
#include <cstddef>
#include <stop_token>
#include <vector>

#include "core/fit/fit_data.h"
#include "core/fit/fit_parameters.h"
#include "core/flare/spectrum.h"
#include "core/ghosts/ghost_path.h"
#include "core/optics/optical_system.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// A lens compiled for a fit: the geometry at a few wavelengths, weights at many.
struct FitScene {
    FittedLens lens;
    std::vector<SpectralSample> samples;
    std::vector<Rgb> colors;                 ///< of the samples, weight included
    std::vector<OpticalSystem> geometry;     ///< at one wavelength, or at three
    std::vector<std::vector<double>> nodes;  ///< by sample: shares of the geometry nodes
    std::size_t main = 0;
    std::vector<GhostPath> ghosts;
    const OpticalSystem& system() const { return geometry[main]; }
};
FitScene fit_scene(const FittedLens& lens, const Spectrum& spectrum, int spectral_samples);

/// Functions of the entrance pupil by which a ghost's weight is written: polynomials of v and u²
/// up to the third degree, since a round lens weighs u and −u alike. u and v go from −1 to 1 over
/// the part of the pupil that arrives on the sensor.
inline constexpr int pupil_terms = 6;
std::array<double, pupil_terms> pupil_functions(double u, double v);

/// One meeting of the light with an interface that does something to it.
struct FilmEvent {
    std::size_t surface = 0;
    bool forward = true, reflects = false;
};

/// One ray that stands for its part of the pupil: what films need of it.
struct FilmRay {
    std::vector<double> cosines;  ///< of incidence, event by event, wavelengths running faster
    std::vector<double> passed;   ///< by the glasses, wavelength by wavelength; empty: all
    std::vector<double> turn_cos, turn_sin;  ///< of the frame of s and p into each event's plane
};

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

/// A small piece of a ghost's bundle that passes: its middle on the sensor and in the pupil, and
/// its area across the beam.
struct BundlePiece {
    double x_mm, y_mm, u, v, area_mm2;
};

/// The pieces of one ghost, small against a sample, that land on the frame, at each geometry node.
struct GhostPieces {
    std::vector<std::vector<BundlePiece>> at_node;
    std::vector<std::array<double, 2>> ray_places;  ///< u, v in mm across the beam, for FilmRays
    std::vector<double> ray_areas;
    double u_half_mm = 1.0, v_mid_mm = 0.0, v_half_mm = 1.0;  ///< of u, v from −1 to 1
    std::size_t traced = 0;
};
GhostPieces ghost_pieces(const FitScene& scene, const GhostPath& path, const LightDirection& light,
                         const PixelFrame& frame, bool main_only);

/// Empty for a ghost that does not land on the frame.
GhostBasis ghost_basis(const FitScene& scene, std::size_t ghost, const LightDirection& light,
                       const PixelFrame& frame, const FitPlace& place, bool main_only = false);

/// Of all ghosts, those that land on the frame. Nothing when stopped.
std::vector<GhostBasis> ghost_bases(const FitScene& scene, const LightDirection& light,
                                    const PixelFrame& frame, const FitPlace& place, bool main_only,
                                    unsigned threads, std::stop_token stop);

/// Derivatives of the picture by the place, for given coefficients of one ghost (nodes ×
/// pupil_terms × 3): x, y and rotation, added to three pictures of 3 values a sample.
void add_place_slopes(const FitScene& scene, const GhostBasis& basis, const LightDirection& light,
                      const PixelFrame& frame, const FitPlace& place,
                      const std::vector<double>& coefficients,
                      std::array<std::vector<double>, 3>& slopes);

}  // namespace ghostlight
