#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/io/coating_dat.h"
#include "core/io/coating_library.h"
#include "core/io/glass_library.h"
#include "core/io/same_name.h"
#include "core/io/word_lines.h"
#include "core/units.h"

namespace ghostlight {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_layers = 2000;

/// A layer of the material, without its thickness.
Layer layer_of(const CoatingFile& file, const std::string& material, const std::string& where) {
    for (const CoatingMaterial& known : file.materials) {
        if (!is_same_name(known.name, material)) continue;
        Layer layer;
        layer.medium = {known.name, TabulatedGlass{known.n, true}};
        if (std::ranges::any_of(known.k, [](const SpectralValue& at) { return at.value > 0.0; }))
            layer.extinction_table = known.k;
        return layer;
    }
    if (const auto glass = find_glass(material, {})) return {glass->glass.medium};
    throw Error({.problem = fmt::format("coating material {} is not known", material),
                 .file = file.file.string(),
                 .where = where,
                 .found = material,
                 .expected = "a MATE of the file, or a glass of the catalogues"});
}

LayerStack stack_of(const CoatingFile& file, const ListedCoating& listed,
                    const ListedLayers& definition, double primary_nm) {
    LayerStack stack{{}, true, listed.name};
    const auto& layers = definition.layers;
    for (std::size_t begin = 0; begin < layers.size();) {
        // Neighbours with one loop index repeat together.
        std::size_t end = begin + 1;
        const int repeats = layers[begin].repeats;
        while (repeats > 0 && end < layers.size() && layers[end].repeats == repeats) ++end;
        std::vector<Layer> group;
        for (std::size_t i = begin; i < end; ++i) {
            Layer layer = layer_of(file, layers[i].material, listed.where);
            layer.thickness_nm = layers[i].in_um ? nm_from_um(layers[i].thickness)
                                                 : layers[i].thickness * primary_nm /
                                                       refractive_index(layer.medium, primary_nm);
            group.push_back(std::move(layer));
        }
        const auto times = static_cast<std::size_t>(std::max(repeats, 1));
        if (stack.layers.size() + times * group.size() > most_layers)
            throw Error({.problem = fmt::format("coating {} has too many layers", listed.name),
                         .file = file.file.string(),
                         .where = listed.where,
                         .found = fmt::format("{}", stack.layers.size() + times * group.size()),
                         .expected = fmt::format("at most {}", most_layers)});
        for (std::size_t k = 0; k < times; ++k)
            stack.layers.insert(stack.layers.end(), group.begin(), group.end());
        begin = end;
    }
    return stack;
}

Note assumed(std::string text) {
    return {
        Note::Severity::warning, {},   std::move(text),
        Note::Fate::assumed,     true, "put the COATING.DAT that the lens was made with beside it"};
}

/// The names that come with Zemax. What its own file says of HEAR1 and WAR is not public: their
/// kinds stand in for them.
std::optional<ResolvedCoating> zemax_name(std::string_view name, double primary_nm) {
    const std::string key = upper_case(name);
    if (key.starts_with("I.")) {
        const auto t = parse_number(std::string_view(key).substr(1));
        if (!t || *t < 0.0 || *t > 1.0) return std::nullopt;
        return ResolvedCoating{
            ConstantReflectance{1.0 - *t, *t},
            "Zemax name",
            {assumed(fmt::format("{}: an ideal coating that transmits {} and reflects the rest",
                                 key, *t))}};
    }
    if (key == "AR")
        return ResolvedCoating{
            QuarterWave{.center_nm = primary_nm},
            "Zemax name",
            {assumed(fmt::format("AR: a quarter wave of MgF2 at {} nm", primary_nm))}};
    const char* stand_in = key == "HEAR1" ? "three-layer-quarter-half-quarter"
                           : key == "WAR" ? "two-layer-quarter-half"
                                          : nullptr;
    const Coating* coating = stand_in != nullptr ? find_coating(stand_in) : nullptr;
    if (coating == nullptr) return std::nullopt;
    return ResolvedCoating{
        *coating,
        "library",
        {assumed(fmt::format("{}: its layers are not in the lens file; {} of the "
                             "library stands in for it",
                             key, stand_in))}};
}

std::optional<fs::path> in_folder(const fs::path& folder, std::string_view name) {
    std::error_code status;
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, status))
        if (is_same_name(entry.path().filename().string(), name)) found.push_back(entry.path());
    if (found.empty()) return std::nullopt;
    return *std::ranges::min_element(found);
}

}  // namespace

std::optional<Coating> coating_of(const CoatingFile& file, std::string_view name,
                                  double primary_nm) {
    const auto listed = std::ranges::find_if(
        file.coatings, [&](const ListedCoating& each) { return is_same_name(each.name, name); });
    if (listed == file.coatings.end()) return std::nullopt;
    if (const auto* ready = std::get_if<Coating>(&listed->definition)) return *ready;
    return stack_of(file, *listed, std::get<ListedLayers>(listed->definition), primary_nm);
}

std::optional<fs::path> find_coating_file(const fs::path& lens_file, std::string_view name) {
    // The name may be a path on the machine that wrote the lens.
    const auto slash = name.find_last_of("/\\");
    if (slash != name.npos) name.remove_prefix(slash + 1);
    if (name.empty()) return std::nullopt;
    const fs::path folder = lens_file.has_parent_path() ? lens_file.parent_path() : fs::path(".");
    if (auto found = in_folder(folder, name)) return found;
    const auto below = in_folder(folder, "COATINGS");
    return below ? in_folder(*below, name) : std::nullopt;
}

std::optional<ResolvedCoating> resolve_coating(std::string_view name, const CoatingFile* file,
                                               double primary_nm) {
    if (file != nullptr)
        if (auto found = coating_of(*file, name, primary_nm))
            return ResolvedCoating{std::move(*found), file->file.string(), {}};
    if (const Coating* known = find_coating(name)) return ResolvedCoating{*known, "library", {}};
    return zemax_name(name, primary_nm);
}

}  // namespace ghostlight
