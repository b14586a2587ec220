#include "core/io/optical_bench.h"

#include <gmock/gmock.h>

#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "tests/support/error_of.h"
#include "tests/support/import_kit.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double rounding_mm = 1e-9;  ///< two ways of the same sum

ImportedLens import(const std::string& text) { return import_optical_bench({text, "test.txt"}); }

constexpr const char* singlet =
    "[variable distances]\nFocal Length\t50\nF-Number\t4\nd2\t1.5\nBf\t47\n"
    "[lens data]\n1\t50\t4\t1.5\t20\t60\n2\t-50\td2\t\t20\n3\tAS\tBf\t\t11\t\t\n";

std::string with(std::string_view from, std::string_view to) {
    std::string text = singlet;
    const auto at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return text.replace(at, from.size(), to);
}

/// The listing was made from the bundled zoom: every number has to come back.
TEST(OpticalBench, ZoomInEveryPosition) {
    const LensFile file = read_sample("optical_bench/zoom.txt");
    const Prescription bundled_zoom = bundled("nikon_zoom_80_200_f2.8");
    ASSERT_EQ(file.lens.surfaces.size(), bundled_zoom.surfaces.size());
    for (std::size_t row = 0; row < file.lens.surfaces.size(); ++row) {
        const Surface& got = file.lens.surfaces[row];
        const Surface& wanted = bundled_zoom.surfaces[row];
        EXPECT_EQ(got.curve, wanted.curve) << row;
        EXPECT_EQ(got.thickness_mm, wanted.thickness_mm) << row;
        EXPECT_EQ(got.medium_after, wanted.medium_after) << row;
        EXPECT_NEAR(got.semi_diameter_mm, wanted.semi_diameter_mm, 1e-12) << row;
    }
    EXPECT_EQ(file.lens.name, "Zoom 80-200 f/2.8");
    EXPECT_EQ(file.lens.stop.surface, 17u);
    ASSERT_EQ(file.lens.configurations.size(), 2u);
    const Configuration& tele = file.lens.configurations[1];
    EXPECT_EQ(file.lens.configurations[0].name, "82 mm");
    EXPECT_EQ(tele.name, "196 mm");
    EXPECT_EQ(tele.thickness_mm, bundled_zoom.configurations[1].thickness_mm);
    EXPECT_EQ(tele.stop_semi_diameter_mm, 9.4);
    EXPECT_EQ(tele.published.f_number, 2.9);
    EXPECT_EQ(tele.published.half_field_deg, 6.1);
    EXPECT_NE(note_with(file.notes, "position 3"), nullptr);
    // In either position the lens is the bundled one.
    for (const auto& [ours, theirs] : {std::pair{"82 mm", "short"}, {"196 mm", "long"}})
        EXPECT_NEAR(first_order(compile(file.lens, d_line_nm, ours)).efl_mm,
                    first_order(compile(bundled_zoom, d_line_nm, theirs)).efl_mm, rounding_mm);
    const OpticalSystem wide = compile(file.lens, d_line_nm, "82 mm");
    EXPECT_EQ(wide.stop_mask.semi_diameter_mm, 9.1);
    EXPECT_EQ(compile(file.lens, d_line_nm).stop_mask.semi_diameter_mm, 9.1);
}

TEST(OpticalBench, DiametersAspheresStopsAndCoverGlass) {
    const LensFile file = read_sample("optical_bench/aspheres.txt");
    const Prescription& lens = file.lens;
    ASSERT_EQ(lens.surfaces.size(), 10u);
    EXPECT_EQ(lens.surfaces[0].semi_diameter_mm, 12.0);
    EXPECT_EQ(lens.surfaces[2].comment, "field stop");
    EXPECT_EQ(lens.surfaces[8].comment, "cover glass");
    EXPECT_EQ(lens.surfaces[8].curve, BaseCurve(Plane{}));
    EXPECT_EQ(lens.stop.surface, 5u);
    EXPECT_EQ(lens.surfaces.back().thickness_mm, 1.5);
    // AsphericalOddCount 1: r³, r⁴, r⁶. Without the r³ term the others are exact.
    EXPECT_EQ(lens.surfaces[0].conic, -0.5);
    EXPECT_EQ(lens.surfaces[0].aspheric, (std::vector<double>{1e-6, -2e-9}));
    EXPECT_EQ(lens.surfaces[7].aspheric, (std::vector<double>{-1.5e-6}));
    const Note* odd = note_with(file.notes, "r^3");
    ASSERT_NE(odd, nullptr);
    EXPECT_EQ(odd->fate, Note::Fate::converted);
    EXPECT_NE(note_with(file.notes, "\"CONSTANTS\" is disabled"), nullptr);
    EXPECT_TRUE(note_with(file.notes, "\"ASPHERICAL DATA\" is disabled")->matters_for_flare);
    EXPECT_TRUE(note_with(file.notes, "the object is 1000 mm away")->matters_for_flare);
}

/// The catalogue's glass where its nd agrees within 2e-4, else the file's nd and Vd.
TEST(OpticalBench, NamedGlasses) {
    const LensFile file = read_sample("optical_bench/aspheres.txt");
    EXPECT_EQ(file.lens.surfaces[0].medium_after, *bundled_glasses().find("N-BK7"));
    EXPECT_EQ(file.lens.surfaces[3].medium_after, (Medium{"N-BK7", ModelGlass{1.7, 55.0}}));
    EXPECT_EQ(file.lens.surfaces[6].medium_after, (Medium{"NO-SUCH-1", ModelGlass{1.65, 33.8}}));
    EXPECT_EQ(note_with(file.notes, "but 1.7 in the file")->where, "line 18");
}

/// z = R − √(R² − r²) + a2 r² + a4 r⁴, as the surface is traced.
TEST(OpticalBench, ATermInTheSquareOfTheHeight) {
    const Prescription lens = read_sample("optical_bench/square_term.txt").lens;
    const Surface& surface = lens.surfaces[1];
    for (double r = 0.0; r < 6.0; r += 0.5) {
        const double c = curvature_per_mm(surface.curve);
        double z = c * r * r / (1.0 + std::sqrt(1.0 - (1.0 + surface.conic) * c * c * r * r));
        for (std::size_t i = 0; i < surface.aspheric.size(); ++i)
            z += surface.aspheric[i] * std::pow(r, 4.0 + 2.0 * static_cast<double>(i));
        const double wanted =
            50.0 - std::sqrt(2500.0 - r * r) + 1e-3 * r * r - 1e-6 * std::pow(r, 4);
        EXPECT_NEAR(z, wanted, 1e-9) << r;
    }
}

TEST(OpticalBench, FirstOrderByAnotherWay) {
    const ImportedLens lens = import(singlet);
    const FirstOrder order = first_order(compile(lens.lens, d_line_nm));
    const BookFocus book = book_focus({{50, 4, 1.5}, {-50, 1.5, 1}, {0, 47, 1}});
    EXPECT_NEAR(order.efl_mm, book.efl_mm, rounding_mm);
    EXPECT_EQ(lens.stop, 2u);
    EXPECT_EQ(lens.sensor_distance_mm, 47.0);
    EXPECT_EQ(lens.f_number, 4.0);
    EXPECT_TRUE(lens.lens.configurations.empty());
}

TEST(OpticalBench, LostTabsAndNamesWithSuffix) {
    const ImportedLens lens = import(
        "[variable distances]\nFocal Length (p)\t50\n[lens data]\n1 50 4 1.5 20 60\n"
        "2 -50 40 20\n");
    EXPECT_TRUE(is_air(lens.lens.surfaces[1].medium_after));
    EXPECT_EQ(lens.surfaces[1].semi_diameter_mm, 10.0);
    EXPECT_EQ(lens.stated_efl_mm, 50.0);
}

TEST(OpticalBench, FNumbersOfPositionsWithoutAStopWidth) {
    const ImportedLens lens = import(with("Focal Length\t50\nF-Number\t4\nd2\t1.5",
                                          "Focal Length\t50\t51\nF-Number\t4\t5.6\nd2\t1.5\t1.7"));
    ASSERT_EQ(lens.lens.configurations.size(), 2u);
    EXPECT_EQ(lens.lens.configurations[1].f_number, 5.6);
    EXPECT_FALSE(lens.lens.configurations[1].stop_semi_diameter_mm);
    EXPECT_EQ(lens.lens.configurations[1].thickness_mm.at(1), 1.7);
}

TEST(OpticalBench, ErrorsNameTheLine) {
    const auto refused = [](std::string_view from, std::string_view to) {
        return error_of([&] { import(with(from, to)); });
    };
    EXPECT_EQ(refused("-50\td2", "-50\td3").where, "line 8");
    EXPECT_THAT(refused("-50\td2", "-50\td3").found, testing::HasSubstr("d3"));
    EXPECT_EQ(refused("1\t50\t4", "1\tx\t4").where, "line 7");
    EXPECT_EQ(refused("d2\t1.5", "d2\tundefined").problem, "no position has all its thicknesses");
    EXPECT_THAT(refused("1.5\t20\t60", "0.5\t20\t60").problem, testing::HasSubstr("index"));
    EXPECT_THAT(refused("[lens data]", "[aspherical data]\n9\t1\t0\t1\n[lens data]").found,
                testing::HasSubstr("9"));
    EXPECT_THAT(refused("[lens data]", "[constants]\nAsphericalOddCount\tx\n[lens data]").where,
                "line 7");
    error_of([] { import("[lens data]\n"); });
}

}  // namespace
}  // namespace ghostlight
