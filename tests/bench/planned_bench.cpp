// The planned flare: time of a dragged frame, and error against time beside uniform grids.
//
//   planned_bench [LENS]...   times of a dragged light, of every bundled lens or of those whose
//   file
//                             names contain one of these
//   planned_bench --error     also the error against the reference, at one wavelength; takes
//   minutes
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "core/flare/planned_flare.h"
#include "core/instruction_set.h"
#include "core/io/lens_file.h"
#include "core/parallel.h"
#include "tests/bench/bench_support.h"

namespace ghostlight::bench {
namespace {

constexpr int frames = 40;
constexpr double step_deg = 0.1;

Prescription widescreen(Prescription lens) {
    lens.sensor.height_mm = lens.sensor.width_mm * 720.0 / 1280.0;
    return lens;
}

double percentile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

double relative_l1(const FlareImage& image, const FlareImage& truth) {
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < truth.irradiance.size(); ++i) {
        difference += std::abs(static_cast<double>(image.irradiance[i] - truth.irradiance[i]));
        sum += static_cast<double>(truth.irradiance[i]);
    }
    return difference / sum;
}

void print_drag(const std::string& name, const Prescription& lens) {
    const double start_deg = middle_field_deg(lens);
    for (const Spectrum& spectrum :
         {Spectrum{Monochromatic{}}, Spectrum{StandardLight{Illuminant::d65}}}) {
        const FlareScene scene = flare_scene(lens, spectrum);
        FlareRequest request;
        request.tolerance = 0.04;
        request.search = ProbeSearch::quick;
        std::vector<double> total, processor, parts[4];
        double error = 0.0;
        for (int k = -3; k < frames; ++k) {
            request.light.field_deg = start_deg + k * step_deg;
            const std::clock_t began = std::clock();
            const FlareImage image = render_planned(scene, request).value();
            const std::clock_t ended = std::clock();
            // As the window does: each picture's search begins with what the last one found.
            request.nearby = std::make_shared<const FlarePlan>(image.plan);
            ++request.turn;
            if (k < 0) continue;  // warm-up
            processor.push_back(1e3 * static_cast<double>(ended - began) / CLOCKS_PER_SEC);
            total.push_back(image.times.total_ms);
            parts[0].push_back(image.times.bounds_ms);
            parts[1].push_back(image.times.trace_ms);
            parts[2].push_back(image.times.raster_ms);
            parts[3].push_back(image.times.composite_ms);
            error = std::max(error, image.plan.estimated_error());
        }
        fmt::print(
            "{:<28}{:<10}{:>7}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.2f}\n",
            name, ghostlight::name(spectrum).substr(0, 8), scene.ghosts.size(),
            percentile(total, 0.5), percentile(total, 0.95), percentile(parts[0], 0.5),
            percentile(parts[1], 0.5), percentile(parts[2], 0.5), percentile(parts[3], 0.5),
            percentile(processor, 0.5), 100.0 * error);
    }
}

void print_error(const std::string& name, const Prescription& lens) {
    FlareRequest request;
    request.light.field_deg = middle_field_deg(lens);
    FlareRequest dense = request;
    dense.method = FlareMethod::reference;
    dense.tolerance = 0.002;
    const FlareImage truth = render_flare(lens, dense).value();
    const FlareScene scene = flare_scene(lens, request.spectrum);
    auto best = [](auto&& render) {
        FlareImage kept = render();
        for (int k = 0; k < 2; ++k) {
            FlareImage image = render();
            if (image.times.total_ms < kept.times.total_ms) kept = std::move(image);
        }
        return kept;
    };
    auto print = [&](const std::string& method, const FlareImage& image) {
        fmt::print("{:<28}{:<16}{:>9.1f}{:>10.2f}{:>10.2f}\n", name, method, image.times.total_ms,
                   100.0 * relative_l1(image, truth),
                   100.0 * (image.flux_on_sensor_mm2 / truth.flux_on_sensor_mm2 - 1.0));
    };
    for (const double tolerance : {0.1, 0.04, 0.02, 0.01, 0.003}) {
        request.tolerance = tolerance;
        print(fmt::format("planned {} %", 100.0 * tolerance),
              best([&] { return render_planned(scene, request).value(); }));
    }
    for (const int grid : {8, 16, 32, 64}) {
        FlareRequest uniform = request;
        uniform.method = FlareMethod::uniform;
        uniform.grid = grid;
        print(fmt::format("uniform {}", grid),
              best([&] { return render_flare(lens, uniform).value(); }));
    }
}

}  // namespace
}  // namespace ghostlight::bench

int main(int argc, char** argv) {
    using namespace ghostlight;
    bool with_error = false;
    std::vector<std::string> wanted;
    for (const std::string& argument : std::vector<std::string>(argv + 1, argv + argc))
        if (argument == "--error")
            with_error = true;
        else
            wanted.push_back(argument);
    auto for_each_lens = [&](auto&& visit) {
        for (const BundledLens& each : bundled_lenses()) {
            const std::string name = each.file.stem().string();
            if (wanted.empty() || std::ranges::any_of(wanted, [&](const std::string& part) {
                    return name.find(part) != name.npos;
                }))
                visit(name, bench::widescreen(read_lens(each.file).lens));
        }
    };
    fmt::print("1280 x 720, {} threads, {}\n", default_thread_count(), instruction_set_name());
    fmt::print(
        "A light dragged by {} degrees a frame, tolerance 4 %; ms, medians but for p95; processor: "
        "of all threads; estimated error, %\n",
        bench::step_deg);
    fmt::print("{:<28}{:<10}{:>7}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>10}{:>8}\n", "lens", "light",
               "ghosts", "p50", "p95", "bounds", "trace", "raster", "compose", "processor",
               "error");
    for_each_lens(bench::print_drag);
    if (!with_error) return 0;
    fmt::print("\nOne wavelength: ms (least of 3), relative L1 %, energy %\n");
    for_each_lens(bench::print_error);
    return 0;
}
