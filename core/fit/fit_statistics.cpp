#include "core/fit/fit_statistics.h"

#include <algorithm>
#include <cmath>

namespace ghostlight {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Correlates columns of a picture's Jacobian along one axis.
void correlate(const RowMatrix& from, int width, int height, bool along_x, RowMatrix& to) {
    to.setZero(from.rows(), from.cols());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int lag = -2; lag <= 2; ++lag) {
                const int i = along_x ? x + lag : x, j = along_x ? y : y + lag;
                if (i < 0 || j < 0 || i >= width || j >= height) continue;
                to.row(y * width + x) += spline_correlation(lag) * from.row(j * width + i);
            }
}

/// A ghost's light in one channel over its patch.
std::vector<double> light_of(const GhostBasis& basis, const GhostWeights& weights,
                             std::size_t channel) {
    std::vector<double> coefficients, light;
    weights.coefficients(basis, coefficients, nullptr);
    for (int row = 0; row < basis.rows; ++row)
        for (int column = 0; column < basis.columns; ++column) {
            const float* b = basis.at(basis.first_column + column, basis.first_row + row);
            double sum = 0.0;
            for (std::size_t r = 0; r < basis.width(); ++r)
                sum += static_cast<double>(b[r]) * coefficients[3 * r + channel];
            light.push_back(sum);
        }
    return light;
}

template <class Visit>
void for_each_sample(const GhostBasis& basis, int width, const Visit& visit) {
    for (int y = 0; y < basis.rows; ++y)
        for (int x = 0; x < basis.columns; ++x)
            visit(static_cast<std::size_t>((basis.first_row + y) * width + basis.first_column + x),
                  x, y);
}

/// What a sample of a patch gains by the whole ghost's light, by moving it a sample along x or y,
/// and by making it larger by a sample at its edge.
struct GhostChange {
    double light, x, y, size;
};
GhostChange change_of(const GhostBasis& basis, const std::vector<double>& light, int x, int y) {
    auto at = [&](int column, int row) {
        return column < 0 || row < 0 || column >= basis.columns || row >= basis.rows
                   ? 0.0
                   : light[static_cast<std::size_t>(row * basis.columns + column)];
    };
    // The patch may end where the frame does: no step there.
    auto slope = [](double before, double here, double after, bool first, bool last) {
        return 0.5 * ((last ? here : after) - (first ? here : before));
    };
    const double here = at(x, y);
    const double dx = slope(at(x - 1, y), here, at(x + 1, y), x == 0, x + 1 == basis.columns),
                 dy = slope(at(x, y - 1), here, at(x, y + 1), y == 0, y + 1 == basis.rows);
    const double half = std::max(1.0, 0.5 * std::max(basis.columns, basis.rows));
    return {here, dx, dy,
            ((x + 0.5 - 0.5 * basis.columns) * dx + (y + 0.5 - 0.5 * basis.rows) * dy) / half};
}

}  // namespace

FitInformation information(const FitEvaluator& evaluator, FitLoss loss, double loss_scale,
                           double ghost_error, const std::stop_token& stop) {
    const auto count = static_cast<Eigen::Index>(evaluator.layout().count());
    FitInformation info{Eigen::MatrixXd::Identity(count, count),
                        Eigen::MatrixXd::Identity(count, count)};
    const auto rho = make_loss(loss, loss_scale);
    if (evaluator.stopped()) return info;
    auto& views = const_cast<FitEvaluator&>(evaluator).views();
    auto& weights = const_cast<FitEvaluator&>(evaluator).weights();
    for (std::size_t i = 0; i < views.size(); ++i) {
        const FitView& view = views[i];
        const auto samples = static_cast<Eigen::Index>(view.data.samples());
        const int width = view.data.frame.width_px, height = view.data.frame.height_px;
        std::vector<double> roots(view.data.samples(), 0.0);
        for (std::size_t s = 0; s < view.data.samples(); ++s) {
            if (!view.data.used[s]) continue;
            double squares = 0.0;
            for (std::size_t c = 0; c < 3; ++c)
                squares += std::pow(evaluator.residuals(i)[3 * s + c], 2);
            double out[3] = {squares, 1.0, 0.0};
            if (rho) rho->Evaluate(squares, out);
            roots[s] = std::sqrt(std::max(0.0, out[1]));
        }
        std::vector<Eigen::VectorXd> places(3 * view.bases.size(), Eigen::VectorXd::Zero(count));
        for (std::size_t c = 0; c < 3; ++c) {
            RowMatrix j(samples, count);
            for (Eigen::Index s = 0; s < samples; ++s) {
                const Eigen::Map<const Eigen::RowVectorXd> row(
                    &evaluator.jacobian(
                        i)[(3 * static_cast<std::size_t>(s) + c) * static_cast<std::size_t>(count)],
                    count);
                j.row(s) = roots[static_cast<std::size_t>(s)] * row;
            }
            info.hessian.noalias() += j.transpose() * j;
            RowMatrix once, twice;
            correlate(j, width, height, true, once);
            correlate(once, width, height, false, twice);
            info.spread.noalias() += j.transpose() * twice;
            // Each ghost's light may be off as a whole.
            const double off = std::hypot(ghost_error, view.curve_error);
            if (off <= 0.0) continue;
            for (std::size_t g = 0; g < view.bases.size(); ++g) {
                if (stop.stop_requested()) return info;
                const std::vector<double> light = light_of(view.bases[g], weights, c);
                Eigen::VectorXd moved = Eigen::VectorXd::Zero(count);
                for_each_sample(view.bases[g], width, [&](std::size_t s, int x, int y) {
                    if (roots[s] == 0.0) return;
                    const double change = evaluator.gain(i, c) * roots[s] /
                                          view.scales[s].sigma(evaluator.model(i)[3 * s + c]);
                    const auto row = j.row(static_cast<Eigen::Index>(s)).transpose();
                    const GhostChange by = change_of(view.bases[g], light, x, y);
                    moved += change * by.light * row;
                    places[3 * g] += change * by.x * row;
                    places[3 * g + 1] += change * by.y * row;
                    places[3 * g + 2] += change * by.size * row;
                });
                info.spread.noalias() += off * off * moved * moved.transpose();
            }
        }
        // And so may its place and its size, in all channels together: what geometry is fitted by.
        if (evaluator.layout().geometry.empty()) continue;
        for (const Eigen::VectorXd& moved : places)
            info.spread.noalias() += place_error * place_error * moved * moved.transpose();
    }
    return info;
}

double scatter_of_difference(const FitEvaluator& evaluator,
                             const std::vector<std::vector<double>>& difference,
                             double ghost_error) {
    auto& views = const_cast<FitEvaluator&>(evaluator).views();
    auto& weights = const_cast<FitEvaluator&>(evaluator).weights();
    double size = 0.0, scatter = 0.0;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const FitView& view = views[i];
        const std::size_t samples = view.data.samples();
        RowMatrix delta(static_cast<Eigen::Index>(samples), 3), once, twice;
        for (std::size_t s = 0; s < samples; ++s)
            for (std::size_t c = 0; c < 3; ++c)
                delta(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(c)) =
                    view.data.used[s] ? difference[i][3 * s + c] : 0.0;
        correlate(delta, view.data.frame.width_px, view.data.frame.height_px, true, once);
        correlate(once, view.data.frame.width_px, view.data.frame.height_px, false, twice);
        size += delta.squaredNorm();
        scatter += delta.cwiseProduct(twice).sum();
        for (const GhostBasis& basis : view.bases) {
            const ModelPicture one = one_ghost(basis, weights, view.data.frame);
            double along[3] = {0.0, 0.0, 0.0};
            for (std::size_t s = 0; s < samples; ++s)
                for (std::size_t c = 0; c < 3 && view.data.used[s]; ++c)
                    along[c] += difference[i][3 * s + c] * evaluator.gain(i, c) * *one.at(s, c) /
                                view.scales[s].sigma(evaluator.model(i)[3 * s + c]);
            const double off = std::hypot(ghost_error, view.curve_error);
            for (const double each : along) scatter += off * off * each * each;
        }
    }
    return size > 0.0 ? std::max(1.0, scatter / size) : 1.0;
}

Eigen::MatrixXd covariance_of(const FitInformation& information, const Eigen::MatrixXd& inverse) {
    const Eigen::MatrixXd covariance = inverse * information.spread * inverse;
    return 0.5 * (covariance + covariance.transpose());
}

Eigen::MatrixXd covariance_of(const FitInformation& information) {
    const Eigen::Index count = information.hessian.rows();
    return covariance_of(information,
                         information.hessian.ldlt().solve(Eigen::MatrixXd::Identity(count, count)));
}

Directions directions(const Eigen::MatrixXd& covariance, std::size_t count) {
    const auto n = static_cast<Eigen::Index>(count);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance.topLeftCorner(n, n));
    Directions found{Eigen::VectorXd(n), Eigen::MatrixXd(n, n)};
    for (Eigen::Index k = 0; k < n; ++k) {
        found.narrowed(k) = std::sqrt(std::max(0.0, solver.eigenvalues()(n - 1 - k)));
        found.vectors.col(k) = solver.eigenvectors().col(n - 1 - k);
    }
    return found;
}

Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& normal,
                                           const Eigen::VectorXd& right) {
    const Eigen::Index n = right.size();
    Eigen::VectorXd g = Eigen::VectorXd::Zero(n);
    std::vector<bool> free(static_cast<std::size_t>(n), false);
    const double tolerance = 1e-10 * std::max(1e-300, right.cwiseAbs().maxCoeff());
    for (Eigen::Index turn = 0; turn < 3 * n; ++turn) {
        const Eigen::VectorXd slope = right - normal * g;
        Eigen::Index best = -1;
        for (Eigen::Index i = 0; i < n; ++i)
            if (!free[static_cast<std::size_t>(i)] && slope(i) > tolerance &&
                (best < 0 || slope(i) > slope(best)))
                best = i;
        if (best < 0) break;
        free[static_cast<std::size_t>(best)] = true;
        for (;;) {
            std::vector<Eigen::Index> in;
            for (Eigen::Index i = 0; i < n; ++i)
                if (free[static_cast<std::size_t>(i)]) in.push_back(i);
            const auto m = static_cast<Eigen::Index>(in.size());
            if (m == 0) break;
            Eigen::MatrixXd a(m, m);
            Eigen::VectorXd b(m);
            for (Eigen::Index i = 0; i < m; ++i) {
                b(i) = right(in[static_cast<std::size_t>(i)]);
                for (Eigen::Index k = 0; k < m; ++k)
                    a(i, k) =
                        normal(in[static_cast<std::size_t>(i)], in[static_cast<std::size_t>(k)]);
                a(i, i) *= 1.0 + 1e-12;
            }
            const Eigen::VectorXd z = a.ldlt().solve(b);
            double step = 1.0;
            for (Eigen::Index i = 0; i < m; ++i) {
                const double now = g(in[static_cast<std::size_t>(i)]);
                if (z(i) <= 0.0) step = std::min(step, now / std::max(now - z(i), 1e-300));
            }
            for (Eigen::Index i = 0; i < m; ++i) {
                double& now = g(in[static_cast<std::size_t>(i)]);
                now += step * (z(i) - now);
            }
            if (step >= 1.0) break;
            for (const Eigen::Index i : in)
                if (g(i) <= 1e-12) {
                    g(i) = 0.0;
                    free[static_cast<std::size_t>(i)] = false;
                }
        }
    }
    return g;
}

}  // namespace ghostlight
