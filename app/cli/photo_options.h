#pragma once

#include <string>
#include <vector>

#include "app/cli/options.h"
#include "core/fit/flare_fit.h"

namespace ghostlight::cli {

/// Photographs of a fit. Values of several photographs are separated by semicolons, files by
/// commas.
struct PhotoOptions {
    std::string files, lights = "auto", masks, regions, crops, widths_mm, principals,
                       rotations_deg = "0", noises, saturations;
    bool merge = false;
};
void add_photos(CLI::App& command, PhotoOptions& options);

/// Reads, masks and places them. Throws Error.
std::vector<FitPhoto> photos_of(const PhotoOptions& options, const Prescription& lens,
                                Notes& notes);

/// The options again, for a report, as far as they are not the usual ones.
std::string command_text(const PhotoOptions& options);

}  // namespace ghostlight::cli
