#include "core/ghosts/lens_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/ghosts/ghost_table.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

/// What was found about a cell, row from 1; empty if nothing was.
std::string about(const std::vector<Finding>& findings, std::size_t row, LensCell cell) {
    for (const Finding& finding : findings)
        if (finding.surface == row - 1 && finding.cell == cell && finding.ghosts.empty())
            return finding.text;
    return {};
}

class LensCheck : public ::testing::Test {
   protected:
    Prescription lens = bundled("cooke_triplet_50_f5");
};

// Their listings' semi-diameters are estimates in part, and some cross at the rim; but all trace.
TEST(LensCheckOfBundled, FindsNothingThatCannotBeTraced) {
    for (const BundledLens& listed : bundled_lenses())
        for (const Finding& finding : check_lens(configured(read_lens(listed.file).lens, "")))
            EXPECT_NE(finding.severity, Note::Severity::error) << listed.name << finding.text;
}

TEST_F(LensCheck, FindsARimWiderThanItsSphere) {
    const double radius = 1.0 / std::abs(curvature_per_mm(lens.surfaces[0].curve));
    lens.surfaces[0].semi_diameter_mm = 0.99 * radius;
    EXPECT_EQ(about(check_lens(lens), 1, LensCell::semi_diameter), "");
    lens.surfaces[0].semi_diameter_mm = 1.01 * radius;
    EXPECT_NE(about(check_lens(lens), 1, LensCell::semi_diameter).find("radius of curvature"),
              std::string::npos);
    lens.surfaces[0].conic = -1.0;  // a paraboloid has no end
    EXPECT_EQ(about(check_lens(lens), 1, LensCell::semi_diameter), "");
}

TEST(LensCheckOfMade, FindsSurfacesThatCross) {
    // Two spheres of 50 mm, bulging to one another: at 10 mm each has a sag of 50 − √(50² − 10²) =
    // 1.0102 mm.
    const auto biconcave = [](double gap_mm) {
        return lens_of({row(-50, gap_mm, 1.5), row(50, 100, 1)});
    };
    const auto lens_between = [](double thickness_mm) {
        return lens_of({row(50, thickness_mm, 1.5), row(-50, 100, 1)});
    };
    EXPECT_EQ(about(check_lens(lens_between(2.03)), 1, LensCell::thickness), "");
    EXPECT_NE(about(check_lens(lens_between(2.0)), 1, LensCell::thickness).find("cross"),
              std::string::npos);
    EXPECT_EQ(about(check_lens(biconcave(0.1)), 1, LensCell::thickness), "");
}

TEST_F(LensCheck, FindsOddGlass) {
    lens.surfaces[0].medium_after = {"", ModelGlass{16.2, 60.0}, {}};
    EXPECT_FALSE(check_lens(lens).empty());
    lens.surfaces[0].medium_after = {"", ModelGlass{1.62, 6.0}, {}};
    EXPECT_NE(about(check_lens(lens), 1, LensCell::medium).find("Abbe"), std::string::npos);
    lens.surfaces[0].medium_after = {"", ConstantIndex{2.6}, {}};
    EXPECT_NE(about(check_lens(lens), 1, LensCell::medium).find("index"), std::string::npos);
    lens.surfaces[0].medium_after = {"X-ABC", UnknownGlass{}, {}};
    const auto unknown = check_lens(lens);
    EXPECT_NE(about(unknown, 1, LensCell::medium).find("X-ABC"), std::string::npos);
    EXPECT_EQ(unknown.front().severity, Note::Severity::error);
}

TEST_F(LensCheck, FindsCoatingsThatDoNotHelp) {
    // A quarter wave of higher index than the glass is a mirror layer: n⁴ instead of n² in R.
    LayerStack mirror;
    mirror.layers = {{medium(2.3), 550.0 / (4.0 * 2.3)}};
    lens.surfaces[0].coating = mirror;
    EXPECT_NE(about(check_lens(lens), 1, LensCell::coating).find("more than the bare"),
              std::string::npos);
    lens.surfaces[0].coating = QuarterWave{};
    EXPECT_EQ(about(check_lens(lens), 1, LensCell::coating), "");
    lens.surfaces[0].coating = QuarterWave{5500.0, magnesium_fluoride(), 1.0};
    EXPECT_NE(about(check_lens(lens), 1, LensCell::coating).find("5500"), std::string::npos);
}

TEST_F(LensCheck, FindsTheBareSurfaceAmongCoatedOnes) {
    lens = with_air_coating(lens, QuarterWave{});
    const auto is_bare = [&](std::size_t row) {
        return about(check_lens(lens), row, LensCell::coating).find("not coated") !=
               std::string::npos;
    };
    EXPECT_FALSE(is_bare(2));
    lens.surfaces[1].coating = Uncoated{};
    EXPECT_TRUE(is_bare(2));
    EXPECT_FALSE(is_bare(1));
}

TEST_F(LensCheck, FindsARimThatClipsTheAxialBeam) {
    EXPECT_EQ(about(check_lens(lens), 1, LensCell::semi_diameter), "");
    lens.surfaces[0].semi_diameter_mm = 1.0;
    EXPECT_NE(about(check_lens(lens), 1, LensCell::semi_diameter).find("axial beam"),
              std::string::npos);
}

// Real rays, against the first order that the finding is made by: a focused ghost is small.
TEST(LensCheckOfGhosts, FocusedOnesAreSmallInTheTable) {
    const Prescription lens = bundled("double_gauss_tronnier_100_f2");
    LensCheckRequest request;
    request.focused_share = 0.1;
    const double diagonal_mm = std::hypot(lens.sensor.width_mm, lens.sensor.height_mm);
    GhostTableRequest wanted;
    wanted.tolerance = 0.05;
    wanted.peaks = false;
    wanted.light.field_deg = 0.0;
    const auto table =
        ghost_table(stopped_down(lens, 1.0), wanted);  // so that the first order holds
    ASSERT_TRUE(table);
    std::size_t named = 0;
    for (const Finding& finding : check_lens(stopped_down(lens, 1.0), request))
        for (const GhostPath& path : finding.ghosts) {
            ++named;
            const auto row = std::ranges::find(table->ghosts, path, &GhostRow::path);
            ASSERT_NE(row, table->ghosts.end());
            // An even disc of diameter d has an RMS radius of d/√8; 30 % for what is not paraxial.
            EXPECT_LT(row->rms_radius_mm,
                      1.3 * request.focused_share * diagonal_mm / std::sqrt(8.0))
                << name(path);
        }
    EXPECT_GT(named, 0U);
}

}  // namespace
}  // namespace ghostlight
