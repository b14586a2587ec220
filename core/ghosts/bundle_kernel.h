#pragma once

#include <cstddef>

#include "core/instruction_set.h"
#include "core/optics/trace_path.h"

namespace ghostlight {

/// As in bundle.h, which no kernel includes.
inline constexpr int max_recorded_reflections = 4;

/// A bundle as the kernels see it: plain arrays whose length is a multiple of `bundle_padding`.
template <class T>
struct BundleView {
    const TraceStep<T>* steps;
    std::size_t step_count;
    const T* aspheric;
    const LayerAt<T>* layers;
    T sensor_gap_mm;
    T direction[3], e1[3], e2[3];
    std::size_t count;
    const T *u, *v;
    T *x, *y, *weight, *weight_average, *margin, *r_rel;
    T* const* stop_u;
    T* const* stop_v;
    T *reflectance[max_recorded_reflections], *onset[max_recorded_reflections];
    T* cosines;   ///< of incidence, `count` for each step; null when nobody asks
    T* lengths;   ///< mm to each step and to the sensor, `count` for each; null when nobody asks
    int weights;  ///< Weights, as a number
};

/// Lanes of the widest instruction set, for the narrowest type.
inline constexpr std::size_t bundle_padding = 16;

#define GHOSTLIGHT_BUNDLE_KERNELS(set)                  \
    namespace set {                                     \
    void trace_bundle_lanes(const BundleView<float>&);  \
    void trace_bundle_lanes(const BundleView<double>&); \
    }
GHOSTLIGHT_EVERY_SET(GHOSTLIGHT_BUNDLE_KERNELS)
#undef GHOSTLIGHT_BUNDLE_KERNELS

}  // namespace ghostlight
