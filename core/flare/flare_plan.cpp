#include "core/flare/flare_plan.h"

#include <algorithm>
#include <cmath>

namespace ghostlight {

std::size_t FlarePlan::count(GhostFate fate) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        ghosts, [&](const PlannedGhost& ghost) { return ghost.fate == fate; }));
}

std::vector<double> share_out(const std::vector<double>& flux_mm2, double error_mm2,
                              double most_share) {
    double total = 0.0, roots = 0.0;
    for (const double flux : flux_mm2) {
        total += flux;
        roots += std::sqrt(flux);
    }
    std::vector<double> shares(flux_mm2.size(), 0.0);
    if (!(total > 0.0)) return shares;
    const bool all_at_most = error_mm2 >= most_share * total;
    // The factor of the roots, by bisection: the sum grows with it.
    auto shared = [&](double factor) {
        double sum = 0.0;
        for (std::size_t g = 0; g < shares.size(); ++g) {
            shares[g] = std::min(factor * std::sqrt(flux_mm2[g]), most_share * flux_mm2[g]);
            sum += shares[g];
        }
        return sum;
    };
    double low = 0.0, high = error_mm2 / roots;
    for (int k = 0; k < 60 && !all_at_most && shared(high) < error_mm2; ++k) high *= 2.0;
    constexpr int halvings = 40;
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (low + high);
        (shared(middle) < error_mm2 ? low : high) = middle;
    }
    shared(all_at_most ? 1e300 : low);
    return shares;
}

}  // namespace ghostlight
