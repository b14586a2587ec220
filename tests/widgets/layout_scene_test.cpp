#include "widgets/layout_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/io/lens_file.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

constexpr double drawn_mm = 1e-9;  // of two formulas for one sag

Prescription bundled_lens(const std::string& file) { return read_lens(lens_folder() / file).lens; }

Surface sphere(double radius_mm, double thickness_mm, double semi_mm, double n_after) {
    Surface surface;
    surface.curve = Radius{radius_mm};
    surface.thickness_mm = thickness_mm;
    surface.semi_diameter_mm = semi_mm;
    if (n_after != 1.0) {
        surface.medium_after = {"", ConstantIndex{n_after}};
    }
    return surface;
}

/// A biconvex lens with a stop behind it.
Prescription singlet(double front_semi_mm, double back_semi_mm) {
    Prescription lens;
    lens.name = "singlet";
    lens.surfaces = {sphere(50.0, 8.0, front_semi_mm, 1.5), sphere(-50.0, 2.0, back_semi_mm, 1.0),
                     sphere(1e9, 45.0, 6.0, 1.0)};
    lens.surfaces[2].curve = Plane{};
    lens.stop.surface = 2;
    return lens;
}

double area(const Polyline& outline) {
    double twice = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const DrawingPoint& a = outline[i];
        const DrawingPoint& b = outline[(i + 1) % outline.size()];
        twice += a.x * b.y - b.x * a.y;
    }
    return std::abs(twice) / 2.0;
}

double sliced_area(const GlassElement& element) {
    double sum = 0.0;
    for (std::size_t i = 1; i < element.slices.size(); ++i) {
        const auto& a = element.slices[i - 1];
        const auto& b = element.slices[i];
        sum += (b.y - a.y) * (a.z_back - a.z_front + b.z_back - b.z_front) / 2.0;
    }
    return sum;
}

TEST(Sag, IsThatOfTheSphereTheConicAndTheAsphere) {
    Surface surface = sphere(40.0, 1.0, 20.0, 1.5);
    EXPECT_NEAR(sag_mm(surface, 20.0), 40.0 - std::sqrt(1600.0 - 400.0), drawn_mm);
    EXPECT_NEAR(sag_mm(surface, -20.0), sag_mm(surface, 20.0), drawn_mm);
    surface.conic = -1.0;
    EXPECT_NEAR(sag_mm(surface, 20.0), 400.0 / 80.0, drawn_mm) << "paraboloid: y²/2R";
    surface.aspheric = {1e-5, -2e-8};
    EXPECT_NEAR(sag_mm(surface, 10.0), 100.0 / 80.0 + 1e-5 * 1e4 - 2e-8 * 1e6, drawn_mm);
    surface.curve = Plane{};
    surface.aspheric.clear();
    EXPECT_EQ(sag_mm(surface, 7.0), 0.0);
}

TEST(Sag, EndsWhereTheSphereEnds) {
    const Surface surface = sphere(-10.0, 1.0, 12.0, 1.5);
    EXPECT_NEAR(sag_mm(surface, 12.0), -10.0, drawn_mm);
}

TEST(LayoutScene, OutlinesReachFromRimToRimOnTheSurface) {
    const Prescription lens = singlet(15.0, 12.0);
    const LensDrawing drawing = lens_drawing(lens, nullptr, {});
    ASSERT_EQ(drawing.surfaces.size(), 3U);
    const SurfaceOutline& front = drawing.surfaces[0];
    EXPECT_NEAR(front.points.front().y, -15.0, drawn_mm);
    EXPECT_NEAR(front.points.back().y, 15.0, drawn_mm);
    EXPECT_NEAR(front.points.back().x, 50.0 - std::sqrt(2500.0 - 225.0), drawn_mm);
    for (const DrawingPoint& point : drawing.surfaces[1].points) {
        EXPECT_NEAR(std::hypot(point.x - (8.0 - 50.0), point.y), 50.0, drawn_mm);
    }
    EXPECT_FALSE(drawing.surfaces[2].refracts);
    EXPECT_TRUE(drawing.surfaces[2].is_stop);
}

TEST(LayoutScene, TheSmallerSurfaceIsJoinedToTheLargerOnesRim) {
    for (const auto& [front, back] : {std::pair{15.0, 12.0}, {12.0, 15.0}, {14.0, 14.0}}) {
        const LensDrawing drawing = lens_drawing(singlet(front, back), nullptr, {});
        ASSERT_EQ(drawing.elements.size(), 1U);
        const GlassElement& element = drawing.elements.front();
        const double rim = std::max(front, back);
        // Both faces reach the same height, so that the outline has a straight edge there.
        const GlassElement::Slice& top = element.slices.back();
        EXPECT_NEAR(top.y, rim, drawn_mm);
        EXPECT_GT(top.z_back, top.z_front);
        // Symmetrical, closed and not crossed: its area is that of its slices.
        EXPECT_NEAR(area(element.outline), sliced_area(element), 1e-6 * sliced_area(element));
        EXPECT_NEAR(element.slices.front().y, -rim, drawn_mm);
    }
}

TEST(LayoutScene, TheEdgeIsFlatUnlessItWouldLeaveTheGlass) {
    // A flat ring of the back surface, at its rim's z, is where a lens is ground for its seat.
    const LensDrawing flat = lens_drawing(singlet(15.0, 12.0), nullptr, {});
    const Surface back = sphere(-50.0, 2.0, 12.0, 1.0);
    EXPECT_NEAR(flat.elements[0].slices.back().z_back, 8.0 + sag_mm(back, 12.0), drawn_mm);

    // A thin, deeply curved meniscus with a small front: the ring would come out at the back.
    Prescription lens = singlet(8.0, 18.0);
    lens.surfaces[0].curve = Radius{-20.0};
    lens.surfaces[1].curve = Radius{-20.5};
    lens.surfaces[0].thickness_mm = 1.5;
    const GlassElement bevelled = lens_drawing(lens, nullptr, {}).elements.at(0);
    for (const GlassElement::Slice& slice : bevelled.slices) {
        EXPECT_LE(slice.z_front, slice.z_back + drawn_mm);
    }
}

TEST(LayoutScene, CementedElementsShareTheirSurface) {
    const Prescription lens = bundled_lens("tessar_brendel_100_f2.8.json");
    const OpticalSystem system = compile(lens, 587.5618);
    const LensDrawing drawing = lens_drawing(lens, &system, {});
    bool cemented = false;
    for (std::size_t i = 1; i < drawing.elements.size(); ++i) {
        const GlassElement& before = drawing.elements[i - 1];
        const GlassElement& after = drawing.elements[i];
        if (before.back_row != after.front_row) {
            continue;
        }
        cemented = true;
        // At every height that both have, the one ends where the other begins.
        for (const GlassElement::Slice& a : before.slices) {
            for (const GlassElement::Slice& b : after.slices) {
                if (a.y == b.y) {
                    EXPECT_NEAR(a.z_back, b.z_front, drawn_mm);
                }
            }
        }
    }
    EXPECT_TRUE(cemented);
}

TEST(LayoutScene, AStopInsideGlassDoesNotDivideTheElement) {
    Prescription lens = singlet(10.0, 10.0);
    Surface stop = sphere(1.0, 4.0, 6.0, 1.5);
    stop.curve = Plane{};
    lens.surfaces = {sphere(50.0, 4.0, 10.0, 1.5), stop, sphere(-50.0, 45.0, 10.0, 1.0)};
    lens.stop.surface = 1;
    const LensDrawing drawing = lens_drawing(lens, nullptr, {});
    ASSERT_EQ(drawing.elements.size(), 1U);
    EXPECT_EQ(drawing.elements[0].front_row, 0U);
    EXPECT_EQ(drawing.elements[0].back_row, 2U);
}

TEST(LayoutScene, SurfacesThatCrossInsideTheirRimsLeaveNoGlassOutside) {
    Prescription lens = singlet(30.0, 30.0);
    lens.surfaces[0].thickness_mm = 5.0;  // the rims are 9 mm past each other
    const GlassElement element = lens_drawing(lens, nullptr, {}).elements.at(0);
    EXPECT_FALSE(element.slices.empty());
    for (const GlassElement::Slice& slice : element.slices) {
        EXPECT_LE(slice.z_front, slice.z_back);
        EXPECT_LT(std::abs(slice.y), 16.0);
    }
}

TEST(LayoutScene, TheStopOpensAsFarAsTheFNumberSays) {
    Prescription lens = bundled_lens("tessar_brendel_100_f2.8.json");
    lens.stop.f_number = 8.0;
    const OpticalSystem system = compile(lens, 587.5618);
    const LensDrawing drawing = lens_drawing(lens, &system, {});
    EXPECT_EQ(drawing.stop.opening_mm, system.stop_mask.semi_diameter_mm);
    EXPECT_GT(drawing.stop.outer_mm, lens.surfaces[lens.stop.surface].semi_diameter_mm);
}

TEST(LayoutScene, TheSensorIsAsLongAsItIsInTheLightsPlane) {
    const Prescription lens = singlet(15.0, 12.0);
    EXPECT_NEAR(lens_drawing(lens, nullptr, {5.0, 90.0}).sensor.half_length_mm, 12.0, drawn_mm);
    EXPECT_NEAR(lens_drawing(lens, nullptr, {5.0, 0.0}).sensor.half_length_mm, 18.0, drawn_mm);
    EXPECT_NEAR(lens_drawing(lens, nullptr, {5.0, -180.0}).sensor.half_length_mm, 18.0, drawn_mm);
    const double to_corner = std::atan2(24.0, 36.0) * 180.0 / std::acos(-1.0);
    EXPECT_NEAR(lens_drawing(lens, nullptr, {5.0, to_corner}).sensor.half_length_mm,
                std::hypot(18.0, 12.0), 1e-6);
}

TEST(LayoutScene, TheBoxHoldsTheLens) {
    for (const auto& entry : bundled_lenses()) {
        const Prescription lens = configured(read_lens(entry.file).lens, {});
        const OpticalSystem system = compile(lens, 587.5618);
        const LensDrawing drawing = lens_drawing(lens, &system, {});
        EXPECT_FALSE(drawing.elements.empty()) << entry.name;
        for (const GlassElement& element : drawing.elements) {
            for (const DrawingPoint& point : element.outline) {
                ASSERT_GE(point.x, drawing.box.z_min) << entry.name;
                ASSERT_LE(point.x, drawing.box.z_max) << entry.name;
                ASSERT_GE(point.y, drawing.box.y_min) << entry.name;
                ASSERT_LE(point.y, drawing.box.y_max) << entry.name;
            }
        }
    }
}

TEST(LayoutScene, DrawsWhatItCanOfALensThatCannotBeTraced) {
    Prescription lens = singlet(15.0, 12.0);
    lens.surfaces[1].curve = Radius{0.0};
    const LensDrawing drawing = lens_drawing(lens, nullptr, {});
    EXPECT_EQ(drawing.surfaces.size(), 3U);
    EXPECT_TRUE(drawing.elements.empty());
    EXPECT_TRUE(std::isfinite(drawing.box.z_max));
    EXPECT_TRUE(lens_drawing(Prescription{}, nullptr, {}).elements.empty());
}

}  // namespace
}  // namespace ghostlight
