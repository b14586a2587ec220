#include "core/flare/probe_all.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/flare/fold_ghosts.h"
#include "core/ghosts/incoherent_stack.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

/// What is granted in all, over what is asked, by the tolerance: linear between in its logarithm.
/// Errors of ghosts cancel in part where they overlap, and the estimates are cautious; at tight
/// tolerances there is more that no estimate sees. Calibrated on the bundled lenses, see
/// docs/benchmarks.md.
struct Granted {
    double tolerance, share;
};
constexpr std::array<Granted, 6> granted = {
    {{0.003, 0.25}, {0.005, 0.35}, {0.01, 0.5}, {0.02, 0.9}, {0.04, 1.45}, {0.1, 2.4}}};
constexpr double most_share = 0.5;  ///< of a ghost's own light
/// Of the tolerance, for what is left out.
constexpr double left_out_share = 0.1;
/// Those ghosts are weighed first that have this share of all bounds: their light is nearly all.
constexpr double strong_share = 0.9;
/// With a plan nearby, one ghost of so many is searched for in all of the entrance all the same.
constexpr std::size_t search_anew_every = 8;
/// And one of so many has its colours and polarisation measured anew, which change slowly.
constexpr std::size_t weigh_anew_every = 32;

/// A plan for another count of ghosts is of another lens.
const PlannedGhost* nearby_of(const FlareRequest& request, std::size_t g, const GhostPath& path) {
    if (!request.nearby || g >= request.nearby->ghosts.size()) return nullptr;
    const PlannedGhost& nearby = request.nearby->ghosts[g];
    return nearby.path != path ? nullptr : &nearby;
}

/// The ghosts that are found, by falling bound.
std::vector<std::size_t> by_bound(const std::vector<ProbedGhost>& ghosts) {
    std::vector<std::size_t> order;
    for (std::size_t g = 0; g < ghosts.size(); ++g)
        if (ghosts[g].planned.fate == GhostFate::drawn) order.push_back(g);
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&](std::size_t g) { return ghosts[g].planned.bound_mm2; });
    return order;
}

double granted_share(double tolerance) {
    if (tolerance <= granted.front().tolerance) return granted.front().share;
    for (std::size_t k = 1; k < granted.size(); ++k) {
        const auto [low, share] = granted[k - 1];
        const auto [high, next] = granted[k];
        if (tolerance < high)
            return std::lerp(share, next, std::log(tolerance / low) / std::log(high / low));
    }
    return granted.back().share;
}

double made_up(const std::vector<ProbedGhost>& ghosts) {
    std::vector<double> fluxes_mm2;
    for (const ProbedGhost& ghost : ghosts)
        if (ghost.planned.fate == GhostFate::drawn) fluxes_mm2.push_back(ghost.planned.flux_mm2);
    return ghostlight::made_up(fluxes_mm2);
}

void share_among(std::vector<ProbedGhost>& ghosts, double tolerance) {
    std::vector<ErrorShare> shares;
    double total = 0.0, left_out = 0.0;
    for (const ProbedGhost& ghost : ghosts) {
        const bool drawn = ghost.planned.fate == GhostFate::drawn;
        shares.push_back(
            {drawn ? ghost.planned.flux_mm2 : 0.0,
             ghost.errors.grid_mm2 + ghost.errors.colors.error(1) * ghost.planned.flux_mm2});
        total += shares.back().flux_mm2;
        if (ghost.planned.fate == GhostFate::left_out) left_out += ghost.planned.bound_mm2;
    }
    const std::vector<double> allowance = share_out(
        shares,
        granted_share(tolerance) * made_up(ghosts) * std::max(0.0, tolerance * total - left_out),
        most_share);
    for (std::size_t g = 0; g < ghosts.size(); ++g) ghosts[g].planned.allowance_mm2 = allowance[g];
}

}  // namespace

double made_up(const std::vector<double>& fluxes_mm2) {
    // As a root, from so many ghosts of equal light on. Calibrated like `granted`.
    constexpr double few = 25.0, most = 1.6;
    double sum = 0.0, squares = 0.0;
    for (const double flux : fluxes_mm2) {
        sum += flux;
        squares += flux * flux;
    }
    return squares > 0.0 ? std::clamp(std::sqrt(sum * sum / squares / few), 1.0, most) : 1.0;
}

std::optional<std::vector<ProbedGhost>> probe_all(const FlareScene& scene,
                                                  const GhostPlanner& planner,
                                                  const FlareRequest& request,
                                                  std::stop_token stop) {
    const std::vector<GhostPath>& paths = request.only.empty() ? scene.ghosts : request.only;
    std::vector<ProbedGhost> ghosts(paths.size());
    const bool found = parallel_for(ghosts.size(), request.threads, stop, [&](std::size_t g) {
        const PlannedGhost* nearby = nearby_of(request, g, paths[g]);
        const std::size_t turn = g + static_cast<std::size_t>(request.turn);
        const bool anew = turn % search_anew_every == 0;
        // Searched for well then: it serves the next pictures, too.
        ghosts[g] = nearby != nullptr && anew
                        ? planner.find(paths[g], nullptr, ProbeSearch::careful)
                        : planner.find(paths[g], nearby);
        if (nearby != nullptr && turn % weigh_anew_every != 0) ghosts[g].known = &nearby->look;
    });
    if (!found) return std::nullopt;

    const std::vector<std::size_t> order = by_bound(ghosts);
    double all_mm2 = 0.0, first_mm2 = 0.0;
    for (const std::size_t g : order) all_mm2 += ghosts[g].planned.bound_mm2;
    std::size_t strong = 0;
    while (strong < order.size() && first_mm2 < strong_share * all_mm2)
        first_mm2 += ghosts[order[strong++]].planned.bound_mm2;
    auto weigh = [&](std::size_t first, std::size_t count) {
        return parallel_for(count, request.threads, stop,
                            [&](std::size_t k) { planner.weigh(ghosts[order[first + k]]); });
    };
    if (!weigh(0, strong)) return std::nullopt;

    double light_mm2 = 0.0;
    for (std::size_t k = 0; k < strong; ++k)
        if (ghosts[order[k]].planned.fate == GhostFate::drawn)
            light_mm2 += ghosts[order[k]].planned.flux_mm2;
    double budget_mm2 =
        request.economies.leaving_out ? left_out_share * request.tolerance * light_mm2 : 0.0;
    std::size_t end = order.size();
    // What is asked for by name, or by the share of each, is not left out.
    while (request.only.empty() && end > strong && budget_mm2 > 0.0) {
        PlannedGhost& weakest = ghosts[order[end - 1]].planned;
        if (weakest.bound_mm2 > budget_mm2 ||
            std::ranges::find(request.highlighted, weakest.path) != request.highlighted.end())
            break;
        budget_mm2 -= weakest.bound_mm2;
        weakest.fate = GhostFate::left_out;
        --end;
    }
    if (!weigh(strong, end - strong)) return std::nullopt;
    fold_ghosts(planner, request.folded_share, ghosts);
    share_among(ghosts, request.tolerance);
    return ghosts;
}

FlarePlan plan_of(const FlareScene& scene, const FlareRequest& request,
                  std::vector<ProbedGhost>& ghosts) {
    FlarePlan plan;
    plan.tolerance = request.tolerance;
    plan.not_modelled = higher_order_share(scene.system());
    // What is granted beyond what is asked is what the estimates are too cautious by.
    const double caution = std::max(1.0, granted_share(request.tolerance)) * made_up(ghosts);
    for (ProbedGhost& ghost : ghosts) {
        PlannedGhost& planned = ghost.planned;
        planned.error_mm2 /= caution;
        (planned.fate == GhostFate::folded ? plan.folded_mm2 : plan.flux_mm2) += planned.flux_mm2;
        plan.error_mm2 += planned.error_mm2;
        if (planned.fate == GhostFate::left_out) plan.left_out_mm2 += planned.bound_mm2;
        plan.ghosts.push_back(std::move(planned));
    }
    return plan;
}

}  // namespace ghostlight
