#include "core/optics/reverse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/io/lens_file.h"
#include "core/optics/between_configurations.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

std::vector<Prescription> bundled_lenses() {
    std::vector<Prescription> lenses;
    for (const auto& entry : std::filesystem::directory_iterator(lens_folder()))
        if (entry.path().extension() == ".json") lenses.push_back(read_lens(entry.path()).lens);
    return lenses;
}

/// A lens in air has the same focal length from both sides (its system matrix has determinant 1).
TEST(ReverseTest, KeepsTheFocalLength) {
    const auto lenses = bundled_lenses();
    ASSERT_EQ(lenses.size(), 10U);
    for (const Prescription& lens : lenses) {
        const double efl_mm = first_order(compile(lens, d_line_nm)).efl_mm;
        const double turned_mm = first_order(compile(reversed(lens), d_line_nm)).efl_mm;
        EXPECT_NEAR(turned_mm / efl_mm, 1.0, 1e-12)
            << lens.name;  // rounding of some 60 refractions
    }
}

TEST(ReverseTest, TwiceIsTheLensItself) {
    for (const Prescription& lens : bundled_lenses()) EXPECT_EQ(reversed(reversed(lens)), lens);
}

/// Light that goes back through an interface meets the same reflectance.
TEST(ReverseTest, CoatingsAreSeenFromTheirOtherSide) {
    const Medium glass{{}, ConstantIndex{1.6}};
    const LayerStack stack{{{magnesium_fluoride(), 96.0}, {Medium{{}, ConstantIndex{2.1}}, 50.0}}};
    const Film film = film_at(stack, Medium{}, glass, 550.0);
    const Film turned = film_at(reversed(Coating{stack}), glass, Medium{}, 550.0);
    EXPECT_EQ(turned, reversed(film));
    LayerStack from_air = stack;
    from_air.from_air = true;
    EXPECT_EQ(reversed(Coating{from_air}), Coating{from_air});
}

TEST(ReverseTest, ConfigurationsFollowTheirGaps) {
    const Prescription zoom = read_lens(lens_folder() / "nikon_zoom_80_200_f2.8.json").lens;
    const Prescription turned = reversed(zoom);
    for (const Configuration& position : zoom.configurations) {
        const double efl_mm =
            first_order(compile(configured(zoom, position.name), d_line_nm)).efl_mm;
        const double turned_mm =
            first_order(compile(configured(turned, position.name), d_line_nm)).efl_mm;
        EXPECT_NEAR(turned_mm / efl_mm, 1.0, 1e-12) << position.name;
    }
}

TEST(ReverseTest, ALensThatEndsInGlassIsRefused) {
    Prescription lens = bundled_lenses().front();
    lens.surfaces.back().medium_after = Medium{{}, ConstantIndex{1.5}};
    EXPECT_THROW(reversed(lens), Error);
}

TEST(BetweenConfigurationsTest, EndsAreTheEndsAndTheMiddleIsHalfway) {
    const Prescription zoom = read_lens(lens_folder() / "nikon_zoom_80_200_f2.8.json").lens;
    ASSERT_GE(zoom.configurations.size(), 2U);
    const std::string first = zoom.configurations.front().name;
    const std::string last = zoom.configurations.back().name;
    for (const double share : {0.0, 1.0}) {
        Prescription lens = zoom;
        lens.configurations.push_back(between_configurations(zoom, first, last, share));
        lens.configurations.back().name = "between";
        const Prescription there = configured(lens, "between");
        const Prescription end = configured(zoom, share == 0.0 ? first : last);
        EXPECT_EQ(there.surfaces, end.surfaces) << share;
        EXPECT_EQ(there.stop.f_number, end.stop.f_number) << share;
    }
    const Configuration middle = between_configurations(zoom, first, last, 0.5);
    const Prescription a = configured(zoom, first), b = configured(zoom, last);
    ASSERT_FALSE(middle.thickness_mm.empty());
    for (const auto& [row, thickness_mm] : middle.thickness_mm)
        EXPECT_DOUBLE_EQ(thickness_mm,
                         0.5 * (a.surfaces[row].thickness_mm + b.surfaces[row].thickness_mm));
    // Every gap moves one way, so the focal length lies between the two.
    Prescription lens = zoom;
    lens.configurations.push_back(middle);
    lens.configurations.back().name = "middle";
    const auto efl_mm = [&](const std::string& name) {
        return first_order(compile(configured(lens, name), d_line_nm)).efl_mm;
    };
    EXPECT_GT(efl_mm("middle"), std::min(efl_mm(first), efl_mm(last)));
    EXPECT_LT(efl_mm("middle"), std::max(efl_mm(first), efl_mm(last)));
}

TEST(BetweenConfigurationsTest, AsListedIsAnEndToo) {
    Prescription lens = bundled_lenses().front();
    const double listed_mm = lens.surfaces[0].thickness_mm;
    Configuration near;
    near.name = "near";
    near.thickness_mm[0] = listed_mm + 2.0;
    lens.configurations = {near};
    const Configuration half = between_configurations(lens, "", "near", 0.5);
    EXPECT_EQ(half.thickness_mm, (std::map<std::size_t, double>{{0, listed_mm + 1.0}}));
    EXPECT_FALSE(half.f_number);
    EXPECT_THROW(between_configurations(lens, "", "far", 0.5), Error);
    EXPECT_THROW(between_configurations(lens, "", "near", 1.5), Error);
}

}  // namespace
}  // namespace ghostlight
