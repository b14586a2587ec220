// The planned picture beyond its frames' times: growth with the lens, memory, colour.
//
//   picture_bench --growth   made lenses of 10 … 80 surfaces
//   picture_bench --memory   of the largest bundled zoom
//   picture_bench --color    against 61 wavelengths, each traced; takes minutes
//   picture_bench --colors   the same, ghost by ghost; [LENS] after it: of that lens alone
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/flare/ghost_sampling.h"
#include "core/flare/planned_flare.h"
#include "core/io/lens_file.h"
#include "core/parallel.h"
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
    fmt::print("{:>10}{:>10}{:>12}{:>14}{:>10}{:>18}{:>14}\n", "surfaces", "ghosts", "cpu, ms",
               "ms a ghost", "drawn", "surfaces a path", "us a surface");
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
        std::size_t met = 0;
        for (const GhostPath& path : scene.ghosts)
            met += events(path, scene.system().surfaces.size()).size();
        const auto ghosts = static_cast<double>(scene.ghosts.size());
        fmt::print("{:>10}{:>10}{:>12.1f}{:>14.4f}{:>10}{:>18.1f}{:>14.3f}\n", surfaces,
                   scene.ghosts.size(), ms, ms / ghosts, drawn, static_cast<double>(met) / ghosts,
                   1e3 * ms / static_cast<double>(met));
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

/// From linear Rec.709 (IEC 61966-2-1).
Xyz xyz_of(double r, double g, double b) {
    return {0.4124 * r + 0.3576 * g + 0.1805 * b, 0.2126 * r + 0.7152 * g + 0.0722 * b,
            0.0193 * r + 0.1192 * g + 0.9505 * b};
}

Xyz operator+(const Xyz& a, const Xyz& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

/// Of the whole picture.
Xyz sum_of(const FlareImage& image) {
    double r = 0.0, g = 0.0, b = 0.0;
    for (std::size_t k = 0; k < image.rgb.size(); k += 3) {
        r += static_cast<double>(image.rgb[k]);
        g += static_cast<double>(image.rgb[k + 1]);
        b += static_cast<double>(image.rgb[k + 2]);
    }
    return xyz_of(r, g, b);
}
Xyz sum_of(const BandedPicture& picture) {
    double r = 0.0, g = 0.0, b = 0.0;
    for (const std::vector<double>& band : picture.bands)
        for (std::size_t k = 0; k < band.size(); k += 4) {
            r += band[k];
            g += band[k + 1];
            b += band[k + 2];
        }
    return xyz_of(r, g, b);
}

/// Of each of X, Y, Z, %.
Xyz off(const Xyz& a, const Xyz& truth) {
    return {100.0 * (a.x / truth.x - 1.0), 100.0 * (a.y / truth.y - 1.0),
            100.0 * (a.z / truth.z - 1.0)};
}
double largest(const Xyz& off) {
    return std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)});
}

/// Each wavelength's rays and films by themselves, in double, polarisation carried.
SampledGhost dense(const Prescription& lens, const FlareRequest& request, const GhostPath& path) {
    constexpr SamplingLevel level{
        .cells = 96, .directions = 1, .wavelengths = 61, .shift_u = 0.3, .shift_v = 0.7};
    const SamplingScene scene{
        .lens = lens,
        .light = request.light,
        .disc_diameter_deg = 0.0,
        .spectrum = request.spectrum,
        .pixels = pixel_frame(lens.sensor.width_mm, lens.sensor.height_mm, request.width_px),
        .weights = WeightModel::carried,
        .precision = TracePrecision::double_precision};
    std::vector<Pupil> pupils;
    return sample_ghost(scene, sampled_spectrum(scene, level), level, path, pupils);
}

/// `each`: every ghost's own line.
void print_color(double tolerance, bool each, std::string_view only) {
    constexpr std::size_t strongest = 8;
    fmt::print(
        "D65, within {:g} %: the largest relative difference of X, Y, Z from 61 wavelengths, each "
        "traced, %\n{:<28}{:>10}{:>24}\n",
        100.0 * tolerance, "lens", "together", "each of the strongest");
    for (const BundledLens& bundled : bundled_lenses()) {
        if (bundled.file.stem().string().find(only) == std::string::npos) continue;
        const Prescription lens = read_lens(bundled.file).lens;
        FlareRequest request;
        request.light.field_deg = middle_field_deg(lens);
        request.spectrum = StandardLight{Illuminant::d65};
        request.width_px = 320;
        request.tolerance = tolerance;
        const FlareScene scene = flare_scene(lens, request.spectrum);
        const FlareImage planned = render_planned(scene, request).value();
        std::vector<PlannedGhost> ghosts = planned.plan.ghosts;
        std::ranges::sort(ghosts, std::ranges::greater{}, &PlannedGhost::flux_mm2);
        ghosts.resize(std::min(strongest, ghosts.size()));
        std::vector<SampledGhost> truth(ghosts.size());
        parallel_for(ghosts.size(), 0, {},
                     [&](std::size_t g) { truth[g] = dense(lens, request, ghosts[g].path); });
        std::vector<double> own;
        Xyz all_planned, all_dense;
        for (std::size_t g = 0; g < ghosts.size(); ++g) {
            request.only = {ghosts[g].path};
            const FlareImage image = render_planned(scene, request).value();
            const Xyz a = sum_of(image), b = sum_of(truth[g].picture);
            const Xyz by = off(a, b);
            own.push_back(largest(by));
            all_planned = all_planned + a;
            all_dense = all_dense + b;
            if (each)
                fmt::print("    {:<8} bands {:>2}  X {:+.2f}  Y {:+.2f}  Z {:+.2f}  E {:+.2f}\n",
                           name(ghosts[g].path), image.plan.ghosts.front().bands, by.x, by.y, by.z,
                           100.0 * (image.flux_on_sensor_mm2 / truth[g].on_sensor_mm2 - 1.0));
        }
        std::ranges::sort(own);
        fmt::print("{:<28}{:>10.2f}      p50 {:.2f}, worst {:.2f}\n", bundled.file.stem().string(),
                   largest(off(all_planned, all_dense)), own[own.size() / 2], own.back());
        std::fflush(stdout);
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
        const std::string_view next = k + 1 < argc ? argv[k + 1] : "";
        if (what == "--color" || what == "--colors") {
            for (const double tolerance : {0.003, 0.02})
                print_color(tolerance, what == "--colors", next);
        }
    }
    if (argc == 1) {
        print_growth();
        print_memory();
    }
    return 0;
}
