// Compiled once per instruction set; see core/CMakeLists.txt. Nothing here may call an inline
// function that is shared with the rest of the program.
#include "core/flare/film_tables_kernel.h"

#define GHOSTLIGHT_JOIN_(a, b) a##b
#define GHOSTLIGHT_JOIN(a, b) GHOSTLIGHT_JOIN_(a, b)

namespace ghostlight::GHOSTLIGHT_JOIN(kernels_, GHOSTLIGHT_ISA) {
    using V = stdx::native_simd<float>;

    void film_curve(const FilmCurveView& c) {
        for (std::size_t i = 0; i < c.count; i += V::size()) {
            const V cosine(c.cosines + i, stdx::element_aligned);
            const Amplitudes<V> film =
                c.angles != nullptr
                    ? given_amplitudes(c.n_in, c.angles, c.angle_count, c.n_out, cosine)
                : c.absorbing
                    ? film_amplitudes<true>(c.n_in, c.layers, c.layer_count, c.n_out, cosine)
                    : film_amplitudes<false>(c.n_in, c.layers, c.layer_count, c.n_out, cosine);
            const V r_s = norm(film.r_s), r_p = norm(film.r_p);
            const V r = 0.5F * (r_s + r_p);
            V most = r_s;
            stdx::where(r_p > r_s, most) = r_p;
            const V t = 0.5F * (norm(film.t_s) + norm(film.t_p));
            const V t_s = norm(film.t_s);
            V s_reflected(1.0F), s_passed(1.0F);
            stdx::where(r > 0.0F, s_reflected) = r_s / r;
            stdx::where(t > 0.0F, s_passed) = t_s / t;
            s_reflected.copy_to(c.s_reflected + i, stdx::element_aligned);
            s_passed.copy_to(c.s_passed + i, stdx::element_aligned);
            r.copy_to(c.reflectance + i, stdx::element_aligned);
            t.copy_to(c.transmittance + i, stdx::element_aligned);
            most.copy_to(c.most_reflected + i, stdx::element_aligned);
        }
    }

    void spectral_states(const SpectralWeightsView& w) {
        constexpr std::size_t lanes = V::size();
        const float last = static_cast<float>(w.nodes - 1);
        for (std::size_t ray = 0; ray < w.count; ++ray) {
            float* out = w.weights + ray * w.wavelengths;
            for (std::size_t k = 0; k < w.wavelengths; k += lanes) {
                V s(1.0F), p(1.0F);
                for (std::size_t step = 0; step < w.step_count; ++step) {
                    const float* table = w.tables[step];
                    if (table == nullptr) continue;
                    const float at = w.cosines[step * w.stride + ray] * last;
                    const int node =
                        at >= 0.0F ? (at < last ? static_cast<int>(at) : w.nodes - 2) : 0;
                    const V share(at >= 0.0F ? at - static_cast<float>(node) : 0.0F);
                    const float* low = table + static_cast<std::size_t>(node) * w.wavelengths;
                    const V a(low + k, stdx::element_aligned);
                    const V b(low + w.wavelengths + k, stdx::element_aligned);
                    const V of_s = a + share * (b - a);
                    s *= of_s;
                    p *= 2.0F - of_s;
                }
                V(0.5F * (s + p)).copy_to(out + k, stdx::element_aligned);
            }
        }
    }

    void spectral_weights(const SpectralWeightsView& w) {
        constexpr std::size_t lanes = V::size();
        const float last = static_cast<float>(w.nodes - 1);
        for (std::size_t ray = 0; ray < w.count; ++ray) {
            float* out = w.weights + ray * w.wavelengths;
            for (std::size_t k = 0; k < w.wavelengths; k += lanes)
                V(1.0F).copy_to(out + k, stdx::element_aligned);
            for (std::size_t step = 0; step < w.step_count; ++step) {
                const float* table = w.tables[step];
                if (table == nullptr) continue;
                const float at = w.cosines[step * w.stride + ray] * last;
                // What is no number is no light.
                const int node = at >= 0.0F ? (at < last ? static_cast<int>(at) : w.nodes - 2) : 0;
                const V share(at >= 0.0F ? at - static_cast<float>(node) : 0.0F);
                const float* low = table + static_cast<std::size_t>(node) * w.wavelengths;
                for (std::size_t k = 0; k < w.wavelengths; k += lanes) {
                    const V a(low + k, stdx::element_aligned);
                    const V b(low + w.wavelengths + k, stdx::element_aligned);
                    const V so_far(out + k, stdx::element_aligned);
                    V(so_far * (a + share * (b - a))).copy_to(out + k, stdx::element_aligned);
                }
            }
        }
    }

}  // namespace ghostlight::GHOSTLIGHT_JOIN(kernels_,GHOSTLIGHT_ISA)
