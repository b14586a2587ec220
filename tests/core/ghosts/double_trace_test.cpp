#include "core/ghosts/double_trace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/flare/planned_ghost.h"
#include "core/ghosts/path_stability.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

/// A lens of twenty metres that focuses its ghost on a sensor of 0.03 mm: floats
/// of metres do not tell such pixels apart.
Prescription huge_lens() {
    Prescription lens = lens_of({row(2e4, 400.0, 1.5, 100.0), row(-2e4, 6000.0, 1.0, 100.0)});
    lens.surfaces.back().thickness_mm +=
        paraxial_ghost(compile(lens, d_line_nm), GhostPath{{1, 0}}).focus_from_sensor_mm;
    lens.sensor.width_mm = lens.sensor.height_mm = 0.03;
    return lens;
}

Bundle<float> fan(float step_mm) {
    Bundle<float> rays;
    for (int k = 1; k <= 20; ++k) {
        rays.u_mm.push_back(step_mm * static_cast<float>(k) / 3.0F);
        rays.v_mm.push_back(step_mm * static_cast<float>(k) / 7.0F);
    }
    return rays;
}

TEST(DoubleTrace, RoundsWhatDoublePrecisionSays) {
    const OpticalSystem system = compile(bundled("heliar_tronnier_100"), d_line_nm);
    const BeamFrame frame = beam_frame({5.0, 90.0});
    const GhostPath path{{4, 2}};
    Bundle<float> rays = fan(0.3F);
    trace_in_double(system, path, frame, Weights::polarised, rays);
    Bundle<double> full;
    full.u_mm.assign(rays.u_mm.begin(), rays.u_mm.end());
    full.v_mm.assign(rays.v_mm.begin(), rays.v_mm.end());
    trace_bundle(trace_path<double>(system, path), frame, Weights::polarised, full);
    for (std::size_t k = 0; k < rays.size(); ++k) {
        EXPECT_EQ(rays.x_mm[k], static_cast<float>(full.x_mm[k]));
        EXPECT_EQ(rays.y_mm[k], static_cast<float>(full.y_mm[k]));
        EXPECT_EQ(rays.weight[k], static_cast<float>(full.weight[k]));
        EXPECT_EQ(rays.margin[k], static_cast<float>(full.margin[k]));
        EXPECT_EQ(rays.stop_v_mm[0][k], static_cast<float>(full.stop_v_mm[0][k]));
    }
}

TEST(DoubleTrace, TakesWhatIsIllConditionedAndNothingElse) {
    const LightDirection on_axis{0.0, 90.0};
    for (const bool huge : {true, false}) {
        const Prescription lens = huge ? huge_lens() : bundled("tessar_brendel_100_f2.8");
        const FlareScene scene = flare_scene(lens, Monochromatic{});
        const OpticalSystem& system = scene.system();
        const PixelFrame frame = pixel_frame(system.sensor_width_mm, system.sensor_height_mm, 1280);
        const GhostPlanner planner(scene, on_axis, frame);
        for (const GhostPath& path : scene.ghosts)
            EXPECT_EQ(planner.probe(path).in_double, huge) << name(path);
    }
}

TEST(DoubleTrace, MeasuresWhatSinglePrecisionMoves) {
    const OpticalSystem system = compile(huge_lens(), d_line_nm);
    const BeamFrame frame = beam_frame({0.0, 90.0});
    const GhostPath path{{1, 0}};
    Bundle<float> rays = fan(10.0F);
    trace_bundle(trace_path<float>(system, path), frame, Weights::none, rays);
    const double moved = float_displacement_mm(system, path, frame, rays, rays.size());
    // Some roundings of the largest length on the way, by the slope that rays of 70 mm have.
    const double rounding_mm = float_rounding * 6000.0;
    EXPECT_GT(moved, 1e-3 * rounding_mm);
    EXPECT_LT(moved, 10.0 * rounding_mm);
    trace_in_double(system, path, frame, Weights::none, rays);
    // What is left is the rounding of places on a sensor of 0.03 mm.
    EXPECT_LT(float_displacement_mm(system, path, frame, rays, rays.size()),
              0.03 * std::numeric_limits<float>::epsilon());
}

}  // namespace
}  // namespace ghostlight
