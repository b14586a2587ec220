// What a fit costs: twelve coatings, then with six numbers of geometry, then a large file.

#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <ctime>

#include "app/cli/fit_study_cases.h"
#include "app/cli/fit_study_photo.h"
#include "app/cli/options.h"
#include "core/elapsed.h"
#include "core/flare/flare_image.h"
#include "core/io/photo_file.h"
#include "core/optics/optical_system.h"

namespace ghostlight::cli {
namespace {

/// Of all threads of this program so far, s.
double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The most that this program has held so far, MB.
double most_memory_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// A picture brought up to a camera's size, bilinearly.
FlareImage enlarged(const FlareImage& small, int width_px) {
    FlareImage large = small;
    large.width_px = width_px;
    large.height_px = width_px * small.height_px / small.width_px;
    large.rgb.assign(
        3 * static_cast<std::size_t>(large.width_px) * static_cast<std::size_t>(large.height_px),
        0.0F);
    large.irradiance.clear();
    const double scale = static_cast<double>(small.width_px) / width_px;
    for (int y = 0; y < large.height_px; ++y)
        for (int x = 0; x < large.width_px; ++x) {
            const double u = std::clamp((x + 0.5) * scale - 0.5, 0.0, small.width_px - 1.001),
                         v = std::clamp((y + 0.5) * scale - 0.5, 0.0, small.height_px - 1.001);
            const int i = static_cast<int>(u), j = static_cast<int>(v);
            for (std::size_t c = 0; c < 3; ++c) {
                auto at = [&](int column, int row) {
                    return static_cast<double>(
                        small.rgb[3 * static_cast<std::size_t>(row * small.width_px + column) + c]);
                };
                large.rgb[3 * static_cast<std::size_t>(y) *
                              static_cast<std::size_t>(large.width_px) +
                          3 * static_cast<std::size_t>(x) + c] =
                    static_cast<float>(std::lerp(std::lerp(at(i, j), at(i + 1, j), u - i),
                                                 std::lerp(at(i, j + 1), at(i + 1, j + 1), u - i),
                                                 v - j));
            }
        }
    return large;
}

}  // namespace

StudySection study_speed(const StudyRequest& request) {
    StudySection section{.key = "speed",
                         .title = "Time and memory",
                         .text = {},
                         .table = {.columns = {"case", "numbers", "ghosts", "iterations", "wall_s",
                                               "processor_s", "iteration_ms", "most_memory_mb"},
                                   .rows = {}},
                         .pictures = {}};
    LensOptions which;
    which.lens = "angenieux_1953_100_f1.1";
    const Prescription truth = load_lens(which).lens;
    SyntheticPhotoRequest camera = study_camera(5.0, request.quick);
    camera.tolerance = 0.03;
    const FlareImage subject = *photo_subject(truth, camera);
    Prescription wrong = truth;
    int sign = 1;
    for (Surface& surface : wrong.surfaces)
        if (auto* film = std::get_if<QuarterWave>(&surface.coating)) {
            film->center_nm += 40.0 * sign;
            sign = -sign;
        }
    const FitPhoto photo = fit_photo(exposed(subject, truth, camera), truth, camera.light);
    auto timed = [&](const std::string& name, const std::vector<FitPhoto>& photos,
                     const std::string& vary) {
        const auto began = Clock::now();
        const double before_s = processor_s();
        const FitReport report = *fit_flare(wrong, photos, usual_fit(wrong, vary, request.quick));
        section.table.rows.push_back({name, static_cast<std::int64_t>(report.numbers.size()),
                                      static_cast<std::int64_t>(report.ghosts.size()),
                                      static_cast<std::int64_t>(report.iterations),
                                      1e-3 * ms_since(began), processor_s() - before_s,
                                      report.iteration_ms, most_memory_mb()});
        section.text += fmt::format(
            "- **{}**: {} numbers, {} iterations, {:.1f} s ({:.1f} s of processor time), {:.0f} ms "
            "for the last iterations; at most {:.0f} MB so far. {}\n",
            name, report.numbers.size(), report.iterations, 1e-3 * ms_since(began),
            processor_s() - before_s, report.iteration_ms, most_memory_mb(), report.verdict);
    };
    timed("twelve coatings", {photo}, "center@all");
    timed("and six of geometry", {photo},
          "center@all,radius@1,radius@4,gap@2,gap@5,index@1,stop-size");
    // 24 million pixels, from file to report, by the command itself.
    const auto file = request.folder / "speed_24_megapixels.tif";
    camera.seed = 2;
    write_photo(exposed(enlarged(subject, request.quick ? 1500 : 6000), truth, camera), 16, file);
    section.text += fmt::format(
        "\nMemory with a large file: `/usr/bin/time -v ghostlight-cli fit {} --photo {} --light "
        "deg:5 --vary center@all`\n",
        which.lens, file.string());
    return section;
}

}  // namespace ghostlight::cli
