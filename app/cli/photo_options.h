#pragma once

#include <string>

#include "app/cli/options.h"
#include "core/fit/fit_setup.h"

namespace ghostlight::cli {

/// Photographs of a fit. Values of several photographs are separated by semicolons, files by
/// commas.
struct PhotoOptions {
    std::string files, lights = "auto", masks, regions, crops, widths_mm, principals,
                       rotations_deg = "0", noises, saturations;
    bool merge = false;
};
void add_photos(CLI::App& command, PhotoOptions& options);

/// The photographs of a set-up, and whether they are merged. Throws Error.
FitSetup photo_setup_of(const PhotoOptions& options);

}  // namespace ghostlight::cli
