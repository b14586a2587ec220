#include "core/io/frame_sequence.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "core/flare/tone_map.h"
#include "core/io/aside_file.h"
#include "core/io/refuse_file.h"
#include "core/io/same_name.h"

namespace ghostlight {
namespace {

constexpr std::size_t most_frames = 100'000;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

std::string list_of(const std::vector<long>& numbers) {
    std::string text;
    constexpr std::size_t shown = 8;
    for (std::size_t k = 0; k < std::min(shown, numbers.size()); ++k)
        text += fmt::format("{}{}", k > 0 ? ", " : "", numbers[k]);
    if (numbers.size() > shown) text += fmt::format(" and {} more", numbers.size() - shown);
    return text;
}

}  // namespace

std::filesystem::path FramePattern::file(long frame) const {
    return folder /
           (digits == 0 ? before : fmt::format("{}{:0{}}{}", before, frame, digits, after));
}

FramePattern parse_frame_pattern(const std::string& text) {
    const std::filesystem::path path(text);
    FramePattern pattern{path.parent_path(), path.filename().string(), {}, 0};
    constexpr auto expected = "one run of # in the file's name, such as shot.####.exr";
    if (pattern.folder.string().find('#') != std::string::npos)
        refuse_file(path, "not a name of frames", "# in a folder's name", expected);
    const std::string name = pattern.before;
    const auto first = name.find('#');
    if (first == std::string::npos) return pattern;
    const auto end = name.find_first_not_of('#', first);
    pattern.before = name.substr(0, first);
    pattern.after = end == std::string::npos ? "" : name.substr(end);
    pattern.digits = static_cast<int>((end == std::string::npos ? name.size() : end) - first);
    if (pattern.after.find('#') != std::string::npos || pattern.digits > 9)
        refuse_file(path, "not a name of frames", name, expected);
    return pattern;
}

std::vector<long> frames_of(const FramePattern& pattern) {
    if (pattern.digits == 0) {
        std::error_code unreadable;
        if (!std::filesystem::is_regular_file(pattern.file(0), unreadable))
            refuse_file(pattern.file(0), "no such picture", {}, {});
        return {0};
    }
    std::vector<long> numbers;
    std::error_code unreadable;
    const auto folder = pattern.folder.empty() ? std::filesystem::path(".") : pattern.folder;
    for (std::filesystem::directory_iterator at(folder, unreadable), end; !unreadable && at != end;
         at.increment(unreadable)) {
        const std::string name = at->path().filename().string();
        if (name.size() < pattern.before.size() + pattern.after.size() + 1 ||
            !name.starts_with(pattern.before) || !name.ends_with(pattern.after))
            continue;
        const std::string number = name.substr(
            pattern.before.size(), name.size() - pattern.before.size() - pattern.after.size());
        long value = 0;
        const auto [stop, status] =
            std::from_chars(number.data(), number.data() + number.size(), value);
        if (status != std::errc{} || stop != number.data() + number.size() || value < 0 ||
            pattern.file(value).filename().string() != name)
            continue;
        numbers.push_back(value);
        if (numbers.size() > most_frames)
            refuse_file(folder, "too many frames", {}, fmt::format("at most {}", most_frames));
    }
    const std::string shown =
        pattern.before + std::string(idx(pattern.digits), '#') + pattern.after;
    if (numbers.empty()) refuse_file(folder / shown, "no frame is there", {}, "numbered pictures");
    std::ranges::sort(numbers);
    std::vector<long> missing;
    for (std::size_t k = 1; k < numbers.size(); ++k)
        for (long n = numbers[k - 1] + 1; n < numbers[k] && missing.size() < most_frames; ++n)
            missing.push_back(n);
    if (!missing.empty())
        refuse_file(folder / shown, "frames are missing", "all but " + list_of(missing),
                    fmt::format("every frame from {} to {}, or --frames FIRST:LAST",
                                numbers.front(), numbers.back()));
    return numbers;
}

LinearPicture read_frame(const std::filesystem::path& file, bool clamps) {
    LinearPicture picture = read_linear_picture(file);
    std::size_t bad = 0, first = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        float& value = picture.rgb[i];
        if (std::isfinite(value) && value >= 0.0F) continue;
        if (bad++ == 0) first = i;
        if (clamps) value = 0.0F;
    }
    if (bad > 0 && !clamps) {
        const std::size_t pixel = first / 3;
        refuse_file(file, "a pixel without a usable value",
                    fmt::format("{} at column {}, row {} (from 0, at the top left); {} such values",
                                picture.rgb[first], pixel % idx(picture.width),
                                pixel / idx(picture.width), bad),
                    "finite numbers from 0; --clamp takes others as black");
    }
    return picture;
}

void write_frame(const LinearPicture& picture, const std::filesystem::path& file) {
    const std::string extension = file.extension().string();
    const bool exr = is_same_name(extension, ".exr"), png = is_same_name(extension, ".png");
    const bool tiff = is_same_name(extension, ".tif") || is_same_name(extension, ".tiff");
    if (!exr && !png && !tiff)
        refuse_file(file, "not a picture's name", extension, ".exr, .png or .tif");
    OIIO::ImageSpec spec(picture.width, picture.height, 3,
                         exr ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT16);
    spec.attribute("oiio:ColorSpace", exr ? "Linear" : "sRGB");
    if (exr) spec.attribute("compression", "zip");
    AsideFile aside(file);
    const auto out = OIIO::ImageOutput::create(exr ? "openexr" : png ? "png" : "tiff");
    if (!out) refuse_file(file, "the picture cannot be written: " + OIIO::geterror(), {}, {});
    bool written = out->open(aside.path().string(), spec);
    if (written && exr) {
        written = out->write_image(OIIO::TypeDesc::FLOAT, picture.rgb.data());
    } else if (written) {
        std::vector<std::uint16_t> values(picture.rgb.size());
        std::ranges::transform(picture.rgb, values.begin(), [](float value) {
            return static_cast<std::uint16_t>(
                std::lround(65535.0F * srgb_encoded(std::clamp(value, 0.0F, 1.0F))));
        });
        written = out->write_image(OIIO::TypeDesc::UINT16, values.data());
    }
    if (!written || !out->close())
        refuse_file(file, "the picture cannot be written: " + out->geterror(), {}, {});
    aside.commit();
}

}  // namespace ghostlight
