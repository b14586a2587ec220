// Ray-surface interactions per second on one core: SIMD lanes against one ray at a time.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/ghosts/bundle.h"
#include "core/ghosts/pupil.h"
#include "core/instruction_set.h"
#include "core/optics/optical_system.h"
#include "tests/bench/bench_support.h"
#include "tests/bench/scalar_trace.h"
#include "tests/bench/supplement_trace.h"

namespace ghostlight::bench {
namespace {

constexpr int grid_cells = 63;  ///< 4096 rays: all arrays of a bundle fit into the second cache
constexpr const char* rate = "rs/s";

struct LensCase {
    const char *name, *file, *configuration, *ghost;
};
constexpr LensCase lens_cases[] = {
    {"zoom", "nikon_zoom_80_200_f2.8.json", "long", "20-4"},
    {"tessar", "tessar_brendel_100_f2.8.json", "", "7-2"},
};

struct WeightCase {
    const char* name;
    Weights weights;
    bool coated;
};
constexpr WeightCase weight_cases[] = {
    {"geometry", Weights::none, false},
    {"bare, average", Weights::average, false},
    {"bare, polarised", Weights::polarised, false},
    {"coated, average", Weights::average, true},
    {"coated, polarised", Weights::polarised, true},
};

constexpr const char* scalar = "scalar double";
constexpr const char* scalar_fused = "scalar double, AVX2 flags";
constexpr const char* supplement = "supplement 2011";
constexpr const char* simd_double = "SIMD double";
constexpr const char* simd_float = "SIMD float";

std::string benchmark_name(const LensCase& lens, const WeightCase& weight, const char* variant) {
    return fmt::format("{}/{}/{}", lens.name, weight.name, variant);
}

/// A lens unfolded along a ghost's path, and the box of its pupil.
struct Scene {
    OpticalSystem system;
    GhostPath ghost;
    BeamFrame frame;
    PupilBox box;
};

Scene scene_of(const LensCase& lens_case, bool coated) {
    Prescription lens = lens_named(lens_case.file, lens_case.configuration);
    if (!coated) lens = with_air_coating(lens, Uncoated{});
    Scene scene{compile(lens, 587.5618), {}, {}, {}};
    scene.ghost = parse_ghost(lens_case.ghost, scene.system);
    scene.frame = beam_frame({.field_deg = middle_field_deg(lens)});
    const Pupil pupil = find_pupil(scene.system, trace_path<double>(scene.system, scene.ghost),
                                   scene.frame, PupilSearch::thorough);
    if (pupil.empty())
        throw std::runtime_error(fmt::format("{}: ghost {} is dark", lens.name, lens_case.ghost));
    scene.box = pupil.box;
    return scene;
}

template <class T>
struct Work {
    TracePath<T> path;
    Bundle<T> bundle;
    explicit Work(const Scene& scene) : path(trace_path<T>(scene.system, scene.ghost)) {
        lay_grid(scene.box, grid_cells, bundle);
    }
    double interactions() const {
        return static_cast<double>(bundle.size()) * static_cast<double>(path.steps.size());
    }
};

void report(benchmark::State& state, double interactions) {
    state.counters[rate] = benchmark::Counter(
        interactions * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

template <class T>
void run_lanes(benchmark::State& state, const Scene& scene, Weights weights) {
    Work<T> work(scene);
    for (auto unused : state) {
        (void)unused;
        trace_bundle(work.path, scene.frame, weights, work.bundle);
        benchmark::ClobberMemory();
    }
    report(state, work.interactions());
}

using TraceRays = void (*)(const TracePath<double>&, const BeamFrame&, Weights, Bundle<double>&);

/// Largest difference between what two traces say of rays that pass; infinite if they do not
/// agree on which rays do.
double difference(const Bundle<double>& a, const Bundle<double>& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const bool passes = a.margin[i] > 1e-6 && a.r_rel[i] < 1.0;
        if (!passes) continue;
        if (!(b.margin[i] > 0.0)) return std::numeric_limits<double>::infinity();
        most = std::max({most, std::abs(a.x_mm[i] - b.x_mm[i]), std::abs(a.y_mm[i] - b.y_mm[i]),
                         std::abs(a.weight[i] - b.weight[i])});
    }
    return most;
}

void run_scalar(benchmark::State& state, const Scene& scene, Weights weights, TraceRays trace) {
    constexpr double rounding_mm = 1e-8;
    Work<double> work(scene);
    trace_bundle(work.path, scene.frame, weights, work.bundle);
    const Bundle<double> lanes = work.bundle;
    trace(work.path, scene.frame, weights, work.bundle);
    if (!(difference(lanes, work.bundle) < rounding_mm)) {
        state.SkipWithError("the scalar and the SIMD trace differ");
        return;
    }
    for (auto unused : state) {
        (void)unused;
        trace(work.path, scene.frame, weights, work.bundle);
        benchmark::ClobberMemory();
    }
    report(state, work.interactions());
}

void run_supplement(benchmark::State& state, const Scene& scene) {
    constexpr double rounding_mm = 1e-6;
    Work<double> work(scene);
    trace_bundle(work.path, scene.frame, Weights::none, work.bundle);
    const Bundle<double> ours = work.bundle;
    const SupplementPath path = supplement_path(scene.system, scene.ghost);
    trace_supplement(path, scene.frame, work.bundle);
    for (std::size_t i = 0; i < ours.size(); ++i)
        if (ours.margin[i] > 1e-6 && ours.r_rel[i] < 1.0 &&
            !(std::hypot(ours.x_mm[i] - work.bundle.x_mm[i], ours.y_mm[i] - work.bundle.y_mm[i]) <
              rounding_mm)) {
            state.SkipWithError("the supplement's rays land elsewhere");
            return;
        }
    for (auto unused : state) {
        (void)unused;
        trace_supplement(path, scene.frame, work.bundle);
        benchmark::ClobberMemory();
    }
    report(state, work.interactions());
}

void declare() {
    for (const LensCase& lens : lens_cases)
        for (const WeightCase& weight : weight_cases) {
            const auto scene = std::make_shared<Scene>(scene_of(lens, weight.coated));
            const Weights weights = weight.weights;
            auto add = [&](const char* variant, auto work) {
                benchmark::RegisterBenchmark(benchmark_name(lens, weight, variant).c_str(), work);
            };
            add(scalar, [=](benchmark::State& state) {
                run_scalar(state, *scene, weights, scalar_portable::trace_rays);
            });
#ifdef GHOSTLIGHT_HAVE_X86_ISA
            if (instruction_set() == InstructionSet::v3)
                add(scalar_fused, [=](benchmark::State& state) {
                    run_scalar(state, *scene, weights, scalar_v3::trace_rays);
                });
#endif
            if (weights == Weights::average && weight.coated)
                add(supplement, [=](benchmark::State& state) { run_supplement(state, *scene); });
            add(simd_double,
                [=](benchmark::State& state) { run_lanes<double>(state, *scene, weights); });
            add(simd_float,
                [=](benchmark::State& state) { run_lanes<float>(state, *scene, weights); });
        }
}

void print_summary(const Results& results) {
    const double peak = results.median(fma_f32, fma_rate);
    fmt::print("Interactions per second of one core; scalar double of the same row = 1\n");
    fmt::print("{:<8}{:<19}{:>10}{:>10}{:>12}{:>12}{:>12}{:>16}\n", "lens", "weights", "scalar M/s",
               "scalar", "scalar AVX2", "SIMD double", "SIMD float", "float, flop/rs");
    for (const LensCase& lens : lens_cases)
        for (const WeightCase& weight : weight_cases) {
            auto of = [&](const char* variant) {
                return results.median(benchmark_name(lens, weight, variant), rate);
            };
            const double one = of(scalar);
            fmt::print("{:<8}{:<19}{:>10}{:>10}{:>12}{:>12}{:>12}{:>16}\n", lens.name, weight.name,
                       number(1e-6 * one, 1), number(one / one, 2),
                       number(of(scalar_fused) / one, 2), number(of(simd_double) / one, 2),
                       number(of(simd_float) / one, 2), number(peak / of(simd_float), 0));
        }
    fmt::print(
        "\nAgainst the algorithm of the 2011 supplement, scalar double, coatings at its two "
        "reflections = 1\n");
    for (const LensCase& lens : lens_cases) {
        const double one = results.median(benchmark_name(lens, weight_cases[3], supplement), rate);
        fmt::print("{:<8}{:>8} M/s", lens.name, number(1e-6 * one, 1));
        for (const WeightCase& weight : weight_cases)
            fmt::print(
                "   {} {}", weight.name,
                number(results.median(benchmark_name(lens, weight, simd_float), rate) / one, 1));
        const double geometry =
            results.median(benchmark_name(lens, weight_cases[0], simd_float), rate);
        fmt::print("   geometry, of the peak at 50 flop {}\n", number(50.0 * geometry / peak, 2));
    }
    fmt::print("flop/rs: operations of the float peak in the time of one interaction\n");
}

}  // namespace
}  // namespace ghostlight::bench

int main(int argc, char** argv) {
    return ghostlight::bench::run(argc, argv,
                                  {{"--benchmark_repetitions=9", "--benchmark_min_time=0.05",
                                    "--benchmark_enable_random_interleaving=true"},
                                   ghostlight::bench::declare,
                                   ghostlight::bench::print_summary});
}
