// The characteristic matrix against a second method that shares nothing with it: the boundary
// conditions of all interfaces at once, solved for the waves in every layer.
#include "core/optics/thin_film.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>
#include <numbers>
#include <vector>

#include "core/optics/coating.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

using Number = std::complex<double>;
constexpr Number i_unit(0.0, 1.0);

struct Solved {
    Number r, t;
};

/// Unknowns: r, forward and backward wave of each layer (each 1 where it enters), t. Continuous are
/// the field (E for s, H for p) and its normal derivative (over n² for p).
Solved solve_boundaries(const Film& film, double cos_incidence, bool p_polarised) {
    const double k0 = 2.0 * std::numbers::pi / film.wavelength_nm;
    const double q2 = film.n_in * film.n_in * (1.0 - cos_incidence * cos_incidence);
    struct Space {
        Number y, phase;
    };
    auto space = [&](Number n, double thickness_nm) {
        Number w = std::sqrt(n * n - q2);
        if (w.imag() < 0.0) w = -w;
        return Space{p_polarised ? w / (n * n) : w, std::exp(i_unit * k0 * w * thickness_nm)};
    };
    const double y0 = p_polarised ? cos_incidence / film.n_in : cos_incidence * film.n_in;
    std::vector<Space> layers;
    for (const FilmLayer& layer : film.layers)
        layers.push_back(space({layer.n, layer.k}, layer.thickness_nm));
    const Number y_exit = space(film.n_out, 0.0).y;

    const Eigen::Index size = 2 * static_cast<Eigen::Index>(layers.size()) + 2;
    Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Zero(size, size);
    Eigen::VectorXcd right = Eigen::VectorXcd::Zero(size);
    // Equations 2m and 2m + 1 hold at interface m; column 0 is r, the last is t.
    right(0) = 1.0;
    right(1) = y0;
    matrix(0, 0) = -1.0;
    matrix(1, 0) = y0;
    for (std::size_t m = 0; m < layers.size(); ++m) {
        const auto& [y, phase] = layers[m];
        const Eigen::Index front = 2 * static_cast<Eigen::Index>(m), back = front + 2;
        const Eigen::Index forward = front + 1, backward = front + 2;
        matrix(front, forward) = 1.0;
        matrix(front, backward) = phase;
        matrix(front + 1, forward) = y;
        matrix(front + 1, backward) = -y * phase;
        matrix(back, forward) = -phase;
        matrix(back, backward) = -1.0;
        matrix(back + 1, forward) = -y * phase;
        matrix(back + 1, backward) = y;
    }
    matrix(size - 2, size - 1) = 1.0;
    matrix(size - 1, size - 1) = y_exit;
    const Eigen::VectorXcd waves = matrix.partialPivLu().solve(right);
    return {waves(0), waves(size - 1) * std::sqrt(std::max(0.0, y_exit.real()) / y0)};
}

template <bool absorbing>
Amplitudes<double> amplitudes_of(const Film& film, double cos_incidence) {
    std::vector<LayerAt<double>> layers;
    for (const FilmLayer& layer : film.layers)
        layers.push_back({layer.n * layer.n - layer.k * layer.k, 2.0 * layer.n * layer.k,
                          2.0 * std::numbers::pi / film.wavelength_nm * layer.thickness_nm});
    return film_amplitudes<absorbing>(film.n_in, layers.data(), static_cast<int>(layers.size()),
                                      film.n_out, cos_incidence);
}

Number number(const Complex<double>& z) { return {z.re, z.im}; }

/// No layer within `closest` of its critical angle, where the waves of the second method become
/// parallel and it loses digits.
Film random_film(Random& random, bool absorbing) {
    Film film;
    film.n_in = random.between(1.0, 1.9);
    film.n_out = random.between(1.0, 1.9);
    film.wavelength_nm = random.between(380.0, 780.0);
    const int count = random.integer(0, 8);
    for (int i = 0; i < count; ++i)
        film.layers.push_back({random.between(1.3, 2.5),
                               absorbing && random.integer(0, 1) ? random.between(0.0, 3.0) : 0.0,
                               random.between(1.0, 400.0)});
    return film;
}

bool is_well_conditioned(const Film& film, double cos_incidence) {
    constexpr double closest = 0.02;  // |n² − q²|
    const double q2 = film.n_in * film.n_in * (1.0 - cos_incidence * cos_incidence);
    auto far = [&](Number n) { return std::abs(n * n - q2) > closest; };
    bool fine = far(film.n_out);
    for (const FilmLayer& layer : film.layers) fine = fine && far({layer.n, layer.k});
    return fine;
}

template <bool absorbing>
void expect_both_methods_agree(std::uint64_t seed) {
    // Amplitudes; 18 equations solved in double with a condition number up to some hundreds.
    constexpr double tolerance = 2e-12;
    Random random(seed);
    int compared = 0;
    while (compared < 2000) {
        const Film film = random_film(random, absorbing);
        const double cos_incidence = random.between(0.01, 1.0);
        if (!is_well_conditioned(film, cos_incidence)) continue;
        ++compared;
        const auto ours = amplitudes_of<absorbing>(film, cos_incidence);
        const Solved s = solve_boundaries(film, cos_incidence, false);
        const Solved p = solve_boundaries(film, cos_incidence, true);
        ASSERT_NEAR(std::abs(number(ours.r_s) - s.r), 0.0, tolerance) << compared;
        ASSERT_NEAR(std::abs(number(ours.r_p) - p.r), 0.0, tolerance) << compared;
        ASSERT_NEAR(std::abs(number(ours.t_s) - s.t), 0.0, tolerance) << compared;
        ASSERT_NEAR(std::abs(number(ours.t_p) - p.t), 0.0, tolerance) << compared;
    }
}

TEST(ThinFilm, LosslessStacksSolveTheBoundaryConditions) { expect_both_methods_agree<false>(1); }

TEST(ThinFilm, AbsorbingStacksSolveTheBoundaryConditions) { expect_both_methods_agree<true>(2); }

TEST(ThinFilm, RealAndComplexFormsAgree) {
    constexpr double tolerance = 1e-12;  // amplitude: rounding of up to eight layers
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        const Film film = random_film(random, false);
        const double cos_incidence = random.between(0.0, 1.0);
        const auto real = amplitudes_of<false>(film, cos_incidence);
        const auto complex = amplitudes_of<true>(film, cos_incidence);
        ASSERT_NEAR(std::abs(number(real.r_s) - number(complex.r_s)), 0.0, tolerance) << i;
        ASSERT_NEAR(std::abs(number(real.r_p) - number(complex.r_p)), 0.0, tolerance) << i;
        ASSERT_NEAR(std::abs(number(real.t_s) - number(complex.t_s)), 0.0, tolerance) << i;
        ASSERT_NEAR(std::abs(number(real.t_p) - number(complex.t_p)), 0.0, tolerance) << i;
    }
}

TEST(ThinFilm, FramesOfSAndPMeetAtNormalIncidence) {
    // p̂ = k̂ × ŝ turns round with k̂ in reflection: r_p = −r_s, and t_p = t_s.
    constexpr double tolerance = 1e-14;
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        const auto a = amplitudes_of<true>(random_film(random, true), 1.0);
        EXPECT_NEAR(std::abs(number(a.r_s) + number(a.r_p)), 0.0, tolerance);
        EXPECT_NEAR(std::abs(number(a.t_s) - number(a.t_p)), 0.0, tolerance);
    }
}

TEST(ThinFilm, SquareRootHasAPositiveImaginaryPart) {
    constexpr double tolerance = 1e-15;  // relative: a few roundings
    for (const double re : {-4.0, -1e-200, 0.0, 1e-200, 2.0})
        for (const double im : {-3.0, -1e-300, 0.0, 1e-300, 5.0}) {
            const Number z(re, im);
            if (std::norm(z) == 0.0 && z != 0.0) continue;  // the modulus underflows
            Number expected = std::sqrt(z);
            if (expected.imag() < 0.0) expected = -expected;
            const Complex<double> root = upper_sqrt(Complex<double>{re, im});
            EXPECT_GE(root.im, 0.0);
            EXPECT_NEAR(std::abs(number(root) - expected), 0.0, tolerance * std::abs(expected))
                << z;
        }
}

TEST(ThinFilm, PhaseIsSmoothWhereTheSeriesTakesOver) {
    // cos δ and sin δ/δ with δ² = x, against long double, decay put back.
    constexpr double tolerance = 4e-16;
    for (double x : {0.0, 1e-300, 1e-9, -1e-9, 0.0099999, -0.0099999, 0.0100001, -0.0100001, 1.0,
                     -1.0, 30.0, -30.0}) {
        const auto phase = phase_of(x);
        const std::complex<long double> delta =
            std::sqrt(std::complex<long double>(static_cast<long double>(x)));
        const long double scale = std::exp(-std::abs(delta.imag()));
        const long double cosine = std::cos(delta).real();
        const long double sinc = x == 0.0 ? 1.0L : (std::sin(delta) / delta).real();
        // The small branch leaves the decay in.
        const long double put = phase.decay > 0.0 ? scale : 1.0L;
        EXPECT_NEAR(phase.cos, static_cast<double>(cosine * put), tolerance) << x;
        EXPECT_NEAR(phase.sinc, static_cast<double>(sinc * put), tolerance) << x;
    }
}

TEST(ThinFilm, MeanSharesAreTheMeansOfTheSquares) {
    // Two ways to the same numbers: rounding alone, where |y0 B + C|² is not small.
    constexpr double tolerance = 1e-11;
    Random random(9);
    for (int i = 0; i < 500; ++i) {
        const Film film = random_film(random, i % 2 == 1);
        std::vector<LayerAt<double>> layers;
        for (const FilmLayer& layer : film.layers)
            layers.push_back({layer.n * layer.n - layer.k * layer.k, 2.0 * layer.n * layer.k,
                              2.0 * std::numbers::pi / film.wavelength_nm * layer.thickness_nm});
        const auto count = static_cast<int>(layers.size());
        const double cos_incidence = random.between(0.05, 1.0);
        const Reflectances exact = reflectances(film, cos_incidence);
        const MeanShares<double> means =
            is_absorbing(film)
                ? film_shares<true>(film.n_in, layers.data(), count, film.n_out, cos_incidence)
                : film_shares<false>(film.n_in, layers.data(), count, film.n_out, cos_incidence);
        EXPECT_NEAR(means.reflected, exact.r(), tolerance) << i;
        EXPECT_NEAR(means.passed, exact.t(), tolerance) << i;
    }
}

TEST(ThinFilm, SinglePrecisionFollowsDouble) {
    // Eight layers of up to a few waves each: some tens of float roundings of the phase.
    constexpr double tolerance = 1e-4;
    Random random(5);
    for (int i = 0; i < 500; ++i) {
        const Film film = random_film(random, false);
        const double cos_incidence = random.between(0.05, 1.0);
        if (!is_well_conditioned(film, cos_incidence)) continue;
        std::vector<LayerAt<float>> layers;
        for (const FilmLayer& layer : film.layers)
            layers.push_back({static_cast<float>(layer.n * layer.n), 0.0F,
                              static_cast<float>(2.0 * std::numbers::pi / film.wavelength_nm *
                                                 layer.thickness_nm)});
        const auto single = film_amplitudes<false>(
            static_cast<float>(film.n_in), layers.data(), static_cast<int>(layers.size()),
            static_cast<float>(film.n_out), static_cast<float>(cos_incidence));
        const Reflectances exact = reflectances(film, cos_incidence);
        EXPECT_NEAR(static_cast<double>(norm(single.r_s)), exact.r_s, tolerance) << i;
        EXPECT_NEAR(static_cast<double>(norm(single.r_p)), exact.r_p, tolerance) << i;
        EXPECT_NEAR(static_cast<double>(norm(single.t_s)), exact.t_s, tolerance) << i;
    }
}

}  // namespace
}  // namespace ghostlight
