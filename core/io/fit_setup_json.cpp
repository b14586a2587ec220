#include "core/io/fit_setup_json.h"

#include <cmath>

#include "core/error.h"
#include "core/io/json_value.h"

namespace ghostlight {
namespace {

void read_text(const Json& object, const char* key, std::string& text) {
    if (const auto at = object.find(key); at != object.end() && at->is_string())
        text = at->get<std::string>();
}

template <class Number>
void read_count(const Json& object, const char* key, double low, double high, Number& number) {
    const auto at = object.find(key);
    if (at == object.end() || !at->is_number()) return;
    const double value = at->get<double>();
    if (value >= low && value <= high && value == std::floor(value))
        number = static_cast<Number>(value);
}

}  // namespace

std::string fit_setup_to_json(const FitSetup& setup, const std::filesystem::path& folder) {
    Json photos = Json::array();
    for (const FitPhotoSetup& photo : setup.photos) {
        std::filesystem::path file = photo.file;
        if (!folder.empty() && file.is_absolute()) {
            const auto from_there = file.lexically_relative(folder);
            if (!from_there.empty() && *from_there.begin() != "..") file = from_there;
        }
        photos.push_back(Json{{"file", file.generic_string()}, {"light", photo.light}});
    }
    return compact_json(Json{{"photos", std::move(photos)},
                             {"vary", setup.vary},
                             {"held", setup.held},
                             {"spectrum", setup.spectrum},
                             {"merge", setup.merge},
                             {"samples", setup.across},
                             {"starts", setup.starts},
                             {"suggest", setup.suggestions},
                             {"seed", setup.seed}});
}

FitSetup fit_setup_from_json(std::string_view text, const std::filesystem::path& folder) {
    FitSetup setup;
    if (text.empty()) return setup;
    try {
        const Json json = parse_json(text, "the set-up of the fit");
        if (!json.is_object()) return setup;
        if (const auto photos = json.find("photos"); photos != json.end() && photos->is_array())
            for (const Json& each : *photos) {
                if (!each.is_object()) continue;
                FitPhotoSetup photo;
                read_text(each, "file", photo.file);
                read_text(each, "light", photo.light);
                std::filesystem::path file = photo.file;
                if (photo.file.empty()) continue;
                if (!folder.empty() && file.is_relative()) photo.file = (folder / file).string();
                setup.photos.push_back(std::move(photo));
            }
        read_text(json, "vary", setup.vary);
        read_text(json, "held", setup.held);
        read_text(json, "spectrum", setup.spectrum);
        if (const auto at = json.find("merge"); at != json.end() && at->is_boolean())
            setup.merge = at->get<bool>();
        read_count(json, "samples", 16, 512, setup.across);
        read_count(json, "starts", 1, 100, setup.starts);
        read_count(json, "suggest", 0, 50, setup.suggestions);
        read_count(json, "seed", 0, 1e9, setup.seed);
    } catch (const Error&) {
        // Text that is no JSON is no set-up.
    }
    return setup;
}

}  // namespace ghostlight
