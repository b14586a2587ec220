#include "core/io/coating_library.h"

#include <algorithm>
#include <system_error>

#include "core/error.h"
#include "core/io/coating_json.h"
#include "core/io/json_value.h"
#include "core/io/lens_file.h"
#include "core/io/read_text.h"
#include "core/io/same_name.h"

namespace ghostlight {
namespace {

constexpr long schema_version = 1;

std::vector<LibraryCoating> read_library(const std::filesystem::path& folder) {
    std::vector<LibraryCoating> coatings;
    std::error_code status;
    for (const auto& entry : std::filesystem::directory_iterator(folder, status))
        if (entry.path().extension() == ".json")
            coatings.push_back(library_coating_from_json(read_text(entry.path()), entry.path()));
    std::ranges::sort(coatings, {}, &LibraryCoating::name);
    return coatings;
}

}  // namespace

LibraryCoating library_coating_from_json(std::string_view text, const std::filesystem::path& file) {
    const std::string name = file.string();
    const Json json = parse_json(text, name);
    const JsonAt root(json, name);
    root.require_object("a coating {…}");
    root.at("ghostlight_coating", "version 1").integer(1, schema_version, "version 1");
    UnknownFields unknown;
    LibraryCoating coating;
    coating.file = file;
    coating.name = root.at("name", "the coating's name").text();
    if (coating.name.empty()) root.at("name", "a name").refuse("no name", "a name");
    coating.title = optional_text(root, "title");
    coating.source = optional_text(root, "source");
    coating.notes = optional_text(root, "notes");
    coating.design_nm = optional_number(root, "design_nm").value_or(0.0);
    coating.substrate_index = optional_number(root, "substrate_index").value_or(0.0);
    coating.coating = read_described_coating(root.at("coating", "a coating"), unknown);
    // Lenses name it; whatever becomes of it carries that name.
    if (auto* stack = std::get_if<LayerStack>(&coating.coating)) stack->name = coating.name;
    if (auto* table = std::get_if<MeasuredReflectance>(&coating.coating))
        table->name = coating.name;
    keep_unknown(root,
                 {"ghostlight_coating", "name", "title", "source", "notes", "design_nm",
                  "substrate_index", "coating"},
                 unknown);
    if (!unknown.empty())
        root.refuse("a field of the coating is not known: " + unknown.begin()->first,
                    "the fields of docs/formats-catalogues.md");
    return coating;
}

const std::vector<LibraryCoating>& coating_library() {
    static const std::vector<LibraryCoating> library = read_library(data_directory() / "coatings");
    return library;
}

const Coating* find_coating(std::string_view name) {
    for (const LibraryCoating& each : coating_library())
        if (is_same_name(each.name, name)) return &each.coating;
    return nullptr;
}

std::vector<std::string> coating_names() {
    std::vector<std::string> names;
    for (const LibraryCoating& each : coating_library()) names.push_back(each.name);
    return names;
}

}  // namespace ghostlight
