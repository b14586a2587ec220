#pragma once

#include <filesystem>
#include <string_view>

#include "core/io/catalogued_glass.h"

namespace ghostlight {

/// Reads a material of the refractiveindex.info database (YAML): formula 1 to 9, tabulated n, nk or
/// k. Its name is the file's and its catalogue the folder's. Aliases and deep nesting, which those
/// files never have, are refused. Throws Error naming file and line.
GlassFile material_from_yaml(std::string_view text, const std::filesystem::path& file);

GlassFile read_material_yaml(const std::filesystem::path& file);

}  // namespace ghostlight
