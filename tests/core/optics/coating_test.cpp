#include "core/optics/coating.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

constexpr double rounding = 1e-14;  // intensities: some tens of roundings of numbers up to 1

Film bare(double n_in, double n_out) { return {n_in, {}, n_out, 550.0}; }

void expect_near(const Reflectances& a, const Reflectances& b, double tolerance) {
    EXPECT_NEAR(a.r_s, b.r_s, tolerance);
    EXPECT_NEAR(a.r_p, b.r_p, tolerance);
    EXPECT_NEAR(a.t_s, b.t_s, tolerance);
    EXPECT_NEAR(a.t_p, b.t_p, tolerance);
}

TEST(Coating, BareInterfaceAtNormalIncidenceIsFresnel) {
    for (const auto& [a, b] : {std::pair{1.0, 1.5168}, {1.5168, 1.0}, {1.62, 1.8}, {1.0, 4.0}}) {
        const double r = (a - b) / (a + b);
        expect_near(reflectances(bare(a, b), 1.0), {r * r, r * r, 1.0 - r * r, 1.0 - r * r},
                    rounding);
    }
}

TEST(Coating, BareInterfaceAtAnyAngleIsFresnel) {
    const double n1 = 1.0, n2 = 1.7;
    for (double deg = 0.0; deg < 90.0; deg += 7.5) {
        const double c1 = std::cos(deg * std::numbers::pi / 180.0);
        const double c2 = std::sqrt(1.0 - n1 * n1 / (n2 * n2) * (1.0 - c1 * c1));
        const double s = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2);
        const double p = (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
        expect_near(reflectances(bare(n1, n2), c1), {s * s, p * p, 1.0 - s * s, 1.0 - p * p},
                    rounding);
    }
}

TEST(Coating, NoParallelReflectionAtBrewstersAngle) {
    constexpr double zero = 1e-30;  // the square of a rounding
    for (const double n : {1.33, 1.5168, 2.4}) {
        // tan θ = n; from inside, the refracted angle.
        EXPECT_LT(reflectances(bare(1.0, n), 1.0 / std::sqrt(1.0 + n * n)).r_p, zero);
        EXPECT_LT(reflectances(bare(n, 1.0), n / std::sqrt(1.0 + n * n)).r_p, zero);
        EXPECT_GT(reflectances(bare(1.0, n), 1.0 / std::sqrt(1.0 + n * n)).r_s, 0.05);
    }
}

TEST(Coating, IdealQuarterWaveDoesNotReflectAtItsWavelength) {
    constexpr double zero = 1e-30;  // the square of a rounding
    const QuarterWave ideal{550.0, IdealIndex{}, 1.0};
    for (const double n : {1.4, 1.5168, 1.9}) {
        const Film film = film_at(ideal, medium(1.0), medium(n), 550.0);
        EXPECT_LT(reflectances(film, 1.0).r_s, zero);
        EXPECT_LT(reflectances(reversed(film), 1.0).r_p, zero);
        EXPECT_GT(reflectances(film_at(ideal, medium(1.0), medium(n), 450.0), 1.0).r_s, 1e-5);
    }
}

TEST(Coating, HalfWaveLayerIsAbsentAtItsWavelength) {
    const QuarterWave half{550.0, medium(1.38), 2.0};
    expect_near(reflectances(film_at(half, medium(1.0), medium(1.6), 550.0), 1.0),
                reflectances(bare(1.0, 1.6), 1.0), rounding);
}

TEST(Coating, QuarterWaveHasAQuarterOfItsOwnIndexAtItsOwnWavelength) {
    // Dispersion: the thickness comes from the index at the centre wavelength, the phase does not.
    const Medium layer{"layer", ModelGlass{1.5, 30.0}};
    const QuarterWave coating{550.0, layer, 0.9};
    const Film film = film_at(coating, medium(1.0), medium(1.8), 430.0);
    ASSERT_EQ(film.layers.size(), 1U);
    EXPECT_DOUBLE_EQ(film.layers[0].thickness_nm,
                     0.9 * 550.0 / 4.0 / refractive_index(layer, 550.0));
    EXPECT_DOUBLE_EQ(film.layers[0].n, refractive_index(layer, 430.0));
}

TEST(Coating, TwoQuarterWavesAreTheirAdmittance) {
    // Y = (n1/n2)² n_s, R = ((n0 − Y)/(n0 + Y))²: two quarter-wave transformations by hand.
    const double n0 = 1.0, n1 = 1.38, n2 = 1.7, ns = 1.52, nm = 550.0;
    const Film film{n0, {{n1, 0.0, nm / 4.0 / n1}, {n2, 0.0, nm / 4.0 / n2}}, ns, nm};
    const double y = n1 * n1 / (n2 * n2) * ns;
    const double r = (n0 - y) / (n0 + y);
    expect_near(reflectances(film, 1.0), {r * r, r * r, 1.0 - r * r, 1.0 - r * r}, rounding);
}

TEST(Coating, OneLayerIsAirysSum) {
    // r = (r01 + r12 e^(2iδ))/(1 + r01 r12 e^(2iδ)) for both polarisations.
    const double n0 = 1.0, n1 = 1.38, n2 = 1.75, nm = 520.0, d = 130.0;
    const Film film{n0, {{n1, 0.0, d}}, n2, nm};
    for (double c0 = 0.05; c0 <= 1.0; c0 += 0.05) {
        auto cosine = [&](double n) {
            return std::sqrt(1.0 - n0 * n0 / (n * n) * (1.0 - c0 * c0));
        };
        const double c1 = cosine(n1), c2 = cosine(n2);
        const auto turn = std::polar(1.0, 4.0 * std::numbers::pi / nm * d * n1 * c1);
        auto airy = [&](double r01, double r12) {
            return std::norm((r01 + r12 * turn) / (1.0 + r01 * r12 * turn));
        };
        auto s = [](double na, double ca, double nb, double cb) {
            return (na * ca - nb * cb) / (na * ca + nb * cb);
        };
        auto p = [](double na, double ca, double nb, double cb) {
            return (nb * ca - na * cb) / (nb * ca + na * cb);
        };
        const double rs = airy(s(n0, c0, n1, c1), s(n1, c1, n2, c2));
        const double rp = airy(p(n0, c0, n1, c1), p(n1, c1, n2, c2));
        expect_near(reflectances(film, c0), {rs, rp, 1.0 - rs, 1.0 - rp}, rounding);
    }
}

Film random_stack(Random& random, double largest_k) {
    Film film{random.between(1.0, 2.0), {}, random.between(1.0, 2.0), random.between(380.0, 780.0)};
    const int count = random.integer(1, 12);
    for (int i = 0; i < count; ++i)
        film.layers.push_back({random.between(1.2, 2.6),
                               largest_k > 0.0 ? random.between(0.001, largest_k) : 0.0,
                               random.between(5.0, 400.0)});
    return film;
}

/// The cosine on the other side of the stack; below 0 under total reflection.
double cos_beyond(const Film& film, double cos_incidence) {
    const double squared =
        1.0 - std::pow(film.n_in / film.n_out, 2) * (1.0 - cos_incidence * cos_incidence);
    return squared < 0.0 ? -1.0 : std::sqrt(squared);
}

TEST(Coating, LosslessStacksKeepEnergyAndReciprocity) {
    constexpr double tolerance = 1e-12;  // rounding of up to twelve layers, most near resonance
    Random random(11);
    for (int i = 0; i < 3000; ++i) {
        const Film film = random_stack(random, 0.0);
        const double c = random.between(0.0, 1.0);
        const Reflectances a = reflectances(film, c);
        ASSERT_NEAR(a.r_s + a.t_s, 1.0, tolerance) << i;
        ASSERT_NEAR(a.r_p + a.t_p, 1.0, tolerance) << i;
        const double beyond = cos_beyond(film, c);
        if (beyond < 0.0) {
            ASSERT_EQ(a.t_s, 0.0);
            ASSERT_EQ(a.t_p, 0.0);
            continue;
        }
        // The angle beyond is computed from the cosine: near grazing it has half its digits.
        if (beyond > 0.01 && c > 0.01) {
            const Reflectances b = reflectances(reversed(film), beyond);
            ASSERT_NEAR(a.t_s, b.t_s, 1e3 * tolerance) << i;
            ASSERT_NEAR(a.r_p, b.r_p, 1e3 * tolerance) << i;
        }
    }
}

TEST(Coating, AbsorbingStacksLoseEnergyAndTransmitAlikeBothWays) {
    constexpr double tolerance = 1e-11;
    Random random(12);
    int different = 0;
    for (int i = 0; i < 2000; ++i) {
        const Film film = random_stack(random, 2.0);
        const double c = random.between(0.05, 1.0);
        const Reflectances a = reflectances(film, c);
        ASSERT_LT(a.r_s + a.t_s, 1.0) << i;
        ASSERT_LT(a.r_p + a.t_p, 1.0) << i;
        const double beyond = cos_beyond(film, c);
        if (beyond < 0.01) continue;
        const Reflectances b = reflectances(reversed(film), beyond);
        ASSERT_NEAR(a.t_s, b.t_s, tolerance) << i;
        ASSERT_NEAR(a.t_p, b.t_p, tolerance) << i;
        different += std::abs(a.r_s - b.r_s) > 1e-3 ? 1 : 0;
    }
    EXPECT_GT(different, 1000) << "reflection of an absorbing stack depends on the side";
}

TEST(Coating, ThinGapLeaksUnderTotalReflection) {
    // T = 1/(1 + α sinh² κd) between equal media (S. Zhu et al., Am. J. Phys. 54, 601, 1986).
    constexpr double tolerance = 1e-13;
    const double n = 1.5, nm = 600.0;
    for (const double deg : {42.5, 45.0, 60.0, 80.0})
        for (const double gap : {1.0, 50.0, 300.0, 2000.0}) {
            const double c = std::cos(deg * std::numbers::pi / 180.0), s2 = 1.0 - c * c;
            const double kappa = 2.0 * std::numbers::pi / nm * std::sqrt(n * n * s2 - 1.0);
            const double sinh2 = std::pow(std::sinh(kappa * gap), 2);
            const double alpha_s =
                std::pow(n * n - 1.0, 2) / (4.0 * n * n * c * c * (n * n * s2 - 1.0));
            const double alpha_p = alpha_s * std::pow((n * n + 1.0) * s2 - 1.0, 2);
            const double ts = 1.0 / (1.0 + alpha_s * sinh2), tp = 1.0 / (1.0 + alpha_p * sinh2);
            const Film film{n, {{1.0, 0.0, gap}}, n, nm};
            expect_near(reflectances(film, c), {1.0 - ts, 1.0 - tp, ts, tp}, tolerance);
        }
}

TEST(Coating, ThickEvanescentLayerReflectsAll) {
    for (const double gap_nm : {1e5, 1e7, 1e12}) {
        const Film film{1.5, {{1.0, 0.0, gap_nm}, {1.4, 0.0, 50.0}}, 1.5, 550.0};
        expect_near(reflectances(film, 0.3), {1.0, 1.0, 0.0, 0.0}, rounding);
    }
}

TEST(Coating, ThickMetalReflectsAsItsHalfSpace) {
    const std::complex<double> n(0.13, 3.99);
    for (const double c : {1.0, 0.6, 0.1}) {
        const auto w = std::sqrt(n * n - (1.0 - c * c));
        const double rs = std::norm((c - w) / (c + w));
        const double rp = std::norm((c - w / (n * n)) / (c + w / (n * n)));
        for (const double thickness_nm : {2e3, 1e6, 1e9}) {
            const Film film{1.0, {{0.13, 3.99, thickness_nm}}, 1.5, 632.8};
            expect_near(reflectances(film, c), {rs, rp, 0.0, 0.0}, rounding);
        }
        EXPECT_GT(reflectances({1.0, {{0.13, 3.99, 20.0}}, 1.5, 632.8}, c).t_p, 0.01);
    }
}

TEST(Coating, GrazingLightIsReflected) {
    for (const Film& film :
         {bare(1.0, 1.5), bare(1.5, 1.0), Film{1.0, {{1.38, 0.0, 100.0}}, 1.5, 550.0},
          Film{1.0, {{1.38, 0.2, 100.0}}, 1.5, 550.0}})
        expect_near(reflectances(film, 0.0), {1.0, 1.0, 0.0, 0.0}, rounding);
}

TEST(Coating, EqualMediaDoNotReflectAtAnyAngle) {
    for (const double c : {0.0, 1e-12, 0.5, 1.0}) {
        expect_near(reflectances(bare(1.5, 1.5), c), {0.0, 0.0, 1.0, 1.0}, 0.0);
        const Film hidden =
            film_at(LayerStack{{{medium(1.5), 80.0, 0.0}}}, medium(1.5), medium(1.5), 550.0);
        EXPECT_TRUE(is_invisible(hidden));
        expect_near(reflectances(hidden, c), {0.0, 0.0, 1.0, 1.0}, 0.0);
    }
}

TEST(Coating, OnsetOfTotalReflectionIsContinuous) {
    constexpr double tolerance = 3e-7;  // square root of the rounding of the critical cosine
    const double n = 1.6, critical = std::sqrt(1.0 - 1.0 / (n * n));
    for (const Film& film : {bare(n, 1.0), Film{n, {{1.38, 0.0, 100.0}}, 1.0, 550.0}}) {
        expect_near(reflectances(film, critical), {1.0, 1.0, 0.0, 0.0}, tolerance);
        // Below it T grows as the square root of the distance: 1e-2 of it for 1e-4.
        double before = 1.0;
        for (const double step : {1e-4, 1e-6, 1e-8, 1e-10}) {
            const Reflectances near = reflectances(film, critical + step);
            EXPECT_NEAR(near.r_s + near.t_s, 1.0, rounding);
            EXPECT_LT(near.t_p, 0.2 * before);
            before = near.t_p;
        }
        expect_near(reflectances(film, critical - 1e-4), {1.0, 1.0, 0.0, 0.0}, rounding);
    }
}

TEST(Coating, LayerAtItsOwnCriticalAngleIsFinite) {
    // n sin θ = 1.38 within rounding, with light beyond: w = 0 in the layer.
    constexpr double tolerance = 1e-6;  // change over 1e-7 of the cosine
    const double c = std::sqrt(1.0 - std::pow(1.38 / 1.6, 2));
    const Film film{1.6, {{1.38, 0.0, 700.0}}, 1.6, 550.0};
    expect_near(reflectances(film, c), reflectances(film, c + 1e-7), tolerance);
    expect_near(reflectances(film, c), reflectances(film, c - 1e-7), tolerance);
}

TEST(Coating, LayersWithoutEffectAreDropped) {
    const Medium glass = medium(1.5), air = medium(1.0);
    const LayerStack stack{{{air, 200.0, 0.0},
                            {medium(1.38), 60.0, 0.0},
                            {medium(2.0), 0.0, 0.0},
                            {medium(1.38), 40.0, 0.0},
                            {glass, 300.0, 0.0}}};
    const Film film = film_at(stack, air, glass, 550.0);
    EXPECT_EQ(film, (Film{1.0, {{1.38, 0.0, 100.0}}, 1.5, 550.0}));
    const Film thin = film_at(QuarterWave{550.0, medium(1.38), 0.0}, air, glass, 550.0);
    EXPECT_TRUE(thin.layers.empty());
    EXPECT_FALSE(is_invisible(thin));
    // An absorbing layer of a neighbour's index stays.
    EXPECT_EQ(film_at(LayerStack{{{glass, 100.0, 0.1}}}, glass, glass, 550.0).layers.size(), 1U);
}

TEST(Coating, VanishingLayerIsTheLimitOfAThinOne) {
    constexpr double tolerance = 1e-7;  // phase of 1e-6 nm
    for (const double c : {1.0, 0.3, 0.01})
        expect_near(reflectances({1.0, {{1.38, 0.0, 1e-6}}, 1.5, 550.0}, c),
                    reflectances(bare(1.0, 1.5), c), tolerance);
}

TEST(Coating, NonPhysicalLayersAreRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    auto at = [](Layer layer) {
        return error_of([&] { film_at(LayerStack{{layer}}, medium(1.0), medium(1.5), 550.0); });
    };
    EXPECT_NE(at({medium(1.4), 100.0, -0.1}).found.find("k -0.1"), std::string::npos);
    EXPECT_FALSE(at({medium(1.4), -100.0, 0.0}).expected.empty());
    EXPECT_FALSE(at({medium(1.4), nan, 0.0}).expected.empty());
    EXPECT_FALSE(at({medium(1.4), 100.0, nan}).expected.empty());
    for (const char* text : {"1.0 | 1.4,-0.1:100 | 1.5", "1.0 | 1.4:-100 | 1.5", "0 | 1.5", "1.0",
                             "", "1.0 | 1.4 | 1.5", "1.0 | 1.4:x | 1.5", "1.0 | nan:10 | 1.5"})
        EXPECT_FALSE(error_of([&] { parse_stack(text, 550.0); }).expected.empty()) << text;
}

TEST(Coating, StackTextIsReadFromTheIncomingSide) {
    const Film film = parse_stack(" 1.0 | 1.38:96.4|2.1,0.02 : 10 | 1.5", 532.0);
    EXPECT_EQ(film, (Film{1.0, {{1.38, 0.0, 96.4}, {2.1, 0.02, 10.0}}, 1.5, 532.0}));
    EXPECT_EQ(reversed(reversed(film)), film);
    EXPECT_EQ(reversed(film).layers.front().n, 2.1);
}

TEST(Coating, AgreesWithASeparateProgram) {
    constexpr double tolerance = 1e-10;  // what the values' source states
    const std::string folder = (test_data_folder() / "expected/").string();
    std::ifstream definitions(folder + "coatings_def.json");
    const auto stacks = nlohmann::json::parse(definitions);
    std::ifstream table(folder + "coatings.csv");
    std::string line;
    std::getline(table, line);
    int compared = 0;
    while (std::getline(table, line)) {
        std::istringstream fields(line);
        std::string name, direction, word;
        std::getline(fields, name, ',');
        std::getline(fields, direction, ',');
        double value[4] = {};
        for (double& v : value) {
            std::getline(fields, word, ',');
            v = std::stod(word);
        }
        Film film{1.0, {}, stacks[name]["n_glass"].get<double>(), value[0]};
        for (const auto& layer : stacks[name]["layers_air_side_first"])
            film.layers.push_back({layer["n"].get<double>(), 0.0, layer["d_nm"].get<double>()});
        if (direction == "glass_to_air") film = reversed(film);
        const Reflectances r = reflectances(film, std::cos(value[1] * std::numbers::pi / 180.0));
        EXPECT_NEAR(r.r_s, value[2], tolerance) << line;
        EXPECT_NEAR(r.r_p, value[3], tolerance) << line;
        ++compared;
    }
    EXPECT_EQ(compared, 144);
}

}  // namespace
}  // namespace ghostlight
