#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/fit/fit_setup.h"

namespace ghostlight {

/// In a lens file the set-up of a fit is the field "fit", which readers of lenses pass over.
inline constexpr std::string_view fit_field = "fit";

/// One line of JSON. Photographs in or below `folder`, where the lens's file is, are named from
/// there, so that the folder can be moved as a whole.
std::string fit_setup_to_json(const FitSetup& setup, const std::filesystem::path& folder = {});

/// Takes what it understands; the rest stays as it is at first. Never a reason to refuse a lens.
FitSetup fit_setup_from_json(std::string_view text, const std::filesystem::path& folder = {});

}  // namespace ghostlight
