#include "core/ghosts/ghost_path.h"

#include <fmt/format.h>

#include <charconv>

#include "core/error.h"

namespace ghostlight {
namespace {

constexpr std::string_view sensor_word = "sensor";

[[noreturn]] void refuse(std::string_view text, const std::string& problem) {
    throw Error({.problem = problem,
                 .file = {},
                 .where = {},
                 .found = fmt::format("ghost '{}'", text),
                 .expected =
                     "direct, or two surfaces that reflect, like 5-3 (the later one first), or "
                     "sensor-3 where the sensor reflects"});
}

std::size_t surface_number(std::string_view word, std::string_view text) {
    std::size_t number = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (problem != std::errc{} || end != word.data() + word.size() || word.empty())
        refuse(text, "a ghost is named by surface numbers");
    return number;
}

}  // namespace

std::string name(const GhostPath& path, std::size_t surface_count) {
    if (path.is_direct()) return "direct";
    std::string text;
    for (const std::size_t surface : path.reflections) {
        if (!text.empty()) text += '-';
        text += surface == surface_count ? std::string(sensor_word) : std::to_string(surface + 1);
    }
    return text;
}

GhostPath parse_ghost(std::string_view text, const OpticalSystem& system) {
    GhostPath path;
    if (text == "direct") return path;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t dash = std::min(text.find('-', begin), text.size());
        const std::string_view word = text.substr(begin, dash - begin);
        begin = dash + 1;
        if (word == sensor_word) {
            if (!system.sensor_face)
                refuse(text, "the sensor of this lens does not reflect (it has no reflectance)");
            path.reflections.push_back(system.surfaces.size());
            continue;
        }
        const std::size_t number = surface_number(word, text);
        if (number < 1 || number > system.surfaces.size())
            refuse(text, fmt::format("surface {} does not exist; this lens has surfaces 1 to {}",
                                     number, system.surfaces.size()));
        if (!system.surfaces[number - 1].reflects)
            refuse(text, fmt::format("surface {} does not reflect (same medium on both sides, no "
                                     "coating)",
                                     number));
        path.reflections.push_back(number - 1);
    }
    if (path.reflections.size() % 2 != 0)
        refuse(text, "light reaches the sensor only after an even number of reflections");
    for (std::size_t k = 1; k < path.reflections.size(); ++k) {
        const bool backwards = k % 2 == 1;
        const bool in_order = backwards ? path.reflections[k] < path.reflections[k - 1]
                                        : path.reflections[k] > path.reflections[k - 1];
        if (!in_order) refuse(text, "the reflections are not in an order that light can take");
    }
    return path;
}

std::vector<PathEvent> events(const GhostPath& path, std::size_t surface_count) {
    std::vector<PathEvent> result;
    result.reserve((1 + path.reflections.size()) * (surface_count + 1));
    std::size_t surface = 0;
    bool forward = true;
    for (const std::size_t turn : path.reflections) {
        for (; surface != turn; forward ? ++surface : --surface)
            result.push_back({surface, false, forward});
        result.push_back({turn, true, forward});
        forward = !forward;
        forward ? ++surface : --surface;
    }
    for (; surface < surface_count; ++surface) result.push_back({surface, false, true});
    return result;
}

bool can_turn(const OpticalSystem& system, std::size_t row) {
    return row < turning_count(system) && surface_at(system, row).reflects;
}

std::vector<GhostPath> two_reflection_ghosts(const OpticalSystem& system) {
    std::vector<GhostPath> ghosts;
    for (std::size_t i = 1; i < turning_count(system); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (can_turn(system, i) && can_turn(system, j)) ghosts.push_back({{i, j}});
    return ghosts;
}

}  // namespace ghostlight
