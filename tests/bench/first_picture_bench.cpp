// How soon there is something to see: a lens just opened, and OpenGL that fails in use. Times of
// the parts that a window waits for, without the window's own drawing.
//
//   first_picture_bench        all bundled lenses, D65
//   first_picture_bench LENS   those whose name contains it
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

#include "core/elapsed.h"
#include "core/error.h"
#include "core/flare/first_look.h"
#include "core/flare/planned_flare.h"
#include "core/io/lens_file.h"
#include "render/gl_flare/flare_engines.h"
#include "tests/bench/bench_support.h"

namespace ghostlight::bench {
namespace {

double cpu_now_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Least of some runs: of the clock, and of the processor over all threads.
struct Took {
    double wall_ms = 1e300, cpu_ms = 1e300;
};
std::string text(const Took& took) {
    return fmt::format("{:.1f} ({:.1f})", took.wall_ms, took.cpu_ms);
}

template <class Work>
Took took(Work work) {
    constexpr int times = 7;
    Took least;
    for (int k = 0; k < times; ++k) {
        const double cpu = cpu_now_ms();
        const auto began = Clock::now();
        work();
        least.wall_ms = std::min(least.wall_ms, ms_since(began));
        least.cpu_ms = std::min(least.cpu_ms, cpu_now_ms() - cpu);
    }
    return least;
}

double relative_l1(const FlareImage& image, const FlareImage& truth) {
    double off = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < truth.irradiance.size(); ++k) {
        off += std::abs(static_cast<double>(image.irradiance[k] - truth.irradiance[k]));
        sum += static_cast<double>(truth.irradiance[k]);
    }
    return sum > 0.0 ? off / sum : 0.0;
}

/// An OpenGL that is lost at its first picture.
GlEngine lost_gl() {
    return {
        "lost",
        [](const FlareScene&, const FlareRequest&, std::stop_token) -> std::optional<FlareImage> {
            throw Error("the context was lost");
        }};
}

void measure(const BundledLens& bundled) {
    LensFile file;
    const Took read = took([&] { file = read_lens(bundled.file); });
    FlareRequest request;
    request.light.field_deg = middle_field_deg(file.lens);
    request.spectrum = StandardLight{Illuminant::d65};
    std::optional<FlareScene> scene;
    const Took compiled = took([&] { scene = flare_scene(file.lens, request.spectrum); });

    FlareRequest small = request;
    small.width_px = first_look_width_px;
    std::optional<FlareImage> seen;
    const Took look = took([&] { seen = render_first_look(*scene, small); });
    small.tolerance = 0.005;
    const FlareImage truth = render_planned(*scene, small).value();

    FlareRequest coarse = request;
    coarse.tolerance = 0.04;
    coarse.search = ProbeSearch::quick;
    const Took planned = took([&] { render_planned(*scene, coarse); });

    const Took taken_over = took([&] {
        FlareEngines engines(lost_gl);
        engines.wish(FlareEngine::gl);
        engines.settle(*scene, request);
        if (!engines.draw(*scene, request) || !engines.state().gave_up)
            throw Error("the CPU did not take over");
    });
    fmt::print("| {} | {} | {} | {} | {} | {:.1f} | {:.0f} % | {:.0f} % | {} | {} |\n",
               bundled.file.stem().string(), seen->ghosts, text(read), text(compiled), text(look),
               read.wall_ms + compiled.wall_ms + look.wall_ms, 100.0 * seen->plan.estimated_error(),
               100.0 * relative_l1(*seen, truth), text(planned), text(taken_over));
    std::fflush(stdout);
}

}  // namespace
}  // namespace ghostlight::bench

int main(int argc, char** argv) {
    using namespace ghostlight;
    const std::string_view only = argc > 1 ? argv[1] : "";
    fmt::print(
        "D65, half of the half field; ms of the clock, in brackets of all processors; first look "
        "{} px wide, else 1280\n\n"
        "| lens | ghosts | read | compile | first look | to it in all | its error, stated | "
        "measured | within 4 %, quick search | OpenGL lost, within 2 % |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
        first_look_width_px);
    for (const BundledLens& bundled : bundled_lenses())
        if (bundled.file.stem().string().find(only) != std::string::npos) bench::measure(bundled);
    return 0;
}
