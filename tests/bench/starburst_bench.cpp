// The stop's diffraction: an edit of the stop until its starburst is drawn, a frame while only the
// light moves, and what ringing adds to a planned flare.
//
//   starburst_bench [edit|move|ringing]     all or one of them; median wall and CPU times, ms
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <string_view>
#include <vector>

#include "core/elapsed.h"
#include "core/flare/planned_flare.h"
#include "core/flare/starburst.h"
#include "core/parallel.h"
#include "tests/bench/bench_support.h"

namespace ghostlight::bench {
namespace {

constexpr int repetitions = 7;

struct Took {
    double wall_ms = 0.0, cpu_ms = 0.0;
};

/// Medians. CPU time is of all threads: on a busy machine it says more than the wall's.
Took median_of(const std::function<void(int)>& work) {
    std::vector<double> wall, cpu;
    for (int k = -1; k < repetitions; ++k) {
        const auto began = Clock::now();
        const std::clock_t cpu_began = std::clock();
        work(k);
        if (k < 0) continue;  // warm-up
        wall.push_back(ms_since(began));
        cpu.push_back(1e3 * static_cast<double>(std::clock() - cpu_began) / CLOCKS_PER_SEC);
    }
    std::ranges::sort(wall);
    std::ranges::sort(cpu);
    return {wall[repetitions / 2], cpu[repetitions / 2]};
}

void print(const std::string& what, const Took& took) {
    fmt::print("{:<64}{:>9.2f}{:>9.2f}\n", what, took.wall_ms, took.cpu_ms);
}

Prescription square(Prescription lens) {
    lens.sensor.height_mm = lens.sensor.width_mm;
    return lens;
}
Prescription widescreen(Prescription lens) {
    lens.sensor.height_mm = lens.sensor.width_mm * 720.0 / 1280.0;
    return lens;
}

void bench_edit() {
    Prescription lens = square(lens_named("tessar_brendel_100_f2.8.json"));
    lens.stop.f_number = 8.0;
    StarburstRequest request;
    request.light = {4.0, 90.0};
    request.spectrum = StandardLight{};
    request.width_px = 1024;
    struct Case {
        const char* name;
        int blades;
        double curvature;
        bool dirty;
    };
    for (const Case& each :
         {Case{"round", 0, 0.0, false}, Case{"6 blades", 6, 0.0, false},
          Case{"9 blades", 9, 0.0, false}, Case{"9 blades, curved", 9, 0.4, false},
          Case{"6 blades, dust and scratches", 6, 0.0, true}}) {
        lens.stop.blades = each.blades;
        lens.stop.blade_curvature = each.curvature;
        lens.stop.dirt.dust_coverage = each.dirty ? 0.02 : 0.0;
        lens.stop.dirt.scratches = each.dirty ? 30 : 0;
        print(fmt::format("edit of the stop to starburst, 1024 x 1024: {}", each.name),
              median_of([&](int k) {
                  lens.stop.rotation_deg = k;
                  render_starburst(lens, request).value();
              }));
    }
}

void bench_move() {
    Prescription lens = widescreen(lens_named("tessar_brendel_100_f2.8.json"));
    lens.stop.f_number = 8.0;
    lens.stop.blades = 7;
    StarburstRequest request;
    request.spectrum = StandardLight{};
    MovingStarburst moving(lens, request);
    print("starburst of a moving light, 1280 x 720, a frame", median_of([&](int k) {
              moving.frame({4.0 + 0.05 * k, 90.0});
          }));
}

void bench_ringing() {
    for (const char* name : {"tessar_brendel_100_f2.8.json", "double_gauss_tronnier_100_f2.json",
                             "nikon_zoom_80_200_f2.8.json"})
        for (const double f_number : {0.0, 11.0}) {
            Prescription lens = widescreen(lens_named(name));
            if (f_number > 0.0) lens.stop.f_number = f_number;
            lens.stop.blades = 6;
            const FlareScene scene = flare_scene(lens, StandardLight{});
            FlareRequest request;
            request.light.field_deg = middle_field_deg(lens);
            request.tolerance = 0.02;
            double added_ms = 0.0;
            std::size_t rung = 0;
            const Took plain = median_of([&](int) { render_planned(scene, request).value(); });
            request.ringing = true;
            const Took with = median_of([&](int) {
                const FlareImage image = render_planned(scene, request).value();
                added_ms = image.times.ringing_ms;
                rung = image.ringing.size();
            });
            const std::string which = fmt::format("{}{}", name, f_number > 0.0 ? ", f/11" : "");
            print("planned flare, " + which, plain);
            print(fmt::format("  with ringing of {} ghosts ({:+.0f} % CPU)", rung,
                              100.0 * (with.cpu_ms / plain.cpu_ms - 1.0)),
                  with);
        }
}

}  // namespace
}  // namespace ghostlight::bench

int main(int argc, char** argv) {
    using namespace ghostlight;
    const std::string_view only = argc > 1 ? argv[1] : "";
    fmt::print("{} threads; medians of {}, ms\n", default_thread_count(), bench::repetitions);
    fmt::print("{:<64}{:>9}{:>9}\n", "", "wall", "CPU");
    if (only.empty() || only == "edit") bench::bench_edit();
    if (only.empty() || only == "move") bench::bench_move();
    if (only.empty() || only == "ringing") bench::bench_ringing();
    return 0;
}
