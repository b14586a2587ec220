#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>
#include <vector>

#include "core/fit/fit_evaluator.h"

namespace ghostlight {

/// A place where the cost has a minimum, or nearly so.
struct FitMinimum {
    std::vector<double> x;
    std::vector<double> log_gains;  ///< FitView::log_gain_start of each photograph
    double cost = 0.0;
};

/// Every `step`-th sample of a view each way, as a view of its own. Two steps apart samples share
/// next to no noise (1/66), so that a step of 2 keeps four fifths of what a photograph tells, for a
/// quarter of the work.
FitView thinned(const FitView& view, int step);

/// Looks for minima of the cost, over the coatings, on thinned photographs. A reflectance comes
/// back as its λ0 moves, and two surfaces that share their ghosts can stand for each other: there
/// are many minima, and only their cost tells which is the right one. Costs are those of nearly
/// independent samples: twice a difference of costs is one of χ².
class CoatingSearch {
   public:
    CoatingSearch(const FitLayout& layout, const std::vector<FitView>& views,
                  const GhostWeights& weights, FitLoss loss, double loss_scale, unsigned threads);
    /// The minima that some iterations lead to from each of the points, in their order, gains
    /// fitted first. Several points at a time; the result does not depend on how many.
    std::vector<FitMinimum> descend_all(const std::vector<std::vector<double>>& points,
                                        int iterations, const std::stop_token& stop);
    /// Minima from the neighbourhood of `from`: each λ0 elsewhere, pairs exchanged, and pairs moved
    /// against each other; again from each better one until there is none. The lowest first, those
    /// within `margin` of it after it, no two alike. `tell` is told the best so far after each
    /// batch.
    std::vector<FitMinimum> explore(const FitMinimum& from, double margin,
                                    const std::stop_token& stop,
                                    const std::function<void(const FitMinimum& best)>& tell);
    /// Whether the coatings are the same, but for what iterations leave.
    bool alike(const std::vector<double>& a, const std::vector<double>& b) const;
    int iterations() const { return iterations_; }

   private:
    std::vector<std::vector<double>> neighbours(const std::vector<double>& x) const;

    const FitLayout& layout_;
    std::vector<FitView> views_;
    const GhostWeights& weights_;
    FitLoss loss_;
    double loss_scale_;
    unsigned threads_;
    int iterations_ = 0;
};

}  // namespace ghostlight
