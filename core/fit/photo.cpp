#include "core/fit/photo.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <queue>

namespace ghostlight {
namespace {

double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

float brightest(const float* rgb) { return std::max({rgb[0], rgb[1], rgb[2]}); }

[[noreturn]] void fail(const Photo& photo, std::string problem, std::string found,
                       std::string expected) {
    throw Error({.problem = std::move(problem),
                 .file = photo.file,
                 .where = {},
                 .found = std::move(found),
                 .expected = std::move(expected)});
}

}  // namespace

PhotoNoise estimated_noise(const Photo& photo) {
    // Of a normal distribution the median of |a − 2b + c| is 0.6745 σ √6.
    constexpr double of_second_difference = 0.6745 * 2.449489742783178;
    constexpr int bins = 24;
    std::vector<float> levels;
    for (std::size_t i = 0; i < photo.pixels(); i += 7)
        if (photo.masked.empty() || !photo.masked[i]) levels.push_back(photo.rgb[3 * i + 1]);
    if (levels.empty()) return {.shot = 0.0, .read = 1e-12, .estimated = true};
    std::ranges::sort(levels);
    std::array<std::vector<double>, bins> differences, means;
    // A million pixels tell enough.
    const int step = 1 + static_cast<int>(photo.pixels() / 1'000'000);
    for (int row = 0; row < photo.height_px; row += step)
        for (int column = 1; column + 1 < photo.width_px; ++column) {
            const auto i =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(photo.width_px) +
                static_cast<std::size_t>(column);
            if (!photo.masked.empty() &&
                (photo.masked[i - 1] || photo.masked[i] || photo.masked[i + 1]))
                continue;
            for (std::size_t c = 0; c < 3; ++c) {
                const double a = photo.rgb[3 * (i - 1) + c], b = photo.rgb[3 * i + c],
                             d = photo.rgb[3 * (i + 1) + c];
                const double mean = (a + b + d) / 3.0;
                const auto place = std::ranges::lower_bound(levels, static_cast<float>(mean));
                const auto bin = std::min<std::size_t>(
                    bins - 1,
                    bins * static_cast<std::size_t>(place - levels.begin()) / levels.size());
                differences[bin].push_back(std::abs(a - 2.0 * b + d));
                means[bin].push_back(mean);
            }
        }
    // Least squares of variance = shot × level + read, each bin weighted by 1/variance².
    double s = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (std::size_t k = 0; k < bins; ++k) {
        if (differences[k].size() < 30) continue;
        const double sigma = median(differences[k]) / of_second_difference;
        const double level = std::max(0.0, median(means[k]));
        const double variance = std::max(sigma * sigma, 1e-16);
        const double w = 1.0 / (variance * variance);
        s += w;
        sx += w * level;
        sy += w * variance;
        sxx += w * level * level;
        sxy += w * level * variance;
    }
    if (!(s > 0.0)) return {.shot = 0.0, .read = 1e-12, .estimated = true};
    const double determinant = s * sxx - sx * sx;
    double shot = determinant > 0.0 ? (s * sxy - sx * sy) / determinant : 0.0;
    shot = std::max(0.0, shot);
    const double read = std::max((sy - shot * sx) / s, 1e-12);
    return {.shot = shot, .read = read, .estimated = true};
}

MaskCounts mask_unusable(Photo& photo) {
    MaskCounts counts;
    const std::size_t pixels = photo.pixels();
    photo.masked.resize(pixels, 0);
    std::vector<char> clipped(pixels, 0);
    float highest = 0.0F;
    for (std::size_t i = 0; i < pixels; ++i) {
        float* rgb = &photo.rgb[3 * i];
        if (!std::isfinite(rgb[0] + rgb[1] + rgb[2])) {
            photo.masked[i] = mask_reason::not_a_number;
            rgb[0] = rgb[1] = rgb[2] = 0.0F;
            ++counts.not_a_number;
            continue;
        }
        highest = std::max(highest, brightest(rgb));
        if (static_cast<double>(brightest(rgb)) >= photo.saturation) {
            clipped[i] = 1;
            ++counts.saturated;
        }
    }
    if (counts.not_a_number == pixels)
        fail(photo, "the photograph has no pixel that is a number", "NaN or infinite everywhere",
             "linear values; is the file complete?");
    if (!(highest > 0.0F))
        fail(photo, "the photograph is all black", "no value above 0",
             "a photograph with a bright light and its flare; a longer exposure");
    // Light spills into the neighbours of what is clipped.
    for (int row = 0; row < photo.height_px; ++row)
        for (int column = 0; column < photo.width_px; ++column)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    const int x = column + dx, y = row + dy;
                    if (x < 0 || y < 0 || x >= photo.width_px || y >= photo.height_px) continue;
                    const auto w = static_cast<std::size_t>(photo.width_px);
                    char& masked = photo.masked[static_cast<std::size_t>(row) * w +
                                                static_cast<std::size_t>(column)];
                    if (!masked &&
                        clipped[static_cast<std::size_t>(y) * w + static_cast<std::size_t>(x)])
                        masked = mask_reason::saturated;
                }
    if (counts.saturated + counts.not_a_number == pixels)
        fail(photo, "the photograph is saturated everywhere",
             fmt::format("every pixel at {:.4g} or above", photo.saturation), "a shorter exposure");
    if (photo.noise.read > 0.0 || photo.noise.shot > 0.0) counts.hot = mask_hot(photo);
    return counts;
}

std::size_t mask_hot(Photo& photo) {
    std::size_t count = 0;
    const auto w = static_cast<std::size_t>(photo.width_px);
    for (int row = 1; row + 1 < photo.height_px; ++row)
        for (int column = 1; column + 1 < photo.width_px; ++column) {
            const auto i = static_cast<std::size_t>(row) * w + static_cast<std::size_t>(column);
            if (photo.masked[i]) continue;
            for (std::size_t c = 0; c < 3; ++c) {
                float most = -std::numeric_limits<float>::infinity();
                for (const std::size_t k :
                     {i - 1, i + 1, i - w, i + w, i - w - 1, i - w + 1, i + w - 1, i + w + 1})
                    most = std::max(most, photo.rgb[3 * k + c]);
                const double value = photo.rgb[3 * i + c];
                const double sigma = std::sqrt(
                    photo.noise.shot * std::max(0.0, static_cast<double>(most)) + photo.noise.read);
                if (value - static_cast<double>(most) > 10.0 * sigma &&
                    value > 1.5 * static_cast<double>(most)) {
                    photo.masked[i] = mask_reason::hot;
                    ++count;
                    break;
                }
            }
        }
    return count;
}

MaskCounts count_masked(const Photo& photo) {
    std::array<std::size_t, mask_reason::cropped + 1> counts{};
    for (const char reason : photo.masked) ++counts[static_cast<std::size_t>(reason)];
    return {.saturated = counts[mask_reason::saturated],
            .not_a_number = counts[mask_reason::not_a_number],
            .hot = counts[mask_reason::hot],
            .light = counts[mask_reason::light],
            .painted = counts[mask_reason::painted],
            .cropped = counts[mask_reason::cropped]};
}

Photo merged(const std::vector<Photo>& exposures) {
    if (exposures.empty()) throw Error("no photographs to merge");
    double longest_s = 0.0;
    const Photo* shortest = nullptr;
    for (const Photo& each : exposures) {
        if (!each.exposure_s || !(*each.exposure_s > 0.0))
            fail(each, "bracketed exposures are merged by their exposure times", "none in the file",
                 "EXIF data with the exposure time, or photographs that are merged already");
        if (each.width_px != exposures.front().width_px ||
            each.height_px != exposures.front().height_px)
            fail(each, "bracketed exposures differ in size",
                 fmt::format("{} x {} pixels", each.width_px, each.height_px),
                 fmt::format("{} x {}, as the first", exposures.front().width_px,
                             exposures.front().height_px));
        longest_s = std::max(longest_s, *each.exposure_s);
        if (shortest == nullptr || *each.exposure_s < *shortest->exposure_s) shortest = &each;
    }
    Photo sum = exposures.front();
    // What is masked everywhere, as a light that clips even the shortest exposure, keeps that one's
    // value: it stays the brightest, and clipped, for find_light().
    const double longest_scale = longest_s / *shortest->exposure_s;
    sum.saturation = longest_scale * shortest->saturation;
    double read = 0.0;
    // How many pixels come from which exposures, one bit each.
    std::map<std::uint64_t, std::size_t> sources;
    for (std::size_t i = 0; i < sum.pixels(); ++i) {
        std::array<double, 3> total{}, weights{}, pooled{};
        double time = 0.0;
        for (const Photo& each : exposures) {
            if (!each.masked.empty() && each.masked[i]) continue;
            time += *each.exposure_s / longest_s;
            for (std::size_t c = 0; c < 3; ++c)
                pooled[c] += static_cast<double>(each.rgb[3 * i + c]);
        }
        std::uint64_t from = 0;
        for (std::size_t k = 0; k < exposures.size(); ++k) {
            const Photo& each = exposures[k];
            if (!each.masked.empty() && each.masked[i]) continue;
            from |= std::uint64_t{1} << (k % 64);
            const double scale = longest_s / *each.exposure_s;
            for (std::size_t c = 0; c < 3; ++c) {
                const double value = each.rgb[3 * i + c];
                // Of what all of them say: by its own noise each would weigh its low values more.
                const double expected = std::max(0.0, pooled[c] / time) / scale;
                const double variance =
                    scale * scale * (each.noise.shot * expected + each.noise.read);
                const double w = 1.0 / std::max(variance, 1e-30);
                total[c] += w * scale * value;
                weights[c] += w;
            }
        }
        ++sources[from];
        sum.masked.resize(sum.pixels(), 0);
        sum.masked[i] = weights[0] > 0.0 ? char{0} : shortest->masked[i];
        for (std::size_t c = 0; c < 3; ++c)
            sum.rgb[3 * i + c] =
                static_cast<float>(weights[c] > 0.0 ? total[c] / weights[c]
                                                    : longest_scale * shortest->rgb[3 * i + c]);
    }
    // In the dim parts, where reading decides, all exposures count. Shot noise decides in the
    // bright ones, where the longer exposures clip: that of the fewest photons that make up a
    // hundredth of the picture stands for all, so that no part is thought better known than it is.
    for (const Photo& each : exposures) {
        const double scale = longest_s / *each.exposure_s;
        read += 1.0 / std::max(scale * scale * each.noise.read, 1e-30);
    }
    sources.erase(0);
    std::size_t usable = 0;
    for (const auto& [from, pixels] : sources) usable += pixels;
    double shot = 0.0;
    for (const auto& [from, pixels] : sources) {
        if (100 * pixels < usable) continue;
        double light = 0.0;
        for (std::size_t k = 0; k < exposures.size(); ++k)
            if ((from >> (k % 64)) & 1U)
                light +=
                    1.0 /
                    std::max(longest_s / *exposures[k].exposure_s * exposures[k].noise.shot, 1e-30);
        shot = std::max(shot, 1.0 / light);
    }
    sum.noise = {.shot = shot, .read = 1.0 / read, .estimated = exposures.front().noise.estimated};
    sum.exposure_s = longest_s;
    return sum;
}

LightSpot find_light(const Photo& photo) {
    float highest = 0.0F;
    double mean = 0.0;
    for (std::size_t i = 0; i < photo.pixels(); ++i) {
        const float value = brightest(&photo.rgb[3 * i]);
        highest = std::max(highest, value);
        mean += static_cast<double>(value);
    }
    mean /= static_cast<double>(photo.pixels());
    // What is clipped, or what is at least half as bright as the brightest: ghosts may be bright,
    // but they do not clip where the light does not.
    const bool clipped = static_cast<double>(highest) >= photo.saturation;
    const double limit = clipped ? photo.saturation : 0.5 * static_cast<double>(highest);
    if (!(limit > 3.0 * mean) && !clipped)
        fail(photo, "no light stands out in the photograph",
             fmt::format("brightest value {:.3g}, mean {:.3g}", highest, mean),
             "a light in the frame, or its place given in place of auto: X,Y in pixels, or "
             "deg:FIELD:AZIMUTH where it is outside");
    std::vector<char> seen(photo.pixels(), 0);
    LightSpot best;
    const auto w = static_cast<std::size_t>(photo.width_px);
    for (std::size_t start = 0; start < photo.pixels(); ++start) {
        if (seen[start] || static_cast<double>(brightest(&photo.rgb[3 * start])) < limit) continue;
        std::queue<std::size_t> open;
        open.push(start);
        seen[start] = 1;
        double sx = 0.0, sy = 0.0;
        std::size_t count = 0;
        while (!open.empty()) {
            const std::size_t i = open.front();
            open.pop();
            const auto column = i % w, row = i / w;
            sx += static_cast<double>(column) + 0.5;
            sy += static_cast<double>(row) + 0.5;
            ++count;
            auto visit = [&](std::size_t k) {
                if (seen[k] || static_cast<double>(brightest(&photo.rgb[3 * k])) < limit) return;
                seen[k] = 1;
                open.push(k);
            };
            if (column > 0) visit(i - 1);
            if (column + 1 < w) visit(i + 1);
            if (row > 0) visit(i - w);
            if (row + 1 < static_cast<std::size_t>(photo.height_px)) visit(i + w);
        }
        if (count > best.pixels)
            best = {.column = sx / static_cast<double>(count),
                    .row = sy / static_cast<double>(count),
                    .radius_px = std::sqrt(static_cast<double>(count) / 3.14159265358979),
                    .pixels = count};
    }
    return best;
}

double light_core_px(const Photo& photo, double column, double row, double least_px) {
    constexpr double most_share = 0.08, ring_share = 1.0 / 400.0, above_level = 1.5;
    const double most_px = most_share * photo.width_px;
    if (!(least_px < most_px)) return least_px;
    const double ring_px = std::max(1.0, ring_share * photo.width_px);
    std::vector<double> sums(static_cast<std::size_t>(2.0 * most_px / ring_px) + 1), counts = sums;
    const double reach_px = ring_px * static_cast<double>(sums.size());
    auto from = [&](double middle) { return std::max(0, static_cast<int>(middle - reach_px)); };
    auto to = [&](double middle, int size) {
        return std::min(size, static_cast<int>(middle + reach_px) + 1);
    };
    for (int y = from(row); y < to(row, photo.height_px); ++y)
        for (int x = from(column); x < to(column, photo.width_px); ++x) {
            const double ring = std::hypot(x + 0.5 - column, y + 0.5 - row) / ring_px;
            if (ring >= static_cast<double>(sums.size())) continue;
            sums[static_cast<std::size_t>(ring)] += static_cast<double>(brightest(photo.at(x, y)));
            counts[static_cast<std::size_t>(ring)] += 1.0;
        }
    std::vector<double> outer;
    for (std::size_t k = 0; k < sums.size(); ++k) {
        if (counts[k] == 0.0) continue;
        sums[k] /= counts[k];
        if (static_cast<double>(k) * ring_px >= most_px) outer.push_back(sums[k]);
    }
    if (outer.empty()) return least_px;
    const double level = median(outer);
    for (std::size_t k = 0; k < sums.size(); ++k) {
        const double inner_px = static_cast<double>(k) * ring_px;
        if (inner_px < least_px) continue;
        if (counts[k] > 0.0 && sums[k] <= above_level * level) return std::min(inner_px, most_px);
    }
    return most_px;
}

void mask_disc(Photo& photo, double column, double row, double radius_px) {
    photo.masked.resize(photo.pixels(), 0);
    for (int y = 0; y < photo.height_px; ++y)
        for (int x = 0; x < photo.width_px; ++x) {
            char& masked =
                photo
                    .masked[static_cast<std::size_t>(y) * static_cast<std::size_t>(photo.width_px) +
                            static_cast<std::size_t>(x)];
            if (!masked && std::hypot(x + 0.5 - column, y + 0.5 - row) <= radius_px)
                masked = mask_reason::light;
        }
}

}  // namespace ghostlight
