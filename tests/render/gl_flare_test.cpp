#include "render/gl_flare/gl_flare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <filesystem>
#include <iostream>
#include <sstream>

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

struct Moments {
    double flux = 0.0, column = 0.0, row = 0.0, spread_px = 0.0;
};
Moments moments(const FlareImage& image) {
    Moments m;
    auto each = [&](auto work) {
        for (int row = 0; row < image.height_px; ++row)
            for (int column = 0; column < image.width_px; ++column)
                work(column + 0.5, row + 0.5,
                     static_cast<double>(
                         image.irradiance[static_cast<std::size_t>(row * image.width_px + column)]));
    };
    each([&](double x, double y, double e) {
        m.flux += e;
        m.column += x * e;
        m.row += y * e;
    });
    m.column /= m.flux;
    m.row /= m.flux;
    double square = 0.0;
    each([&](double x, double y, double e) {
        square += e * (std::pow(x - m.column, 2) + std::pow(y - m.row, 2));
    });
    m.spread_px = std::sqrt(std::max(0.0, square / m.flux));
    return m;
}

TEST_F(GlFlareTest, Explore) {
    for (const auto& file : lens_files()) {
        FlareRequest request;
        request.light.field_deg = 12.0;
        request.light.azimuth_deg = 60.0;
        request.width_px = 480;
        request.tolerance = 0.005;
        const FlareScene scene = flare_scene(read_lens(file).lens, request.spectrum, 16);
        const auto cpu = render_planned(scene, request), gl = gl_.render(scene, request);
        std::cout << file.stem().string() << " flux " << gl->flux_on_sensor_mm2/cpu->flux_on_sensor_mm2 << " L1 " << relative_l1(*cpu, *gl) << " ms " << gl->times.raster_ms << "\n";
    }
}

TEST_F(GlFlareTest, Rank) {
    for (const auto& file : lens_files()) {
        if (getenv("LENS") && file.string().find(getenv("LENS")) == std::string::npos) continue;
        FlareRequest request;
        request.light.field_deg = 12.0;
        request.light.azimuth_deg = 60.0;
        request.width_px = 480;
        request.tolerance = 0.005;
        FlareScene scene = flare_scene(read_lens(file).lens, request.spectrum, 16);
        auto plan = render_planned(scene, request)->plan;
        struct Row { double off; std::string text; };
        std::vector<Row> rows;
        for (const PlannedGhost& ghost : plan.ghosts) {
            if (ghost.fate != GhostFate::drawn || ghost.flux_mm2 < 1e-3 * plan.flux_mm2) continue;
            scene.ghosts = {ghost.path};
            const auto cpu = render_planned(scene, request), gl = gl_.render(scene, request);
            const Moments a = moments(*cpu), b = moments(*gl);
            const double l1 = relative_l1(*cpu, *gl);
            std::ostringstream o;
            o << name(ghost.path) << " flux " << b.flux / a.flux << " spread " << a.spread_px << " L1 " << l1 << " share of all " << cpu->flux_on_sensor_mm2 / plan.flux_mm2 << " cells " << gl->plan.ghosts[0].cells << " bands " << gl->plan.ghosts[0].bands << " rays cpu " << cpu->rays << " gl " << gl->rays;
            rows.push_back({l1 * cpu->flux_on_sensor_mm2 / plan.flux_mm2, o.str()});
        }
        std::ranges::sort(rows, std::greater{}, &Row::off);
        std::cout << file.stem().string() << "\n";
        for (std::size_t i = 0; i < std::min<std::size_t>(8, rows.size()); ++i) std::cout << "   " << rows[i].off << "  " << rows[i].text << "\n";
    }
}

TEST_F(GlFlareTest, Ghosts) {
    for (const auto& file : lens_files()) {
        FlareRequest request;
        request.light.field_deg = 12.0;
        request.light.azimuth_deg = 60.0;
        request.width_px = 480;
        request.tolerance = 0.02;
        FlareScene scene = flare_scene(read_lens(file).lens, request.spectrum, 16);
        auto plan = render_planned(scene, request)->plan;
        std::ranges::sort(plan.ghosts, std::greater{}, &PlannedGhost::flux_mm2);
        plan.ghosts.resize(std::min<std::size_t>(plan.ghosts.size(), 10));
        for (const PlannedGhost& ghost : plan.ghosts) {
            if (ghost.fate != GhostFate::drawn) continue;
            scene.ghosts = {ghost.path};
            const auto cpu = render_planned(scene, request), gl = gl_.render(scene, request);
            const Moments a = moments(*cpu), b = moments(*gl);
            std::cout << file.stem().string() << " " << name(ghost.path) << " flux " << b.flux / a.flux
                      << " off " << std::hypot(a.column - b.column, a.row - b.row) << " of "
                      << a.spread_px << " px, L1 " << relative_l1(*cpu, *gl) << " level "
                      << gl->plan.ghosts[0].level << " cells " << gl->plan.ghosts[0].cells << " cpu "
                      << cpu->plan.ghosts[0].level << " "
                      << cpu->plan.ghosts[0].cells << "\n";
        }
    }
}

}  // namespace
}  // namespace ghostlight
