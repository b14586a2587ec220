#pragma once

#include <set>
#include <string>
#include <string_view>

#include "core/optics/prescription.h"

namespace ghostlight {

/// What a person has marked as variable for a fit, surface by surface: kinds as `--vary` names
/// them ("radius", "gap", "index", "semi-diameter", "thickness", …; core/fit/fit_parameters.h).
/// The marks are the field "vary" of a surface in a lens file, so they are saved, undone and moved
/// with their row; they change nothing about the lens.
inline constexpr std::string_view vary_field = "vary";

/// The marks of a surface; text in the field that is no list of names counts as none.
std::set<std::string> varied(const Surface& surface);
void set_varied(Surface& surface, std::string_view kind, bool varies);

/// All marks as `--vary` and parse_vary() take them: "radius@1,gap@1,radius@4"; empty for none.
std::string vary_text(const Prescription& lens);

}  // namespace ghostlight
