// Interfaces whose shares are given instead of layers, and layers whose extinction is a table.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "core/flare/film_tables.h"
#include "core/ghosts/bundle.h"
#include "core/optics/coating.h"
#include "core/optics/trace.h"
#include "core/units.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

const Medium air = medium(1.0);
const Medium glass = medium(1.5);

MeasuredReflectance sheet() {
    return {{450.0, 550.0, 650.0},
            {0.0, 30.0, 60.0},
            {{0.010, 0.010, 0.985, 0.985},
             {0.012, 0.008, 0.980, 0.990},
             {0.050, 0.004, 0.945, 0.992},
             {0.004, 0.004, 0.993, 0.993},
             {0.006, 0.003, 0.990, 0.995},
             {0.040, 0.002, 0.955, 0.995},
             {0.008, 0.008, 0.990, 0.990},
             {0.011, 0.006, 0.985, 0.992},
             {0.060, 0.005, 0.935, 0.990}}};
}

// sqrt and square of a share that passes through the amplitude.
constexpr double rounding = 1e-15;

void expect_shares(const Reflectances& found, const MeasuredShares& expected) {
    EXPECT_NEAR(found.r_s, expected.r_s, rounding);
    EXPECT_NEAR(found.r_p, expected.r_p, rounding);
    EXPECT_NEAR(found.t_s, expected.t_s, rounding);
    EXPECT_NEAR(found.t_p, expected.t_p, rounding);
}

TEST(MeasuredReflectance, ReturnsItsEntries) {
    const MeasuredReflectance table = sheet();
    for (std::size_t w = 0; w < 3; ++w)
        for (std::size_t a = 0; a < 3; ++a) {
            const Film film = film_at(table, air, glass, table.wavelengths_nm[w]);
            expect_shares(reflectances(film, cos_from_deg(table.angles_deg[a])),
                          table.shares[3 * w + a]);
        }
}

TEST(MeasuredReflectance, IsLinearInWavelengthAndCosineAndHeldBeyond) {
    const MeasuredReflectance table = sheet();
    const Film between = film_at(table, air, glass, 500.0);
    EXPECT_NEAR(reflectances(between, 1.0).r_s, 0.007, rounding);
    const double middle = 0.5 * (cos_from_deg(30.0) + cos_from_deg(60.0));
    EXPECT_NEAR(reflectances(film_at(table, air, glass, 550.0), middle).r_s, 0.023, rounding);
    expect_shares(reflectances(film_at(table, air, glass, 300.0), 1.0), table.shares[0]);
    expect_shares(reflectances(film_at(table, air, glass, 900.0), 0.1), table.shares[8]);
}

TEST(MeasuredReflectance, LooksTheSameFromTheGlassAtTheRefractedAngle) {
    const Film film = film_at(sheet(), air, glass, 550.0);
    const Film back = reversed(film);
    for (const double deg : {0.0, 10.0, 45.0, 75.0}) {
        const double inside = std::asin(std::sin(rad_from_deg(deg)) / 1.5);
        const Reflectances a = reflectances(film, cos_from_deg(deg));
        const Reflectances b = reflectances(back, std::cos(inside));
        EXPECT_NEAR(a.r_s, b.r_s, 1e-14);
        EXPECT_NEAR(a.t_p, b.t_p, 1e-14);
    }
    // A surface from glass to air means the same thing.
    EXPECT_NEAR(reflectances(film_at(sheet(), glass, air, 550.0), 1.0).r_s, 0.004, rounding);
    // Beyond the critical angle, 41.8 degrees, everything comes back.
    const Reflectances total = reflectances(back, cos_from_deg(50.0));
    EXPECT_NEAR(total.r_s, 1.0, 1e-14);
    EXPECT_NEAR(total.r_p, 1.0, 1e-14);
    EXPECT_EQ(total.t_s, 0.0);
    EXPECT_EQ(total.t_p, 0.0);
}

TEST(MeasuredReflectance, NeverCreatesEnergy) {
    Random random(5);
    const MeasuredReflectance table = sheet();
    for (int i = 0; i < 2000; ++i) {
        Film film =
            film_at(table, air, medium(random.between(1.0, 2.0)), random.between(300.0, 800.0));
        if (random.integer(0, 1) == 1) film = reversed(film);
        const Reflectances found = reflectances(film, random.between(0.0, 1.0));
        EXPECT_LE(found.r_s + found.t_s, 1.0 + 1e-14);
        EXPECT_LE(found.r_p + found.t_p, 1.0 + 1e-14);
        EXPECT_GE(std::min({found.r_s, found.r_p, found.t_s, found.t_p}), 0.0);
    }
}

TEST(MeasuredReflectance, OfABareInterfaceIsThatInterface) {
    // A table of Fresnel's own values at every degree: shares between them, signs and phases come
    // out as the bare interface's, from either side.
    MeasuredReflectance table{{550.0}, {}, {}};
    for (int deg = 0; deg <= 90; ++deg) {
        const Reflectances at = reflectances({1.0, {}, 1.5, 550.0}, cos_from_deg(deg));
        table.angles_deg.push_back(deg);
        table.shares.push_back({at.r_s, at.r_p, 1.0 - at.r_s, 1.0 - at.r_p});
    }
    // What a chord misses, h²/8·R″: h = 0.0175 between the last entries, and R near grazing goes as
    // ((1 − αc)/(1 + αc))² with R″ = 16α², α² = 1/(n² − 1) for s and n⁴/(n² − 1) for p.
    const double chord = std::pow(cos_from_deg(89.0), 2) / 8.0 * 16.0 / (1.5 * 1.5 - 1.0);
    const double between_s = chord, between_p = chord * std::pow(1.5, 4);
    const Film given = film_at(table, air, glass, 550.0);
    const Film bare{1.0, {}, 1.5, 550.0};
    for (const auto& [mine, theirs] :
         {std::pair(given, bare), std::pair(reversed(given), reversed(bare))})
        for (double cosine = 0.02; cosine <= 1.0; cosine += 0.01) {
            EXPECT_NEAR(reflectances(mine, cosine).r_s, reflectances(theirs, cosine).r_s, between_s)
                << cosine;
            EXPECT_NEAR(reflectances(mine, cosine).r_p, reflectances(theirs, cosine).r_p, between_p)
                << cosine;
        }
}

TEST(MeasuredReflectance, KeepsTheBareInterfacesSigns) {
    MeasuredReflectance table{{550.0}, {0.0}, {{0.01, 0.01, 0.99, 0.99}}};
    for (const auto& [n_in, n_out] : {std::pair(1.0, 1.5), std::pair(1.5, 1.0)})
        for (const double cosine : {1.0, 0.9, 0.8, 0.6, 0.3}) {
            const Film film = film_at(table, medium(n_in), medium(n_out), 550.0);
            const auto angles = angles_at<double>(film);
            const auto mine = given_amplitudes(n_in, angles.data(), 1, n_out, cosine);
            const LayerAt<double>* none = nullptr;
            const auto bare = film_amplitudes<false>(n_in, none, 0, n_out, cosine);
            // In total reflection both have modulus 1 and the same phase.
            EXPECT_GT(mine.r_s.re * bare.r_s.re + mine.r_s.im * bare.r_s.im, 0.0) << cosine;
            EXPECT_GT(mine.r_p.re * bare.r_p.re + mine.r_p.im * bare.r_p.im, 0.0) << cosine;
        }
}

TEST(ConstantReflectance, IsTheSameEverywhere) {
    const ConstantReflectance fixed{0.05, 0.9};
    for (const double nm : {300.0, 550.0, 2000.0})
        for (const double cosine : {1.0, 0.5, 0.0}) {
            const Reflectances found = reflectances(film_at(fixed, air, glass, nm), cosine);
            EXPECT_NEAR(found.r_s, 0.05, rounding);
            EXPECT_NEAR(found.t_p, 0.9, rounding);
        }
    // Between equal media too; what passes everything is not there at all.
    EXPECT_FALSE(is_invisible(film_at(fixed, glass, glass, 550.0)));
    EXPECT_NEAR(reflectances(film_at(fixed, glass, glass, 550.0), 0.0).r(), 0.05, rounding);
    EXPECT_TRUE(is_invisible(film_at(ConstantReflectance{}, glass, glass, 550.0)));
    EXPECT_TRUE(is_absorbing(film_at(fixed, air, glass, 550.0)));
    EXPECT_FALSE(is_absorbing(film_at(ConstantReflectance{0.05, 0.95}, air, glass, 550.0)));
}

TEST(GivenReflectance, RefusesWhatCreatesEnergy) {
    const Error::Parts error = error_of([] {
        film_at(ConstantReflectance{0.5, 0.6}, air, glass, 550.0);
    });
    EXPECT_THAT(error.expected, testing::HasSubstr("R + T"));
    error_of([] { film_at(ConstantReflectance{-0.1, 0.6}, air, glass, 550.0); });
    error_of([] { film_at(ConstantReflectance{std::nan(""), 0.6}, air, glass, 550.0); });
    error_of([] { film_at(MeasuredReflectance{{550.0}, {0.0, 10.0}, {{}}}, air, glass, 550.0); });
    error_of([] { film_at(MeasuredReflectance{}, air, glass, 550.0); });
    Prescription lens = lens_of({row(50.0, 5.0, 1.5), row(-50.0, 90.0, 1.0)});
    lens.surfaces[0].coating = MeasuredReflectance{{550.0, 500.0}, {0.0}, {{}, {}}};
    EXPECT_THAT(error_of([&] { validate(lens); }).where, testing::HasSubstr("measured.nm"));
    lens.surfaces[0].coating = sheet();
    EXPECT_NO_THROW(validate(lens));
}

/// A lens of which one surface has given shares, seen by the single ray and by the lanes of the
/// bundle: weights must agree, and be those of the shares.
TEST(GivenReflectance, SingleRaysAndBundlesAgree) {
    Prescription lens =
        lens_of({row(60.0, 6.0, 1.6), row(-80.0, 10.0, 1.0), row(0.0, 60.0, 1.0)}, 2);
    lens.surfaces[0].coating = sheet();
    lens.surfaces[1].coating = ConstantReflectance{0.2, 0.7};
    const OpticalSystem system = compile(lens, 500.0);
    const GhostPath ghost{{1, 0}};
    const LightDirection light{.field_deg = 12.0, .azimuth_deg = 70.0};
    const BeamFrame frame = beam_frame(light);
    const TracePath<double> path = trace_path<double>(system, ghost);
    Bundle<double> rays;
    Random random(3);
    for (int i = 0; i < 64; ++i) {
        rays.u_mm.push_back(random.between(-6.0, 6.0));
        rays.v_mm.push_back(random.between(-6.0, 6.0));
    }
    trace_bundle(path, frame, Weights::polarised, rays);
    int compared = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 start = rays.u_mm[i] * frame.e1 + rays.v_mm[i] * frame.e2;
        const TracedRay single = trace_ray(system, ghost, {start, frame.direction});
        if (single.status.fate == RayFate::miss || single.status.fate == RayFate::tir) continue;
        ++compared;
        // The lanes' square roots and divisions are those of the processor: a few ulp.
        EXPECT_NEAR(rays.weight[i], single.weight, 1e-13 * single.weight);
        EXPECT_NEAR(rays.weight_average[i], single.weight_average, 1e-13 * single.weight_average);
    }
    EXPECT_GT(compared, 50);
    // On the axis: T of the first, R of the second, R of the first, T of the second.
    const TracedRay axis = trace_ray(system, ghost, {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}});
    const double r = 0.5 * (0.010 + 0.004), t = 0.5 * (0.985 + 0.993);
    EXPECT_NEAR(axis.weight, t * 0.2 * r * 0.7, 1e-15);
}

/// A picture's tables of films over the cosine of incidence, against the trace itself.
TEST(GivenReflectance, PicturesSeeTheSameShares) {
    Prescription lens =
        lens_of({row(60.0, 6.0, 1.6), row(-80.0, 10.0, 1.0), row(0.0, 60.0, 1.0)}, 2);
    // Two angles alone: a picture's tables round off the corner that a third would make.
    lens.surfaces[0].coating = MeasuredReflectance{{450.0, 600.0},
                                                   {0.0, 80.0},
                                                   {{0.010, 0.010, 0.985, 0.985},
                                                    {0.050, 0.030, 0.945, 0.965},
                                                    {0.006, 0.006, 0.990, 0.990},
                                                    {0.040, 0.020, 0.955, 0.975}}};
    lens.surfaces[1].coating = ConstantReflectance{0.2, 0.7};
    const std::vector<OpticalSystem> systems{compile(lens, 450.0), compile(lens, 600.0)};
    const FilmTables films(systems, 1);
    const TracePath<float> path = trace_path<float>(systems[1], GhostPath{{1, 0}});
    const BeamFrame frame = beam_frame({.field_deg = 10.0, .azimuth_deg = 90.0});
    Bundle<float> rays;
    rays.keep_cosines = true;
    Random random(4);
    for (int i = 0; i < 64; ++i) {
        rays.u_mm.push_back(static_cast<float>(random.between(-5.0, 5.0)));
        rays.v_mm.push_back(static_cast<float>(random.between(-5.0, 5.0)));
    }
    trace_bundle(path, frame, Weights::average, rays);
    std::vector<float> weights;
    films.weights(path, rays, weights);
    int compared = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (rays.margin[i] < 0.0F) continue;
        ++compared;
        // The tables' own stated accuracy: 1e-3 of R, here twice, and float.
        EXPECT_NEAR(weights[i * films.stride() + 1], rays.weight_average[i],
                    2e-3F * rays.weight_average[i]);
    }
    EXPECT_GT(compared, 50);
}

TEST(GivenReflectance, SinglePrecisionFollowsDouble) {
    const Film film = reversed(film_at(sheet(), air, glass, 520.0));
    const auto wide = angles_at<double>(film);
    const auto narrow = angles_at<float>(film);
    constexpr double tolerance = 2e-6;  // some float ulp of the cosine's root near the onset
    for (double cosine = 0.76; cosine <= 1.0; cosine += 0.01) {
        const auto a = given_amplitudes(1.5, wide.data(), 3, 1.0, cosine);
        const auto b = given_amplitudes(1.5F, narrow.data(), 3, 1.0F, static_cast<float>(cosine));
        EXPECT_NEAR(a.r_s.re, b.r_s.re, tolerance);
        EXPECT_NEAR(a.t_p.re, b.t_p.re, tolerance);
    }
}

TEST(LayerStack, ExtinctionMayBeATable) {
    // A thick silver layer is Fresnel's formula for a complex index, here by hand:
    // R = ((n − 1)² + k²)/((n + 1)² + k²).
    Layer silver{{"Ag", TabulatedGlass{{{495.9, 0.05}, {548.6, 0.06}, {582.1, 0.05}}, true}},
                 2000.0,
                 0.0,
                 {{495.9, 3.093}, {548.6, 3.586}, {582.1, 3.858}}};
    const LayerStack stack{{silver}};
    for (const auto& [nm, n, k] : {std::tuple(548.6, 0.06, 3.586), std::tuple(582.1, 0.05, 3.858)})
        EXPECT_NEAR(reflectances(film_at(stack, air, glass, nm), 1.0).r(),
                    ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k), 1e-12);
    EXPECT_NEAR(film_at(stack, air, glass, 565.35).layers[0].k, 0.5 * (3.586 + 3.858), 1e-12);
    EXPECT_EQ(film_at(stack, air, glass, 400.0).layers[0].k, 3.093);
    EXPECT_TRUE(is_absorbing(film_at(stack, air, glass, 500.0)));
}

TEST(LayerStack, ListedFromTheAirTurnsWithTheSurface) {
    const Layer low{medium(1.38), 100.0, 0.0}, high{medium(2.1), 60.0, 0.0};
    const LayerStack stack{{low, high}, true};
    const Film front = film_at(stack, air, glass, 550.0);
    const Film rear = film_at(stack, glass, air, 550.0);
    EXPECT_EQ(front.layers[0].n, 1.38);
    EXPECT_EQ(rear, reversed(front));
    // Between two glasses it stays as listed.
    EXPECT_EQ(film_at(stack, medium(1.7), glass, 550.0).layers[0].n, 1.38);
    const LayerStack from_front{{low, high}};
    EXPECT_EQ(film_at(from_front, glass, air, 550.0).layers[0].n, 1.38);
}

}  // namespace
}  // namespace ghostlight
