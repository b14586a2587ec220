#include "core/ghosts/four_reflections.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace ghostlight {
namespace {

constexpr int angles = 90;  ///< samples up to the steepest incidence

double largest_reflectance(const SurfaceAt& surface, bool forward, double steepest_rad) {
    if (!surface.reflects) return 0.0;
    if (surface.uniform_reflectance) return *surface.uniform_reflectance;
    const Film film = forward ? surface.film : reversed(surface.film);
    double largest = 0.0;
    for (int k = 0; k <= angles; ++k) {
        const Reflectances at = reflectances(film, std::cos(steepest_rad * k / angles));
        largest = std::max({largest, at.r_s, at.r_p});
    }
    return largest;
}

/// Rows by falling reflectance.
using Rows = std::vector<std::size_t>;

Rows sorted_rows(const std::vector<double>& of, std::size_t first, std::size_t end) {
    Rows rows;
    for (std::size_t row = first; row < end; ++row)
        if (of[row] > 0.0) rows.push_back(row);
    std::ranges::stable_sort(rows, [&](std::size_t a, std::size_t b) { return of[a] > of[b]; });
    return rows;
}

double sum_over(const std::vector<double>& of, const Rows& rows) {
    double sum = 0.0;
    for (const std::size_t row : rows) sum += of[row];
    return sum;
}

/// One of the paths i, j, k, l that share j and k: the a-th best i and the b-th best l.
struct Candidate {
    double bound;
    std::size_t j, k, a, b;
    bool operator<(const Candidate& other) const { return bound < other.bound; }
};

}  // namespace

LargestReflectances largest_reflectances(const OpticalSystem& system,
                                         const SteepestIncidence& steepest) {
    LargestReflectances bounds;
    for (std::size_t row = 0; row < turning_count(system); ++row) {
        const SurfaceAt& surface = surface_at(system, row);
        bounds.forward.push_back(largest_reflectance(surface, true, steepest.forward_rad[row]));
        bounds.backward.push_back(
            row < system.surfaces.size()
                ? largest_reflectance(surface, false, steepest.backward_rad[row])
                : 0.0);
    }
    return bounds;
}

void widen(LargestReflectances& bounds, const LargestReflectances& other) {
    for (std::size_t row = 0; row < bounds.forward.size(); ++row) {
        bounds.forward[row] = std::max(bounds.forward[row], other.forward[row]);
        bounds.backward[row] = std::max(bounds.backward[row], other.backward[row]);
    }
}

RankedPaths strongest_four_reflections(const LargestReflectances& bounds, double clear_area_mm2,
                                       std::size_t most, double rest_mm2) {
    const std::size_t rows = bounds.forward.size();
    // i lies behind j, l before k, and k behind both j and l.
    std::vector<Rows> i_of(rows), l_of(rows);
    std::vector<double> i_sum(rows), l_sum(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        i_of[row] = sorted_rows(bounds.forward, row + 1, rows);
        l_of[row] = sorted_rows(bounds.backward, 0, row);
        i_sum[row] = sum_over(bounds.forward, i_of[row]);
        l_sum[row] = sum_over(bounds.backward, l_of[row]);
    }
    RankedPaths ranked;
    std::priority_queue<Candidate> queue;
    auto bound_of = [&](std::size_t j, std::size_t k, std::size_t a, std::size_t b) {
        return clear_area_mm2 * bounds.forward[i_of[j][a]] * bounds.backward[j] *
               bounds.forward[k] * bounds.backward[l_of[k][b]];
    };
    for (std::size_t j = 0; j + 1 < rows; ++j)
        for (std::size_t k = j + 1; k < rows; ++k) {
            if (!(bounds.backward[j] > 0.0) || !(bounds.forward[k] > 0.0)) continue;
            if (i_of[j].empty() || l_of[k].empty()) continue;
            ranked.count += i_of[j].size() * l_of[k].size();
            ranked.flux_bound_mm2 +=
                clear_area_mm2 * i_sum[j] * bounds.backward[j] * bounds.forward[k] * l_sum[k];
            queue.push({bound_of(j, k, 0, 0), j, k, 0, 0});
        }
    double rest = ranked.flux_bound_mm2;
    while (!queue.empty() && ranked.strongest.size() < most && rest > rest_mm2) {
        const Candidate best = queue.top();
        queue.pop();
        const auto& [bound, j, k, a, b] = best;
        ranked.strongest.push_back({{{i_of[j][a], j, k, l_of[k][b]}}, bound});
        rest -= bound;
        if (b + 1 < l_of[k].size()) queue.push({bound_of(j, k, a, b + 1), j, k, a, b + 1});
        if (b == 0 && a + 1 < i_of[j].size())
            queue.push({bound_of(j, k, a + 1, 0), j, k, a + 1, 0});
    }
    return ranked;
}

}  // namespace ghostlight
