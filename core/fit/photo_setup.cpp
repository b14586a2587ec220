#include "core/fit/photo_setup.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/fit/light_place.h"
#include "core/optics/paraxial.h"
#include "core/units.h"

namespace ghostlight {
namespace {

std::optional<double> number(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

[[noreturn]] void refuse_place(const std::string& text, const char* expected) {
    throw Error({.problem = "the light's place cannot be read",
                 .file = {},
                 .where = {},
                 .found = fmt::format("'{}'", text),
                 .expected = expected});
}

/// "deg:FIELD" or "deg:FIELD:AZIMUTH".
LightDirection read_direction(const std::string& text) {
    constexpr const char* expected = "deg:FIELD or deg:FIELD:AZIMUTH, degrees";
    const std::string_view rest = std::string_view(text).substr(4);
    const std::size_t colon = rest.find(':');
    const auto field = number(rest.substr(0, colon));
    const auto azimuth =
        colon == std::string_view::npos ? std::optional(90.0) : number(rest.substr(colon + 1));
    if (!field || !azimuth || std::abs(*field) > 90.0) refuse_place(text, expected);
    return {*field, *azimuth};
}

void mask_light(Photo& photo, double column, double row, double least_px) {
    mask_disc(photo, column, row, light_core_px(photo, column, row, least_px));
}

}  // namespace

PhotoNoise parse_noise(std::string_view text) {
    const std::size_t comma = text.find(',');
    const auto shot = number(text.substr(0, comma));
    const auto read =
        comma == std::string_view::npos ? std::nullopt : number(text.substr(comma + 1));
    if (!shot || !read || *shot < 0.0 || *read < 0.0 || !(*shot + *read > 0.0))
        throw Error({.problem = "a photograph's noise cannot be read",
                     .file = {},
                     .where = {},
                     .found = fmt::format("'{}'", text),
                     .expected = "SHOT,READ, none below 0: variance = SHOT x value + READ, 1 being "
                                 "full scale"});
    return {.shot = *shot, .read = *read, .estimated = false};
}

std::string text_of(const PhotoNoise& noise) {
    return fmt::format("{},{}", noise.shot, noise.read);
}

void check_shape(const Photo& photo, const Prescription& lens) {
    const double sensor = lens.sensor.width_mm / lens.sensor.height_mm;
    const double shape = static_cast<double>(photo.width_px) / photo.height_px;
    if (std::abs(shape / sensor - 1.0) < 0.02) return;
    const bool turned = std::abs(shape * sensor - 1.0) < 0.02;
    throw Error(
        {.problem = turned ? "the photograph is turned by 90 degrees against the sensor"
                           : "the photograph has not the sensor's shape",
         .file = photo.file,
         .where = {},
         .found = fmt::format("{} x {} pixels", photo.width_px, photo.height_px),
         .expected = fmt::format(
             "{:.4g} : {:.4g} as the sensor of {:.4g} x {:.4g} mm; {}", lens.sensor.width_mm,
             lens.sensor.height_mm, lens.sensor.width_mm, lens.sensor.height_mm,
             turned ? "turn the picture, or swap the sensor's width and height (--sensor HxW)"
                    : "the camera's sensor size (--sensor WxH), or a cropped picture's own width "
                      "(--photo-width MM)")});
}

LightDirection light_at(const OpticalSystem& system, const FitPhoto& photo, double column,
                        double row) {
    const double pitch_mm = photo.place.pitch_mm(photo.photo);
    const double x = (column - photo.place.axis_column) * pitch_mm,
                 y = (row - photo.place.axis_row) * pitch_mm;
    const double c = std::cos(photo.place.rotation_rad), s = std::sin(photo.place.rotation_rad);
    return light_imaged_at(system, {c * x - s * y, s * x + c * y});
}

PhotoPixel pixel_at(const FitPhoto& photo, double x_mm, double y_mm) {
    const double pitch_mm = photo.place.pitch_mm(photo.photo);
    const double c = std::cos(photo.place.rotation_rad), s = std::sin(photo.place.rotation_rad);
    return {photo.place.axis_column + (c * x_mm + s * y_mm) / pitch_mm,
            photo.place.axis_row + (c * y_mm - s * x_mm) / pitch_mm};
}

void place_light(const std::string& text, const OpticalSystem& system, FitPhoto& photo,
                 Notes& notes) {
    if (text.starts_with("deg:")) {
        photo.light = read_direction(text);
        if (const auto at = image_of_light(system, photo.light)) {
            const PhotoPixel pixel = pixel_at(photo, at->x_mm, at->y_mm);
            mask_light(photo.photo, pixel.column, pixel.row, 0.01 * photo.photo.width_px + 2.0);
        }
        return;
    }
    double column = 0.0, row = 0.0;
    if (text == "auto") {
        const LightSpot spot = find_light(photo.photo);
        column = spot.column;
        row = spot.row;
        // Its glow reaches further than what is clipped.
        mask_light(photo.photo, column, row, 1.5 * spot.radius_px + 3.0);
        notes.push_back({Note::Severity::info, photo.photo.file,
                         fmt::format("the light was found at {:.2f},{:.2f} px, {} pixels",
                                     photo.photo.width_px - column, row, spot.pixels)});
    } else {
        const std::size_t comma = text.find(',');
        const auto x = number(std::string_view(text).substr(0, comma));
        const auto y = comma == std::string::npos
                           ? std::nullopt
                           : number(std::string_view(text).substr(comma + 1));
        if (!x || !y)
            refuse_place(text,
                         "auto, X,Y in pixels from the upper left corner, or deg:FIELD:AZIMUTH");
        // Upright pictures are mirrored left to right against the sensor's frame.
        column = photo.photo.width_px - *x;
        row = *y;
        mask_light(photo.photo, column, row, 0.01 * photo.photo.width_px);
    }
    photo.light = light_at(system, photo, column, row);
}

void adjust_photo(Photo& photo, const FitPhotoSetup& setup) {
    if (!setup.noise && !setup.saturation) return;
    if (setup.noise) photo.noise = *setup.noise;
    if (setup.saturation) photo.saturation = *setup.saturation;
    for (char& reason : photo.masked)
        if (reason == mask_reason::saturated || reason == mask_reason::hot) reason = 0;
    mask_unusable(photo);
}

FitPhoto fit_photo(Photo picture, const FitPhotoSetup& setup, const Prescription& lens,
                   Notes& notes) {
    const OpticalSystem system = compile(lens, d_line_nm);
    FitPhoto photo;
    photo.photo = std::move(picture);
    if (!setup.width_mm) check_shape(photo.photo, lens);
    photo.place.sensor_width_mm = setup.width_mm.value_or(lens.sensor.width_mm);
    // Upright pictures are mirrored left to right against the sensor's frame.
    photo.place.axis_column =
        setup.axis ? photo.photo.width_px - setup.axis->x_px : 0.5 * photo.photo.width_px;
    photo.place.axis_row = setup.axis ? setup.axis->y_px : 0.5 * photo.photo.height_px;
    photo.place.rotation_rad = rad_from_deg(setup.rotation_deg);
    const double f_number = first_order(system).f_number;
    if (photo.photo.f_number && std::abs(*photo.photo.f_number / f_number - 1.0) > 0.05)
        notes.push_back({Note::Severity::warning, photo.photo.file,
                         fmt::format("taken at f/{:.3g}, the lens stands at f/{:.3g}",
                                     *photo.photo.f_number, f_number),
                         Note::Fate::noticed, true,
                         fmt::format("give the lens f/{:.3g}", *photo.photo.f_number)});
    try {
        place_light(setup.light, system, photo, notes);
        for (const MaskRegion& region : setup.masked) mask_region(photo.photo, region);
        if (setup.crop) mask_outside(photo.photo, *setup.crop);
    } catch (const Error& error) {
        Error::Parts parts = error.parts();
        if (parts.file.empty()) parts.file = photo.photo.file;
        throw Error(std::move(parts));
    }
    return photo;
}

}  // namespace ghostlight
