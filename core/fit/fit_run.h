#pragma once

#include <Eigen/Core>

#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "core/fit/coating_search.h"
#include "core/fit/fit_evaluator.h"
#include "core/fit/fit_report.h"
#include "core/fit/fit_statistics.h"
#include "core/fit/flare_fit.h"
#include "core/fit/lens_move.h"

namespace ghostlight {

/// Thrown inside of a fit that was asked to stop.
struct FitStopped {};

/// One fit as it goes on: data and bases (fit_run.cpp), what the first look tells (fit_start.cpp),
/// the iterations (fit_solve.cpp), the report (fit_finish.cpp).
class FitRun {
   public:
    FitRun(const Prescription& lens, const std::vector<FitPhoto>& photos, const FitRequest& request,
           std::stop_token stop, const FitProgress& progress)
        : listed_{lens, {}},
          given_(lens),
          photos_(photos),
          request_(request),
          stop_(std::move(stop)),
          progress_(progress) {}
    FitReport run();

   private:
    void check_stop() const;
    void tell(double share) const;
    void tell_stage(const char* words) const;
    /// Shows the iteration that is done, where somebody looks.
    void show_look() const;
    /// The same where a search stands, whose descents are on thinned photographs.
    void show_search();
    void prepare();
    /// The lens with the geometry as it stands; coatings are the weights' business.
    FittedLens current_geometry() const;
    FittedLens with_coatings(FittedLens lens) const;
    LightDirection light_of(std::size_t photo) const;
    FitPlace place_of(std::size_t photo) const;
    /// Bases of all photographs for the geometry and places as they stand.
    void build();
    /// Signal to noise of each basis of a photograph at the model's gains.
    std::vector<double> signals(std::size_t photo);
    void look_at_start();
    /// Throws Error where the ghosts explain no more of the photographs than their background does.
    void refuse_mere_noise();
    /// After the layout has changed: everything that depends on it.
    void refresh();
    void drop_unfelt();
    /// What the photographs would tell of each number, from the Jacobian where the fit stands.
    void expect_errors();
    /// The lens with one number of its geometry moved on, by so many priors.
    FittedLens geometry_moved(std::size_t which, double by) const;
    /// What a photograph's picture is differentiated by: geometry, then the light's field.
    LensMoves moves_of(std::size_t photo) const;
    /// Slopes by geometry and place where they stand.
    void linearise();
    double cost_now();
    double explained();
    double solve(int iterations);
    void solve_coatings();
    /// Looks for better minima about the best of the first guesses, and keeps those that explain
    /// the photographs nearly as well. True when it ends at another one.
    bool explore_coatings();
    /// Surfaces whose kind of coating is to be chosen, and the signal that turns there.
    std::vector<std::pair<std::size_t, double>> kind_rows();
    /// Which kind each surface of a search has, by its place among the surface's own.
    using KindChoice = std::vector<std::size_t>;
    struct KindSurface {
        std::size_t row = 0;
        double signal_to_noise = 0.0;
        std::vector<CoatingKind> kinds;  ///< those asked for, then the listed one if it is another
    };
    /// The best that the coatings can do with a choice of kinds.
    struct KindTrial {
        KindChoice choice;
        std::vector<Coating> coatings;  ///< of the search's surfaces
        FitLayout layout;
        std::vector<double> x, log_gains;
        double cost = 0.0;
    };
    struct KindSearch {
        std::vector<KindSurface> surfaces;  ///< the strongest first
        double values = 0.0;                ///< data that costs are sums of
        std::map<KindChoice, KindTrial> tried;
        KindChoice now, best;
        double misfit() const;  ///< that the lowest cost leaves, at least 1
        double bic(const KindTrial& trial) const;
        bool is_better(const KindChoice& a, const KindChoice& b) const;
    };
    KindSearch kind_search();
    /// From where the search stands; surfaces whose kind changes begin at several values.
    KindTrial with_kinds(const KindSearch& search, const KindChoice& choice);
    void try_kinds(KindSearch& search, const KindChoice& choice);
    void take_kinds(KindSearch& search, const KindChoice& choice);
    /// Surface by surface and pair by pair, until nothing is better.
    void improve_kinds(KindSearch& search);
    void report_kinds(const KindSearch& search);
    /// The kind of coating on each surface by its BIC (kind_choice.cpp). True when one was changed.
    bool choose_kinds();
    void stand_at(const FitMinimum& minimum);
    FitMinimum standing() const;
    /// Linearises geometry and place again until they stay, or so many times.
    void settle(int most_linearisations);
    bool is_linearised(std::size_t k) const;
    std::vector<double> shares(std::size_t photo);
    struct Unmixed {
        Eigen::VectorXd gains, errors;
        std::vector<std::size_t> ghosts;  ///< bases, strongest first
        std::vector<std::size_t> merged;  ///< into which of `ghosts`; itself: not
        std::vector<double> signals;
    };
    /// Gains of the strongest ghosts against their pictures, by non-negative least squares.
    Unmixed unmixed(std::size_t photo);
    FitReport finish();
    /// The cost against one number, all others fitted (fit_profile.cpp).
    void profile(FitReport& report);
    /// The fit again on photographs drawn from its own model and errors.
    void bootstrap(FitReport& report);
    /// Which light would narrow the worst known number most: its Jacobian, from the model, with the
    /// noise of the first photograph at a tenth of its brightest level.
    void suggest(const Eigen::MatrixXd& known);

    FittedLens listed_;  ///< with the kinds of coating that were chosen
    Prescription given_;
    const std::vector<FitPhoto>& photos_;
    const FitRequest& request_;
    std::stop_token stop_;
    const FitProgress& progress_;
    FitLayout layout_;
    std::vector<FitParameter> not_felt_;
    std::vector<FitView> views_;
    std::unique_ptr<FitScene> scene_;
    std::unique_ptr<GhostWeights> weights_;
    std::unique_ptr<FitEvaluator> evaluator_;
    std::vector<std::vector<double>> start_models_;
    std::vector<std::vector<double>> start_shares_;  ///< by photo, by basis
    std::vector<Eigen::VectorXd> start_gains_;
    Eigen::VectorXd start_errors_;
    FitReport report_;
    /// Besides the one taken; their costs are χ² above its own.
    std::vector<FitMinimum> other_minima_;
    double basis_ms_ = 0.0, cost_ = 0.0, share_ = 0.0;
    std::size_t kept_ = 0;
    std::optional<std::vector<GhostPath>> kept_paths_;
};

}  // namespace ghostlight
