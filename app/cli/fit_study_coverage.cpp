// How often the 95 % intervals hold the truth: one picture, many draws of its noise.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "app/cli/fit_study_cases.h"
#include "app/cli/fit_study_photo.h"
#include "core/flare/flare_image.h"

namespace ghostlight::cli {
namespace {

/// What of one number of one draw is kept, as its line in the draws' file.
struct DrawnNumber {
    double value = 0.0, error = 0.0, low = 0.0, high = 0.0;
    std::int64_t other_minima = 0;
    bool determined = false, usable = false;
};
using Draw = std::vector<DrawnNumber>;

/// Draws that an earlier run has done, by seed. A line that was not finished is left out, and its
/// draw done again.
std::map<std::uint64_t, Draw> earlier_draws(const std::filesystem::path& file, std::size_t count) {
    std::map<std::uint64_t, Draw> draws;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::istringstream text(line);
        std::uint64_t seed = 0;
        if (!(text >> seed)) continue;
        Draw draw;
        DrawnNumber one;
        while (text >> one.value >> one.error >> one.low >> one.high >> one.other_minima >>
               one.determined >> one.usable)
            draw.push_back(one);
        if (draw.size() == count) draws[seed] = draw;
    }
    return draws;
}

std::string draw_line(std::uint64_t seed, const Draw& draw) {
    std::string line = fmt::format("{}", seed);
    for (const DrawnNumber& each : draw)
        line += fmt::format("  {:.6g} {:.6g} {:.6g} {:.6g} {} {:d} {:d}", each.value, each.error,
                            each.low, each.high, each.other_minima, each.determined, each.usable);
    return line + "\n";
}

}  // namespace

StudySection study_coverage(const StudyRequest& request) {
    StudySection section{.key = "coverage",
                         .title = "Coverage of the 95 % intervals",
                         .text = {},
                         .table = {},
                         .pictures = {}};
    const Prescription truth = tessar_with(true_centers_nm), wrong = tessar_with(first_centers_nm);
    SyntheticPhotoRequest camera = study_camera(5.0, request.quick);
    const FitRequest fit = usual_fit(wrong, "center@all", request.quick);
    const std::size_t count = true_centers_nm.size();
    // A draw is kept as soon as it is done: a study that was stopped goes on where it was.
    const auto file = request.folder / (request.quick ? "coverage-quick.draws" : "coverage.draws");
    auto draws = earlier_draws(file, count);
    std::optional<FlareImage> subject;
    for (int draw = 0; draw < request.draws; ++draw) {
        camera.seed = request.seed + static_cast<std::uint64_t>(draw);
        if (draws.contains(camera.seed)) continue;
        if (!subject) subject = photo_subject(truth, camera);
        const std::vector<FitPhoto> photos = {
            fit_photo(exposed(*subject, truth, camera), truth, camera.light)};
        const FitReport report = *fit_flare(wrong, photos, fit);
        Draw& done = draws[camera.seed];
        for (const FittedNumber& each : report.numbers)
            done.push_back({.value = each.value,
                            .error = each.standard_error,
                            .low = each.low,
                            .high = each.high,
                            .other_minima = static_cast<std::int64_t>(report.other_minima.size()),
                            .determined = each.knowledge == FitKnowledge::determined,
                            .usable = report.usable});
        std::ofstream(file, std::ios::app) << draw_line(camera.seed, done);
        if (draw == 0) write_pages(report, truth.name, request.folder, "coverage");
        if (request.progress) request.progress((draw + 1.0) / request.draws);
    }
    if (std::filesystem::exists(request.folder / "coverage.png"))
        section.pictures.emplace_back("coverage.png");
    section.table.columns = {"seed", "number", "truth_nm", "value_nm",     "standard_error_nm",
                             "low",  "high",   "covered",  "other_minima", "determined"};
    struct Sum {
        double error = 0.0, square = 0.0;
        std::vector<double> bars;
        int covered = 0, determined = 0, near = 0;
    };
    std::vector<Sum> sums(count);
    int usable = 0, ambiguous = 0, all = 0;
    for (int draw = 0; draw < request.draws; ++draw) {
        const std::uint64_t seed = request.seed + static_cast<std::uint64_t>(draw);
        const Draw& done = draws.at(seed);
        usable += done.front().usable;
        ambiguous += done.front().other_minima > 0;
        for (std::size_t k = 0; k < count; ++k) {
            const DrawnNumber& number = done[k];
            const double off = number.value - true_centers_nm[k];
            const bool covered =
                number.low <= true_centers_nm[k] && true_centers_nm[k] <= number.high;
            Sum& sum = sums[k];
            sum.error += off;
            sum.square += off * off;
            sum.bars.push_back(number.error);
            sum.covered += covered;
            all += covered;
            if (number.determined) {
                ++sum.determined;
                sum.near += std::abs(off) < 3.0;
            }
            section.table.rows.push_back({static_cast<std::int64_t>(seed), name(fit.vary[k]),
                                          true_centers_nm[k], number.value, number.error,
                                          number.low, number.high, covered ? "yes" : "no",
                                          number.other_minima, number.determined ? "yes" : "no"});
        }
    }
    const int intervals = request.draws * static_cast<int>(count);
    section.text = fmt::format(
        "{} draws of the noise (seeds from {}), a Tessar with six λ0 off by up to 105 nm at first, "
        "5°, {} pixels, 1 % noise, exposure, balance, shading, background and place unknown. "
        "**{} of {} intervals hold the truth: {:.1f} %.** {} verdicts of {} call the fit usable; "
        "{} name another minimum.\n\n"
        "| number | mean error, nm | scatter | median standard error | covered | determined | of "
        "those within 3 nm |\n| --- | --- | --- | --- | --- | --- | --- |\n",
        request.draws, request.seed, camera.width_px, all, intervals, 100.0 * all / intervals,
        usable, request.draws, ambiguous);
    const double n = request.draws;
    for (std::size_t k = 0; k < sums.size(); ++k) {
        Sum& sum = sums[k];
        std::ranges::sort(sum.bars);
        const double mean = sum.error / n;
        section.text += fmt::format(
            "| {} | {:.1f} | {:.1f} | {:.1f} | {} of {} | {} | {} |\n", name(fit.vary[k]), mean,
            std::sqrt(std::max(0.0, sum.square / n - mean * mean)), sum.bars[sum.bars.size() / 2],
            sum.covered, request.draws, sum.determined, sum.near);
    }
    return section;
}

}  // namespace ghostlight::cli
