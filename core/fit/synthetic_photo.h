#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>

#include "core/fit/photo.h"
#include "core/flare/flare_image.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// A photograph that never was: the reference picture of a lens, seen by a camera.
struct SyntheticPhotoRequest {
    LightDirection light;
    /// Added to the field and azimuth of the light, though the photograph's data do not say so.
    double field_offset_deg = 0.0, azimuth_offset_deg = 0.0;
    Spectrum spectrum = StandardLight{};
    int width_px = 720;
    /// Of the reference picture, relative L1.
    double tolerance = 0.01;
    /// log2 of the value of the light's own irradiance E0 on the sensor, 1 being saturation; none:
    /// so that the brightest thousandth of the flare is at half of saturation.
    std::optional<double> exposure_ev;
    Rgb gains{1.0, 1.0, 1.0};  ///< white balance, unknown to a fit
    double shading = 0.0;      ///< share of the light that is missing in the corners, as r²
    double noise = 0.0;        ///< σ over signal of a pixel at saturation: shot noise, Poisson
    double read_noise = 0.0;   ///< σ of a pixel in the dark, 1 being saturation: normal
    double background = 0.0;   ///< a uniform glow added everywhere, 1 being saturation
    double light_deg = 0.53;   ///< diameter of the light; its own image is drawn as that disc
    int bits = 0;              ///< levels 2^bits − 1, as the file will hold them; 0: none
    bool srgb = false;         ///< rounded after the sRGB curve instead of before
    std::uint64_t seed = 1;
    unsigned threads = 0;
};

/// Made from FlareMethod::reference, never from a fit's own model. Nothing when stopped.
std::optional<Photo> synthetic_photo(const Prescription& lens, const SyntheticPhotoRequest& request,
                                     std::stop_token stop = {});

/// The same camera before another picture of the same scene: for many seeds of one picture.
Photo exposed(const FlareImage& picture, const Prescription& lens,
              const SyntheticPhotoRequest& request);

/// The picture alone.
std::optional<FlareImage> photo_subject(const Prescription& lens,
                                        const SyntheticPhotoRequest& request,
                                        std::stop_token stop = {});

}  // namespace ghostlight
