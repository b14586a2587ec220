#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ghostlight {

/// The whole of a file, up to 16 MiB. Throws Error naming the file and why it cannot be read.
std::string read_text(const std::filesystem::path& file);

/// Bytes as UTF-8 without a byte-order mark: UTF-16 where a mark (or every second byte being zero)
/// says so, UTF-8 where the bytes are that, else Latin-1.
std::string utf8_text(std::string_view bytes);

}  // namespace ghostlight
