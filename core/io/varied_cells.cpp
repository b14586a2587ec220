#include "core/io/varied_cells.h"

#include "core/io/json_value.h"

namespace ghostlight {

std::set<std::string> varied(const Surface& surface) {
    std::set<std::string> kinds;
    const auto field = surface.unknown.find(std::string(vary_field));
    if (field == surface.unknown.end()) return kinds;
    const Json list = Json::parse(field->second, nullptr, false);
    if (!list.is_array()) return kinds;
    for (const Json& kind : list)
        if (kind.is_string()) kinds.insert(kind.get<std::string>());
    return kinds;
}

void set_varied(Surface& surface, std::string_view kind, bool varies) {
    std::set<std::string> kinds = varied(surface);
    if (varies)
        kinds.insert(std::string(kind));
    else
        kinds.erase(std::string(kind));
    if (kinds.empty()) {
        surface.unknown.erase(std::string(vary_field));
        return;
    }
    Json list = Json::array();
    for (const std::string& each : kinds) list.push_back(each);
    surface.unknown[std::string(vary_field)] = compact_json(list);
}

std::string vary_text(const Prescription& lens) {
    std::string text;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
        for (const std::string& kind : varied(lens.surfaces[row]))
            text += (text.empty() ? "" : ",") + kind + "@" + std::to_string(row + 1);
    return text;
}

}  // namespace ghostlight
