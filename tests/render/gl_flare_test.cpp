#include "render/gl_flare/gl_flare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "core/flare/planned_flare.h"
#include "core/io/lens_file.h"
#include "render/offscreen.h"
#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

std::vector<std::filesystem::path> lens_files() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(GHOSTLIGHT_LENS_DIR))
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

double relative_l1(const FlareImage& a, const FlareImage& b) {
    double off = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < a.irradiance.size(); ++i) {
        off += std::abs(static_cast<double>(a.irradiance[i] - b.irradiance[i]));
        sum += static_cast<double>(a.irradiance[i]);
    }
    return sum > 0.0 ? off / sum : 0.0;
}

class GlFlareTest : public testing::Test {
   protected:
    OffscreenContext context_;
    GlFlare gl_;
};

TEST_F(GlFlareTest, Explore) {
    for (const auto& file : lens_files()) {
        const Prescription lens = read_lens(file).lens;
        FlareRequest request;
        request.light.field_deg = 12.0;
        request.light.azimuth_deg = 60.0;
        request.width_px = 960;
        const FlareScene scene = flare_scene(lens, request.spectrum, 16);
        for (const double tolerance : {0.02, 0.005}) {
            request.tolerance = tolerance;
            const auto cpu = render_planned(scene, request);
            gl_.render(scene, request);
            const auto gl = gl_.render(scene, request);
            std::cout << file.stem().string() << " tol " << tolerance << " L1 "
                      << relative_l1(*cpu, *gl) << " flux " << cpu->flux_on_sensor_mm2 << " "
                      << gl->flux_on_sensor_mm2 / cpu->flux_on_sensor_mm2 << " cpu ms "
                      << cpu->times.total_ms << " gl " << gl->times.bounds_ms << " + "
                      << gl->times.raster_ms << " cells " << gl->cells << "\n";
        }
    }
}

}  // namespace
}  // namespace ghostlight
