#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/optics/trace.h"
#include "core/optics/trace_path.h"

namespace ghostlight {

/// The share of light that an optical depth leaves: between nothing and all, whatever the depth of
/// a ray that failed.
template <class T>
T passed_share(T depth) {
    return depth > T(0) ? std::exp(-depth) : T(1);
}

/// How a bundle's weights are computed.
enum class Weights {
    none,       ///< geometry only
    average,    ///< (R_s + R_p)/2 and (T_s + T_p)/2 at every surface
    polarised,  ///< the state carried along, unpolarised light in
};

/// At most this many stop crossings and reflections are recorded (four-reflection paths).
inline constexpr int max_stop_crossings = 5;
inline constexpr int max_reflections = 4;

/// Rays of one collimated beam along one path, one array per quantity. Points are u e1 + v e2 on
/// the plane across the beam through the first vertex, mm. Rays that fail are carried on with
/// clamped roots; `margin` is negative there (see trace_steps.h).
template <class T>
struct Bundle {
    std::vector<T> u_mm, v_mm;
    std::vector<T> x_mm, y_mm;  ///< on the sensor plane
    std::vector<T> weight;
    std::vector<T> weight_average;  ///< also filled when the polarised weight is asked for
    std::vector<T> margin;  ///< ≥ 0: no miss, no total reflection, not turned, vertex hemisphere
    std::vector<T> r_rel;   ///< largest r over the clear radius, all crossings but the stop's
    std::array<std::vector<T>, max_stop_crossings> stop_u_mm, stop_v_mm;
    /// Mean R at each reflection, as many as the path has.
    std::array<std::vector<T>, max_reflections> reflectance;
    /// There, how far from the onset of total reflection: cos² of refraction, negative beyond.
    std::array<std::vector<T>, max_reflections> onset;
    int stop_crossings = 0;
    int reflections = 0;
    bool keep_cosines = false;
    /// On request: cosines of incidence, step by step, each step's `cosine_stride` apart.
    std::vector<T> cosines;
    std::size_t cosine_stride = 0;
    /// With the cosines, where the path absorbs: lengths of the way to each step and to the sensor,
    /// mm, laid out like the cosines. Legs against the direction of travel are negative.
    std::vector<T> lengths_mm;

    std::size_t size() const { return u_mm.size(); }
};

/// Traces all points of `bundle` (u_mm and v_mm are given, the rest is filled), with the widest
/// SIMD lanes that this processor has.
template <class T>
void trace_bundle(const TracePath<T>& path, const BeamFrame& frame, Weights weights,
                  Bundle<T>& bundle);
extern template void trace_bundle(const TracePath<float>&, const BeamFrame&, Weights,
                                  Bundle<float>&);
extern template void trace_bundle(const TracePath<double>&, const BeamFrame&, Weights,
                                  Bundle<double>&);

}  // namespace ghostlight
