// The ghost table as lenses grow: its cost per row for made lenses of 10, 20, 40 and 80 surfaces,
// and a zoom of 20 elements at 1 %.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <memory>
#include <string>

#include "core/ghosts/ghost_table.h"
#include "tests/bench/bench_support.h"
#include "tests/bench/made_lenses.h"

namespace ghostlight::bench {
namespace {

constexpr int surface_counts[] = {10, 20, 40, 80};
constexpr double tolerance = 0.01;
constexpr unsigned threads = 1;
constexpr auto zoom_name = "zoom of 20 elements";

std::string benchmark_name(int surfaces) { return fmt::format("train/{} surfaces", surfaces); }

void run_table(benchmark::State& state, const Prescription& lens, double field) {
    GhostTableRequest request;
    request.light.field_deg = field;
    request.tolerance = tolerance;
    request.peaks = false;
    request.threads = threads;
    double ghosts = 0.0, rays = 0.0;
    for (auto unused : state) {
        (void)unused;
        const auto table = ghost_table(lens, request);
        ghosts = static_cast<double>(table->ghosts.size());
        rays = static_cast<double>(table->rays);
    }
    state.counters["ghosts"] = ghosts;
    state.counters["rays"] = rays;
}

void declare_one(const std::string& name, Prescription lens, double field) {
    const auto shared = std::make_shared<Prescription>(std::move(lens));
    benchmark::RegisterBenchmark(
        name.c_str(),
        [shared, field](benchmark::State& state) { run_table(state, *shared, field); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}

void declare() {
    for (const int surfaces : surface_counts)
        declare_one(benchmark_name(surfaces), train(surfaces), train_field_deg);
    const Prescription zoom = lens_named("canon_zoom_70_200_f2.8.json", "tele");
    declare_one(zoom_name, zoom, middle_field_deg(zoom));
}

void print_row(const Results& results, const std::string& name, const std::string& title) {
    const double ghosts = results.median(name, "ghosts");
    const double seconds = results.smallest(name, "real_s");
    fmt::print("{:<24}{:>10}{:>14}{:>16}{:>14}\n", title, number(ghosts, 0),
               number(1e3 * seconds, 1), number(1e3 * seconds / ghosts, 3),
               number(results.median(name, "rays") / ghosts, 0));
}

void summary(const Results& results) {
    fmt::print("\nTable of all two-reflection ghosts at {:g} %, one wavelength, one thread\n",
               100.0 * tolerance);
    fmt::print("{:<24}{:>10}{:>14}{:>16}{:>14}\n", "lens", "ghosts", "table, ms", "a ghost, ms",
               "rays a ghost");
    for (const int surfaces : surface_counts)
        print_row(results, benchmark_name(surfaces), fmt::format("{} surfaces", surfaces));
    print_row(results, zoom_name, zoom_name);
}

}  // namespace
}  // namespace ghostlight::bench

int main(int argc, char** argv) {
    return ghostlight::bench::run(argc, argv,
                                  {{"--benchmark_repetitions=3", "--benchmark_min_time=0.05"},
                                   ghostlight::bench::declare,
                                   ghostlight::bench::summary});
}
