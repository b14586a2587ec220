#include "core/ghosts/ghost_sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace ghostlight {
namespace {

template <class Sum>
void largest_first(std::vector<Sum>& sums) {
    std::ranges::stable_sort(
        sums, [](const Sum& a, const Sum& b) { return a.sum.flux_mm2 > b.sum.flux_mm2; });
}

}  // namespace

GhostSum& GhostSum::operator+=(const GhostRow& row) {
    flux_mm2 += row.flux_mm2;
    on_sensor_mm2 += row.flux_mm2 * row.on_sensor;
    ++ghosts;
    return *this;
}

GhostSum sum_of(const GhostTable& table) {
    GhostSum all;
    for (const GhostRow& row : table.ghosts) all += row;
    return all;
}

std::vector<SurfaceSum> sums_by_surface(const GhostTable& table) {
    std::map<std::size_t, GhostSum> by_surface;
    for (const GhostRow& row : table.ghosts)
        for (const std::size_t surface :
             std::set(row.path.reflections.begin(), row.path.reflections.end()))
            by_surface[surface] += row;
    std::vector<SurfaceSum> sums;
    for (const auto& [surface, sum] : by_surface) sums.push_back({surface, sum});
    largest_first(sums);
    return sums;
}

std::vector<std::string> elements_of(const Prescription& lens) {
    std::vector<std::string> elements;
    int element = 0;  // the one in front of the row, if it is glass
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        const bool glass_before = !is_air(medium_before(lens, row));
        const bool glass_after = !is_air(lens.surfaces[row].medium_after);
        std::string text = glass_before ? fmt::format("{}", element) : "";
        if (glass_after) {
            ++element;
            text += fmt::format("{}{}", glass_before ? "+" : "", element);
        }
        elements.push_back(text);
    }
    elements.push_back("sensor");
    return elements;
}

std::vector<ElementSum> sums_by_element(const GhostTable& table, const Prescription& lens) {
    const std::vector<std::string> elements = elements_of(lens);
    std::map<std::pair<std::string, std::string>, GhostSum> by_pair;
    for (const GhostRow& row : table.ghosts) {
        const auto& turns = row.path.reflections;
        if (turns.size() == 2) by_pair[{elements[turns[0]], elements[turns[1]]}] += row;
    }
    std::vector<ElementSum> sums;
    for (const auto& [pair, sum] : by_pair) sums.push_back({pair.first, pair.second, sum});
    largest_first(sums);
    return sums;
}

}  // namespace ghostlight
