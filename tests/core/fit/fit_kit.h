#pragma once

#include "core/fit/flare_fit.h"
#include "core/fit/light_place.h"
#include "core/fit/synthetic_photo.h"
#include "core/optics/optical_system.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight::test {

inline const Prescription& tessar() {
    static const Prescription lens = bundled("tessar_brendel_100_f2.8");
    return lens;
}

/// A light at 5° before a camera of few pixels; exposure and balance are for the fit to find.
inline SyntheticPhotoRequest small_camera(const Spectrum& spectrum) {
    SyntheticPhotoRequest request;
    request.light = {5.0, 90.0};
    request.width_px = 160;
    request.tolerance = 0.02;
    request.spectrum = spectrum;
    request.noise = 0.01;
    request.gains = {0.7, 1.0, 0.8};
    return request;
}

/// A photograph as a fit takes it, by what a camera saw of a lens: what is clipped and the light's
/// own image are masked.
inline FitPhoto placed_photo(Photo seen, const Prescription& lens, const LightDirection& light) {
    FitPhoto photo;
    photo.photo = std::move(seen);
    photo.photo.saturation = 0.999;
    mask_unusable(photo.photo);
    const double pitch_mm = lens.sensor.width_mm / photo.photo.width_px;
    photo.place = {.sensor_width_mm = lens.sensor.width_mm,
                   .axis_column = 0.5 * photo.photo.width_px,
                   .axis_row = 0.5 * photo.photo.height_px,
                   .rotation_rad = 0.0};
    if (const auto at = image_of_light(compile(lens, d_line_nm), light))
        mask_disc(photo.photo, photo.place.axis_column + at->x_mm / pitch_mm,
                  photo.place.axis_row + at->y_mm / pitch_mm, 8.0);
    photo.light = light;
    return photo;
}

inline FitPhoto photo_of(const Prescription& lens, const SyntheticPhotoRequest& camera) {
    return placed_photo(*synthetic_photo(lens, camera), lens, camera.light);
}

/// Few samples, one first guess, place known.
inline FitRequest quick_request(const Spectrum& spectrum = StandardLight{}) {
    FitRequest request;
    request.spectrum = spectrum;
    request.fit_place = false;
    request.fit_shading = false;
    request.background_terms = 1;
    request.across = 48;
    request.starts = 1;
    return request;
}

}  // namespace ghostlight::test
