#include "core/optics/even_asphere.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace ghostlight {
namespace {

constexpr int last_exact_power = 42;
/// Powers r⁴ … r²⁴: eleven terms follow |r|³ to some 1e-6 of its size at the rim.
constexpr int fitted_terms = 11;
constexpr int samples = 200;
/// A conic ends where its slope is vertical; up to here it is still steep but tame.
constexpr double share_of_edge = 0.98;

double conic_sag(double c, double k, double r) {
    return c * r * r / (1.0 + std::sqrt(std::max(0.0, 1.0 - (1.0 + k) * c * c * r * r)));
}
double conic_slope(double c, double k, double r) {
    return c * r / std::sqrt(std::max(1e-12, 1.0 - (1.0 + k) * c * c * r * r));
}

struct Sag {
    double z = 0.0;
    double slope = 0.0;
};

Sag sag(const RadialSurface& surface, double r) {
    Sag at{conic_sag(surface.curvature_per_mm, surface.conic, r),
           conic_slope(surface.curvature_per_mm, surface.conic, r)};
    for (const auto& [power, term] : surface.terms) {
        at.z += term * std::pow(r, power);
        at.slope += term * power * std::pow(r, power - 1);
    }
    return at;
}

/// Coefficients of t^first, t^(first+1), … nearest to `values` at `t`.
Eigen::VectorXd nearest(const std::vector<double>& t, const std::vector<double>& values, int first,
                        int count) {
    Eigen::MatrixXd basis(static_cast<Eigen::Index>(t.size()), count);
    Eigen::VectorXd wanted(static_cast<Eigen::Index>(t.size()));
    for (std::size_t i = 0; i < t.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        for (int j = 0; j < count; ++j) basis(row, j) = std::pow(t[i], first + j);
        wanted(row) = values[i];
    }
    return basis.colPivHouseholderQr().solve(wanted);
}

bool is_exact(const RadialSurface& surface) {
    return std::ranges::all_of(surface.terms, [](const auto& term) {
        return term.second == 0.0 ||
               (term.first % 2 == 0 && term.first >= 4 && term.first <= last_exact_power);
    });
}

BaseCurve curve_of(double curvature_per_mm) {
    if (curvature_per_mm == 0.0) return Plane{};
    return Curvature{curvature_per_mm};
}

}  // namespace

EvenAsphere even_asphere(const RadialSurface& surface, double clear_radius_mm) {
    if (!(clear_radius_mm > 0.0) || (!surface.terms.empty() && surface.terms.begin()->first < 1))
        throw Error({.problem = "not an asphere that can be fitted",
                     .file = {},
                     .where = {},
                     .found = fmt::format("clear radius {} mm", clear_radius_mm),
                     .expected = "a clear radius above 0 and powers from 1"});
    EvenAsphere result;
    result.curve = curve_of(surface.curvature_per_mm);
    result.conic = surface.conic;
    if (is_exact(surface)) {
        for (const auto& [power, term] : surface.terms) {
            if (term == 0.0) continue;
            const auto index = static_cast<std::size_t>((power - 4) / 2);
            if (result.aspheric.size() <= index) result.aspheric.resize(index + 1, 0.0);
            result.aspheric[index] = term;
        }
        return result;
    }

    result.exact = false;
    const double c = surface.curvature_per_mm;
    double rim = clear_radius_mm;
    if ((1.0 + surface.conic) * c * c * rim * rim > share_of_edge * share_of_edge)
        rim = share_of_edge / (std::abs(c) * std::sqrt(1.0 + surface.conic));
    // Chebyshev points of t = (r/rim)², dense at the rim and at the vertex.
    std::vector<double> t(samples), extra(samples);
    for (int i = 0; i < samples; ++i) {
        const auto at = static_cast<std::size_t>(i);
        t[at] = 0.5 - 0.5 * std::cos((i + 0.5) * std::numbers::pi / samples);
        const double r = rim * std::sqrt(t[at]);
        extra[at] = sag(surface, r).z - conic_sag(c, surface.conic, r);
    }
    const double fitted_curvature =
        c + 2.0 * nearest(t, extra, 1, fitted_terms + 1)(0) / (rim * rim);
    const bool still_there =
        (1.0 + surface.conic) * fitted_curvature * fitted_curvature * rim * rim < 1.0;
    const double new_c = still_there ? fitted_curvature : c;
    for (int i = 0; i < samples; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const double r = rim * std::sqrt(t[at]);
        extra[at] = sag(surface, r).z - conic_sag(new_c, surface.conic, r);
    }
    const Eigen::VectorXd terms = nearest(t, extra, 2, fitted_terms);
    RadialSurface even{new_c, surface.conic, {}};
    for (int j = 0; j < fitted_terms; ++j) {
        const double term = terms(j) / std::pow(rim, 4 + 2 * j);
        even.terms[4 + 2 * j] = term;
        result.aspheric.push_back(term);
    }
    result.curve = curve_of(new_c);
    for (const double at : t) {
        const double r = rim * std::sqrt(at);
        const Sag wanted = sag(surface, r);
        const Sag got = sag(even, r);
        result.sag_error_mm = std::max(result.sag_error_mm, std::abs(wanted.z - got.z));
        result.slope_error = std::max(result.slope_error, std::abs(wanted.slope - got.slope));
    }
    return result;
}

}  // namespace ghostlight
