#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "core/error.h"

namespace ghostlight {

/// Throws Error about a whole file.
[[noreturn]] inline void refuse_file(const std::filesystem::path& file, std::string problem,
                                     std::string found = {}, std::string expected = {}) {
    throw Error({.problem = std::move(problem),
                 .file = file.string(),
                 .where = {},
                 .found = std::move(found),
                 .expected = std::move(expected)});
}

}  // namespace ghostlight
