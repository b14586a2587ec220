#pragma once

#include <cstddef>

#include "core/instruction_set.h"
#include "core/optics/film_angles.h"

namespace ghostlight {

/// One interface at one wavelength, to be tabulated over the cosine of incidence.
struct FilmCurveView {
    float n_in, n_out;
    const LayerAt<float>* layers;
    int layer_count;
    bool absorbing;
    const AngleAt<float>* angles;  ///< where shares are given instead of layers, else null
    int angle_count;
    std::size_t count;  ///< of cosines; a multiple of `film_padding`
    const float* cosines;
    float *reflectance, *transmittance;  ///< means of s and p
    float *s_reflected, *s_passed;       ///< that of s over the mean; 1 where there is no light
    float* most_reflected;               ///< the larger of s and p
};

/// Weights of rays at many wavelengths, from tables of each step over the cosine of incidence.
struct SpectralWeightsView {
    const float* cosines;  ///< step by step, `stride` apart
    std::size_t stride, step_count, count;
    const float* const* tables;  ///< of each step: node by node, `wavelengths` values each
    int nodes;
    std::size_t wavelengths;  ///< 1, or a multiple of `film_padding`
    float* weights;           ///< ray by ray, `wavelengths` values each
};

/// Lanes of the widest instruction set.
inline constexpr std::size_t film_padding = 16;

#define GHOSTLIGHT_FILM_KERNELS(set)                   \
    namespace set {                                    \
    void film_curve(const FilmCurveView&);             \
    void spectral_weights(const SpectralWeightsView&); \
    void spectral_states(const SpectralWeightsView&);  \
    }
GHOSTLIGHT_EVERY_SET(GHOSTLIGHT_FILM_KERNELS)
#undef GHOSTLIGHT_FILM_KERNELS

}  // namespace ghostlight
