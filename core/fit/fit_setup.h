#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/fit/flare_fit.h"
#include "core/optics/optical_system.h"

namespace ghostlight {

/// One photograph of a fit as a person gives it.
struct FitPhotoSetup {
    std::string file;
    std::string light = "auto";  ///< where its light is, see place_light()
    bool operator==(const FitPhotoSetup&) const = default;
};

/// All that a fit is started from beside the lens; saved with the lens.
struct FitSetup {
    std::vector<FitPhotoSetup> photos;
    std::string vary;  ///< as parse_vary() reads it
    std::string held;  ///< listed, but not varied at present; the same words
    std::string spectrum = "D65";
    bool merge = false;  ///< the photographs are exposures of one scene
    int across = 96;
    int starts = 6;
    int suggestions = 0;
    std::uint64_t seed = 1;
    bool operator==(const FitSetup&) const = default;
};

/// Throws Error like parse_vary() and parse_spectrum().
FitRequest fit_request(const FitSetup& setup, const Prescription& lens);

/// Throws Error where a photograph of the whole sensor has not the sensor's shape.
void check_shape(const Photo& photo, const Prescription& lens);

/// Direction of a light whose image is at a place of the photograph, pixels of the sensor's frame
/// (as Photo::rgb). Throws Error where no light can be there.
LightDirection light_at(const OpticalSystem& system, const FitPhoto& photo, double column,
                        double row);

/// Reads where the light is, sets FitPhoto::light and masks its image: "auto" (the largest bright
/// patch), "X,Y" (pixels from the upper left corner of the upright picture) or
/// "deg:FIELD[:AZIMUTH]". A light that was found is told in `notes`. Throws Error.
void place_light(const std::string& text, const OpticalSystem& system, FitPhoto& photo,
                 Notes& notes);

/// The photograph over the whole sensor, its axis in the middle, its light placed. Throws Error.
FitPhoto fit_photo(Photo photo, const std::string& light, const Prescription& lens, Notes& notes);

}  // namespace ghostlight
