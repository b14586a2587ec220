#include "core/flare/ghost_sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/io/sweep_table.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

SweepRequest request_of(const Prescription& lens, const char* parameter,
                        std::vector<double> values) {
    SweepRequest request;
    request.parameter = parse_sweep_parameter(parameter, lens);
    request.values = std::move(values);
    request.table.light = {6.0, 90.0};
    request.table.tolerance = 0.1;
    request.table.peaks = false;
    return request;
}

TEST(GhostSweep, RowsAreThoseOfTheTable) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    const SweepRequest request = request_of(lens, "field", {0.0, 9.0});
    const auto points = sweep(lens, request);
    ASSERT_TRUE(points);
    ASSERT_EQ(points->size(), 2U);
    GhostTableRequest alone = request.table;
    alone.light.field_deg = 9.0;
    const auto table = ghost_table(lens, alone);
    ASSERT_TRUE(table);
    const auto& swept = points->back().table;
    ASSERT_EQ(swept->ghosts.size(), table->ghosts.size());
    for (std::size_t k = 0; k < table->ghosts.size(); ++k) {
        EXPECT_EQ(swept->ghosts[k].path, table->ghosts[k].path);
        EXPECT_EQ(swept->ghosts[k].flux_mm2, table->ghosts[k].flux_mm2);
    }
}

TEST(GhostSweep, FindsWhereEachGhostIsWorst) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    const auto points = sweep(lens, request_of(lens, "field", {0.0, 5.0, 10.0, 15.0}));
    ASSERT_TRUE(points);
    const auto curves = curves_of(*points, SweepQuantity::flux);
    ASSERT_EQ(curves.size(), 15U);  // pairs of six surfaces
    for (std::size_t k = 0; k < curves.size(); ++k) {
        for (std::size_t p = 0; p < points->size(); ++p)
            EXPECT_LE(curves[k].values[p], curves[k].largest());
        EXPECT_LE(curves[k].largest(), curves[k > 0 ? k - 1 : 0].largest());
    }
    const Table table = sweep_table({SweepParameter::Kind::field, 0}, *points);
    EXPECT_EQ(table.columns.front(), "field_deg");
    EXPECT_EQ(table.columns.back(), "worst_field_deg");
    EXPECT_EQ(table.rows.size(), 4U * 15U);
}

TEST(GhostSweep, SetsWhatItSays) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    const auto set = [&](const char* parameter, double value) {
        return at_value(lens, "", {5.0, 90.0}, parse_sweep_parameter(parameter, lens), value);
    };
    EXPECT_EQ(set("azimuth", 30.0).light, (LightDirection{5.0, 30.0}));
    EXPECT_NEAR(first_order(compile(set("f-number", 8.0).lens, d_line_nm)).f_number, 8.0, 1e-9);
    EXPECT_EQ(set("thickness 2", 4.5).lens.surfaces[1].thickness_mm, 4.5);
    EXPECT_EQ(set("radius 3", -70.0).lens.surfaces[2].curve, BaseCurve(Radius{-70.0}));
    EXPECT_EQ(set("curvature 3", 0.01).lens.surfaces[2].curve, BaseCurve(Curvature{0.01}));
    EXPECT_EQ(set("semi-diameter 1", 3.0).lens.surfaces[0].semi_diameter_mm, 3.0);
    const Prescription coated = with_air_coating(lens, QuarterWave{});
    const auto thicker = at_value(coated, "", {}, parse_sweep_parameter("coating 1", coated), 1.2);
    EXPECT_EQ(std::get<QuarterWave>(thicker.lens.surfaces[0].coating).thickness_factor, 1.2);
    EXPECT_EQ(thicker.lens.surfaces[1].coating, coated.surfaces[1].coating);
}

TEST(GhostSweep, RunsThroughPositions) {
    Prescription lens = bundled("cooke_triplet_50_f5");
    Configuration near{.name = "near",
                       .thickness_mm = {{1, 5.0}},
                       .f_number = {},
                       .stop_semi_diameter_mm = {},
                       .published = {},
                       .unknown = {}};
    Configuration far = near;
    far.name = "far";
    far.thickness_mm = {{1, 7.0}};
    lens.configurations = {near, far};
    const SweepParameter position = parse_sweep_parameter("position", lens);
    const auto gap = [&](double value) {
        return at_value(lens, "", {}, position, value).lens.surfaces[1].thickness_mm;
    };
    EXPECT_EQ(gap(1.0), 5.0);
    EXPECT_EQ(gap(2.0), 7.0);
    EXPECT_NEAR(gap(1.25), 5.5, 1e-12);
    EXPECT_EQ(present_value(lens, "far", {}, position), 2.0);
    EXPECT_THROW(gap(2.5), Error);
}

TEST(GhostSweep, AValueThatCannotBeTracedSaysWhy) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    const auto points = sweep(lens, request_of(lens, "thickness 1", {-1.0, 3.0}));
    ASSERT_TRUE(points);
    EXPECT_FALSE(points->at(0).table);
    EXPECT_NE(points->at(0).failure.find("thickness"), std::string::npos);
    EXPECT_TRUE(points->at(1).table);
    const auto curves = curves_of(*points, SweepQuantity::flux);
    EXPECT_TRUE(std::isnan(curves.front().values[0]));
    EXPECT_EQ(curves.front().worst, 1U);
}

TEST(GhostSweep, RefusesWhatIsNoParameter) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    const auto refused = [&](const char* text) {
        return error_of([&] { parse_sweep_parameter(text, lens); });
    };
    EXPECT_NE(refused("colour").expected.find("f-number"), std::string::npos);
    EXPECT_NE(refused("radius").expected.find("surface from 1 to"), std::string::npos);
    EXPECT_NE(refused("radius 99").expected.find("surface from 1 to"), std::string::npos);
    EXPECT_NE(refused("position").expected.find("configurations"), std::string::npos);
    for (const char* text : {"field", "f-number", "radius 3", "semi-diameter 2", "coating 1"})
        EXPECT_EQ(name(parse_sweep_parameter(text, lens)), text);
}

TEST(GhostSweep, StopsWhenAsked) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    std::stop_source stop;
    std::size_t done = 0;
    const auto points = sweep(lens, request_of(lens, "field", {0.0, 1.0, 2.0}), stop.get_token(),
                              [&](const SweepPoint&) {
                                  ++done;
                                  stop.request_stop();
                              });
    EXPECT_FALSE(points);
    EXPECT_EQ(done, 1U);
}

}  // namespace
}  // namespace ghostlight
