#include "core/flare/mask_raster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/ghosts/row_details.h"
#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

StopMask stop_of(double semi_diameter_mm, int blades = 0) {
    StopMask mask;
    mask.semi_diameter_mm = semi_diameter_mm;
    mask.blades = blades;
    return mask;
}

TEST(MaskRaster, AreaIsTheStops) {
    for (const int blades : {0, 5, 8})
        for (const int across : {64, 512}) {
            const StopMask mask = stop_of(1.0, blades);
            // Coverage by the distance to the edge: off at corners, a pixel's area each.
            EXPECT_NEAR(mask_raster(mask, {}, across).area(), stop_area_mm2(mask),
                        10.0 * 4.0 / (across * across))
                << blades << " blades at " << across;
        }
}

TEST(MaskRaster, DustCoversWhatItIsAskedTo) {
    // Specks of one size thrown at random: their number varies little here, since they are thrown
    // until their areas add up; the overlap varies with 1/√number.
    const StopMask mask = stop_of(5.0);
    for (const double coverage : {0.01, 0.05, 0.3}) {
        double mean = 0.0;
        constexpr int seeds = 8;
        for (int seed = 1; seed <= seeds; ++seed) {
            StopDirt dirt;
            dirt.dust_coverage = coverage;
            dirt.dust_smallest_mm = 0.05;
            dirt.dust_largest_mm = 0.1;
            dirt.seed = seed;
            mean += (1.0 - clear_share(mask, dirt)) / seeds;
        }
        // Hundreds of specks and more over eight seeds: 1 % of their sum.
        EXPECT_NEAR(mean, coverage, 0.02 * coverage);
    }
}

TEST(MaskRaster, ScratchesCoverTheirLengthTimesTheirWidth) {
    // Lengths even between 0.1 and 1 radius: 0.55 on average; some of it beyond the rim.
    const StopMask mask = stop_of(5.0);
    double mean = 0.0;
    constexpr int seeds = 6, count = 60;
    for (int seed = 1; seed <= seeds; ++seed) {
        StopDirt dirt;
        dirt.scratches = count;
        dirt.scratch_thinnest_mm = dirt.scratch_widest_mm = 0.01;
        dirt.seed = seed;
        mean += (1.0 - clear_share(mask, dirt)) / seeds;
    }
    const double whole = count * 0.55 * 5.0 * 0.01 / (std::numbers::pi * 25.0);
    EXPECT_LT(mean, whole);
    EXPECT_GT(mean, 0.75 * whole);  // a tenth to a fifth of them reaches over the rim
}

TEST(MaskRaster, SameSeedSameDirtAtAnyResolution) {
    const StopMask mask = stop_of(5.0);
    StopDirt dirt;
    dirt.dust_coverage = 0.1;
    dirt.dust_smallest_mm = 0.2;
    dirt.dust_largest_mm = 0.4;
    dirt.scratches = 5;
    dirt.scratch_thinnest_mm = dirt.scratch_widest_mm = 0.1;
    dirt.fingerprint = 0.5;
    const MaskRaster once = mask_raster(mask, dirt, 256), again = mask_raster(mask, dirt, 256);
    EXPECT_EQ(once.open, again.open);
    // Four pixels of a finer one are one of the coarser one, to what edges cover.
    const MaskRaster fine = mask_raster(mask, dirt, 512);
    double difference = 0.0;
    for (int j = 0; j < 256; ++j)
        for (int i = 0; i < 256; ++i) {
            auto at = [&](int a, int b) {
                return static_cast<double>(
                    fine.open[static_cast<std::size_t>((2 * j + b) * 512 + 2 * i + a)]);
            };
            difference +=
                std::abs(0.25 * (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) -
                         static_cast<double>(once.open[static_cast<std::size_t>(j * 256 + i)]));
        }
    EXPECT_LT(difference / (256.0 * 256.0), 2e-3);
    dirt.seed = 2;
    EXPECT_NE(mask_raster(mask, dirt, 256).open, once.open);
}

TEST(MaskRaster, ImageTurnsWithTheStop) {
    // Its upper half is open; turned by 90° counter-clockwise that is the left half.
    std::vector<float> upper(64 * 64, 0.0F);
    std::fill_n(upper.begin(), 32 * 64, 1.0F);
    StopMask mask = stop_of(1.0);
    mask.picture = std::make_shared<const StopPicture>(64, 64, upper);
    auto open = [&](double x, double y) {
        const MaskRaster raster = mask_raster(mask, {}, 64);
        return raster.open[static_cast<std::size_t>(static_cast<int>((y + 1.0) * 32.0) * 64 +
                                                    static_cast<int>((x + 1.0) * 32.0))];
    };
    EXPECT_EQ(open(0.0, 0.5), 1.0F);
    EXPECT_EQ(open(0.0, -0.5), 0.0F);
    mask.rotation_rad = 0.5 * std::numbers::pi;
    EXPECT_EQ(open(-0.5, 0.0), 1.0F);
    EXPECT_EQ(open(0.5, 0.0), 0.0F);
}

TEST(MaskRaster, TooManySpecksAreRefused) {
    StopDirt dirt;
    dirt.dust_coverage = 0.5;
    dirt.dust_smallest_mm = dirt.dust_largest_mm = 1e-4;
    const auto parts = error_of([&] { mask_raster(stop_of(20.0), dirt, 64); });
    EXPECT_EQ(parts.problem, "more specks of dust than can be drawn");
    EXPECT_NE(parts.expected.find("larger specks"), std::string::npos);
}

}  // namespace
}  // namespace ghostlight
