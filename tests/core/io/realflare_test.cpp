#include "core/io/realflare.h"

#include <gmock/gmock.h>

#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "tests/support/error_of.h"
#include "tests/support/import_kit.h"

namespace ghostlight {
namespace {

constexpr double rounding_mm = 1e-9;  ///< two ways of the same sum

ImportedLens import(const std::string& text) { return import_realflare({text, "test.json"}); }

TEST(Realflare, NumbersAsPrinted) {
    const LensFile file = read_sample("realflare/double_gauss.json");
    expect_rows(file.lens, double_gauss_rows, double_gauss_clear_radii);
    EXPECT_EQ(file.lens.name, "Double Gauss");
    EXPECT_EQ(file.lens.source, "US2673491, 1954");
    EXPECT_EQ(file.lens.stop.surface, 5u);
    EXPECT_EQ(file.lens.published.efl_mm, 100.0);
    EXPECT_EQ(file.lens.published.f_number, 2.0);
    EXPECT_EQ(file.lens.surfaces[0].medium_after, (Medium{"", ModelGlass{1.67, 47.1}}));
    const FirstOrder order = first_order(compile(file.lens, d_line_nm));
    EXPECT_NEAR(order.efl_mm, book_focus(double_gauss_rows).efl_mm, rounding_mm);
    EXPECT_NE(note_with(file.notes, "heights are semi-diameters"), nullptr);
}

constexpr const char* singlet = R"({"focal_length": 50, "fstop": 2.5, "aperture_index": 0,
 "lens_elements": [
  {"radius": 0, "distance": 1, "refractive_index": 1, "abbe_nr": 0, "height": 1},
  {"radius": 50, "distance": 4, "refractive_index": 1.5, "abbe_nr": 60, "height": 1.2,
   "coating_lambda": 500, "coating_index": 1.38},
  {"radius": -50, "distance": 48, "refractive_index": 1, "abbe_nr": 0, "height": 1.2, "odd": 1}]})";

std::string with(std::string_view from, std::string_view to) {
    std::string text = singlet;
    const auto at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(Realflare, HeightsInCentimetresCoatingsAndUnknownFields) {
    const ImportedLens lens = import(singlet);
    EXPECT_EQ(lens.surfaces[1].semi_diameter_mm, 12.0);
    EXPECT_EQ(lens.lens.surfaces[1].coating,
              Coating(QuarterWave{500.0, Medium{"", ConstantIndex{1.38}}, 1.0}));
    EXPECT_EQ(note_with(lens.notes, "centimetres")->fate, Note::Fate::converted);
    EXPECT_EQ(note_with(lens.notes, "\"odd\"")->fate, Note::Fate::left_out);
}

TEST(Realflare, AStopOffByOneIsNoticed) {
    const ImportedLens lens = import(with("\"aperture_index\": 0", "\"aperture_index\": 1"));
    EXPECT_EQ(lens.stop, 1u);
    EXPECT_EQ(note_with(lens.notes, "not a plane in air")->proposal, "set the stop to surface 1");
    EXPECT_FALSE(import(with("\"aperture_index\": 0", "\"x\": 0")).stop);
}

TEST(Realflare, ErrorsNameTheField) {
    const auto refused = [](std::string_view from, std::string_view to) {
        return error_of([&] { import(with(from, to)); });
    };
    EXPECT_EQ(refused("\"radius\": 50", "\"radius\": \"x\"").where, "lens_elements[2].radius");
    EXPECT_EQ(refused("\"refractive_index\": 1.5, ", "").where,
              "lens_elements[2].refractive_index");
    EXPECT_EQ(refused("\"aperture_index\": 0", "\"aperture_index\": 3").where, "aperture_index");
    EXPECT_THAT(refused("1.5", "0.2").problem, testing::HasSubstr("index"));
}

}  // namespace
}  // namespace ghostlight
