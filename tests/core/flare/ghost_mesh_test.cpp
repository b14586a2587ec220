#include "core/flare/ghost_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

std::vector<double> drawn(const GhostMesh& mesh, const PixelFrame& frame) {
    BandRaster raster(frame.width_px, 0, frame.height_px);
    for (const RasterEdge& edge : mesh.edges) raster.add(edge);
    for (const RasterPoint& point : mesh.points) raster.add_point(point.x, point.y, point.flux);
    std::vector<double> pixels(static_cast<std::size_t>(frame.width_px * frame.height_px));
    raster.resolve(pixels);
    return pixels;
}

double flux_of(const std::vector<double>& pixels, const PixelFrame& frame) {
    double sum = 0.0;
    for (const double p : pixels) sum += p;
    return sum * frame.pixel_area_mm2();
}

template <class T>
GhostMesh mesh_of(const OpticalSystem& system, const GhostPath& ghost, const LightDirection& light,
                  const PixelFrame& frame, int cells) {
    const TracePath<double> path = trace_path<double>(system, ghost);
    const BeamFrame beam = beam_frame(light);
    const Pupil pupil = find_pupil(system, path, beam);
    if (pupil.empty()) return {};
    return ghost_mesh(trace_grid(system, trace_path<T>(system, ghost), beam, pupil.box, cells, 4,
                                 Weights::polarised),
                      frame, 1.0);
}

TEST(PixelFrame, IsCentredOnTheAxis) {
    const PixelFrame frame = pixel_frame(36.0, 24.0, 1280);
    EXPECT_EQ(frame.width_px, 1280);
    EXPECT_EQ(frame.height_px, 853);
    EXPECT_DOUBLE_EQ(frame.column(0.0), 640.0);
    EXPECT_DOUBLE_EQ(frame.row(0.0), 426.5);
    EXPECT_DOUBLE_EQ(frame.column(-18.0), 0.0);
    EXPECT_EQ(pixel_frame(36.0, 1e-3, 10).height_px, 1);
}

TEST(GhostMesh, UniformBeamHasItsIrradianceEverywhere) {
    // A hole of 3 mm: E = E0 inside, none outside.
    constexpr double tolerance = 1e-9;
    const OpticalSystem system = compile(lens_of({row(0.0, 5.0, 1.0, 3.0)}), d_line_nm);
    const PixelFrame frame = pixel_frame(10.0, 10.0, 100);
    const auto pixels = drawn(mesh_of<double>(system, {}, {}, frame, 64), frame);
    for (int j = 0; j < 100; ++j)
        for (int i = 0; i < 100; ++i) {
            const double r = std::hypot(0.1 * (i + 0.5) - 5.0, 0.1 * (j + 0.5) - 5.0);
            const double e = pixels[static_cast<std::size_t>(100 * j + i)];
            if (r > 2.85 && r < 3.15) continue;
            EXPECT_NEAR(e, r < 3.0 ? 1.0 : 0.0, tolerance);
        }
    EXPECT_NEAR(flux_of(pixels, frame), std::numbers::pi * 9.0, 0.01 * std::numbers::pi * 9.0);
}

TEST(GhostMesh, PixelsHoldTheFluxOfTheMesh) {
    // All of it lands on a huge sensor: at focus, at a caustic, spread wide.
    constexpr double tolerance = 1e-9;  // relative: cancelling edges over 1e6 px²
    for (const char* file : {"tessar_brendel_100_f2.8", "fisheye_nikkor_10.5_f2.8"}) {
        const OpticalSystem system = compile(bundled(file), d_line_nm);
        std::vector<GhostPath> paths = two_reflection_ghosts(system);
        paths.resize(15);
        paths.emplace_back();
        const PixelFrame frame = pixel_frame(2000.0, 2000.0, 500);
        for (const GhostPath& path : paths) {
            const GhostMesh mesh = mesh_of<double>(system, path, {12.0, 70.0}, frame, 24);
            const auto pixels = drawn(mesh, frame);
            double lost = 0.0;  // beyond even this sensor
            for (const RasterEdge& e : mesh.edges)
                lost = std::max({lost, std::abs(e.x0 - 250.0), std::abs(e.y0 - 250.0)});
            if (lost > 249.0) continue;
            EXPECT_NEAR(flux_of(pixels, frame), mesh.flux_mm2, tolerance * mesh.flux_mm2)
                << name(path);
            const double least = *std::ranges::min_element(pixels);
            EXPECT_GT(least, -1e-9 * *std::ranges::max_element(pixels)) << name(path);
        }
    }
}

TEST(GhostMesh, FocusedGhostKeepsItsFlux) {
    // The sensor moved to a ghost's own focus: a caustic of a few pixels.
    constexpr double tolerance = 1e-6;
    OpticalSystem system = compile(bundled("tessar_brendel_100_f2.8"), d_line_nm);
    int focused = 0;
    for (const GhostPath& path : two_reflection_ghosts(system)) {
        OpticalSystem moved = system;
        moved.sensor_z_mm += paraxial_ghost(system, path).focus_from_sensor_mm;
        if (moved.sensor_z_mm < moved.surfaces.back().vertex_z_mm + 1.0 ||
            moved.sensor_z_mm > 2000.0)
            continue;
        const PixelFrame frame = pixel_frame(400.0, 400.0, 1000);
        const GhostMesh mesh = mesh_of<double>(moved, path, {1.0, 90.0}, frame, 32);
        if (mesh.flux_mm2 == 0.0) continue;
        const auto pixels = drawn(mesh, frame);
        for (const double p : pixels) ASSERT_TRUE(std::isfinite(p));
        EXPECT_LE(flux_of(pixels, frame), mesh.flux_mm2 * (1.0 + tolerance)) << name(path);
        EXPECT_GE(flux_of(pixels, frame), 0.5 * mesh.flux_mm2) << name(path);
        ++focused;
    }
    EXPECT_GE(focused, 3);
}

TEST(GhostMesh, FloatAndDoubleDrawTheSame) {
    constexpr double tolerance = 1e-3;  // of the flux
    const OpticalSystem system = compile(bundled("double_gauss_tronnier_100_f2"), d_line_nm);
    const PixelFrame frame = pixel_frame(36.0, 24.0, 320);
    const auto ghosts = two_reflection_ghosts(system);
    for (std::size_t i = 0; i < ghosts.size(); i += 5) {
        const GhostMesh a = mesh_of<float>(system, ghosts[i], {8.0, 90.0}, frame, 32);
        const GhostMesh b = mesh_of<double>(system, ghosts[i], {8.0, 90.0}, frame, 32);
        EXPECT_NEAR(a.flux_mm2, b.flux_mm2, tolerance * b.flux_mm2) << name(ghosts[i]);
        const auto p = drawn(a, frame), q = drawn(b, frame);
        double difference = 0.0, sum = 0.0;
        for (std::size_t k = 0; k < p.size(); ++k) {
            difference += std::abs(p[k] - q[k]);
            sum += q[k];
        }
        EXPECT_LE(difference, 10.0 * tolerance * sum + 1e-12) << name(ghosts[i]);
    }
}

TEST(GhostMesh, IrradianceAgreesWithRandomRaysOfASeparateProgram) {
    // 4 standard errors of the map, and 2 %: what its source states.
    const std::string folder = (test_data_folder() / "expected/").string();
    std::ifstream file(folder + "irradiance_tessar_5_3.json");
    const auto expected = nlohmann::json::parse(file);
    const Prescription lens =
        with_air_coating(read_lens(folder + "tessar_brendel_100_f2.8.json").lens,
                         QuarterWave{550.0, medium(1.38), 1.0});
    const OpticalSystem system = compile(lens, d_line_nm);
    const auto extent = expected["extent_mm"].get<std::vector<double>>();
    // 16 pixels across a bin, averaged.
    constexpr int bins = 24, fine = 16;
    const double width = extent[1] - extent[0], height = extent[3] - extent[2];
    PixelFrame frame;
    frame.width_px = bins * fine;
    frame.pitch_mm = width / (bins * fine);
    frame.left_mm = extent[0];
    frame.bottom_mm = extent[2];
    // Square pixels: as many rows as the map is high.
    frame.height_px = static_cast<int>(std::ceil(height / frame.pitch_mm));
    // The map averages s and p at each surface.
    const GhostPath ghost = parse_ghost("5-3", system);
    const BeamFrame beam = beam_frame({15.0, 90.0});
    const Pupil pupil = find_pupil(system, trace_path<double>(system, ghost), beam);
    const GhostMesh mesh = ghost_mesh(trace_grid(system, trace_path<double>(system, ghost), beam,
                                                 pupil.box, 128, 4, Weights::average),
                                      frame, 1.0);
    const auto pixels = drawn(mesh, frame);
    const double rows_per_bin = height / bins / frame.pitch_mm;
    int compared = 0;
    double flux = 0.0;
    for (int j = 0; j < bins; ++j)
        for (int i = 0; i < bins; ++i) {
            // Area-weighted mean over the bin's fractional rows.
            double sum = 0.0;
            const double low = j * rows_per_bin, high = low + rows_per_bin;
            for (int y = static_cast<int>(low); y < std::min<double>(frame.height_px, high); ++y) {
                const double share = std::min<double>(high, y + 1) - std::max<double>(low, y);
                for (int x = i * fine; x < (i + 1) * fine; ++x)
                    sum += share * pixels[static_cast<std::size_t>(y * frame.width_px + x)];
            }
            const double found = sum / (rows_per_bin * fine);
            const auto row_of = static_cast<std::size_t>(j),
                       column_of = static_cast<std::size_t>(i);
            const double value = expected["irradiance"][row_of][column_of].get<double>();
            const double error = expected["stderr"][row_of][column_of].get<double>();
            flux += value;
            if (value == 0.0 && found == 0.0) continue;
            // Bins that the edge crosses with a few rays in them: a ray's worth.
            const double one_ray = 1e-8;
            EXPECT_NEAR(found, value, 4.0 * error + 0.02 * value + one_ray) << i << ", " << j;
            ++compared;
        }
    EXPECT_GE(compared, 300);
    EXPECT_NEAR(mesh.flux_mm2, flux * width * height / (bins * bins), 0.02 * mesh.flux_mm2);
}

}  // namespace
}  // namespace ghostlight
