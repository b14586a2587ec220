#pragma once

#include <filesystem>
#include <string>

namespace ghostlight {

/// The whole of a file, up to 16 MiB. Throws Error naming the file and why it cannot be read.
std::string read_text(const std::filesystem::path& file);

}  // namespace ghostlight
