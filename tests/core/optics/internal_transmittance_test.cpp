// Glass that absorbs, against the Beer–Lambert law over lengths that are known, and the ways of
// tracing against one another.

#include <gtest/gtest.h>

#include <cmath>

#include "core/flare/flare_image.h"
#include "core/ghosts/bundle.h"
#include "core/ghosts/ghost_table.h"
#include "core/io/lens_file.h"
#include "core/optics/trace.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double per_mm = 0.03;  ///< of the test's glass at every wavelength
constexpr double plate_mm = 8.0;

/// Absorbs as `at` says at 400 nm and hardly at 700 nm.
void let_absorb(Prescription& lens, double at_400_per_mm, double at_700_per_mm) {
    constexpr double piece_mm = 10.0;
    for (Surface& surface : lens.surfaces)
        if (!is_air(surface.medium_after))
            surface.medium_after.transmittance = {
                {400.0, std::exp(-at_400_per_mm * piece_mm), piece_mm},
                {700.0, std::exp(-at_700_per_mm * piece_mm), piece_mm}};
    lens.internal_transmittance = true;
}

Prescription plate() {
    Prescription lens = lens_of({row(0.0, plate_mm, 1.5, 50.0), row(0.0, 20.0, 1.0, 50.0)});
    let_absorb(lens, per_mm, per_mm);
    return lens;
}

Prescription lossless(Prescription lens) {
    lens.internal_transmittance = false;
    return lens;
}

TEST(InternalTransmittance, EveryPassThroughAPlateLosesTheSame) {
    // Rounding of the length and of the exponential.
    constexpr double tolerance = 1e-13;
    const GhostPath ghost{{1, 0}};
    for (const double field_deg : {0.0, 10.0, 40.0, 70.0}) {
        const double inside = std::asin(std::sin(rad_from_deg(field_deg)) / 1.5);
        const double once = std::exp(-per_mm * plate_mm / std::cos(inside));
        const Ray ray = ray_at_entrance({field_deg, 60.0}, 1.0, -2.0);
        const OpticalSystem absorbing = compile(plate(), d_line_nm);
        const OpticalSystem clear = compile(lossless(plate()), d_line_nm);
        for (const auto& [path, passes] : {std::pair{GhostPath{}, 1}, std::pair{ghost, 3}}) {
            const TracedRay with = trace_ray(absorbing, path, ray);
            const TracedRay without = trace_ray(clear, path, ray);
            const double share = std::pow(once, passes);
            EXPECT_NEAR(with.weight / without.weight, share, tolerance) << field_deg;
            EXPECT_NEAR(with.weight_s / without.weight_s, share, tolerance) << field_deg;
            EXPECT_NEAR(with.weight_average / without.weight_average, share, tolerance);
            EXPECT_NEAR(with.hits.back().intensity / without.hits.back().intensity, share,
                        tolerance);
        }
    }
}

TEST(InternalTransmittance, GlassOnTheSensorAbsorbsUpToIt) {
    Prescription lens = lens_of({row(0.0, plate_mm, 1.5, 50.0)});
    let_absorb(lens, per_mm, per_mm);
    const Ray ray = ray_at_entrance({0.0, 90.0}, 1.0, 0.0);
    const double share = trace_ray(compile(lens, d_line_nm), {}, ray).weight /
                         trace_ray(compile(lossless(lens), d_line_nm), {}, ray).weight;
    EXPECT_NEAR(share, std::exp(-per_mm * plate_mm), 1e-13);
}

/// A coated lens of several glasses whose blue is absorbed: 20 % in 10 mm at 400 nm.
Prescription yellowish() {
    Prescription lens =
        with_air_coating(bundled("tessar_brendel_100_f2.8"), QuarterWave{.center_nm = 540.0});
    let_absorb(lens, 0.0223, 0.001);
    return lens;
}

template <class T>
void expect_like_single_rays(T tolerance) {
    const OpticalSystem system = compile(yellowish(), 450.0);
    const LightDirection light{7.0, 30.0};
    const BeamFrame frame = beam_frame(light);
    for (const GhostPath& path : {GhostPath{}, GhostPath{{4, 2}}, GhostPath{{6, 0}}}) {
        Bundle<T> bundle;
        bundle.u_mm = {T(0), T(3), T(-5), T(1)};
        bundle.v_mm = {T(0), T(2), T(4), T(-6)};
        trace_bundle(trace_path<T>(system, path), frame, Weights::polarised, bundle);
        for (std::size_t i = 0; i < bundle.size(); ++i) {
            const glm::dvec3 from = static_cast<double>(bundle.u_mm[i]) * frame.e1 +
                                    static_cast<double>(bundle.v_mm[i]) * frame.e2;
            const TracedRay single = trace_ray(system, path, {from, frame.direction});
            if (!single.status.reaches_sensor()) continue;
            EXPECT_NEAR(static_cast<double>(bundle.weight[i]) / single.weight, 1.0,
                        static_cast<double>(tolerance));
            EXPECT_NEAR(static_cast<double>(bundle.weight_average[i]) / single.weight_average, 1.0,
                        static_cast<double>(tolerance));
        }
    }
}

TEST(InternalTransmittance, BundlesLoseWhatSingleRaysLose) {
    expect_like_single_rays(1e-11);  // double lanes: rounding
    expect_like_single_rays(2e-4F);  // float lanes: rounding of some 20 films
}

TEST(InternalTransmittance, PicturesAndTablesAgree) {
    // The table at 0.5 %, the picture at 2 % of its light, which bounds its flux too.
    constexpr double tolerance = 0.025;
    const Spectrum light = StandardLight{Illuminant::d65};
    GhostTableRequest table_request{.light = {8.0, 90.0}, .spectrum = light};
    table_request.tolerance = 0.005;
    table_request.peaks = false;
    FlareRequest picture;
    picture.light = table_request.light;
    picture.spectrum = light;
    picture.width_px = 480;
    picture.spectral_samples = 31;  // of the uniform method: five miss 7 % of this coating's ends
    double fluxes[2] = {};
    for (const bool absorbs : {false, true}) {
        Prescription lens = yellowish();
        lens.internal_transmittance = absorbs;
        const GhostTable table = *ghost_table(lens, table_request);
        double on_sensor_mm2 = 0.0;
        for (const GhostRow& ghost : table.ghosts)
            on_sensor_mm2 += ghost.flux_mm2 * ghost.on_sensor;
        for (const FlareMethod method : {FlareMethod::planned, FlareMethod::uniform}) {
            picture.method = method;
            const FlareImage image = *render_flare(lens, picture);
            EXPECT_NEAR(image.flux_on_sensor_mm2 / on_sensor_mm2, 1.0, tolerance)
                << "absorbs " << absorbs << ", method " << static_cast<int>(method);
        }
        fluxes[absorbs ? 1 : 0] = on_sensor_mm2;
    }
    // Ghosts pass some 30 mm of this glass: the agreement above is about more than the tolerance.
    EXPECT_LT(fluxes[1], 0.85 * fluxes[0]);
}

TEST(InternalTransmittance, IsKeptInLensFiles) {
    const Prescription lens = yellowish();
    const std::string text = lens_to_json(lens);
    EXPECT_NE(text.find("\"internal_transmittance\": true"), std::string::npos);
    EXPECT_EQ(lens_from_json(text, "lens.json").lens, lens);
}

}  // namespace
}  // namespace ghostlight
