// Fits to photographs made from the reference picture, whose truth is known.

#include "core/fit/flare_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/fit/fit_kit.h"
#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

using test::photo_of;
using test::quick_request;
using test::small_camera;
using test::tessar;

/// One wavelength makes the reference quick; off λ0, where a reflectance has a slope.
const Spectrum red = Monochromatic{620.0};

class FlareFitSlow : public testing::Test {
   protected:
    static const std::vector<FitPhoto>& photos() {
        static const std::vector<FitPhoto> made = {photo_of(tessar(), small_camera(red))};
        return made;
    }
};

TEST_F(FlareFitSlow, TwoCoatingsComeBackWithinTheirErrors) {
    Prescription wrong = tessar();
    std::get<QuarterWave>(wrong.surfaces[0].coating).center_nm = 590.0;
    std::get<QuarterWave>(wrong.surfaces[7].coating).center_nm = 500.0;
    FitRequest request = quick_request(red);
    request.vary = parse_vary("center@1,center@8", wrong);
    const FitReport report = *fit_flare(wrong, photos(), request);
    EXPECT_TRUE(report.usable) << report.verdict;
    ASSERT_EQ(report.numbers.size(), 2U);
    for (const FittedNumber& number : report.numbers) {
        // Of use (its prior narrowed to less than half), and holding the truth, from starts 40 and
        // 50 nm off: one wavelength and an unknown exposure tell no more.
        EXPECT_EQ(number.knowledge, FitKnowledge::determined);
        EXPECT_LT(std::abs(number.value - 550.0), 3.0 * number.standard_error);
    }
    EXPECT_LT(report.cost_after, report.cost_before);
    // As low as where the truth itself leads: no other minimum was taken for it.
    request.vary = parse_vary("center@1,center@8", tessar());
    const FitReport from_truth = *fit_flare(tessar(), photos(), request);
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
    other.sensor = tessar().sensor;
    FitRequest request = quick_request(red);
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
    FitRequest request = quick_request(red);
    request.vary = parse_vary("center@1", tessar());
    EXPECT_NE(error_of([&] { fit_flare(tessar(), dark, request); }).problem.find("no ghost"),
              std::string::npos);
}

TEST_F(FlareFitSlow, NoiseAloneIsNotFitted) {
    // A grey card: its noise, estimated from the picture, and no flare.
    Random random(3);
    FitRequest request = quick_request(red);
    request.vary = parse_vary("center@1", tessar());
    for (int turn = 0; turn < 2; ++turn) {
        std::vector<FitPhoto> grey = photos();
        for (float& value : grey.front().photo.rgb)
            value = static_cast<float>(0.2 + 0.01 * random.between(-1.0, 1.0));
        grey.front().photo.noise = estimated_noise(grey.front().photo);
        EXPECT_NE(
            error_of([&] { fit_flare(tessar(), grey, request); }).problem.find("out of the noise"),
            std::string::npos);
    }
}

TEST_F(FlareFitSlow, ALightThatThePhotographHasNotIsRefused) {
    // 85 degrees instead of 5: what little such a light leaves on the sensor is not in the picture.
    std::vector<FitPhoto> elsewhere = photos();
    elsewhere.front().light.field_deg = 85.0;
    FitRequest request = quick_request(red);
    request.vary = parse_vary("center@1", tessar());
    const Error::Parts refused = error_of([&] { fit_flare(tessar(), elsewhere, request); });
    EXPECT_NE(refused.found.find("85 degrees"), std::string::npos) << refused.found;
}

}  // namespace
}  // namespace ghostlight
