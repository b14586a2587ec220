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

    namespace {

    /// Where a cosine lies between the nodes of a table. What is no number is no light.
    struct Between {
        int node;
        float share;
    };
    GHOSTLIGHT_INLINE Between between(float cosine, int nodes) {
        const float last = static_cast<float>(nodes - 1);
        const float at = cosine * last >= 0.0F ? cosine * last : 0.0F;
        const int node = static_cast<int>(at < last - 1.0F ? at : last - 1.0F);
        return {node, at - static_cast<float>(node)};
    }

    /// Two rays side by side: a product over the steps is one long chain.
    template <int rays>
    GHOSTLIGHT_INLINE void weigh(const SpectralWeightsView& w, std::size_t first_ray,
                                 std::size_t first_wavelength) {
        constexpr int vectors = static_cast<int>(film_padding / V::size());
        V product[rays][vectors];
        for (auto& own : product)
            for (V& value : own) value = 1.0F;
        for (std::size_t step = 0; step < w.step_count; ++step) {
            const float* table = w.tables[step];
            if (table == nullptr) continue;
            for (int r = 0; r < rays; ++r) {
                const auto ray = first_ray + static_cast<std::size_t>(r);
                const auto [node, share] = between(w.cosines[step * w.stride + ray], w.nodes);
                const float* low =
                    table + static_cast<std::size_t>(node) * w.wavelengths + first_wavelength;
                const float* high = low + w.wavelengths;
                for (int k = 0; k < vectors; ++k) {
                    const auto at = static_cast<std::size_t>(k) * V::size();
                    const V a(low + at, stdx::element_aligned);
                    const V b(high + at, stdx::element_aligned);
                    product[r][k] = product[r][k] * (a + share * (b - a));
                }
            }
        }
        for (int r = 0; r < rays; ++r)
            for (int k = 0; k < vectors; ++k)
                product[r][k].copy_to(
                    w.weights + (first_ray + static_cast<std::size_t>(r)) * w.wavelengths +
                        first_wavelength + static_cast<std::size_t>(k) * V::size(),
                    stdx::element_aligned);
    }

    void weigh_one_wavelength(const SpectralWeightsView& w) {
        for (std::size_t ray = 0; ray < w.count; ++ray) w.weights[ray] = 1.0F;
        for (std::size_t step = 0; step < w.step_count; ++step) {
            const float* __restrict table = w.tables[step];
            if (table == nullptr) continue;
            const float* __restrict cosines = w.cosines + step * w.stride;
            float* __restrict weights = w.weights;
            for (std::size_t ray = 0; ray < w.count; ++ray) {
                const auto [node, share] = between(cosines[ray], w.nodes);
                const float a = table[node], b = table[node + 1];
                weights[ray] *= a + share * (b - a);
            }
        }
    }

    }  // namespace

    void spectral_weights(const SpectralWeightsView& w) {
        if (w.wavelengths == 1) return weigh_one_wavelength(w);
        for (std::size_t first = 0; first < w.wavelengths; first += film_padding) {
            std::size_t ray = 0;
            for (; ray + 2 <= w.count; ray += 2) weigh<2>(w, ray, first);
            for (; ray < w.count; ++ray) weigh<1>(w, ray, first);
        }
    }

    void spectral_states(const SpectralWeightsView& w) {
        const std::size_t together = w.wavelengths < V::size() ? 1 : V::size();
        for (std::size_t ray = 0; ray < w.count; ++ray)
            for (std::size_t k = 0; k < w.wavelengths; k += together) {
                V s(1.0F), p(1.0F);
                for (std::size_t step = 0; step < w.step_count; ++step) {
                    const float* table = w.tables[step];
                    if (table == nullptr) continue;
                    const auto [node, share] = between(w.cosines[step * w.stride + ray], w.nodes);
                    const float* low = table + static_cast<std::size_t>(node) * w.wavelengths + k;
                    V a(low[0]), b(low[w.wavelengths]);
                    if (together > 1) {
                        a.copy_from(low, stdx::element_aligned);
                        b.copy_from(low + w.wavelengths, stdx::element_aligned);
                    }
                    const V of_s = a + share * (b - a);
                    s *= of_s;
                    p *= 2.0F - of_s;
                }
                const V mean = 0.5F * (s + p);
                float* out = w.weights + ray * w.wavelengths + k;
                if (together > 1)
                    mean.copy_to(out, stdx::element_aligned);
                else
                    *out = mean[0];
            }
    }

}  // namespace ghostlight::GHOSTLIGHT_JOIN(kernels_,GHOSTLIGHT_ISA)
