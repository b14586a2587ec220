#include "core/flare/flare_plan.h"

#include <algorithm>
#include <cmath>

namespace ghostlight {

std::size_t FlarePlan::count(GhostFate fate) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        ghosts, [&](const PlannedGhost& ghost) { return ghost.fate == fate; }));
}

std::vector<double> share_out(const std::vector<ErrorShare>& ghosts, double error_mm2,
                              double most_share) {
    /// Work on a ghost's cells over work on its pixels, for the same error. Found by trial on the
    /// bundled lenses; the sum of errors does not depend on it.
    constexpr double work_on_cells = 10.0;
    double total = 0.0, roots = 0.0;
    std::vector<double> root;
    for (const ErrorShare& ghost : ghosts) {
        total += ghost.flux_mm2;
        root.push_back(std::sqrt(ghost.flux_mm2 + work_on_cells * ghost.difficulty_mm2));
        roots += root.back();
    }
    std::vector<double> shares(ghosts.size(), 0.0);
    if (!(total > 0.0) || !(error_mm2 > 0.0)) return shares;
    auto shared = [&](double factor) {
        double sum = 0.0;
        for (std::size_t g = 0; g < shares.size(); ++g) {
            shares[g] = std::min(factor * root[g], most_share * ghosts[g].flux_mm2);
            sum += shares[g];
        }
        return sum;
    };
    // The factor, by bisection: the sum grows with it, up to most_share of all.
    double low = 0.0, high = error_mm2 / roots;
    constexpr int doublings = 60, halvings = 40;
    for (int k = 0; k < doublings && shared(high) < error_mm2; ++k) high *= 2.0;
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (low + high);
        (shared(middle) < error_mm2 ? low : high) = middle;
    }
    shared(low);
    return shares;
}

}  // namespace ghostlight
