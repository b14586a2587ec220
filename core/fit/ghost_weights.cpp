#include "core/fit/ghost_weights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ghostlight {
namespace {

/// Weights of four equidistant nodes for a point at f in units of their distance from the first.
std::array<double, 4> cubic(double f) {
    const double a = f, b = f - 1.0, c = f - 2.0, d = f - 3.0;
    return {-b * c * d / 6.0, 0.5 * a * c * d, -0.5 * a * b * d, a * b * c / 6.0};
}

}  // namespace

void GhostWeights::coefficients(const GhostBasis& basis, std::vector<double>& values,
                                std::vector<double>* slopes) const {
    const std::size_t waves = scene_.samples.size(), events = basis.events.size(),
                      width = basis.width(), count = coatings_.size();
    values.assign(width * 3, 0.0);
    if (slopes != nullptr) slopes->assign(width * 3 * count, 0.0);
    struct Number {
        double re, im;
    };
    struct Event {
        Number in[2][2];  ///< the state in this event's frame, before it: [s or p][column]
        std::array<double, 4> share;
        const double* at;  ///< the first of four nodes
    };
    std::vector<Event> chain(events);
    std::vector<double> by_parameter(count);
    const std::size_t ray_count = basis.rays.size();
    for (std::size_t r = 0; r < ray_count; ++r)
        for (std::size_t k = 0; k < waves; ++k) {
            const FilmRay& ray = basis.rays[r];
            Number state[2][2] = {{{1, 0}, {0, 0}}, {{0, 0}, {1, 0}}};
            for (std::size_t e = 0; e < events; ++e) {
                const FilmEvent& event = basis.events[e];
                const Table& table = tables_[2 * event.surface + (event.forward ? 1 : 0)];
                const double place = (ray.cosines[e * waves + k] - table.low) /
                                     (table.high - table.low) * (table_nodes - 1);
                const int first = std::clamp(static_cast<int>(place) - 1, 0, table_nodes - 4);
                Event& now = chain[e];
                now.share = cubic(place - first);
                now.at = &table.values[(((event.reflects ? 1U : 0U) * waves + k) * table_nodes +
                                        static_cast<std::size_t>(first)) *
                                       table.stride()];
                double film[4] = {0, 0, 0, 0};
                for (std::size_t n = 0; n < 4; ++n)
                    for (std::size_t i = 0; i < 4; ++i)
                        film[i] += now.share[n] * now.at[n * table.stride() + i];
                const double c = ray.turn_cos[e], s = ray.turn_sin[e];
                for (int column = 0; column < 2; ++column) {
                    const Number a = state[0][column], b = state[1][column];
                    const Number e_s = {c * a.re + s * b.re, c * a.im + s * b.im};
                    const Number e_p = {c * b.re - s * a.re, c * b.im - s * a.im};
                    now.in[0][column] = e_s;
                    now.in[1][column] = e_p;
                    state[0][column] = {film[0] * e_s.re - film[1] * e_s.im,
                                        film[0] * e_s.im + film[1] * e_s.re};
                    state[1][column] = {film[2] * e_p.re - film[3] * e_p.im,
                                        film[2] * e_p.im + film[3] * e_p.re};
                }
            }
            double weight = 0.0;
            for (const auto& row : state)
                for (const Number& each : row) weight += each.re * each.re + each.im * each.im;
            // What the glasses let pass scales the weight and its slopes.
            const double passed = ray.passed.empty() ? 1.0 : ray.passed[k];
            weight *= 0.5 * passed;
            if (slopes != nullptr) {
                // dW = Re Σ conj(G) dP, G = P at the end; backwards G = Rᵀ conj(D) G.
                std::ranges::fill(by_parameter, 0.0);
                Number g[2][2] = {{state[0][0], state[0][1]}, {state[1][0], state[1][1]}};
                for (std::size_t e = events; e-- > 0;) {
                    const FilmEvent& event = basis.events[e];
                    const Table& table = tables_[2 * event.surface + (event.forward ? 1 : 0)];
                    const Event& now = chain[e];
                    const std::size_t stride = table.stride();
                    double film[4] = {0, 0, 0, 0};
                    for (std::size_t n = 0; n < 4; ++n)
                        for (std::size_t i = 0; i < 4; ++i)
                            film[i] += now.share[n] * now.at[n * stride + i];
                    if (!table.parameters.empty()) {
                        // γ = Σ conj(G) in: the slope by re and im of each amplitude.
                        double by[4] = {0, 0, 0, 0};
                        for (int kind = 0; kind < 2; ++kind)
                            for (int column = 0; column < 2; ++column) {
                                const Number &x = now.in[kind][column], &y = g[kind][column];
                                by[2 * kind] += y.re * x.re + y.im * x.im;
                                by[2 * kind + 1] += y.im * x.re - y.re * x.im;
                            }
                        for (std::size_t l = 0; l < table.parameters.size(); ++l) {
                            double sum = 0.0;
                            for (std::size_t n = 0; n < 4; ++n)
                                for (std::size_t i = 0; i < 4; ++i)
                                    sum +=
                                        now.share[n] * now.at[n * stride + 4 * (l + 1) + i] * by[i];
                            by_parameter[table.parameters[l]] += sum;
                        }
                    }
                    const double c = ray.turn_cos[e], s = ray.turn_sin[e];
                    for (int column = 0; column < 2; ++column) {
                        const Number a = g[0][column], b = g[1][column];
                        const Number d_s = {film[0] * a.re + film[1] * a.im,
                                            film[0] * a.im - film[1] * a.re};
                        const Number d_p = {film[2] * b.re + film[3] * b.im,
                                            film[2] * b.im - film[3] * b.re};
                        g[0][column] = {c * d_s.re - s * d_p.re, c * d_s.im - s * d_p.im};
                        g[1][column] = {s * d_s.re + c * d_p.re, s * d_s.im + c * d_p.im};
                    }
                }
            }
            const Rgb& color = scene_.colors[k];
            const double channel[3] = {color.r, color.g, color.b};
            for (double& each : by_parameter) each *= passed;
            for (std::size_t node = 0; node < basis.nodes; ++node) {
                const double share = basis.nodes == 1 ? 1.0 : scene_.nodes[k][node];
                for (std::size_t t = 0; t < pupil_terms; ++t) {
                    const double f = share * basis.projection[t * ray_count + r];
                    for (std::size_t c = 0; c < 3; ++c) {
                        const std::size_t at = (node * pupil_terms + t) * 3 + c;
                        values[at] += f * channel[c] * weight;
                        if (slopes == nullptr) continue;
                        double* to = &(*slopes)[at * count];
                        const double factor = f * channel[c];
                        for (std::size_t p = 0; p < count; ++p) to[p] += factor * by_parameter[p];
                    }
                }
            }
        }
}

}  // namespace ghostlight
