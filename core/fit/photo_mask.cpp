#include "core/fit/photo_mask.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace ghostlight {
namespace {

constexpr std::string_view brush_word = "brush:";

[[noreturn]] void refuse(std::string problem, std::string_view text, const char* expected) {
    throw Error({.problem = std::move(problem),
                 .file = {},
                 .where = {},
                 .found = fmt::format("'{}'", text.substr(0, 80)),
                 .expected = expected});
}

/// Numbers separated by commas; nothing where one cannot be read.
std::optional<std::vector<double>> numbers_in(std::string_view text) {
    std::vector<double> numbers;
    for (;;) {
        const std::size_t comma = text.find(',');
        std::string_view part = text.substr(0, comma);
        while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
        while (!part.empty() && part.back() == ' ') part.remove_suffix(1);
        double value = 0.0;
        const auto [end, problem] = std::from_chars(part.data(), part.data() + part.size(), value);
        if (problem != std::errc{} || end != part.data() + part.size() || !std::isfinite(value))
            return std::nullopt;
        numbers.push_back(value);
        if (comma == std::string_view::npos) return numbers;
        text.remove_prefix(comma + 1);
    }
}

std::vector<FilePoint> points_of(const std::vector<double>& numbers) {
    std::vector<FilePoint> points;
    for (std::size_t k = 0; k + 1 < numbers.size(); k += 2)
        points.push_back({numbers[k], numbers[k + 1]});
    return points;
}

double distance_px(const FilePoint& point, const FilePoint& a, const FilePoint& b) {
    const double dx = b.x_px - a.x_px, dy = b.y_px - a.y_px;
    const double squared = dx * dx + dy * dy;
    const double along =
        squared > 0.0
            ? std::clamp(((point.x_px - a.x_px) * dx + (point.y_px - a.y_px) * dy) / squared, 0.0,
                         1.0)
            : 0.0;
    return std::hypot(point.x_px - a.x_px - along * dx, point.y_px - a.y_px - along * dy);
}

/// Where the line y = const crosses the polygon's sides, sorted.
std::vector<double> crossings(const std::vector<FilePoint>& points, double y_px) {
    std::vector<double> at;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const FilePoint &a = points[k], &b = points[(k + 1) % points.size()];
        if ((a.y_px <= y_px) == (b.y_px <= y_px)) continue;
        at.push_back(a.x_px + (y_px - a.y_px) * (b.x_px - a.x_px) / (b.y_px - a.y_px));
    }
    std::ranges::sort(at);
    return at;
}

void mask_pixel(Photo& photo, int x, int y, char reason) {
    // Upright pictures are mirrored left to right against the sensor's frame.
    char& masked =
        photo.masked[static_cast<std::size_t>(y) * static_cast<std::size_t>(photo.width_px) +
                     static_cast<std::size_t>(photo.width_px - 1 - x)];
    if (!masked) masked = reason;
}

/// First and past-the-last pixel of `size` whose middles lie between two places.
std::pair<int, int> pixels_between(double low_px, double high_px, int size) {
    const double limit = size;
    const int first = static_cast<int>(std::ceil(std::clamp(low_px - 0.5, 0.0, limit)));
    const int past = static_cast<int>(std::floor(std::clamp(high_px - 0.5, -1.0, limit - 1.0))) + 1;
    return {first, std::max(first, past)};
}

}  // namespace

FilePoint parse_file_point(std::string_view text) {
    const auto numbers = numbers_in(text);
    if (!numbers || numbers->size() != 2)
        refuse("a place in the photograph cannot be read", text,
               "X,Y in pixels from the upper left corner");
    return {(*numbers)[0], (*numbers)[1]};
}

std::string text_of(const FilePoint& point) { return fmt::format("{},{}", point.x_px, point.y_px); }

FileBox parse_file_box(std::string_view text) {
    const auto numbers = numbers_in(text);
    if (!numbers || numbers->size() != 4 || !((*numbers)[2] > 0.0) || !((*numbers)[3] > 0.0))
        refuse("a part of the photograph cannot be read", text,
               "X,Y,WIDTH,HEIGHT in pixels, X,Y its upper left corner");
    return {(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
}

std::string text_of(const FileBox& box) {
    return fmt::format("{},{},{},{}", box.left_px, box.top_px, box.width_px, box.height_px);
}

std::vector<MaskRegion> parse_mask_regions(std::string_view text) {
    constexpr const char* expected =
        "X,Y,X,Y,X,Y (three corners or more) or brush:DIAMETER:X,Y,..., pixels; several separated "
        "by slashes";
    std::vector<MaskRegion> regions;
    while (!text.empty()) {
        const std::size_t slash = text.find('/');
        const std::string_view whole = text.substr(0, slash);
        std::string_view part = whole;
        MaskRegion region;
        if (part.starts_with(brush_word)) {
            part.remove_prefix(brush_word.size());
            const std::size_t colon = part.find(':');
            const auto breadth = numbers_in(part.substr(0, colon));
            if (colon == std::string_view::npos || !breadth || breadth->size() != 1 ||
                !(breadth->front() > 0.0))
                refuse("a masked region cannot be read", whole, expected);
            region.brush_px = breadth->front();
            part.remove_prefix(colon + 1);
        }
        const auto numbers = numbers_in(part);
        if (!numbers || numbers->size() % 2 != 0 || (region.brush_px == 0.0 && numbers->size() < 6))
            refuse("a masked region cannot be read", whole, expected);
        region.points = points_of(*numbers);
        regions.push_back(std::move(region));
        if (slash == std::string_view::npos) break;
        text.remove_prefix(slash + 1);
    }
    return regions;
}

std::string text_of(const std::vector<MaskRegion>& regions) {
    std::string text;
    for (const MaskRegion& region : regions) {
        if (!text.empty()) text += '/';
        if (region.brush_px > 0.0) text += fmt::format("{}{}:", brush_word, region.brush_px);
        for (std::size_t k = 0; k < region.points.size(); ++k)
            text += (k > 0 ? "," : "") + text_of(region.points[k]);
    }
    return text;
}

bool covers(const MaskRegion& region, const FilePoint& point) {
    const auto& points = region.points;
    if (region.brush_px > 0.0) {
        for (std::size_t k = 0; k < points.size(); ++k)
            if (distance_px(point, points[k == 0 ? 0 : k - 1], points[k]) <= 0.5 * region.brush_px)
                return true;
        return false;
    }
    const std::vector<double> at = crossings(points, point.y_px);
    return std::ranges::count_if(at, [&](double x) { return x <= point.x_px; }) % 2 != 0;
}

void mask_region(Photo& photo, const MaskRegion& region) {
    photo.masked.resize(photo.pixels(), 0);
    const auto& points = region.points;
    if (points.empty()) return;
    const auto [top, bottom] = std::ranges::minmax(points, {}, &FilePoint::y_px);
    const double half = 0.5 * region.brush_px;
    const auto [first, past] = pixels_between(top.y_px - half, bottom.y_px + half, photo.height_px);
    for (int y = first; y < past; ++y) {
        if (region.brush_px == 0.0) {
            const std::vector<double> at = crossings(points, y + 0.5);
            for (std::size_t k = 0; k + 1 < at.size(); k += 2) {
                const auto [left, right] = pixels_between(at[k], at[k + 1], photo.width_px);
                for (int x = left; x < right; ++x) mask_pixel(photo, x, y, mask_reason::painted);
            }
            continue;
        }
        for (std::size_t k = 0; k < points.size(); ++k) {
            const FilePoint &a = points[k == 0 ? 0 : k - 1], &b = points[k];
            if (y + 0.5 < std::min(a.y_px, b.y_px) - half ||
                y + 0.5 > std::max(a.y_px, b.y_px) + half)
                continue;
            const auto [left, right] = pixels_between(
                std::min(a.x_px, b.x_px) - half, std::max(a.x_px, b.x_px) + half, photo.width_px);
            for (int x = left; x < right; ++x)
                if (distance_px({x + 0.5, y + 0.5}, a, b) <= half)
                    mask_pixel(photo, x, y, mask_reason::painted);
        }
    }
}

void mask_outside(Photo& photo, const FileBox& box) {
    photo.masked.resize(photo.pixels(), 0);
    const auto [left, right] =
        pixels_between(box.left_px, box.left_px + box.width_px, photo.width_px);
    const auto [top, bottom] =
        pixels_between(box.top_px, box.top_px + box.height_px, photo.height_px);
    if (left >= right || top >= bottom)
        throw Error({.problem = "nothing of the photograph is inside of the part that counts",
                     .file = photo.file,
                     .where = {},
                     .found = text_of(box),
                     .expected = fmt::format("X,Y,WIDTH,HEIGHT within {} x {} pixels",
                                             photo.width_px, photo.height_px)});
    for (int y = 0; y < photo.height_px; ++y)
        for (int x = 0; x < photo.width_px; ++x)
            if (x < left || x >= right || y < top || y >= bottom)
                mask_pixel(photo, x, y, mask_reason::cropped);
}

}  // namespace ghostlight
