// Fits to photographs made from the reference picture, whose truth is known.

#include "core/fit/flare_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/fit/light_place.h"
#include "core/fit/synthetic_photo.h"
#include "core/optics/optical_system.h"
#include "core/units.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

/// One wavelength makes the reference quick; off λ0, where a reflectance has a slope.
const Spectrum red = Monochromatic{620.0};

FitPhoto photo_of(const Prescription& lens, double field_deg) {
    SyntheticPhotoRequest request;
    request.light = {field_deg, 90.0};
    request.width_px = 192;
    request.spectrum = red;
    request.noise = 0.01;
    request.gains = {0.7, 1.0, 0.8};
    FitPhoto photo;
    photo.photo = *synthetic_photo(lens, request);
    photo.photo.saturation = 0.999;
    mask_unusable(photo.photo);
    const OpticalSystem system = compile(lens, d_line_nm);
    const double pitch_mm = lens.sensor.width_mm / photo.photo.width_px;
    if (const auto at = image_of_light(system, request.light))
        mask_disc(photo.photo, 0.5 * photo.photo.width_px + at->x_mm / pitch_mm,
                  0.5 * photo.photo.height_px + at->y_mm / pitch_mm, 8.0);
    photo.place = {.sensor_width_mm = lens.sensor.width_mm,
                   .axis_column = 0.5 * photo.photo.width_px,
                   .axis_row = 0.5 * photo.photo.height_px,
                   .rotation_rad = 0.0};
    photo.light = request.light;
    return photo;
}

FitRequest quick_request() {
    FitRequest request;
    request.spectrum = red;
    request.fit_place = false;
    request.fit_shading = false;
    request.background_terms = 1;
    request.across = 48;
    request.starts = 1;
    return request;
}

class FlareFitSlow : public testing::Test {
   protected:
    static const Prescription& lens() {
        static const Prescription listed = bundled("tessar_brendel_100_f2.8");
        return listed;
    }
    static const std::vector<FitPhoto>& photos() {
        static const std::vector<FitPhoto> made = {photo_of(lens(), 5.0)};
        return made;
    }
};

TEST_F(FlareFitSlow, TwoCoatingsComeBackWithinTheirErrors) {
    Prescription wrong = lens();
    std::get<QuarterWave>(wrong.surfaces[0].coating).center_nm = 590.0;
    std::get<QuarterWave>(wrong.surfaces[7].coating).center_nm = 500.0;
    FitRequest request = quick_request();
    request.vary = parse_vary("center@1,center@8", wrong);
    const FitReport report = *fit_flare(wrong, photos(), request);
    EXPECT_TRUE(report.usable) << report.verdict;
    ASSERT_EQ(report.numbers.size(), 2U);
    for (const FittedNumber& number : report.numbers) {
        // Of use (its prior narrowed to less than half), and holding the truth, from starts 40 and
        // 50 nm off: one wavelength and an unknown exposure tell no more.
        EXPECT_EQ(number.knowledge, FitKnowledge::determined);
        EXPECT_LT(std::abs(number.value - 550.0), 4.0 * number.standard_error + 0.5);
    }
    EXPECT_LT(report.cost_after, report.cost_before);
    // As low as where the truth itself leads: no other minimum was taken for it.
    request.vary = parse_vary("center@1,center@8", lens());
    const FitReport from_truth = *fit_flare(lens(), photos(), request);
    EXPECT_LT(report.cost_after, 1.01 * from_truth.cost_after);
    request.vary = parse_vary("center@1,center@8", wrong);
    // The same whatever the number of threads.
    request.threads = 1;
    const FitReport again = *fit_flare(wrong, photos(), request);
    for (std::size_t k = 0; k < report.numbers.size(); ++k)
        EXPECT_EQ(report.numbers[k].value, again.numbers[k].value);
}

TEST_F(FlareFitSlow, AnotherLensDoesNotExplainThePhotograph) {
    Prescription other = bundled("double_gauss_tronnier_100_f2");
    other.sensor = lens().sensor;
    FitRequest request = quick_request();
    request.vary = parse_vary("center@1,center@3", other);
    const FitReport report = *fit_flare(other, photos(), request);
    EXPECT_FALSE(report.usable);
    EXPECT_NE(report.verdict.find("does not explain"), std::string::npos) << report.verdict;
}

TEST_F(FlareFitSlow, NoVisibleGhostIsSaid) {
    std::vector<FitPhoto> dark = photos();
    // The light's flare is gone in the noise.
    for (float& value : dark.front().photo.rgb) value = 0.0F;
    dark.front().photo.rgb[0] = 1e-3F;
    dark.front().photo.noise.read = 1.0;
    FitRequest request = quick_request();
    request.vary = parse_vary("center@1", lens());
    EXPECT_NE(error_of([&] { fit_flare(lens(), dark, request); }).problem.find("no ghost"),
              std::string::npos);
}

}  // namespace
}  // namespace ghostlight
