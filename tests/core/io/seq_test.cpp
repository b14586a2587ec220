#include "core/io/seq.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/io/read_text.h"
#include "core/io/seq_commands.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "tests/support/error_of.h"
#include "tests/support/import_kit.h"
#include "tests/support/optics_kit.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

constexpr double rounding_mm = 1e-9;

LensFile read_text_as_seq(const std::string& text) {
    return complete_import(import_seq({text, "test.seq"}), "test.seq");
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const auto at = text.find(what);
    EXPECT_NE(at, text.npos) << what;
    return text.replace(at, what.size(), by);
}

const std::string singlet =
    "RDM\nLEN\nEPD 5\nDIM M\nWL 587.6\nSO 0 1e20\nS 50 4 NBK7_SCHOTT\n STO\n CIR 6\n"
    "S -50 48\n CIR 6\nSI 0 0\nGO\n";

TEST(SeqCommands, ContinuationCommentsQuotes) {
    std::vector<SeqCommand> commands;
    for_each_seq_command(
        "a 1 & ! not this\n 2\nS'x y' 3; b \"two words\" c!d\ntit '\"INF\"'\nTIT Z1 "
        "\"\"WIDE\"\"\n",
        [&](const SeqCommand& command) { commands.push_back(command); });
    ASSERT_EQ(commands.size(), 5U);
    EXPECT_EQ(commands[0].name, "A");
    ASSERT_EQ(commands[0].words.size(), 2U);
    EXPECT_EQ(commands[0].words[1].text, "2");
    EXPECT_EQ(commands[0].where, "line 1");
    EXPECT_EQ(commands[1].name, "S'X Y'");
    EXPECT_EQ(commands[2].words[0].text, "two words");
    EXPECT_EQ(commands[2].words[1].text, "c");
    EXPECT_EQ(commands[2].where, "line 3");
    EXPECT_EQ(commands[3].words[0].text, "INF");
    EXPECT_EQ(commands[4].words[1].text, "WIDE");
}

TEST(Seq, ReadsWhatIsThere) {
    const LensFile file = read_sample("seq/triplet.seq");
    const Prescription& lens = file.lens;
    ASSERT_EQ(lens.surfaces.size(), 7U);
    EXPECT_EQ(lens.name, "Triplet, \"by hand\"");
    EXPECT_EQ(lens.surfaces[0].curve, BaseCurve(Radius{22.01359}));
    EXPECT_EQ(lens.surfaces[0].medium_after.name, "N-SK16");
    EXPECT_EQ(lens.surfaces[2].conic, 0.1);
    EXPECT_EQ(lens.surfaces[2].aspheric, (std::vector<double>{-1e-6, 2e-9}));
    EXPECT_EQ(lens.surfaces[2].semi_diameter_mm, 5.0) << "CIR EDG is not the clear edge";
    EXPECT_EQ(lens.surfaces[3].comment, "back of the flint");
    EXPECT_EQ(lens.stop.surface, 4U);
    EXPECT_EQ(lens.stop.f_number, 5.0);
    EXPECT_NEAR(lens.surfaces[6].thickness_mm, 42.3 - 0.09222, rounding_mm) << "SI's defocus";
    EXPECT_EQ(lens.published.half_field_deg, 20.0) << "a continued line";
    EXPECT_EQ(note_with(file.notes, "\"XYZW\"")->fate, Note::Fate::left_out);
}

/// The same lens in both formats: the same first-order data.
TEST(Seq, AgreesWithZemax) {
    const auto order = [](const char* name) {
        return first_order(compile(read_sample(name).lens, d_line_nm));
    };
    const FirstOrder seq = order("seq/triplet.seq"), zmx = order("zmx/triplet.zmx");
    // Curvatures of 16 digits; radii of 7.
    constexpr double digits_mm = 1e-4;
    EXPECT_NEAR(seq.efl_mm, zmx.efl_mm, digits_mm);
    EXPECT_NEAR(seq.bfd_mm, zmx.bfd_mm, digits_mm);
    EXPECT_NEAR(seq.entrance_pupil_z_mm, zmx.entrance_pupil_z_mm, digits_mm);
}

TEST(Seq, WithoutRadiusModeTheNumbersDecide) {
    const LensFile curved = read_sample("seq/curvatures.seq");
    EXPECT_EQ(curved.lens.surfaces[1].curve, BaseCurve(Curvature{-0.19}));
    EXPECT_EQ(note_with(curved.notes, "RDM")->fate, Note::Fate::assumed);
    EXPECT_TRUE(note_with(curved.notes, "RDM")->matters_for_flare);
    const LensFile radii = read_text_as_seq(replaced(singlet, "RDM\n", ""));
    EXPECT_EQ(radii.lens.surfaces[0].curve, BaseCurve(Radius{50.0}));
    EXPECT_NE(note_with(radii.notes, "taken as radii"), nullptr);
    // The same lens by curvatures, all small: no EPD or edge tells.
    std::string small = replaced(replaced(singlet, "S 50 ", "S 0.02 "), "S -50 ", "S -0.02 ");
    small = replaced(small, "RDM\n", "");
    EXPECT_EQ(read_text_as_seq(small).lens.surfaces[0].curve, BaseCurve(Curvature{0.02}));
    const std::string stated = replaced(replaced(singlet, "RDM\n", "RDM N\n"), "S 50 ", "S 0.02 ");
    EXPECT_EQ(read_text_as_seq(stated).lens.surfaces[0].curve, BaseCurve(Curvature{0.02}));
}

TEST(Seq, EveryWayToNameAGlass) {
    const LensFile file = read_sample("seq/glasses.seq");
    const auto& rows = file.lens.surfaces;
    ASSERT_EQ(rows.size(), 8U);
    const auto index = [&](std::size_t row, double nm) {
        return refractive_index(rows[row].medium_after, nm);
    };
    // The private table through three points is exact there.
    constexpr double exact = 1e-12;
    EXPECT_NEAR(index(0, 656.3), 1.614, exact);
    EXPECT_NEAR(index(0, 587.6), 1.617, exact);
    EXPECT_NEAR(index(0, 486.1), 1.624, exact);
    // Schott's old BK7 by its Laurent series: nd 1.51680, nF 1.52238, nC 1.51432 as printed.
    constexpr double printed = 1e-5;
    EXPECT_NEAR(index(1, 587.5618), 1.51680, printed);
    EXPECT_NEAR(index(1, 486.1327), 1.52238, printed);
    EXPECT_NEAR(index(1, 656.2725), 1.51432, printed);
    EXPECT_EQ(rows[2].medium_after.dispersion, Dispersion(ModelGlass{1.5168, 64.17}));
    EXPECT_EQ(rows[3].medium_after.dispersion, Dispersion(ModelGlass{1.5, 70.0}));
    EXPECT_EQ(rows[4].medium_after.dispersion, Dispersion(ModelGlass{1.62, 60.3}));
    EXPECT_EQ(rows[5].medium_after.dispersion, Dispersion(ModelGlass{1.7, 40.0}));
    EXPECT_TRUE(is_air(rows[7].medium_after));
    EXPECT_NEAR(rows[0].thickness_mm, 2.54, rounding_mm) << "DIM I";
    EXPECT_NEAR(rows[0].semi_diameter_mm, 12.7, rounding_mm) << "CIR S1 after the surfaces";
    EXPECT_TRUE(note_with(file.notes, "a central obstruction")->matters_for_flare);
}

TEST(Seq, ZoomPositions) {
    const Prescription lens = read_sample("seq/zoom.seq").lens;
    ASSERT_EQ(lens.configurations.size(), 2U);
    EXPECT_EQ(lens.configurations[0].name, "wide");
    EXPECT_EQ(lens.configurations[1].name, "tele");
    EXPECT_EQ(lens.configurations[1].thickness_mm,
              (std::map<std::size_t, double>{{1, 5.0}, {4, 35.0}}));
    EXPECT_EQ(lens.configurations[1].f_number, 6.0);
}

TEST(Seq, WhatCannotBeIsRefusedWithItsPlace) {
    const struct {
        std::string what, by, where, problem;
    } cases[] = {
        {"NBK7_SCHOTT", "REFL", "line 7", "mirror"},
        {" STO", " STO\n ADE 5", "line 9", "tilted"},
        {" STO", " STO\n BEN", "line 9", "bent axis"},
        {" STO", " STO\n CYL", "line 9", "cylinder"},
        {" STO", " STO\n CUX 0.1", "line 9", "another curvature in x"},
        {" STO", " STO\n DIF GRT", "line 9", "diffractive"},
        {" STO", " STO\n ASP\n CUF 0.1", "line 10", "Fresnel"},
        {"S 50 4", "S x 4", "line 7", "not a number"},
        {"DIM M", "DIM Q", "line 4", "unit"},
        {"S 50 4", "S 50 -4", "S1 (line 7)", "out of order"},
    };
    for (const auto& each : cases) {
        const Error::Parts parts =
            error_of([&] { read_text_as_seq(replaced(singlet, each.what, each.by)); });
        EXPECT_EQ(parts.file, "test.seq") << each.by;
        EXPECT_EQ(parts.where, each.where) << each.by;
        EXPECT_NE(parts.problem.find(each.problem), std::string::npos) << parts.problem;
    }
}

TEST(Seq, TiltsOfNothingAndOfTheImageAreOpened) {
    EXPECT_NO_THROW(read_text_as_seq(replaced(singlet, " STO", " STO\n ADE 0.0\n XDE 0")));
    const LensFile tilted = read_text_as_seq(replaced(singlet, "SI 0 0", "SI 0 0\n ADE 3"));
    EXPECT_TRUE(note_with(tilted.notes, "upright")->matters_for_flare);
}

TEST(Seq, CutAnywhereIsALensOrAnError) {
    for (const char* name : {"seq/triplet.seq", "seq/glasses.seq", "seq/zoom.seq"}) {
        const std::string text = read_text(test_data_folder() / name);
        for (std::size_t end = 0; end < text.size(); ++end) {
            try {
                read_text_as_seq(text.substr(0, end));
            } catch (const Error& error) {
                EXPECT_EQ(error.parts().file, "test.seq") << error.what();
            }
        }
    }
}

}  // namespace
}  // namespace ghostlight
