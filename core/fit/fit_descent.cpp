#include "core/fit/fit_descent.h"

#include <algorithm>
#include <limits>

namespace ghostlight {
namespace {

struct Watch final : ceres::IterationCallback {
    const std::function<bool(double)>& go_on;
    explicit Watch(const std::function<bool(double)>& whether) : go_on(whether) {}
    ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
        return go_on(s.cost) ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    }
};

}  // namespace

Descent descend(FitEvaluator& evaluator, FitLoss loss, double loss_scale, int iterations,
                const std::function<bool(double)>& go_on, DescentAim aim, int held) {
    const auto problem = fit_problem(evaluator, loss, loss_scale);
    if (held >= 0)
        problem->SetManifold(evaluator.x.data(), new ceres::SubsetManifold(
                                                     static_cast<int>(evaluator.x.size()), {held}));
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.max_num_iterations = iterations;
    if (aim == DescentAim::minimum) {
        // Numbers that trade off lie along narrow valleys that bend: Levenberg and Marquardt's
        // steps end there at a fraction of the way. Steps in the plane of gradient and Gauss and
        // Newton's step, which may rise for a while, follow them.
        options.trust_region_strategy_type = ceres::DOGLEG;
        options.dogleg_type = ceres::SUBSPACE_DOGLEG;
        options.use_nonmonotonic_steps = true;
    }
    options.function_tolerance = 1e-8;
    options.parameter_tolerance = 1e-8;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    options.update_state_every_iteration = static_cast<bool>(go_on);  // who looks sees the best
    Watch watch(go_on);
    if (go_on) options.callbacks.push_back(&watch);
    ceres::Solver::Summary summary;
    ceres::Solve(options, problem.get(), &summary);
    return {.cost = summary.IsSolutionUsable() ? summary.final_cost
                                               : std::numeric_limits<double>::infinity(),
            .iterations = std::max(1, static_cast<int>(summary.iterations.size()) - 1)};
}

double cost_of(FitEvaluator& evaluator, FitLoss loss, double loss_scale) {
    evaluator.PrepareForEvaluation(false, true);
    if (evaluator.stopped()) return std::numeric_limits<double>::infinity();
    const auto rho = make_loss(loss, loss_scale);
    double cost = 0.0;
    for (std::size_t i = 0; i < evaluator.views().size(); ++i) {
        const FitData& data = evaluator.views()[i].data;
        for (std::size_t s = 0; s < data.samples(); ++s) {
            if (!data.used[s]) continue;
            double squares = 0.0;
            for (std::size_t c = 0; c < 3; ++c) {
                const double r = evaluator.residuals(i)[3 * s + c];
                squares += r * r;
            }
            double out[3] = {squares, 1.0, 0.0};
            if (rho) rho->Evaluate(squares, out);
            cost += 0.5 * out[0];
        }
    }
    for (const double each : evaluator.x) cost += 0.5 * each * each;
    return cost;
}

}  // namespace ghostlight
