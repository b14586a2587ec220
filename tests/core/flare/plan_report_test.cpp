#include "core/flare/plan_report.h"

#include <gtest/gtest.h>

#include <numeric>

#include "core/flare/planned_flare.h"
#include "core/io/lens_file.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

TEST(PlanReport, AccountsForEveryGhostOnce) {
    const FlareScene scene = flare_scene(bundled("tessar_brendel_100_f2.8"), Monochromatic{});
    FlareRequest request;
    request.light = {11.0, 90.0};
    request.width_px = 240;
    const FlareImage image = render_planned(scene, request).value();
    const auto proof = certify(scene, request.light, image.plan);
    const PlanReport report = plan_report(scene, request, image.plan, &*proof);
    std::size_t ghosts = 0;
    double bound = 0.0;
    for (const Omission& each : report.omissions) {
        bound += each.bound_mm2.value_or(0.0);
        if (each.what.starts_with("ghosts ") || each.what.starts_with("half "))
            ghosts += each.ghosts;
    }
    EXPECT_EQ(ghosts, scene.ghosts.size());
    EXPECT_DOUBLE_EQ(bound, report.bound_mm2);
    EXPECT_GE(report.bound_mm2, proof->missed_flux_bound_mm2 * (1.0 - 1e-12));
    EXPECT_EQ(report.flux_mm2, image.plan.flux_mm2);
    // Without a proof, what the search can have missed is not bounded, and is not said to be 0.
    for (const Omission& each : plan_report(scene, request, image.plan).omissions)
        if (each.what.starts_with("the entrance")) {
            EXPECT_FALSE(each.bound_mm2.has_value());
        }
}

/// The bound holds on every bundled lens, from the axis to the edge.
TEST(PlanReportSlow, BoundsTheTrueErrorOnEveryBundledLens) {
    constexpr double tolerance = 0.05, reference_tolerance = 0.03;
    for (const BundledLens& each : bundled_lenses()) {
        const Prescription lens = read_lens(each.file).lens;
        const FlareScene scene = flare_scene(lens, Monochromatic{});
        const double corner_deg =
            deg_from_rad(std::atan(0.5 * std::hypot(lens.sensor.width_mm, lens.sensor.height_mm) /
                                   std::abs(first_order(scene.system()).efl_mm)));
        // The zooms' references take seconds: one field for them.
        std::vector<double> shares = {0.0, 0.5, 1.0};
        if (scene.ghosts.size() > 300) shares = {0.5};
        for (const double share : shares) {
            FlareRequest request;
            request.light = {share * corner_deg, 90.0};
            request.width_px = 320;
            request.tolerance = tolerance;
            const FlareImage image = render_planned(scene, request).value();
            const MeasuredPlan measured =
                measure_plan(lens, request, image, reference_tolerance).value();
            // The reference knows no diffraction.
            EXPECT_LE(measured.error, bounded_error(image.plan) + measured.reference_error)
                << lens.name << " at " << request.light.field_deg << " degrees";
            EXPECT_LE(measured.error, tolerance + measured.reference_error) << lens.name;
        }
    }
}

}  // namespace
}  // namespace ghostlight
