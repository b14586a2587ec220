// Stiff and extreme cases, each against a closed form or a limit, in double and in single
// precision. tests/core/ghosts/traps_test.cpp holds that tables and pictures stay finite there.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/flare/reference_image.h"
#include "core/ghosts/bundle.h"
#include "core/ghosts/ghost_table.h"
#include "core/ghosts/path_stability.h"
#include "core/ghosts/pupil.h"
#include "core/optics/mend.h"
#include "core/optics/paraxial.h"
#include "core/optics/trace_steps.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

/// What one ray of a bundle does.
template <class T>
struct Landed {
    T x_mm, y_mm, weight, margin;
};
template <class T>
Landed<T> land(const OpticalSystem& system, const GhostPath& path, const BeamFrame& frame,
               double u_mm, double v_mm) {
    Bundle<T> rays;
    rays.u_mm = {static_cast<T>(u_mm)};
    rays.v_mm = {static_cast<T>(v_mm)};
    trace_bundle(trace_path<T>(system, path), frame, Weights::polarised, rays);
    return {rays.x_mm[0], rays.y_mm[0], rays.weight[0], rays.margin[0]};
}
template <class T>
Landed<T> land(const Prescription& lens, const GhostPath& path, LightDirection light, double u_mm,
               double v_mm) {
    return land<T>(compile(lens, d_line_nm), path, beam_frame(light), u_mm, v_mm);
}

// --- flat and steep surfaces ------------------------------------------------------------------

/// Light at height h on a surface of radius R into index n, z further on: refracted by
/// (n − 1) h / (n R) to first order, ± that about the plane.
TEST(ExtremeRadius, OfABillionDiffersFromAPlaneByTheClosedForm) {
    constexpr double n = 1.5, z_mm = 100.0, h_mm = 5.0;
    const LightDirection axis{0.0, 90.0};
    auto at = [&](double radius_mm, auto zero) {
        return land<decltype(zero)>(lens_of({row(radius_mm, z_mm, n)}), {}, axis, 0.0, h_mm).y_mm;
    };
    for (const double radius_mm : {1e6, 1e9}) {
        const double shift_mm = (n - 1.0) * h_mm * z_mm / (n * radius_mm);
        const double plane_mm = at(0.0, 0.0);
        // A double holds a height of 5 mm to 1e-15 mm.
        constexpr double rounding_mm = 4e-15;
        EXPECT_NEAR(at(radius_mm, 0.0) - plane_mm, -shift_mm, rounding_mm + 1e-4 * shift_mm);
        EXPECT_NEAR(at(-radius_mm, 0.0) - plane_mm, shift_mm, rounding_mm + 1e-4 * shift_mm);
        // Second order, the same for both: the sag h² / 2R times the slope.
        const double second_mm = shift_mm / z_mm * h_mm * h_mm / (2.0 * radius_mm);
        EXPECT_NEAR(0.5 * (at(radius_mm, 0.0) + at(-radius_mm, 0.0)), plane_mm + second_mm,
                    rounding_mm);
    }
    // The difference at 1e9, 1.7e-7 mm, is half of the last digit of 5 mm in float (2.4e-7 mm).
    EXPECT_NEAR(at(1e9, 0.0F), at(0.0, 0.0F), 5e-7F);
    EXPECT_NEAR(at(-1e9, 0.0F), at(0.0, 0.0F), 5e-7F);
}

template <class T>
void expect_rim_of_a_hemisphere(double tolerance) {
    // At the rim of |R| = 1.0001 a the surface is almost parallel to the axis: cos θ = 0.01414.
    constexpr double a_mm = 10.0, radius_mm = 1.0001 * a_mm, n = 1.6, gap_mm = 5.0;
    const double sine = a_mm / radius_mm;
    const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
    const double sag_mm = radius_mm * (1.0 - cosine);
    const double turned = std::asin(sine) - std::asin(sine / n);
    const double y_mm = a_mm - (gap_mm + radius_mm - sag_mm) * std::tan(turned);
    Prescription lens = lens_of({row(radius_mm, radius_mm + gap_mm, n, a_mm)});
    const auto landed = land<T>(lens, {}, {0.0, 90.0}, 0.0, a_mm);
    EXPECT_GE(landed.margin, T(0));
    EXPECT_NEAR(static_cast<double>(landed.y_mm), y_mm, tolerance);
}
TEST(ExtremeRadius, BarelyAboveTheSemiDiameterIsMetAtItsRim) {
    // Rounding of the height turns into 1 / cos θ = 71 times that of the sag, and of the slope.
    expect_rim_of_a_hemisphere<double>(1e-11);
    expect_rim_of_a_hemisphere<float>(5e-3);
}

// --- incidence --------------------------------------------------------------------------------

struct Fresnel {
    double r_s, r_p;
};
Fresnel fresnel(double n1, double n2, double cos1) {
    const double cos2 = std::sqrt(1.0 - (n1 / n2) * (n1 / n2) * (1.0 - cos1 * cos1));
    return {std::pow((n1 * cos1 - n2 * cos2) / (n1 * cos1 + n2 * cos2), 2),
            std::pow((n2 * cos1 - n1 * cos2) / (n2 * cos1 + n1 * cos2), 2)};
}

template <class T>
void expect_grazing(double field_deg, double tolerance) {
    constexpr double n = 1.5;
    const double cosine = cos_from_deg(field_deg);
    const Fresnel r = fresnel(1.0, n, cosine);
    Prescription lens = lens_of({row(0.0, 1.0, n, 1e6)});
    const auto landed = land<T>(lens, {}, {field_deg, 90.0}, 0.0, 0.0);
    const double t = 1.0 - 0.5 * (r.r_s + r.r_p);
    EXPECT_NEAR(static_cast<double>(landed.weight), t, tolerance * t) << field_deg;
    EXPECT_TRUE(std::isfinite(landed.y_mm));
}
TEST(ExtremeIncidence, GrazingTransmitsWhatFresnelSays) {
    for (const double field : {0.0, 60.0, 89.0, 89.9, 89.999}) {
        // cos θ is a component of the direction: float holds it to 6e-8 of 1.
        expect_grazing<double>(field, 1e-9);
        expect_grazing<float>(field, 2e-6 + 3e-7 / cos_from_deg(field));
    }
    const auto along = land<double>(lens_of({row(0.0, 1.0, 1.5, 1e6)}), {}, {90.0, 90.0}, 0.0, 0.0);
    EXPECT_TRUE(std::isfinite(along.weight));
    EXPECT_LE(std::abs(along.weight), 1e-12) << "along the surface nothing enters";
}

TEST(ExtremeIncidence, NormalIncidenceIsExact) {
    const double n = 1.7, r = std::pow((n - 1.0) / (n + 1.0), 2);
    const Prescription lens = lens_of({row(0.0, 3.0, n), row(0.0, 5.0, 1.0)});
    for (const GhostPath& path : {GhostPath{}, GhostPath{{1, 0}}}) {
        const double weight = path.is_direct() ? std::pow(1.0 - r, 2) : std::pow(r * (1.0 - r), 2);
        const auto full = land<double>(lens, path, {0.0, 90.0}, 0.0, 0.0);
        const auto single = land<float>(lens, path, {0.0, 90.0}, 0.0, 0.0);
        EXPECT_NEAR(full.weight, weight, 1e-15);
        EXPECT_NEAR(static_cast<double>(single.weight), weight, 1e-6 * weight);
        EXPECT_EQ(full.x_mm, 0.0);
        EXPECT_EQ(full.y_mm, 0.0);
    }
}

/// From glass to air, the critical angle from both sides.
TEST(ExtremeIncidence, OnsetOfTotalReflectionFromBothSides) {
    constexpr double n = 1.5;
    Film film;
    film.n_in = n;
    film.n_out = 1.0;
    const double critical_cos = std::sqrt(1.0 - 1.0 / (n * n));
    for (const double above : {1e-3, 1e-6, 1e-9, 1e-12}) {
        const Reflectances open = reflectances(film, critical_cos * (1.0 + above));
        const Fresnel r = fresnel(n, 1.0, critical_cos * (1.0 + above));
        // 1 − R goes as the root of the distance, and so does its rounding.
        const double tolerance = 1e-15 / std::sqrt(above) + 1e-12;
        EXPECT_NEAR(open.r_s, r.r_s, tolerance);
        EXPECT_NEAR(open.r_p, r.r_p, tolerance);
        EXPECT_NEAR(open.r_s + open.t_s, 1.0, 1e-12);
        const Reflectances total = reflectances(film, critical_cos * (1.0 - above));
        EXPECT_NEAR(total.r_s, 1.0, 1e-12);
        EXPECT_NEAR(total.r_p, 1.0, 1e-12);
        EXPECT_NEAR(total.t_s, 0.0, 1e-12);
    }
    // 1 − R falls by √10⁻³ for each step of 10⁻³ towards the onset.
    const double far = 1.0 - reflectances(film, critical_cos * (1.0 + 1e-6)).r_s;
    const double near = 1.0 - reflectances(film, critical_cos * (1.0 + 1e-9)).r_s;
    EXPECT_NEAR(far / near, std::sqrt(1e3), 0.1);
}

TEST(ExtremeIncidence, RaysBeyondTheOnsetAreMarkedInBothPrecisions) {
    // Glass fills the space in front of a plane into air: light arrives at the angle of its field.
    constexpr double n = 1.5;
    Prescription lens = lens_of({row(0.0, 1.0, n, 1e6), row(-40.0, 20.0, 1.0, 38.0)});
    const OpticalSystem system = compile(lens, d_line_nm);
    // On a sphere of radius R a ray along the axis at height h meets it at sin θ = h / R.
    const double onset_mm = 40.0 / n;
    for (const double share : {1e-2, 1e-4}) {
        const auto inside =
            land<double>(system, {}, beam_frame({0.0, 90.0}), 0.0, onset_mm * (1.0 - share));
        const auto outside =
            land<double>(system, {}, beam_frame({0.0, 90.0}), 0.0, onset_mm * (1.0 + share));
        EXPECT_LT(outside.margin, 0.0);
        const auto single =
            land<float>(system, {}, beam_frame({0.0, 90.0}), 0.0, onset_mm * (1.0 + share));
        EXPECT_LT(single.margin, 0.0F);
        EXPECT_TRUE(std::isfinite(inside.weight) && std::isfinite(outside.y_mm));
    }
}

// --- films ------------------------------------------------------------------------------------

TEST(ExtremeFilm, EqualMediaBendNothingAndReflectNothing) {
    const Prescription lens =
        lens_of({row(17.0, 2.0, 1.6), row(-13.0, 3.0, 1.6), row(25.0, 10.0, 1.6)});
    const OpticalSystem system = compile(lens, d_line_nm);
    EXPECT_TRUE(two_reflection_ghosts(system).empty()) << "one interface alone is left";
    const Prescription without = lens_of({row(17.0, 15.0, 1.6)});
    const auto a = land<double>(lens, {}, {11.0, 30.0}, 1.0, 2.0);
    const auto b = land<double>(without, {}, {11.0, 30.0}, 1.0, 2.0);
    EXPECT_NEAR(a.x_mm, b.x_mm, 1e-14);
    EXPECT_NEAR(a.y_mm, b.y_mm, 1e-14);
    EXPECT_NEAR(a.weight, b.weight, 1e-15);
}

TEST(ExtremeFilm, NoThicknessIsNoFilmAndHalfAWaveVanishes) {
    const Medium air = medium(1.0), glass = medium(1.52);
    const Film bare = film_at(Uncoated{}, air, glass, 550.0);
    const Film none = film_at(QuarterWave{550.0, medium(1.38), 0.0}, air, glass, 550.0);
    const Film half = film_at(QuarterWave{550.0, medium(1.38), 2.0}, air, glass, 550.0);
    const Film neighbour = film_at(QuarterWave{550.0, medium(1.52), 1.0}, air, glass, 550.0);
    for (const double cosine : {1.0, 0.7, 1e-3, 1e-8}) {
        EXPECT_EQ(reflectances(none, cosine).r_s, reflectances(bare, cosine).r_s);
        EXPECT_EQ(reflectances(none, cosine).t_p, reflectances(bare, cosine).t_p);
        EXPECT_EQ(reflectances(neighbour, cosine).r_p, reflectances(bare, cosine).r_p);
    }
    EXPECT_NEAR(reflectances(half, 1.0).r_s, reflectances(bare, 1.0).r_s, 1e-15);
    const double quarter = (1.0 - 1.38 * 1.38 / 1.52) / (1.0 + 1.38 * 1.38 / 1.52);
    EXPECT_NEAR(reflectances(film_at(QuarterWave{550.0, medium(1.38)}, air, glass, 550.0), 1.0).r_s,
                quarter * quarter, 1e-15);
}

// --- stops, gaps, sizes -----------------------------------------------------------------------

TEST(ExtremeStop, FluxGoesAsItsAreaDownToATenthOfAMicron) {
    // The image's flux of a small stop: π times its entrance pupil's radius squared, times T.
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    double transmitted = 0.0;
    for (const double stop_mm : {1e-1, 1e-2, 1e-3, 1e-4}) {
        const Prescription closed = stopped_down(lens, stop_mm);
        const OpticalSystem system = compile(closed, d_line_nm);
        const double radius_mm = first_order(system).entrance_pupil_radius_mm;
        const auto table =
            ghost_table(closed, {.light = {0.0, 90.0}, .tolerance = 1e-3, .peaks = false});
        const double t = table->direct.flux_mm2 / (std::numbers::pi * radius_mm * radius_mm);
        const auto chief = land<double>(system, {}, beam_frame({0.0, 90.0}), 0.0, 0.0);
        EXPECT_NEAR(t, chief.weight, 2e-3 * chief.weight) << stop_mm;
        if (transmitted > 0.0) {
            EXPECT_NEAR(t, transmitted, 2e-3 * t) << stop_mm;
        }
        transmitted = t;
    }
}

TEST(ExtremeGap, OfNothingAndOfAKilometre) {
    // Cemented with no glass between is not there.
    const Prescription joined = lens_of({row(30.0, 0.0, 1.6), row(30.0, 8.0, 1.7)});
    const Prescription single = lens_of({row(30.0, 8.0, 1.7)});
    const auto a = land<double>(joined, {}, {5.0, 90.0}, 1.0, -3.0);
    const auto b = land<double>(single, {}, {5.0, 90.0}, 1.0, -3.0);
    EXPECT_NEAR(a.x_mm, b.x_mm, 1e-14);
    EXPECT_NEAR(a.y_mm, b.y_mm, 1e-14);
    // A plate, then a kilometre of air.
    constexpr double far_mm = 1e6, field_deg = 3.0, n = 1.5, plate_mm = 4.0, v_mm = 0.5;
    Prescription lens = lens_of({row(0.0, plate_mm, n, 1e6), row(0.0, far_mm, 1.0, 1e6)});
    const double theta = rad_from_deg(field_deg);
    const double y_mm = v_mm / std::cos(theta) +
                        plate_mm * std::tan(std::asin(std::sin(theta) / n)) +
                        far_mm * std::tan(theta);
    const auto full = land<double>(lens, {}, {field_deg, 90.0}, 0.0, v_mm);
    const auto flat = land<float>(lens, {}, {field_deg, 90.0}, 0.0, v_mm);
    EXPECT_NEAR(full.y_mm, y_mm, 1e-15 * 8 * far_mm);
    EXPECT_NEAR(static_cast<double>(flat.y_mm), y_mm, 1.2e-7 * 4 * far_mm);
}

TEST(ExtremeScale, LensesOfAnySizeAreTheSameLens) {
    // Exactly, in powers of two; to rounding in powers of ten.
    for (const char* file : {"tessar_brendel_100_f2.8", "nikon_zoom_80_200_f2.8"}) {
        const Prescription lens = bundled(file);
        const OpticalSystem system = compile(lens, d_line_nm);
        const BeamFrame frame = beam_frame({4.0, 70.0});
        for (const double factor : {0x1p-10, 0x1p10, 1e-3, 1e3}) {
            const OpticalSystem other = compile(scaled(lens, factor), d_line_nm);
            for (const GhostPath& path : {GhostPath{}, GhostPath{{4, 2}}}) {
                const auto a = land<double>(system, path, frame, 0.4, 0.7);
                const auto b = land<double>(other, path, frame, factor * 0.4, factor * 0.7);
                const auto c = land<float>(system, path, frame, 0.4, 0.7);
                const auto d = land<float>(other, path, frame, factor * 0.4, factor * 0.7);
                const double size_mm = std::abs(a.y_mm) + 1.0;
                EXPECT_NEAR(b.y_mm / factor, a.y_mm, 1e-12 * size_mm) << file << factor;
                EXPECT_NEAR(b.weight, a.weight, 1e-12 * a.weight) << file << factor;
                EXPECT_NEAR(static_cast<double>(d.y_mm) / factor, static_cast<double>(c.y_mm),
                            2e-4 * size_mm)
                    << file << factor;
            }
        }
    }
}

// --- many surfaces ----------------------------------------------------------------------------

Prescription two_hundred_surfaces() {
    std::vector<Surface> rows;
    for (int k = 0; k < 200; ++k)
        rows.push_back(row(k % 4 < 2 ? 300.0 + k : -330.0 - k, k % 2 == 0 ? 1.0 : 0.5,
                           k % 2 == 0 ? 1.5 : 1.0, 14.0));
    rows.back().thickness_mm = 40.0;
    return lens_of(rows, 100);
}

TEST(ExtremeCount, TwoHundredSurfacesLoseNoDigits) {
    const OpticalSystem system = compile(two_hundred_surfaces(), d_line_nm);
    ASSERT_EQ(two_reflection_ghosts(system).size(), 19'900U);
    const BeamFrame frame = beam_frame({1.0, 90.0});
    for (const GhostPath& path : {GhostPath{}, GhostPath{{199, 0}}, GhostPath{{150, 20}}}) {
        const RayCondition condition = ray_condition(system, path, frame, 0.3, 0.2);
        ASSERT_TRUE(condition.valid) << name(path);
        // The same steps in long double, whose digits are 2048 times as many.
        using Real = long double;
        const auto wide = trace_path<Real>(system, path);
        RayAt<Real> ray{
            {Real(0.3L * frame.e1.x + 0.2L * frame.e2.x),
             Real(0.3L * frame.e1.y + 0.2L * frame.e2.y),
             Real(0.3L * frame.e1.z + 0.2L * frame.e2.z)},
            {Real(frame.direction.x), Real(frame.direction.y), Real(frame.direction.z)}};
        for (const TraceStep<Real>& step : wide.steps)
            turn(step, meet(step, wide.aspheric.data(), Real(1), ray), ray);
        const Real t = -(ray.position.z + wide.sensor_gap_mm) / ray.direction.z;
        const auto y_mm = static_cast<double>(ray.position.y + t * ray.direction.y);
        const auto full = land<double>(system, path, frame, 0.3, 0.2);
        const auto single = land<float>(system, path, frame, 0.3, 0.2);
        // Some ten roundings at a meeting, where the amplification counts one.
        constexpr double roundings = 10.0;
        EXPECT_NEAR(full.y_mm, y_mm, roundings * 0x1p-53 * condition.amplification_mm)
            << name(path);
        EXPECT_NEAR(static_cast<double>(single.y_mm), y_mm,
                    roundings * float_rounding * condition.amplification_mm)
            << name(path);
    }
}

// --- fields and wavelengths -------------------------------------------------------------------

TEST(ExtremeField, TheFisheyesImageFadesTowardsNinetyDegrees) {
    const Prescription lens = bundled("fisheye_nikkor_10.5_f2.8");
    double before = 1e300;
    for (const double field : {60.0, 75.0, 85.0, 89.0, 90.0}) {
        const auto table =
            ghost_table(lens, {.light = {field, 90.0}, .tolerance = 0.02, .peaks = false});
        const double flux = table->direct.flux_mm2;
        EXPECT_TRUE(std::isfinite(flux));
        EXPECT_LE(flux, before * 1.02) << field;
        before = flux;
        for (const GhostRow& ghost : table->ghosts) EXPECT_TRUE(std::isfinite(ghost.flux_mm2));
    }
}

TEST(ExtremeWavelength, EndsOfAGlassesRange) {
    int tried = 0;
    for (const BundledLens& each : bundled_lenses()) {
        const Prescription lens = read_lens(each.file).lens;
        for (const Surface& surface : lens.surfaces) {
            const auto range = wavelength_range_nm(surface.medium_after);
            if (!range || !(range->first > 0.0) || !std::isfinite(range->second)) continue;
            ++tried;
            for (const double nm : {range->first, range->second}) {
                const double n = refractive_index(surface.medium_after, nm);
                EXPECT_TRUE(std::isfinite(n) && n >= 1.0) << nm;
            }
            EXPECT_THROW(refractive_index(surface.medium_after, 0.99 * range->first), Error);
            EXPECT_THROW(refractive_index(surface.medium_after, 1.01 * range->second), Error);
        }
    }
    if (tried == 0) GTEST_SKIP() << "no bundled glass states a range";
}

// --- caustics ---------------------------------------------------------------------------------

/// A ghost whose paraxial focus lies on the sensor. Near the axis its rays land at k h³: within r
/// there is light as r^(2/3), and the pixel on the axis, of side p, holds p^(2/3) / p² of it.
TEST(ExtremeFocus, ThePixelOnTheAxisGrowsByTheCausticsLawAndTheFluxConverges) {
    Prescription lens = lens_of({row(200.0, 4.0, 1.5, 10.0), row(-200.0, 60.0, 1.0, 10.0)});
    const GhostPath path{{1, 0}};
    lens.surfaces.back().thickness_mm +=
        paraxial_ghost(compile(lens, d_line_nm), path).focus_from_sensor_mm;
    ASSERT_GT(lens.surfaces.back().thickness_mm, 1.0);
    lens.sensor.width_mm = lens.sensor.height_mm = 4.0;
    auto picture = [&](int width_px, double disc_deg) {
        ReferenceRequest request;
        request.width_px = width_px;  // odd: one pixel lies on the axis
        request.tolerance = 0.02;
        request.only = {path};
        request.disc_diameter_deg = disc_deg;
        request.finest_level = disc_deg > 0.0 ? 4 : 8;  // 192 directions
        return render_reference(lens, request).value();
    };
    auto middle = [](const ReferenceImage& image) {
        return static_cast<double>(image.image.irradiance[image.image.irradiance.size() / 2]);
    };
    const ReferenceImage coarse = picture(41, 0.0), fine = picture(123, 0.0);
    EXPECT_NEAR(middle(fine) / middle(coarse), std::pow(3.0, 4.0 / 3.0),
                0.05 * std::pow(3.0, 4.0 / 3.0))
        << "a point source";
    EXPECT_NEAR(fine.image.flux_mm2, coarse.image.flux_mm2, 0.005 * coarse.image.flux_mm2);
    // A disc that covers many pixels has a limit, but for the evenness of its directions.
    const double ratio = middle(picture(369, 0.3)) / middle(picture(123, 0.3));
    EXPECT_LT(std::abs(ratio - 1.0), 0.25) << "a disc";
}

}  // namespace
}  // namespace ghostlight
