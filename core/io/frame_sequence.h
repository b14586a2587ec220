#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/scene_pictures.h"

namespace ghostlight {

/// A numbered sequence of pictures: "shot.####.exr" has numbers of at least four digits. A name
/// without "#" is one picture.
struct FramePattern {
    std::filesystem::path folder;
    std::string before, after;
    int digits = 0;  ///< 0: one picture

    std::filesystem::path file(long frame) const;
};
/// Throws Error for more than one run of "#", or one outside the file's name.
FramePattern parse_frame_pattern(const std::string& text);

/// The numbers of the files that are there, rising. Throws Error when there is none, or when
/// numbers between the first and the last are missing.
std::vector<long> frames_of(const FramePattern& pattern);

/// As read_linear_picture(), and refuses NaN, infinite and negative values, naming the first pixel
/// and their number; with `clamps` they are taken as black instead.
LinearPicture read_frame(const std::filesystem::path& file, bool clamps);

/// Writes a picture by its name's extension: .exr as 32-bit float linear Rec.709, .png and .tif as
/// sRGB of 16 bits. Aside and renamed. Throws Error.
void write_frame(const LinearPicture& picture, const std::filesystem::path& file);

}  // namespace ghostlight
