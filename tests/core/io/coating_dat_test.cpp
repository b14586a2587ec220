#include "core/io/coating_dat.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/io/coating_csv.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

using testing::HasSubstr;

const std::filesystem::path folder = test_data_folder() / "coatings";

CoatingFile sample() { return read_coating_file(folder / "COATING.DAT"); }

LayerStack stack_of(const CoatingFile& file, std::string_view name, double primary_nm) {
    return std::get<LayerStack>(coating_of(file, name, primary_nm).value());
}

TEST(CoatingDat, RelativeLayersArePartsOfThePrimaryWavelengthInTheLayer) {
    const CoatingFile file = sample();
    const LayerStack broad = stack_of(file, "BBAR", 550.0);
    ASSERT_EQ(broad.layers.size(), 3U);
    EXPECT_TRUE(broad.from_air);
    EXPECT_EQ(broad.name, "BBAR");
    EXPECT_NEAR(broad.layers[1].thickness_nm, 0.5 * 550.0 / 2.05, 1e-12);
    EXPECT_NEAR(broad.layers[2].thickness_nm, 0.25 * 550.0 / 1.63, 1e-12);
    // The file's n at the primary wavelength, whichever that is.
    for (const double nm : {450.0, 600.0}) {
        const LayerStack single = stack_of(file, "ar", nm);
        EXPECT_NEAR(single.layers[0].thickness_nm * refractive_index(single.layers[0].medium, nm),
                    0.25 * nm, 1e-12);
    }
    // One wavelength in the file holds everywhere.
    EXPECT_EQ(refractive_index(broad.layers[1].medium, 2000.0), 2.05);
    EXPECT_EQ(refractive_index(broad.layers[0].medium, 400.0), 1.384);
}

TEST(CoatingDat, LoopsRepeatAndAbsoluteLayersAreMicrometres) {
    const LayerStack mirror = stack_of(sample(), "MIRROR", 550.0);
    ASSERT_EQ(mirror.layers.size(), 7U);
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_EQ(mirror.layers[i].medium.name, i % 2 == 0 ? "MGF2" : "ZRO2") << i;
    EXPECT_NEAR(mirror.layers[6].thickness_nm, 100.0, 1e-12);
}

TEST(CoatingDat, ExtinctionTurnsItsSign) {
    const LayerStack metal = stack_of(sample(), "METAL", 550.0);
    const Film film = film_at(metal, medium(1.0), medium(1.5), 550.0);
    ASSERT_EQ(film.layers.size(), 1U);
    EXPECT_NEAR(film.layers[0].n, 0.96, 1e-15);
    EXPECT_NEAR(film.layers[0].k, 6.69, 1e-15);
    // 20 nm of aluminium reflect more than half, and let something through.
    const Reflectances found = reflectances(film, 1.0);
    EXPECT_GT(found.r(), 0.5);
    EXPECT_GT(found.t(), 0.01);
    EXPECT_LT(found.r() + found.t(), 1.0);
}

TEST(CoatingDat, TablesReturnTheirEntries) {
    const auto table = std::get<MeasuredReflectance>(coating_of(sample(), "SHEET", 550.0).value());
    EXPECT_EQ(table.angles_deg, (std::vector<double>{0.0, 45.0}));
    ASSERT_EQ(table.wavelengths_nm.size(), 3U);
    const Film film = film_at(table, medium(1.0), medium(1.5), 550.0);
    const Reflectances tilted = reflectances(film, std::sqrt(0.5));
    EXPECT_NEAR(tilted.r_s, 0.012, 1e-15);
    EXPECT_NEAR(tilted.r_p, 0.003, 1e-15);
    EXPECT_NEAR(tilted.t_s, 0.985, 1e-15);
    EXPECT_NEAR(tilted.t_p, 0.995, 1e-15);
}

TEST(CoatingDat, AnglesMayHaveWavelengthsOfTheirOwn) {
    const CoatingFile file = coating_file_from_text(
        "TABLE T\nANGL 0\nWAVE .4 .01 .01\nWAVE .6 .03 .03\nANGL 30\nWAVE .5 .05 .04\n", "x.dat");
    const auto table = std::get<MeasuredReflectance>(coating_of(file, "T", 550.0).value());
    ASSERT_EQ(table.wavelengths_nm.size(), 3U);
    EXPECT_NEAR(table.shares[2].r_s, 0.02, 1e-15);  // 500 nm, 0°: half-way
    EXPECT_NEAR(table.shares[2].t_s, 0.98, 1e-15);  // T is 1 − R where it is not given
    EXPECT_NEAR(table.shares[1].r_p, 0.04, 1e-15);  // 400 nm, 30°: the only value there is
}

TEST(CoatingDat, IdealCoatingsGiveTheTransmissionFirst) {
    const CoatingFile file = sample();
    EXPECT_EQ(coating_of(file, "I.05", 550.0), Coating(ConstantReflectance{0.95, 0.05}));
    EXPECT_EQ(coating_of(file, "HALF", 550.0), Coating(ConstantReflectance{0.4, 0.5}));
    // IDEAL2 gives amplitudes: their squares.
    const auto split = std::get<MeasuredReflectance>(coating_of(file, "SPLIT", 550.0).value());
    EXPECT_NEAR(split.shares[0].r_s, 0.36, 1e-15);
    EXPECT_NEAR(split.shares[0].t_s, 0.64, 1e-15);
    EXPECT_NEAR(split.shares[0].r_p, 0.09, 1e-15);
    EXPECT_NEAR(split.shares[0].t_p, 0.81, 1e-15);
}

TEST(CoatingDat, WhatIsLeftOutIsSaid) {
    const CoatingFile file = sample();
    std::string said;
    for (const Note& note : file.notes) said += note.where + ": " + note.text + "\n";
    EXPECT_THAT(said, HasSubstr("taper EDGE is left out"));
    EXPECT_THAT(said, HasSubstr("MISTAKEN: k 0.1 would amplify"));
    EXPECT_THAT(said, HasSubstr("IMPOSSIBLE"));
    EXPECT_FALSE(coating_of(file, "IMPOSSIBLE", 550.0));
    EXPECT_FALSE(coating_of(file, "NOTHING", 550.0));
    const Error::Parts error = error_of([&] { coating_of(file, "NOBODY", 550.0); });
    EXPECT_THAT(error.file, HasSubstr("COATING.DAT"));
    EXPECT_EQ(error.where, "line 30");
    EXPECT_EQ(error.found, "XYZZY");
}

TEST(CoatingDat, NoCoatingFileIsRefusedAndLoopsAreBounded) {
    EXPECT_THAT(error_of([] { coating_file_from_text("", "x.dat"); }).problem,
                HasSubstr("no coating file"));
    std::string loops = "MATE A\n.5 1.5 0\nCOAT B\n";
    for (int i = 0; i < 5; ++i) loops += "A .25 0 1000\n";
    const CoatingFile file = coating_file_from_text(loops, "x.dat");
    EXPECT_THAT(error_of([&] { coating_of(file, "B", 550.0); }).problem,
                HasSubstr("too many layers"));
}

TEST(CoatingDat, EveryTruncationIsReadOrRefused) {
    const std::string text =
        "MATE A\n.5 1.5 -1\nCOAT B\nA .25 0 2 T\nTABLE C\nANGL 5\nWAVE .5 .1 .2 .3 .4 5 6 7 8\n"
        "IDEAL D .5\nIDEAL2 E .1 .1 .1 .1 .1 .1 .1 .1\nTAPR T\n1 2\n";
    for (std::size_t size = 0; size <= text.size(); ++size) {
        try {
            const CoatingFile file = coating_file_from_text(text.substr(0, size), "x.dat");
            for (const ListedCoating& each : file.coatings) coating_of(file, each.name, 550.0);
        } catch (const Error&) {
        }
    }
}

TEST(ResolveCoating, LooksBesideTheLensThenInTheLibraryThenAmongZemaxsNames) {
    const CoatingFile file = sample();
    EXPECT_THAT(resolve_coating("bbar", &file, 550.0)->origin, HasSubstr("COATING.DAT"));
    EXPECT_EQ(resolve_coating("v-coat", &file, 550.0)->origin, "library");
    // The file's own AR, not the one that Zemax brings.
    EXPECT_TRUE(std::holds_alternative<LayerStack>(resolve_coating("AR", &file, 550.0)->coating));
    const auto built_in = resolve_coating("AR", nullptr, 600.0);
    EXPECT_EQ(built_in->coating, Coating(QuarterWave{.center_nm = 600.0}));
    ASSERT_EQ(built_in->notes.size(), 1U);
    EXPECT_EQ(built_in->notes[0].fate, Note::Fate::assumed);
    EXPECT_EQ(resolve_coating("I.05", nullptr, 550.0)->coating,
              Coating(ConstantReflectance{0.95, 0.05}));
    EXPECT_EQ(resolve_coating("HEAR1", nullptr, 550.0)->notes.size(), 1U);
    EXPECT_EQ(resolve_coating("WAR", nullptr, 550.0)->notes.size(), 1U);
    for (const char* name : {"NOTHING", "I.5x", "", "I."})
        EXPECT_FALSE(resolve_coating(name, nullptr, 550.0)) << name;
}

TEST(ResolveCoating, FindsTheFileBesideTheLens) {
    EXPECT_EQ(find_coating_file(folder / "lens.zmx"), folder / "COATING.DAT");
    EXPECT_EQ(find_coating_file(folder / "lens.zmx", "C:\\Zemax\\Coatings\\coating.dat"),
              folder / "COATING.DAT");
    // In the folder COATINGS beside it, whatever its case.
    EXPECT_EQ(find_coating_file(folder.parent_path() / "lens.zmx"), folder / "COATING.DAT");
    EXPECT_FALSE(find_coating_file(folder / "lens.zmx", "OTHER.DAT"));
    EXPECT_FALSE(find_coating_file("/nowhere/lens.zmx"));
}

TEST(CoatingCsv, ReadsAVendorsSheet) {
    const MeasuredReflectance table = read_measured_csv(folder / "sheet.csv");
    EXPECT_EQ(table.name, "sheet");
    EXPECT_EQ(table.wavelengths_nm, (std::vector<double>{450.0, 550.0}));
    EXPECT_EQ(table.angles_deg, (std::vector<double>{0.0, 45.0}));
    EXPECT_NEAR(table.shares[1].r_s, 0.02, 1e-15);
    EXPECT_NEAR(table.shares[1].r_p, 0.006, 1e-15);
    EXPECT_NEAR(table.shares[1].t_p, 0.994, 1e-15);
}

TEST(CoatingCsv, TakesOneColumnMicrometresAndTransmittance) {
    const MeasuredReflectance table =
        measured_from_csv("wavelength_um,r,t\n0.5,0.01,0.98\n0.4,0.02,0.97\n", "a.csv");
    EXPECT_NEAR(table.wavelengths_nm[0], 400.0, 1e-9);
    EXPECT_EQ(table.angles_deg, (std::vector<double>{0.0}));
    EXPECT_EQ(table.shares[0], (MeasuredShares{0.02, 0.02, 0.97, 0.97}));
}

struct Fault {
    const char* text;
    const char* where;
    const char* expected;
};
class CoatingCsvFaults : public testing::TestWithParam<Fault> {};

TEST_P(CoatingCsvFaults, AreNamedWithTheirLine) {
    const Error::Parts error = error_of([] { measured_from_csv(GetParam().text, "a.csv"); });
    EXPECT_EQ(error.file, "a.csv");
    EXPECT_EQ(error.where, GetParam().where);
    EXPECT_THAT(error.expected, HasSubstr(GetParam().expected));
}

INSTANTIATE_TEST_SUITE_P(All, CoatingCsvFaults,
                         testing::Values(Fault{"", "", "names"}, Fault{"nm,r\n", "", "one"},
                                         Fault{"nm,x\n1,2\n", "line 1", "wavelength_nm"},
                                         Fault{"nm,r_s\n1,2\n", "line 1", "r_p"},
                                         Fault{"nm,r\n\n500,x\n", "line 3", "decimal point"},
                                         Fault{"nm,r\n500\n", "line 2", "2"},
                                         Fault{"nm,r\n500,4.2\n", "line 2", "r_percent"},
                                         Fault{"nm,r\n500,nan\n", "line 2", "number"},
                                         Fault{"nm,r,t\n500,.5,.6\n", "line 2", "R + T"},
                                         Fault{"nm,r\n500,.1\n500,.2\n", "line 3", "once"},
                                         Fault{"nm,angle_deg,r\n500,0,.1\n600,10,.2\n", "",
                                               "every angle"},
                                         Fault{"nm,angle_deg,r\n500,95,.1\n", "line 2", "90"}));

}  // namespace
}  // namespace ghostlight
