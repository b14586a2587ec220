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

/// Photographs and masks in or below the lens's folder are named from there.
std::string named_from(const std::string& file, const std::filesystem::path& folder) {
    std::filesystem::path named = file;
    if (!folder.empty() && named.is_absolute()) {
        const auto from_there = named.lexically_relative(folder);
        if (!from_there.empty() && *from_there.begin() != "..") named = from_there;
    }
    return named.generic_string();
}

void find_in(std::string& file, const std::filesystem::path& folder) {
    if (!file.empty() && !folder.empty() && std::filesystem::path(file).is_relative())
        file = (folder / file).string();
}

/// What is not as at first.
Json photo_json(const FitPhotoSetup& photo, const std::filesystem::path& folder) {
    Json json = {{"file", named_from(photo.file, folder)}, {"light", photo.light}};
    if (!photo.mask_file.empty()) json["mask"] = named_from(photo.mask_file, folder);
    if (!photo.masked.empty()) json["masked_px"] = text_of(photo.masked);
    if (photo.crop) json["crop_px"] = text_of(*photo.crop);
    if (photo.width_mm) json["width_mm"] = *photo.width_mm;
    if (photo.axis) json["axis_px"] = text_of(*photo.axis);
    if (photo.rotation_deg != 0.0) json["rotation_deg"] = photo.rotation_deg;
    if (photo.noise) json["noise"] = text_of(*photo.noise);
    if (photo.saturation) json["saturation"] = *photo.saturation;
    return json;
}

/// Takes a field's text where `parse` does.
template <class Parse>
void read_parsed(const Json& object, const char* key, const Parse& parse) {
    std::string text;
    read_text(object, key, text);
    if (text.empty()) return;
    try {
        parse(text);
    } catch (const Error&) {
        // As at first.
    }
}

void read_number(const Json& object, const char* key, double low, double high, auto& number) {
    const auto at = object.find(key);
    if (at == object.end() || !at->is_number()) return;
    const double value = at->get<double>();
    if (value >= low && value <= high) number = value;
}

FitPhotoSetup photo_of(const Json& json, const std::filesystem::path& folder) {
    FitPhotoSetup photo;
    read_text(json, "file", photo.file);
    read_text(json, "light", photo.light);
    read_text(json, "mask", photo.mask_file);
    find_in(photo.file, folder);
    find_in(photo.mask_file, folder);
    read_parsed(json, "masked_px",
                [&](const auto& text) { photo.masked = parse_mask_regions(text); });
    read_parsed(json, "crop_px", [&](const auto& text) { photo.crop = parse_file_box(text); });
    read_parsed(json, "axis_px", [&](const auto& text) { photo.axis = parse_file_point(text); });
    read_parsed(json, "noise", [&](const auto& text) { photo.noise = parse_noise(text); });
    read_number(json, "width_mm", 1e-3, 1e6, photo.width_mm);
    read_number(json, "rotation_deg", -360.0, 360.0, photo.rotation_deg);
    read_number(json, "saturation", 1e-9, 1e9, photo.saturation);
    return photo;
}

}  // namespace

std::string fit_setup_to_json(const FitSetup& setup, const std::filesystem::path& folder) {
    Json photos = Json::array();
    for (const FitPhotoSetup& photo : setup.photos) photos.push_back(photo_json(photo, folder));
    return compact_json(Json{{"photos", std::move(photos)},
                             {"vary", setup.vary},
                             {"held", setup.held},
                             {"spectrum", setup.spectrum},
                             {"merge", setup.merge},
                             {"loss", name(setup.loss)},
                             {"loss_scale", setup.loss_scale},
                             {"leave_out", setup.left_out},
                             {"use_ghosts", setup.only},
                             {"samples", setup.across},
                             {"starts", setup.starts},
                             {"suggest", setup.suggestions},
                             {"kinds", setup.kinds},
                             {"kind_rows", setup.kind_rows},
                             {"profile", setup.profiled},
                             {"bootstrap", setup.bootstrap},
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
                if (FitPhotoSetup photo = photo_of(each, folder); !photo.file.empty())
                    setup.photos.push_back(std::move(photo));
            }
        read_text(json, "vary", setup.vary);
        read_text(json, "held", setup.held);
        read_text(json, "spectrum", setup.spectrum);
        if (const auto at = json.find("merge"); at != json.end() && at->is_boolean())
            setup.merge = at->get<bool>();
        read_parsed(json, "loss", [&](const auto& word) { setup.loss = parse_loss(word); });
        read_number(json, "loss_scale", 1e-3, 1e6, setup.loss_scale);
        read_text(json, "leave_out", setup.left_out);
        read_text(json, "use_ghosts", setup.only);
        read_count(json, "samples", 16, 512, setup.across);
        read_count(json, "starts", 1, 100, setup.starts);
        read_count(json, "suggest", 0, 50, setup.suggestions);
        read_text(json, "kinds", setup.kinds);
        read_text(json, "kind_rows", setup.kind_rows);
        read_text(json, "profile", setup.profiled);
        read_count(json, "bootstrap", 0, 1000, setup.bootstrap);
        read_count(json, "seed", 0, 1e9, setup.seed);
    } catch (const Error&) {
        // Text that is no JSON is no set-up.
    }
    return setup;
}

}  // namespace ghostlight
