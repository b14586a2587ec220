#include "tests/bench/bench_support.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/freed_memory.h"
#include "core/instruction_set.h"
#include "core/io/lens_file.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/bench/fma_peak.h"

namespace ghostlight::bench {
namespace {

/// Benchmarks use memory as the programs do.
[[maybe_unused]] const bool as_programs_do = (keep_freed_memory(), true);

/// Shows that something happens, and keeps what was measured.
class Collector : public benchmark::BenchmarkReporter {
   public:
    Results results;

    bool ReportContext(const Context& context) override {
        std::string load;
        for (const double value : context.cpu_info.load_avg) load += fmt::format(" {:.2f}", value);
        fmt::print("{} cores, load{}, trace on {}\n", context.cpu_info.num_cpus, load,
                   instruction_set_name());
        return true;
    }

    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration || run.iterations == 0) continue;
            const auto iterations = static_cast<double>(run.iterations);
            Measured measured{{"real_s", run.real_accumulated_time / iterations},
                              {"cpu_s", run.cpu_accumulated_time / iterations}};
            for (const auto& [name, counter] : run.counters) measured[name] = counter.value;
            results.add(run.run_name.function_name, measured);
        }
        if (runs.empty()) return;
        const std::string& name = runs.front().run_name.function_name;
        fmt::print("  {:<48}{:>12} ms{:>12} ms of CPU\n", name,
                   number(1e3 * results.median(name, "real_s"), 3),
                   number(1e3 * results.median(name, "cpu_s"), 3));
        std::fflush(stdout);
    }
};

template <class T>
void run_calibration(benchmark::State& state) {
    double operations = 0.0;
    for (auto unused : state) {
        (void)unused;
        benchmark::DoNotOptimize(operations += fma_operations<T>());
    }
    state.counters[fma_rate] = benchmark::Counter(operations, benchmark::Counter::kIsRate);
}

}  // namespace

void Results::add(const std::string& benchmark, const Measured& repetition) {
    runs_[benchmark].push_back(repetition);
}

std::vector<double> Results::sorted(const std::string& benchmark, std::string_view counter) const {
    std::vector<double> values;
    if (const auto runs = runs_.find(benchmark); runs != runs_.end())
        for (const Measured& measured : runs->second)
            if (const auto value = measured.find(counter); value != measured.end())
                values.push_back(value->second);
    std::ranges::sort(values);
    if (values.empty()) values.push_back(std::numeric_limits<double>::quiet_NaN());
    return values;
}

double Results::median(const std::string& benchmark, std::string_view counter) const {
    const std::vector<double> values = sorted(benchmark, counter);
    return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

double Results::smallest(const std::string& benchmark, std::string_view counter) const {
    return sorted(benchmark, counter).front();
}

int run(int argc, char** argv, const Program& program) {
    std::vector<std::string> flags = program.default_flags;
    std::vector<char*> arguments{argv[0]};
    for (std::string& flag : flags) arguments.push_back(flag.data());
    arguments.insert(arguments.end(), argv + 1, argv + argc);
    int count = static_cast<int>(arguments.size());
    arguments.push_back(nullptr);
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 1;
    benchmark::AddCustomContext("instruction_set", instruction_set_name());
    benchmark::AddCustomContext("compiler", GHOSTLIGHT_BENCH_COMPILER);
    benchmark::AddCustomContext("flags", GHOSTLIGHT_BENCH_FLAGS);
    benchmark::RegisterBenchmark(fma_f32, run_calibration<float>);
    benchmark::RegisterBenchmark(fma_f64, run_calibration<double>);
    program.declare();
    Collector collector;
    benchmark::RunSpecifiedBenchmarks(&collector);
    fmt::print("\nmultiply-add peak of one core: {} GFLOP/s float, {} GFLOP/s double\n\n",
               number(1e-9 * collector.results.median(fma_f32, fma_rate), 1),
               number(1e-9 * collector.results.median(fma_f64, fma_rate), 1));
    program.summary(collector.results);
    fmt::print("\n");
    benchmark::Shutdown();
    return 0;
}

Prescription lens_named(std::string_view file, std::string_view configuration) {
    const Prescription lens = read_lens(data_directory() / file).lens;
    return configuration.empty() ? lens : configured(lens, configuration);
}

double middle_field_deg(const Prescription& lens) {
    const OpticalSystem system = compile(lens, 587.5618);
    const double corner_mm = 0.5 * std::hypot(system.sensor_width_mm, system.sensor_height_mm);
    return 0.5 * deg_from_rad(std::atan(corner_mm / std::abs(first_order(system).efl_mm)));
}

std::string number(double value, int digits) {
    return std::isnan(value) ? "-" : fmt::format("{:.{}f}", value, digits);
}

}  // namespace ghostlight::bench
