#include "core/io/stated_heights.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "core/io/import_notes.h"
#include "core/io/import_steps.h"
#include "core/io/text_lines.h"

namespace ghostlight {
namespace {

/// Edges are rounded to two digits in these files.
constexpr double rounding = 1e-3;

/// Surfaces whose sphere is smaller than their clear radius, when heights are taken times `factor`.
std::size_t impossible(const ImportedLens& lens, double factor) {
    std::size_t count = 0;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        const Surface& surface = lens.lens.surfaces[row];
        const auto& clear = lens.surfaces[row].semi_diameter_mm;
        const double c = curvature_per_mm(surface.curve);
        if (clear && surface.aspheric.empty() && surface.conic == 0.0 &&
            std::abs(c) * *clear * factor > 1.0 + rounding)
            ++count;
    }
    return count;
}

/// The stop's listed height over that of the marginal ray at the f-number.
std::optional<double> stop_ratio(const ImportedLens& lens, std::optional<double> f_number) {
    if (!f_number || !lens.stop || !lens.surfaces[*lens.stop].semi_diameter_mm) return std::nullopt;
    Prescription trial = lens.lens;
    trial.stop.surface = *lens.stop;
    const auto order = first_order_of(trial);
    if (!order) return std::nullopt;
    const double ratio =
        order->entrance_pupil_radius_mm * 2.0 * *f_number / std::abs(order->efl_mm);
    if (std::isfinite(ratio) && ratio > 0.0) return ratio;
    return std::nullopt;
}

void scale_heights(ImportedLens& lens, double factor) {
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
        if (auto& clear = lens.surfaces[row].semi_diameter_mm) {
            *clear *= factor;
            lens.lens.surfaces[row].semi_diameter_mm = *clear;
        }
}

}  // namespace

void settle_heights(ImportedLens& lens, std::optional<double> f_number, bool diameters_expected) {
    const std::size_t too_large = impossible(lens, 1.0);
    const auto ratio = stop_ratio(lens, f_number);
    const auto about = [&](double value) { return ratio && std::abs(*ratio / value - 1.0) < 0.25; };
    const std::string ratio_text =
        ratio ? fmt::format("the stop is {:.2f} times as high as the marginal ray at f/{}", *ratio,
                            *f_number)
              : std::string("there is no f-number to compare the stop with");

    double factor = 1.0;
    std::string what;
    if (about(2.0) || (!about(1.0) && too_large > 0 && impossible(lens, 0.5) < too_large) ||
        (!ratio && too_large == 0 && diameters_expected)) {
        factor = 0.5;
        what = "the heights in the file are diameters: halved";
    } else if (about(0.1)) {
        factor = 10.0;
        what = "the heights in the file are centimetres: taken times 10";
    }
    const std::string spheres =
        fmt::format("{} surfaces would reach beyond their own sphere", too_large);
    if (factor != 1.0) {
        scale_heights(lens, factor);
        note_converted(
            lens.notes, "clear radii", fmt::format("{} ({}; {})", what, ratio_text, spheres), true,
            fmt::format("if they were right, multiply the semi-diameters by {}", 1.0 / factor));
    } else if (too_large > 0 || (ratio && !about(1.0))) {
        note_noticed(lens.notes, "clear radii",
                     fmt::format("the heights are taken as semi-diameters, but {}, and {}",
                                 ratio_text, spheres),
                     true, "compare them with a drawing of the lens");
    } else {
        note_read(lens.notes, "clear radii",
                  fmt::format("the heights are semi-diameters ({})", ratio_text));
    }
}

std::optional<double> f_number_in(std::string_view text) {
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        if (text[i] != 'f' && text[i] != 'F') continue;
        if (i > 0 && std::isalnum(static_cast<unsigned char>(text[i - 1]))) continue;
        std::size_t begin = i + 1;
        if (text[begin] == '/') ++begin;
        std::size_t end = begin;
        while (end < text.size() && (is_digit(text[end]) || text[end] == '.')) ++end;
        while (end > begin && text[end - 1] == '.') --end;
        const auto value = parse_number(text.substr(begin, end - begin));
        if (value && *value >= 0.5 && *value <= 64.0) return value;
    }
    return std::nullopt;
}

}  // namespace ghostlight
