#pragma once

#include <algorithm>
#include <cmath>

#include "core/ghosts/bundle.h"
#include "core/ghosts/pupil.h"
#include "tests/support/optics_kit.h"

// A second quadrature that knows nothing of the first: one random ray in every cell of a square
// grid over the whole entrance, counted or not.

namespace ghostlight {

struct ReferenceFlux {
    double flux_mm2 = 0.0;
    double sigma_mm2 = 0.0;         ///< standard error, from the scatter of independent repetitions
    double x_mm = 0.0, y_mm = 0.0;  ///< centroid
    int passed = 0;                 ///< rays that count
};

inline ReferenceFlux reference_flux(const OpticalSystem& system, const GhostPath& ghost,
                                    const BeamFrame& frame, int cells, std::uint64_t seed) {
    constexpr int repetitions = 6;
    const PupilBox box = entrance_box(system, frame);
    const TracePath<double> path = trace_path<double>(system, ghost);
    Random random(seed);
    double sum = 0.0, squares = 0.0;
    ReferenceFlux result;
    for (int k = 0; k < repetitions; ++k) {
        Bundle<double> rays;
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i) {
                rays.u_mm.push_back(
                    std::lerp(box.u0_mm, box.u1_mm, (i + random.between(0.0, 1.0)) / cells));
                rays.v_mm.push_back(
                    std::lerp(box.v0_mm, box.v1_mm, (j + random.between(0.0, 1.0)) / cells));
            }
        trace_bundle(path, frame, Weights::polarised, rays);
        double flux = 0.0;
        for (std::size_t n = 0; n < rays.size(); ++n) {
            bool passes = rays.margin[n] >= 0.0 && rays.r_rel[n] <= 1.0;
            for (std::size_t c = 0; passes && c < static_cast<std::size_t>(rays.stop_crossings);
                 ++c)
                passes = stop_passes(system.stop_mask, rays.stop_u_mm[c][n], rays.stop_v_mm[c][n]);
            if (!passes) continue;
            ++result.passed;
            flux += rays.weight[n];
            result.x_mm += rays.weight[n] * rays.x_mm[n];
            result.y_mm += rays.weight[n] * rays.y_mm[n];
        }
        flux *= box.area_mm2() / (cells * cells);
        sum += flux;
        squares += flux * flux;
    }
    result.flux_mm2 = sum / repetitions;
    const double weights = sum * cells * cells / box.area_mm2();
    if (weights > 0.0) {
        result.x_mm /= weights;
        result.y_mm /= weights;
    }
    const double variance =
        std::max(0.0, squares / repetitions - result.flux_mm2 * result.flux_mm2);
    result.sigma_mm2 = std::sqrt(variance / (repetitions - 1));
    return result;
}

}  // namespace ghostlight
