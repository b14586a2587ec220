#include "app/cli/photo_options.h"

#include <fmt/format.h>

#include <cmath>

namespace ghostlight::cli {
namespace {

/// One value for all photographs or one each, an empty one being none, to `take` with its
/// photograph.
template <class Take>
void for_each_photo(std::string_view option, const std::string& text, char separator,
                    std::vector<FitPhotoSetup>& photos, const Take& take) {
    if (text.empty()) return;
    const auto parts = split(text, separator);
    if (parts.size() != 1 && parts.size() != photos.size())
        throw bad_value(option, text,
                        fmt::format("one, or one for each photograph, separated by {}",
                                    separator == ';' ? "semicolons" : "commas"));
    for (std::size_t i = 0; i < photos.size(); ++i) {
        const std::string_view part = parts[parts.size() == 1 ? 0 : i];
        if (!part.empty()) take(photos[i], part);
    }
}

double positive(std::string_view option, std::string_view text, std::string_view expected) {
    return number_value(option, text, expected, [](double value) { return value > 0.0; });
}

}  // namespace

void add_photos(CLI::App& command, PhotoOptions& options) {
    add_text(command, "--photo", options.files, "F[,F...]",
             "EXR, TIFF, PNG, JPEG or RAW, one or several angles of the light")
        ->required();
    command.add_flag("--merge", options.merge,
                     "the photographs are exposures of one scene: merge them first");
    add_text(command, "--light", options.lights, "auto|X,Y|deg:F:A",
             "where its image is: found, pixels from the upper left corner, or a direction;\n"
             "one for all photographs or one each, separated by semicolons, as all that follow")
        ->capture_default_str();
    add_text(command, "--photo-mask", options.masks, "F[,F...]",
             "pictures, bright where not to look");
    add_text(command, "--mask-region", options.regions, "X,Y,X,Y,X,Y",
             "corners of a region where not to look, pixels, or brush:D:X,Y,...; several with /");
    add_text(command, "--crop", options.crops, "X,Y,W,H",
             "the part that counts, pixels from the upper left corner; default: all");
    add_text(command, "--photo-width", options.widths_mm, "MM",
             "width of the whole picture on the sensor; default: the sensor's");
    add_text(command, "--principal", options.principals, "X,Y",
             "the axis in the picture, pixels; default: its middle");
    add_text(command, "--rotation", options.rotations_deg, "DEG", "of the camera about the axis")
        ->capture_default_str();
    add_text(
        command, "--photo-noise", options.noises, "SHOT,READ",
        "variance = SHOT x value + READ, 1 being full scale; default: the file's, or estimated");
    add_text(command, "--saturation", options.saturations, "X",
             "values from here on are clipped; default: the file's largest");
}

FitSetup photo_setup_of(const PhotoOptions& options) {
    FitSetup setup;
    setup.merge = options.merge;
    for (const auto file : split(options.files, ','))
        setup.photos.emplace_back().file = std::string(file);
    auto& photos = setup.photos;
    for_each_photo("--light", options.lights, ';', photos,
                   [](FitPhotoSetup& photo, auto text) { photo.light = text; });
    for_each_photo("--photo-mask", options.masks, ',', photos,
                   [](FitPhotoSetup& photo, auto text) { photo.mask_file = text; });
    const auto parsed = [&](std::string_view option, const std::string& text, auto field,
                            const auto& parse) {
        for_each_photo(option, text, ';', photos, [&](FitPhotoSetup& photo, std::string_view part) {
            photo.*field = read_option(option, [&] { return parse(part); });
        });
    };
    parsed("--mask-region", options.regions, &FitPhotoSetup::masked, parse_mask_regions);
    parsed("--crop", options.crops, &FitPhotoSetup::crop, parse_file_box);
    parsed("--principal", options.principals, &FitPhotoSetup::axis, parse_file_point);
    parsed("--photo-noise", options.noises, &FitPhotoSetup::noise, parse_noise);
    for_each_photo("--photo-width", options.widths_mm, ';', photos, [](auto& photo, auto text) {
        photo.width_mm = positive("--photo-width", text, "the picture's width in mm");
    });
    for_each_photo("--rotation", options.rotations_deg, ';', photos, [](auto& photo, auto text) {
        photo.rotation_deg = number_value("--rotation", text, "degrees from -180 to 180",
                                          [](double value) { return std::abs(value) <= 180.0; });
    });
    for_each_photo("--saturation", options.saturations, ';', photos, [](auto& photo, auto text) {
        photo.saturation = positive("--saturation", text, "a value above 0");
    });
    return setup;
}

}  // namespace ghostlight::cli
