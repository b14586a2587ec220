// The planned picture beyond its frames' times: growth with the lens, memory, colour.
//
//   picture_bench --growth   made lenses of 10 … 80 surfaces
//   picture_bench --memory   of the largest bundled zoom
//   picture_bench --color    against 61 wavelengths, each traced; takes minutes
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/flare/planned_flare.h"
#include "core/io/lens_file.h"
#include "tests/bench/bench_support.h"
#include "tests/bench/made_lenses.h"

namespace ghostlight::bench {
namespace {

/// Processor time of all threads, which other programs on the machine change least.
double cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

template <class Work>
double least_cpu_ms(Work work) {
    constexpr int times = 7;
    double least = 1e300;
    for (int k = 0; k < times; ++k) {
        const double began = cpu_ms();
        work();
        least = std::min(least, cpu_ms() - began);
    }
    return least;
}

void print_growth() {
    fmt::print("Trains of lenses, 1280 x 720, tolerance 4 %, one wavelength, quick search\n");
    fmt::print("{:>10}{:>10}{:>12}{:>14}{:>10}\n", "surfaces", "ghosts", "cpu, ms", "ms a ghost",
               "drawn");
    for (const int surfaces : {10, 20, 40, 80}) {
        const FlareScene scene = flare_scene(train(surfaces), Monochromatic{});
        FlareRequest request;
        request.light.field_deg = train_field_deg;
        request.tolerance = 0.04;
        request.search = ProbeSearch::quick;
        request.threads = 1;
        std::size_t drawn = 0;
        const double ms = least_cpu_ms(
            [&] { drawn = render_planned(scene, request)->plan.count(GhostFate::drawn); });
        fmt::print("{:>10}{:>10}{:>12.1f}{:>14.4f}{:>10}\n", surfaces, scene.ghosts.size(), ms,
                   ms / static_cast<double>(scene.ghosts.size()), drawn);
    }
}

/// A line of /proc/self/status, MB.
double status_mb(const std::string& field) {
    std::ifstream status("/proc/self/status");
    std::string word;
    double kb = 0.0;
    while (status >> word)
        if (word == field + ":") status >> kb;
    return kb / 1024.0;
}

void print_memory() {
    const Prescription lens = lens_named("canon_zoom_70_200_f2.8.json");
    const double before = status_mb("VmRSS");
    const FlareScene scene = flare_scene(lens, StandardLight{Illuminant::d65});
    const double compiled = status_mb("VmHWM");
    FlareRequest request;
    request.light.field_deg = middle_field_deg(lens);
    for (const double tolerance : {0.04, 0.02, 0.005}) {
        request.tolerance = tolerance;
        const auto image = render_planned(scene, request);
        fmt::print(
            "Canon zoom, D65, {} x {}, within {:g} %: peak {:.0f} MB over the program's {:.0f} "
            "(lens compiled {:.0f})\n",
            image->width_px, image->height_px, 100.0 * tolerance, status_mb("VmHWM") - before,
            before, compiled - before);
    }
}

struct Xyz {
    double x = 0.0, y = 0.0, z = 0.0;
};

/// Of the whole picture, from linear Rec.709 (IEC 61966-2-1).
Xyz sum_of(const FlareImage& image) {
    Xyz sum;
    for (std::size_t k = 0; k < image.rgb.size(); k += 3) {
        const auto r = static_cast<double>(image.rgb[k]), g = static_cast<double>(image.rgb[k + 1]),
                   b = static_cast<double>(image.rgb[k + 2]);
        sum.x += 0.4124 * r + 0.3576 * g + 0.1805 * b;
        sum.y += 0.2126 * r + 0.7152 * g + 0.0722 * b;
        sum.z += 0.0193 * r + 0.1192 * g + 0.9505 * b;
    }
    return sum;
}

double difference(const Xyz& a, const Xyz& truth) {
    return std::max({std::abs(a.x - truth.x) / truth.x, std::abs(a.y - truth.y) / truth.y,
                     std::abs(a.z - truth.z) / truth.z});
}

void print_color() {
    constexpr std::size_t strongest = 8;
    fmt::print(
        "D65: 16 weights on 3 geometries against 61 wavelengths, each traced: the largest "
        "relative difference of X, Y, Z, %\n{:<28}{:>10}{:>24}\n",
        "lens", "together", "each of the strongest");
    for (const BundledLens& each : bundled_lenses()) {
        const Prescription lens = read_lens(each.file).lens;
        FlareRequest request;
        request.light.field_deg = middle_field_deg(lens);
        request.spectrum = StandardLight{Illuminant::d65};
        request.width_px = 320;
        request.tolerance = 0.003;
        const FlareScene scene = flare_scene(lens, request.spectrum);
        const FlareImage planned = render_planned(scene, request).value();
        std::vector<PlannedGhost> ghosts = planned.plan.ghosts;
        std::ranges::sort(ghosts, std::ranges::greater{}, &PlannedGhost::flux_mm2);
        ghosts.resize(std::min(strongest, ghosts.size()));
        FlareRequest dense = request;
        dense.method = FlareMethod::uniform;
        dense.spectral_samples = 61;
        dense.grid = 48;
        std::vector<double> own;
        Xyz all_planned, all_dense;
        for (const PlannedGhost& ghost : ghosts) {
            request.only = dense.only = {ghost.path};
            const Xyz a = sum_of(render_planned(scene, request).value());
            const Xyz b = sum_of(render_flare(lens, dense).value());
            own.push_back(100.0 * difference(a, b));
            all_planned = {all_planned.x + a.x, all_planned.y + a.y, all_planned.z + a.z};
            all_dense = {all_dense.x + b.x, all_dense.y + b.y, all_dense.z + b.z};
        }
        std::ranges::sort(own);
        fmt::print("{:<28}{:>10.2f}      p50 {:.2f}, worst {:.2f}\n", each.file.stem().string(),
                   100.0 * difference(all_planned, all_dense), own[own.size() / 2], own.back());
    }
}

}  // namespace
}  // namespace ghostlight::bench

int main(int argc, char** argv) {
    using namespace ghostlight::bench;
    for (int k = 1; k < argc; ++k) {
        const std::string_view what = argv[k];
        if (what == "--growth") print_growth();
        if (what == "--memory") print_memory();
        if (what == "--color") print_color();
    }
    if (argc == 1) {
        print_growth();
        print_memory();
    }
    return 0;
}
