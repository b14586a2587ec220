// The ghost table: time, and the rays it takes.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>

#include "core/ghosts/ghost_table.h"
#include "tests/bench/bench_support.h"

namespace ghostlight::bench {
namespace {

struct Case {
    const char *name, *file;
    bool daylight, peaks;
};
constexpr Case cases[] = {
    {"zoom, 588 nm", "canon_zoom_70_200_f2.8.json", false, true},
    {"zoom, 588 nm, no peaks", "canon_zoom_70_200_f2.8.json", false, false},
    {"Tessar, 588 nm", "tessar_brendel_100_f2.8.json", false, true},
    {"Tessar, D65", "tessar_brendel_100_f2.8.json", true, true},
};
constexpr std::size_t unit_case = 2;
constexpr unsigned thread_counts[] = {1, 2};
constexpr double tolerance = 0.01;

std::string benchmark_name(const Case& of, unsigned threads) {
    return fmt::format("{}/{} threads", of.name, threads);
}

void run_table(benchmark::State& state, const Prescription& lens, const Case& of,
               unsigned threads) {
    GhostTableRequest request;
    request.light.field_deg = middle_field_deg(lens);
    if (of.daylight) request.spectrum = StandardLight{Illuminant::d65};
    request.tolerance = tolerance;
    request.peaks = of.peaks;
    request.threads = threads;
    std::size_t rays = 0, ghosts = 0, loose = 0;
    for (auto unused : state) {
        (void)unused;
        const auto table = ghost_table(lens, request);
        rays = table->rays;
        ghosts = table->ghosts.size();
        loose = static_cast<std::size_t>(std::ranges::count_if(
            table->ghosts, [](const GhostRow& row) { return !row.converged; }));
    }
    state.counters["rays"] = static_cast<double>(rays);
    state.counters["ghosts"] = static_cast<double>(ghosts);
    state.counters["unconverged"] = static_cast<double>(loose);
}

void declare() {
    for (const Case& of : cases) {
        const auto lens = std::make_shared<Prescription>(lens_named(of.file));
        for (const unsigned threads : thread_counts)
            benchmark::RegisterBenchmark(
                benchmark_name(of, threads).c_str(),
                [=](benchmark::State& state) { run_table(state, *lens, of, threads); })
                ->UseRealTime()
                ->MeasureProcessCPUTime()
                ->Unit(benchmark::kMillisecond);
    }
}

void print_summary(const Results& results) {
    const double peak = results.median(fma_f32, fma_rate);
    fmt::print("Ghost tables at {:g} %, the least of the repetitions\n", 100.0 * tolerance);
    constexpr const char* row = "{:<24}{:>8}{:>8}{:>9}{:>10}{:>9}{:>9}{:>8}{:>10}{:>12}\n";
    fmt::print(row, "table", "threads", "ghosts", "not met", "rays", "ms", "CPU ms", "CPU",
               "rays/ms", "peak Gflop");
    const double one = results.smallest(benchmark_name(cases[unit_case], 1), "cpu_s");
    for (const Case& of : cases)
        for (const unsigned threads : thread_counts) {
            const std::string name = benchmark_name(of, threads);
            const double cpu_s = results.smallest(name, "cpu_s");
            const double rays = results.smallest(name, "rays");
            fmt::print(row, of.name, threads, number(results.smallest(name, "ghosts"), 0),
                       number(results.smallest(name, "unconverged"), 0), number(rays, 0),
                       number(1e3 * results.smallest(name, "real_s"), 0), number(1e3 * cpu_s, 0),
                       number(cpu_s / one, 2), number(1e-3 * rays / cpu_s, 0),
                       number(1e-9 * peak * cpu_s, 1));
        }
    fmt::print(
        "CPU: of all threads, the Tessar at one wavelength = 1; peak Gflop: what one core's float\n"
        "peak does in that time\n");
}

}  // namespace
}  // namespace ghostlight::bench

int main(int argc, char** argv) {
    return ghostlight::bench::run(argc, argv,
                                  {{"--benchmark_repetitions=3", "--benchmark_min_time=0.2"},
                                   ghostlight::bench::declare,
                                   ghostlight::bench::print_summary});
}
