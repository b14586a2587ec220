#include "core/io/oslo.h"

#include <gmock/gmock.h>

#include "core/io/oslo_text.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "tests/support/error_of.h"
#include "tests/support/import_kit.h"

namespace ghostlight {
namespace {

constexpr double rounding_mm = 1e-9;  ///< two ways of the same sum

ImportedLens import(const std::string& text) { return import_oslo({text, "test.len"}); }

/// A singlet with its system, first and last block open.
std::string singlet(const std::string& system, const std::string& first = "",
                    const std::string& last = "TH 40") {
    return "LEN NEW \"test\" 100 3\n" + system + "\nTH 1e20\nNXT\nGLA 1.5\nRD 50\nTH 4\n" + first +
           "\nNXT\nAIR\nRD -50\n" + last + "\nNXT\nAIR\nEND 3\n";
}

TEST(Oslo, NumbersAsPrinted) {
    const LensFile file = read_sample("oslo/cooke_triplet.len");
    const Prescription& lens = file.lens;
    ASSERT_EQ(lens.surfaces.size(), 7u);
    const double radii[] = {22.01359, -435.76044, -22.21328, 20.29192, 0, 79.6836, -18.39533};
    const double thicknesses[] = {3.25896, 6.00755, 0.99997, 1.0, 3.75041, 2.95208};
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_EQ(lens.surfaces[i].curve,
                  radii[i] == 0 ? BaseCurve(Plane{}) : BaseCurve(Radius{radii[i]}));
        if (i < 6) {
            EXPECT_EQ(lens.surfaces[i].thickness_mm, thicknesses[i]);
        }
    }
    EXPECT_EQ(lens.name, "Cooke triplet f/5");
    EXPECT_EQ(lens.stop.surface, 4u);
    EXPECT_EQ(lens.surfaces[0].medium_after, *bundled_glasses().find("N-SK16"));
    EXPECT_EQ(lens.surfaces[5].medium_after, lens.surfaces[0].medium_after);
    EXPECT_EQ(lens.surfaces[0].semi_diameter_mm, 9.5);
    EXPECT_EQ(lens.published.efl_mm, 50.0);
    EXPECT_EQ(lens.published.half_field_deg, 20.0);
    EXPECT_TRUE(lens.sensor.at_paraxial_focus);
}

/// The triplet's published focal lengths, and its beam at the stop by hand from EBR.
TEST(Oslo, FirstOrderAndStop) {
    const Prescription lens = read_sample("oslo/cooke_triplet.len").lens;
    const FirstOrder order = first_order(compile(lens, d_line_nm));
    EXPECT_NEAR(order.efl_mm, 50.0, 0.05);  // the rounding of the source's number
    // N-SK16 has nd 1.62041 in Schott's catalogue, to five decimals.
    const BookFocus book = book_focus({{22.01359, 3.25896, 1.62041},
                                       {-435.76044, 6.00755, 1.0},
                                       {-22.21328, 0.99997, 1.62004},
                                       {20.29192, 4.75041, 1.0},
                                       {79.6836, 2.95208, 1.62041},
                                       {-18.39533, 0.0, 1.0}});
    constexpr double index_mm = 2e-3;  // 5e-6 of index times the powers of a 50 mm lens
    EXPECT_NEAR(order.efl_mm, book.efl_mm, index_mm);
    EXPECT_NEAR(order.bfd_mm, book.bfd_mm, index_mm);
    EXPECT_NEAR(order.entrance_pupil_radius_mm, 5.0, 1e-6);
}

/// At d, F and C that is nd itself and Vd = (nd − 1)/(nF − nC).
TEST(Oslo, ModelGlassFromItsIndices) {
    const Medium flint = read_sample("oslo/cooke_triplet.len").lens.surfaces[2].medium_after;
    ASSERT_TRUE(std::holds_alternative<ModelGlass>(flint.dispersion));
    EXPECT_NEAR(refractive_index(flint, d_line_nm), 1.62004, 1e-12);
    EXPECT_NEAR(abbe_number(flint), 0.62004 / (1.63208 - 1.61503), 1e-9);
}

TEST(Oslo, AperturesThatClipAndThatAreOnlyDrawn) {
    const LensFile file = read_sample("oslo/cooke_triplet.len");
    EXPECT_EQ(note_with(file.notes, "AP CHK")->where, "line 14");
    const Note* drawn = note_with(file.notes, "only sizes the drawing in OSLO");
    ASSERT_NE(drawn, nullptr);
    EXPECT_TRUE(drawn->matters_for_flare);
    EXPECT_FALSE(drawn->proposal.empty());
    EXPECT_NE(note_with(file.notes, "commands after END"), nullptr);
    const ImportedLens lens = import(singlet("EBR 5", "AP 4", "TH 40\nAP CHK 9"));
    EXPECT_FALSE(lens.surfaces[0].semi_diameter_mm);  // less than the beam: cannot be the rim
    EXPECT_EQ(lens.surfaces[1].semi_diameter_mm, 9.0);
    EXPECT_FALSE(import(singlet("EBR 5", "AP 1e9")).surfaces[0].semi_diameter_mm);
}

TEST(Oslo, LensUnitsAndAspheres) {
    const LensFile file = read_sample("oslo/asphere_cm.len");
    const Prescription& lens = file.lens;
    EXPECT_EQ(lens.surfaces[0].curve, BaseCurve(Radius{50.0}));
    EXPECT_EQ(lens.surfaces[0].thickness_mm, 4.0);
    EXPECT_EQ(lens.surfaces[0].semi_diameter_mm, 8.0);
    EXPECT_EQ(lens.surfaces[0].conic, -0.5);
    EXPECT_EQ(lens.surfaces[0].medium_after.dispersion, Dispersion(ModelGlass{1.5168, 64.17}));
    // a4 in cm⁻³ is a thousandth of that in mm⁻³; AS2 is the coefficient of r⁴.
    ASSERT_EQ(lens.surfaces[0].aspheric.size(), 2u);
    EXPECT_DOUBLE_EQ(lens.surfaces[0].aspheric[0], -1e-6);
    EXPECT_DOUBLE_EQ(lens.surfaces[0].aspheric[1], 2e-10);
    ASSERT_EQ(lens.surfaces[1].aspheric.size(), 2u);
    EXPECT_DOUBLE_EQ(lens.surfaces[1].aspheric[0], 4e-7);
    EXPECT_DOUBLE_EQ(lens.surfaces[1].aspheric[1], -1e-10);
    EXPECT_EQ(lens.surfaces[1].thickness_mm, 80.0);
    EXPECT_NE(note_with(file.notes, "lens units of 10 mm"), nullptr);
}

/// Thickness and curvature left to the marginal ray: y' = 0 and u' = −0.1, from y = 5.
TEST(Oslo, SolvesFollowTheMarginalRay) {
    const ImportedLens image = import(singlet("EBR 5", "", "PY 0"));
    EXPECT_FALSE(image.sensor_distance_mm);
    const ImportedLens curved = import(
        "LEN NEW \"x\" 100 3\nEBR 5\nTH 1e20\nNXT\nGLA 1.5\nPU -0.1\nPY 4.0\nNXT\nAIR\nRD -50\n"
        "TH 20\nNXT\nAIR\nEND 3\n");
    // n'u' = −y c (n' − 1): c = 1.5·0.1/(5·0.5), and 1 mm of height is lost in 10 mm.
    EXPECT_NEAR(curvature_per_mm(curved.lens.surfaces[0].curve), 0.06, 1e-12);
    EXPECT_NEAR(curved.lens.surfaces[0].thickness_mm, 10.0, rounding_mm);
}

/// Counted from the first surface, or back from this one; the number behind is added.
/// A solve is never worked out from a guess.
TEST(Oslo, SolvesThatLackTheirRayAreRefused) {
    const auto lens = [](const char* system, const char* glass, const char* solve) {
        return std::string("LEN NEW \"x\" 1 3\n") + system + "\nTH 1e20\nNXT\nGLA " + glass +
               "\nRD 50\n" + solve + "\nNXT\nAIR\nRD -50\nTH 20\nNXT\nEND 3\n";
    };
    EXPECT_NO_THROW(import(lens("EBR 5", "1.5", "PY 4")));
    EXPECT_THAT(error_of([&] { import(lens("", "1.5", "PY 4")); }).problem,
                testing::HasSubstr("entrance beam"));
    EXPECT_THAT(error_of([&] { import(lens("EBR 5", "NOSUCH17", "PY 4")); }).problem,
                testing::HasSubstr("nobody knows"));
}

TEST(Oslo, PickupsTakeAnEarlierSurfacesValue) {
    const ImportedLens lens = import(
        "LEN NEW \"x\" 1 4\nEBR 1\nTH 1e20\nNXT\nGLA 1.5\nRD 50\nCC -1\nTH 4\nNXT\nAIR\nPK CVM 1\n"
        "TH 2\nNXT\nPK GLA -2\nPK CV -2 0.01\nPK TH 1 0.5\nNXT\nAIR\nRD -50\nTH 90\nNXT\nEND 4\n");
    ASSERT_EQ(lens.lens.surfaces.size(), 4u);
    EXPECT_EQ(lens.lens.surfaces[1].curve, BaseCurve(Radius{-50.0}));
    EXPECT_EQ(lens.lens.surfaces[1].conic, -1.0);
    EXPECT_NEAR(curvature_per_mm(lens.lens.surfaces[2].curve), 1.0 / 50 + 0.01, 1e-15);
    EXPECT_EQ(lens.lens.surfaces[2].thickness_mm, 4.5);
    EXPECT_EQ(lens.lens.surfaces[2].medium_after, lens.lens.surfaces[0].medium_after);
}

TEST(Oslo, DefaultsAreSaid) {
    const ImportedLens lens = import(singlet("EBR 5\nUNI 1.0", "AP CHK 9"));
    EXPECT_EQ(lens.stop, 0u);
    EXPECT_EQ(note_with(lens.notes, "no AST")->fate, Note::Fate::assumed);
    EXPECT_EQ(lens.sensor_distance_mm, 40.0);
    EXPECT_EQ(lens.entrance_pupil_diameter_mm, 10.0);
    EXPECT_FALSE(lens.stated_efl_mm);  // 100 stands for nothing
    EXPECT_NE(note_with(import(singlet("EBR 5")).notes, "no UNI"), nullptr);
    const ImportedLens small = import(
        "LEN NEW \"x\" 1 3\nEBR .2\nUNI 1\nTH 1e10\nNXT\nGLA 1.5\nRD 1\nTH .1\nNXT\nAIR\n"
        "RD -1\nPY 0\nNXT\nEND 3\n");
    EXPECT_THAT(note_with(small.notes, "UNI 1 means")->proposal, testing::HasSubstr("UNI 10"));
    const ImportedLens near = import(
        "LEN NEW \"x\" 1 3\nNAO .02\nOBH 5\nTH 100\nNXT\nGLA 1.5\nRD 50\n"
        "TH 4\nNXT\nAIR\nRD -50\nTH 90\nNXT\nEND 3\n");
    EXPECT_TRUE(note_with(near.notes, "the object is 100 mm away")->matters_for_flare);
    EXPECT_NEAR(*near.half_field_deg, deg_from_rad(std::atan(0.05)), 1e-12);
    EXPECT_NE(note_with(near.notes, "NAO"), nullptr);
}

TEST(Oslo, UnknownGlassesAreToBeMended) {
    const ImportedLens lens = import(
        "LEN NEW \"x\" 1 3\nEBR 1\nTH 1e20\nNXT\nGLA NOSUCH17\nRD 50\nTH 4\nNXT\nAIR\nRD -50\nTH "
        "90\n"
        "NXT\nEND 3\n");
    EXPECT_TRUE(
        std::holds_alternative<UnknownGlass>(lens.lens.surfaces[0].medium_after.dispersion));
    const ImportedLens made = import(
        "LEN NEW \"x\" 1 3\nEBR 1\nTH 1e20\nNXT\nGLA O_N-BK7\nRD 50\nTH 4\nNXT\nAIR\nRD -50\nTH "
        "90\n"
        "NXT\nEND 3\n");
    EXPECT_EQ(made.lens.surfaces[0].medium_after, *bundled_glasses().find("N-BK7"));
    const Note* note = note_with(lens.notes, "NOSUCH17");
    EXPECT_EQ(note->severity, Note::Severity::error);
    EXPECT_EQ(note->where, "line 5");
}

TEST(Oslo, CommandsQuotesAndComments) {
    std::vector<OsloCommand> commands;
    for_each_oslo_command("LEN NEW \"a // b; c\" 1 // d\nRD 5; th 2;;\r\n\"q\" 3", "f",
                          [&](const OsloCommand& each) { commands.push_back(each); });
    ASSERT_EQ(commands.size(), 4u);
    EXPECT_EQ(commands[0].parts, (std::vector<std::string>{"NEW", "a // b; c", "1"}));
    EXPECT_EQ(commands[2].word, "TH");
    EXPECT_EQ(commands[2].place.where, "line 2");
    EXPECT_EQ(commands[3].word, "Q");
}

TEST(Oslo, WhatCannotBeTracedIsRefusedByLine) {
    const auto refused = [](const std::string& command) {
        return error_of([&] { import(singlet("EBR 5", command)); });
    };
    EXPECT_EQ(refused("RFL").where, "line 8");
    EXPECT_THAT(refused("RFL").problem, testing::HasSubstr("mirror"));
    EXPECT_THAT(refused("PFL 50").problem, testing::HasSubstr("perfect lens"));
    EXPECT_THAT(refused("TLA 10").problem, testing::HasSubstr("tilted"));
    EXPECT_THAT(refused("CVX 0.01").problem, testing::HasSubstr("revolution"));
    EXPECT_THAT(refused("DOR 1").problem, testing::HasSubstr("diffractive"));
    EXPECT_THAT(refused("ASP ZRR 3").problem, testing::HasSubstr("asphere"));
    EXPECT_THAT(refused("PK CV 7").problem, testing::HasSubstr("pickup"));
    EXPECT_THAT(refused("AD x").problem, testing::HasSubstr("number"));
    EXPECT_NO_THROW(import(singlet("EBR 5", "TLA 0.0")));
    error_of([] { import("LEN NEW \"x\" 1 1\nNXT\nEND\n"); });
    error_of([] { import("nothing"); });
}

}  // namespace
}  // namespace ghostlight
