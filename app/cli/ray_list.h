#pragma once

#include <glm/vec2.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace ghostlight::cli {

/// Points of the plane z = 0, mm, from CSV: a header line that has px_mm and py_mm among its
/// names, then one ray a line. Blank lines and lines that start with # are skipped, other columns
/// ignored. Throws Error with `file` and the line.
std::vector<glm::dvec2> rays_from_csv(std::string_view text, const std::string& file);

/// More would fill the memory before the answer is out.
inline constexpr std::size_t max_rays = 1'000'000;

}  // namespace ghostlight::cli
