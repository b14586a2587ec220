#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/io/lens_file.h"

namespace ghostlight {

/// What a reader gets: the file's text as UTF-8 and its name, for messages and for files beside it.
struct FormatSource {
    std::string_view text;
    std::filesystem::path file;
};

/// A kind of lens file. One line in the list of formats.cpp adds a kind.
struct LensFormat {
    std::string_view name;        ///< for people: "Zemax"
    std::string_view extensions;  ///< separated by blanks, with their dots: ".zmx"
    /// True when the text looks like this kind, whatever the file is called.
    bool (*recognises)(std::string_view text);
    /// Throws Error naming the file, the line, what was found and what was expected.
    LensFile (*read)(const FormatSource& source);
    /// Null for a kind that is only read. What the format cannot hold goes to the notes.
    std::string (*write)(const Prescription& lens, Notes& notes);
};
std::span<const LensFormat> lens_formats();

/// The format of a text: of those with the file's extension the first that recognises it, else the
/// first of all that does. Throws Error listing the formats.
const LensFormat& format_of(const FormatSource& source);

/// The format to write a file of this name in. Throws Error listing those that can be written.
const LensFormat& writable_format(const std::filesystem::path& file);

}  // namespace ghostlight
