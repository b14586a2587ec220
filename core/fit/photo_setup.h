#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fit/flare_fit.h"
#include "core/fit/photo_mask.h"
#include "core/optics/optical_system.h"

namespace ghostlight {

/// One photograph of a fit as a person gives it: what its file does not say, and what of it counts.
struct FitPhotoSetup {
    std::string file;
    std::string light = "auto";      ///< where its light is, see place_light()
    std::string mask_file;           ///< a picture, bright where not to look; empty: none
    std::vector<MaskRegion> masked;  ///< painted
    std::optional<FileBox> crop;     ///< what counts; none: all
    std::optional<double> width_mm;  ///< of the whole picture on the sensor; none: the sensor's
    std::optional<FilePoint> axis;   ///< where the lens's axis meets it; none: its middle
    double rotation_deg = 0.0;  ///< of the camera about the axis, counterclockwise on the sensor
    std::optional<PhotoNoise> noise;  ///< none: as the file says, else estimated
    std::optional<double>
        saturation;  ///< values from here on are clipped; none: as the file has it
    bool operator==(const FitPhotoSetup&) const = default;
};

/// "SHOT,READ": variance of a value = SHOT × value + READ, 1 being full scale. Throws Error.
PhotoNoise parse_noise(std::string_view text);
std::string text_of(const PhotoNoise& noise);

/// Throws Error where a photograph of the whole sensor has not the sensor's shape.
void check_shape(const Photo& photo, const Prescription& lens);

/// Direction of a light whose image is at a place of the photograph, pixels of the sensor's frame
/// (as Photo::rgb). Throws Error where no light can be there.
LightDirection light_at(const OpticalSystem& system, const FitPhoto& photo, double column,
                        double row);

/// A point of the sensor in the photograph, pixels of the sensor's frame: the place undone.
struct PhotoPixel {
    double column = 0.0, row = 0.0;
};
PhotoPixel pixel_at(const FitPhoto& photo, double x_mm, double y_mm);

/// Reads where the light is, sets FitPhoto::light and masks its image with its starburst's core:
/// "auto" (the largest bright patch), "X,Y" (pixels from the upper left corner of the upright
/// picture) or "deg:FIELD[:AZIMUTH]". A light that was found is told in `notes`. Throws Error.
void place_light(const std::string& text, const OpticalSystem& system, FitPhoto& photo,
                 Notes& notes);

/// Noise and saturation that the set-up gives in place of the file's; what is clipped or hot is
/// judged again by them. Throws Error where nothing is left.
void adjust_photo(Photo& photo, const FitPhotoSetup& setup);

/// A photograph that is adjusted already, its pixels placed and masked, its light placed.
/// Throws Error naming the photograph.
FitPhoto fit_photo(Photo photo, const FitPhotoSetup& setup, const Prescription& lens, Notes& notes);

}  // namespace ghostlight
