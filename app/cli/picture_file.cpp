#include "app/cli/picture_file.h"

#include <algorithm>
#include <filesystem>

#include "app/cli/options.h"

namespace ghostlight::cli {

std::string picture_extension(const std::string& file) {
    std::string extension = std::filesystem::path(file).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (extension != ".exr" && extension != ".png" && extension != ".tif" && extension != ".tiff")
        throw bad_value("--output", file, "a file name that ends in .exr, .png, .tif or .tiff");
    return extension;
}

std::optional<double> exposure_value(std::string_view text, std::string_view extension) {
    if (text.empty()) return std::nullopt;
    if (extension == ".exr")
        throw Error(
            "--exposure: an EXR file holds linear values; the exposure is for .png and .tif");
    return number_value("--exposure", text, "stops from -64 to 64",
                        [](double ev) { return ev >= -64.0 && ev <= 64.0; });
}

}  // namespace ghostlight::cli
