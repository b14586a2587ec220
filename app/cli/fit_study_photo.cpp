#include "app/cli/fit_study_photo.h"

#include <algorithm>
#include <cmath>

#include "app/cli/options.h"
#include "core/fit/light_place.h"
#include "core/flare/flare_image.h"
#include "core/io/fit_page.h"
#include "core/io/image_file.h"
#include "core/io/lens_file.h"
#include "core/units.h"

namespace ghostlight::cli {

Prescription tessar_with(const std::vector<double>& centers_nm) {
    LensOptions which;
    which.lens = "tessar_brendel_100_f2.8";
    Prescription lens = load_lens(which).lens;
    std::size_t k = 0;
    for (Surface& surface : lens.surfaces)
        if (auto* film = std::get_if<QuarterWave>(&surface.coating); film && k < centers_nm.size())
            film->center_nm = centers_nm[k++];
    return lens;
}

SyntheticPhotoRequest study_camera(double field_deg, bool quick) {
    SyntheticPhotoRequest camera;
    camera.light = {field_deg, 90.0};
    camera.width_px = quick ? 192 : 360;
    camera.tolerance = quick ? 0.02 : 0.01;
    camera.noise = 0.01;
    camera.gains = {0.5, 1.0, 0.7};
    return camera;
}

FitPhoto fit_photo(Photo photo, const Prescription& lens, const LightDirection& light) {
    FitPhoto fit;
    fit.photo = std::move(photo);
    mask_unusable(fit.photo);
    const double pitch_mm = lens.sensor.width_mm / fit.photo.width_px;
    fit.place = {.sensor_width_mm = lens.sensor.width_mm,
                 .axis_column = 0.5 * fit.photo.width_px,
                 .axis_row = 0.5 * fit.photo.height_px,
                 .rotation_rad = 0.0};
    if (const auto at = image_of_light(compile(lens, d_line_nm), light))
        mask_disc(fit.photo, fit.place.axis_column + at->x_mm / pitch_mm,
                  fit.place.axis_row + at->y_mm / pitch_mm, 0.03 * fit.photo.width_px);
    fit.light = light;
    return fit;
}

FitRequest usual_fit(const Prescription& lens, const std::string& vary, bool quick) {
    FitRequest fit;
    fit.vary = parse_vary(vary, lens);
    if (quick) fit.across = 64;
    return fit;
}

bool holds(const FittedNumber& number, double truth) {
    return number.low <= truth && truth <= number.high;
}

double chi2_per_value(const FitReport& report) {
    return report.chi2 / static_cast<double>(report.residuals);
}

std::size_t covered(const FitReport& report, const std::vector<double>& truth) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < truth.size(); ++k) count += holds(report.numbers[k], truth[k]);
    return count;
}

std::string write_pages(const FitReport& report, const std::string& heading,
                        const std::filesystem::path& folder, const std::string& name) {
    write_file_safely(folder / (name + ".html"),
                      fit_page(report, heading, "ghostlight-cli fit-study"));
    const FittedPhoto& photo = report.photos.front();
    // Two by two: photograph and start above, fit and residuals below. Upright, the picture's
    // right is -x and its top -y.
    const int width = photo.frame.width_px, height = photo.frame.height_px;
    FlareImage sheet;
    sheet.width_px = 2 * width;
    sheet.height_px = 2 * height;
    const auto pixels = static_cast<std::size_t>(4 * width * height);
    sheet.rgb.assign(3 * pixels, 0.0F);
    sheet.irradiance.assign(pixels, 0.0F);
    double brightest = 1e-12;
    for (std::size_t s = 0; s < photo.used.size(); ++s)
        for (std::size_t c = 0; c < 3 && photo.used[s]; ++c)
            brightest = std::max(brightest, photo.measured[3 * s + c] / photo.gain[c]);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto s = static_cast<std::size_t>(y * width + x);
            if (!photo.used[s]) continue;
            auto put = [&](int column, int row, std::size_t c, double value) {
                sheet.rgb[3 * static_cast<std::size_t>((y + row * height) * 2 * width + x +
                                                       column * width) +
                          c] = static_cast<float>(std::max(0.0, value));
            };
            double worst = 0.0;
            for (std::size_t c = 0; c < 3; ++c) {
                const double unit = photo.gain[c] * brightest;
                put(1, 0, c, photo.measured[3 * s + c] / unit);
                put(0, 0, c, photo.before[3 * s + c] / unit);
                put(1, 1, c, photo.after[3 * s + c] / unit);
                if (std::abs(photo.residuals[3 * s + c]) > std::abs(worst))
                    worst = photo.residuals[3 * s + c];
            }
            constexpr double full_sigmas = 5.0;
            const double share = std::min(1.0, std::abs(worst) / full_sigmas);
            put(0, 1, 0, worst > 0.0 ? 0.8 : 0.8 * (1.0 - share));
            put(0, 1, 1, 0.8 * (1.0 - share));
            put(0, 1, 2, worst < 0.0 ? 0.8 : 0.8 * (1.0 - share));
        }
    const std::string bytes = png_bytes(sheet, 0.0);
    write_file_safely(folder / (name + ".png"), bytes);
    return name + ".png";
}

}  // namespace ghostlight::cli
