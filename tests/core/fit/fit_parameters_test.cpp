// What may be varied: reading it, setting it, and what is refused.

#include "core/fit/fit_parameters.h"

#include <gtest/gtest.h>

#include "core/optics/optical_system.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

TEST(FitParameters, AllIsEachSurfaceWhereItMakesSense) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    const auto centers = parse_vary("center@all", lens);
    ASSERT_EQ(centers.size(), 6U);  // those that meet air
    EXPECT_EQ(centers[1].rows, std::vector<std::size_t>{2});
    EXPECT_EQ(centers[1].start, 550.0);
    EXPECT_EQ(name(centers[1]), "λ0 of 3");
}

TEST(FitParameters, GroupsBoundsAndPriorsAreRead) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    const auto found =
        parse_vary("center@1+3=450..650~40, radius@5~0.1%, stop-size, gap@2=90%..110%", lens);
    ASSERT_EQ(found.size(), 4U);
    EXPECT_EQ(found[0].rows, (std::vector<std::size_t>{0, 2}));
    EXPECT_EQ(found[0].lower, 450.0);
    EXPECT_EQ(found[0].upper, 650.0);
    EXPECT_EQ(found[0].prior, 40.0);
    EXPECT_NEAR(found[1].prior, 0.001 * std::abs(found[1].start), 1e-12);
    EXPECT_EQ(found[2].kind, FitKind::stop_size);
    EXPECT_NEAR(found[3].lower, 0.9 * lens.surfaces[1].thickness_mm, 1e-12);
}

TEST(FitParameters, SettingChangesThatNumberAlone) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    for (const FitParameter& each : parse_vary(
             "center@1,thickness@3,radius@5,gap@2,index@1,semi-diameter@8,stop-size", lens)) {
        FittedLens changed{lens, {}};
        set(changed, each, each.start);
        // At its own value nothing moves that the trace sees.
        const OpticalSystem before = compile(lens, 550.0), after = compile(changed.lens, 550.0);
        for (std::size_t k = 0; k < before.surfaces.size(); ++k) {
            EXPECT_NEAR(before.surfaces[k].curvature_per_mm, after.surfaces[k].curvature_per_mm,
                        1e-12)
                << name(each);
            EXPECT_NEAR(before.surfaces[k].n_after, after.surfaces[k].n_after, 1e-12) << name(each);
            EXPECT_EQ(before.surfaces[k].film, after.surfaces[k].film) << name(each);
        }
        EXPECT_NEAR(before.stop_mask.semi_diameter_mm, after.stop_mask.semi_diameter_mm, 1e-9);
    }
    FittedLens fitted{lens, {}};
    const auto index = parse_vary("index@1", lens).front();
    set(fitted, index, 0.002);
    for (const double nm : {450.0, 587.5618, 650.0})
        EXPECT_NEAR(refractive_index(fitted.lens.surfaces[0].medium_after, nm),
                    refractive_index(lens.surfaces[0].medium_after, nm) + 0.002, 1e-5)
            << nm;
}

TEST(FitParameters, WhatCannotBeVariedIsSaid) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    const auto problem = [&](const char* text) {
        const auto parts = error_of([&] { parse_vary(text, lens); });
        return parts.problem + "; " + parts.expected;
    };
    EXPECT_NE(problem("center@12").find("surfaces 1 to 8"), std::string::npos);
    EXPECT_NE(problem("center@2").find("quarter-wave coating there"), std::string::npos);
    EXPECT_NE(problem("center@1=650..450").find("lower bound"), std::string::npos);
    EXPECT_NE(problem("center@1=300..400").find("outside of the bounds"), std::string::npos);
    EXPECT_NE(problem("colour@1").find("unknown kind"), std::string::npos);
    EXPECT_NE(problem("center").find("which surface"), std::string::npos);
    EXPECT_NE(problem("center@1,center@1+3").find("varied twice"), std::string::npos);
    EXPECT_NE(problem("stop-rotation").find("blades"), std::string::npos);
    EXPECT_NE(problem("").find("nothing is to be varied"), std::string::npos);
    EXPECT_NE(problem("reflectance@all").find("no surface"), std::string::npos);
}

}  // namespace
}  // namespace ghostlight
