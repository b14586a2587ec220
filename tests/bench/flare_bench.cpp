// A frame of the flare view by its parts, for every bundled lens.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/flare/flare_image.h"
#include "core/io/lens_file.h"
#include "render/flare_renderer.h"
#include "render/offscreen.h"
#include "tests/bench/bench_support.h"

namespace ghostlight::bench {
namespace {

constexpr int width_px = 1280, height_px = 720;
constexpr unsigned thread_counts[] = {1, 2};

/// The part of the sensor that a 16:9 window shows.
Prescription widescreen(Prescription lens) {
    lens.sensor.height_mm = lens.sensor.width_mm * height_px / width_px;
    return lens;
}

std::string benchmark_name(const std::string& lens, unsigned threads) {
    return fmt::format("{}/{} threads", lens, threads);
}

/// A screen without a window; nothing where the system cannot give one.
struct Screen {
    OffscreenContext context;
    OffscreenTarget target{width_px, height_px};
    FlareRenderer renderer;
    PictureUpload upload;
};
std::optional<Screen>& screen() {
    static std::optional<Screen> only;
    return only;
}

double ms_since(std::chrono::steady_clock::time_point began) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began)
        .count();
}

/// Tone-mapping and drawing, until the last pixel is there.
double draw_ms(Screen& on, const FlareImage& image) {
    const auto began = std::chrono::steady_clock::now();
    on.target.bind();
    on.renderer.draw(on.upload.texture(),
                     framed(width_px, height_px, image.sensor_width_mm, image.sensor_height_mm), {},
                     width_px, height_px);
    glFinish();
    return ms_since(began);
}

enum Part { bounds, trace, raster, upload, draw, total, parts };
constexpr const char* part_names[] = {"bounds_ms", "trace_ms", "raster_ms",
                                      "upload_ms", "draw_ms",  "total_ms"};

double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

void run_frame(benchmark::State& state, const Prescription& lens, unsigned threads) {
    FlareRequest request;
    request.light.field_deg = middle_field_deg(lens);
    request.width_px = width_px;
    request.threads = threads;
    std::array<std::vector<double>, parts> times;
    FlareImage image;
    auto frame = [&](bool timed) {
        image = std::move(*render_flare(lens, request));
        std::array<double, parts> ms{};
        ms[bounds] = image.times.bounds_ms;
        ms[trace] = image.times.trace_ms;
        ms[raster] = image.times.raster_ms;
        if (screen()) {
            ms[upload] = screen()->upload.upload(image);
            ms[draw] = draw_ms(*screen(), image);
        }
        ms[total] = image.times.total_ms + ms[upload] + ms[draw];
        for (std::size_t part = 0; timed && part < parts; ++part) times[part].push_back(ms[part]);
    };
    frame(false);  // caches, the texture's memory, and the shader on its first use
    for (auto unused : state) {
        (void)unused;
        frame(true);
    }
    for (std::size_t part = 0; part < parts; ++part)
        if (screen() || (part != upload && part != draw))
            state.counters[part_names[part]] = median(times[part]);
    state.counters["rays"] = static_cast<double>(image.rays);
    state.counters["cells"] = static_cast<double>(image.cells);
    state.counters["ghosts"] = static_cast<double>(image.ghosts);
}

void declare() {
    try {
        screen().emplace();
    } catch (const Error& error) {
        fmt::print("no upload and drawing: {}\n", error.what());
    }
    for (const BundledLens& bundled : bundled_lenses()) {
        const auto lens = std::make_shared<Prescription>(widescreen(read_lens(bundled.file).lens));
        for (const unsigned threads : thread_counts)
            benchmark::RegisterBenchmark(
                benchmark_name(bundled.file.stem().string(), threads).c_str(),
                [=](benchmark::State& state) { run_frame(state, *lens, threads); })
                ->UseRealTime()
                ->MeasureProcessCPUTime()
                ->Unit(benchmark::kMillisecond);
    }
}

void print_summary(const Results& results) {
    const double peak = results.median(fma_f32, fma_rate);
    fmt::print("A frame of {} x {} by its parts, ms\n", width_px, height_px);
    constexpr const char* row =
        "{:<34}{:>7}{:>9}{:>8}{:>8}{:>8}{:>8}{:>8}{:>7}{:>10}{:>11}{:>7}{:>8}\n";
    fmt::print(row, "lens", "ghosts", "rays", "cells", "bounds", "trace", "raster", "upload",
               "draw", "1 thread", "2 threads", "CPU", "Gflop");
    for (const BundledLens& bundled : bundled_lenses()) {
        const std::string lens = bundled.file.stem().string();
        const std::string one = benchmark_name(lens, 1), two = benchmark_name(lens, 2);
        auto of = [&](const char* counter, int digits) {
            return number(results.smallest(one, counter), digits);
        };
        const double whole_ms = results.smallest(one, part_names[total]);
        fmt::print(row, lens, of("ghosts", 0), of("rays", 0), of("cells", 0),
                   of(part_names[bounds], 1), of(part_names[trace], 1), of(part_names[raster], 1),
                   of(part_names[upload], 1), of(part_names[draw], 1), number(whole_ms, 1),
                   number(results.smallest(two, part_names[total]), 1),
                   number(1e3 * results.smallest(one, "cpu_s"), 1),
                   number(1e-12 * peak * whole_ms, 1));
    }
    fmt::print(
        "the least of the repetitions, each the median of its frames; parts on one thread;\n"
        "CPU: of all threads, drawing included; Gflop: what one core's float peak does "
        "meanwhile\n");
}

}  // namespace
}  // namespace ghostlight::bench

int main(int argc, char** argv) {
    return ghostlight::bench::run(argc, argv,
                                  {{"--benchmark_repetitions=5", "--benchmark_min_time=0.3"},
                                   ghostlight::bench::declare,
                                   [](const ghostlight::bench::Results& results) {
                                       ghostlight::bench::print_summary(results);
                                       // The screen goes while its context is still there.
                                       ghostlight::bench::screen().reset();
                                   }});
}
