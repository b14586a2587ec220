#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <vector>

#include "core/fit/fit_setup.h"

namespace ghostlight {

/// Gives a photograph as read_photo() does, perhaps from memory.
using PhotoReader = std::function<Photo(const std::filesystem::path& file)>;

/// One photograph of a fit from its file, placed and masked. Throws Error.
FitPhoto read_fit_photo(const FitPhotoSetup& setup, const Prescription& lens, Notes& notes,
                        const PhotoReader& read);

/// The photographs of a fit. Exposures that are merged (merged()) become one: the first one's place
/// and light, the painted masks of all. Fewer where stopped. Throws Error.
std::vector<FitPhoto> read_fit_photos(const FitSetup& setup, const Prescription& lens, Notes& notes,
                                      const PhotoReader& read, std::stop_token stop = {});

}  // namespace ghostlight
