#include "core/io/open_lens_flare.h"

#include <gmock/gmock.h>

#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "tests/support/error_of.h"
#include "tests/support/import_kit.h"

namespace ghostlight {
namespace {

constexpr double rounding_mm = 1e-9;  ///< two ways of the same sum

ImportedLens import(const std::string& text) { return import_open_lens_flare({text, "test.xml"}); }

const std::vector<BookRow> heliar_rows = {
    {30.81, 7.7, 1.652},   {-89.35, 1.85, 1.603}, {580.38, 3.52, 1.0},
    {-80.63, 1.85, 1.643}, {28.34, 4.18, 1.0},    {0.0, 3.0, 1.0},
    {0.0, 1.85, 1.581},    {32.19, 7.27, 1.694},  {-52.99, 82.857, 1.0}};

TEST(OpenLensFlare, NumbersAsPrinted) {
    const LensFile file = read_sample("open_lens_flare/heliar.xml");
    expect_rows(file.lens, heliar_rows, {14.5, 14.5, 14.5, 12.3, 12, 11.6, 12.3, 12.3, 12.3});
    EXPECT_EQ(file.lens.name, "Heliar & Tronnier");
    EXPECT_EQ(file.lens.stop.surface, 5u);
    EXPECT_EQ(file.lens.stop.f_number, 8.0);
    EXPECT_EQ(file.lens.published.half_field_deg, 30.0);
    EXPECT_EQ(file.lens.sensor.width_mm, 36.0);
    EXPECT_EQ(file.lens.surfaces.back().thickness_mm, 82.857);
    EXPECT_EQ(file.lens.surfaces[0].medium_after, (Medium{"", ModelGlass{1.652, 58.57}}));
    EXPECT_EQ(file.lens.surfaces[0].coating,
              Coating(QuarterWave{620.0, Medium{"", ConstantIndex{1.38}}, 1.0}));
    EXPECT_EQ(file.lens.surfaces[1].coating, Coating(Uncoated{}));
    const Note* mask = note_with(file.notes, "shape");
    ASSERT_NE(mask, nullptr);
    EXPECT_TRUE(mask->matters_for_flare);
}

TEST(OpenLensFlare, FirstOrderByAnotherWayAndAsPublished) {
    const LensFile file = read_sample("open_lens_flare/heliar.xml");
    const FirstOrder order = first_order(compile(file.lens, d_line_nm));
    EXPECT_NEAR(order.efl_mm, book_focus(heliar_rows).efl_mm, rounding_mm);
    EXPECT_NEAR(order.efl_mm, 100.0, 1.0);  // its indices have three decimals
    EXPECT_NEAR(order.f_number, 8.0, 1e-9);
}

std::string system_of(const std::string& elements) {
    return "<opticalSystem>\n<elements>\n" + elements + "\n</elements>\n</opticalSystem>\n";
}
const std::string lens_element =
    "<element><type>lensSpherical</type><height>9</height><thickness>4</thickness>"
    "<radius>50</radius><refractiveIndex>1.5</refractiveIndex><abbeNumber>60</abbeNumber></"
    "element>";

TEST(OpenLensFlare, WhatIsNotThereOrNotKnownIsSaid) {
    const ImportedLens lens = import(system_of(lens_element + "<extra/>"));
    EXPECT_FALSE(lens.stop);
    EXPECT_NE(note_with(lens.notes, "no sensor element"), nullptr);
    EXPECT_EQ(note_with(lens.notes, "\"extra\"")->fate, Note::Fate::left_out);
}

TEST(OpenLensFlare, ErrorsNameTheLine) {
    const auto refused = [](const std::string& elements) {
        return error_of([&] { import(system_of(elements)); });
    };
    EXPECT_EQ(refused(lens_element + "\n<element></element>").where, "line 4");
    EXPECT_THAT(refused("<element><type>mirror</type></element>").problem,
                testing::HasSubstr("kind of element"));
    EXPECT_THAT(
        refused("<element>\n<type>lensSpherical</type><thickness>x</thickness></element>").found,
        testing::HasSubstr("x"));
    EXPECT_THAT(refused("<element><type>sensor</type></element>" + lens_element).problem,
                testing::HasSubstr("behind the sensor"));
    EXPECT_THAT(refused("<element>").problem, testing::HasSubstr("XML"));
    EXPECT_THAT(refused("").problem, testing::HasSubstr("no surfaces"));
}

TEST(OpenLensFlare, EntitiesAreNotExpanded) {
    const Error::Parts error = error_of([] {
        import(
            "<?xml version=\"1.0\"?>\n<!DOCTYPE a [<!ENTITY b \"c\">]>\n<opticalSystem>&b;"
            "</opticalSystem>");
    });
    EXPECT_EQ(error.where, "line 2");
    // An undeclared one stays as it is written.
    EXPECT_EQ(import("<opticalSystem><name>&b;</name><elements>" + lens_element +
                     "</elements></opticalSystem>")
                  .lens.name,
              "&b;");
}

}  // namespace
}  // namespace ghostlight
