#include "core/io/spectrum_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

TEST(SpectrumCsv, ReadsWhatInstrumentsWrite) {
    for (const char* text : {"wavelength_nm,power\n400,1\n500,2.5\n700,0\n",
                             "# lamp\n400;1\r\n500;2.5\r\n700;0\r\n", "400 1\n500\t2.5\n700 0"}) {
        const TabulatedLight light = spectrum_from_csv(text, "lamps/warm.csv");
        EXPECT_EQ(light.name, "warm.csv");
        EXPECT_EQ(light.power, (SpectralTable{{400, 1}, {500, 2.5}, {700, 0}})) << text;
    }
}

TEST(SpectrumCsv, SaysWhichLineIsWrong) {
    const auto refusal = [](const char* text) {
        return error_of([&] { spectrum_from_csv(text, "lamp.csv"); });
    };
    EXPECT_EQ(refusal("nm,power\n500,1\n\n490,1\n").where, "line 4");
    EXPECT_THAT(refusal("nm,power\n500,1\n490,1\n").problem, testing::HasSubstr("do not rise"));
    EXPECT_EQ(refusal("nm,power\n500,1\n510,-1\n").where, "line 3");
    EXPECT_EQ(refusal("500,1\n510\n").where, "line 2");
    EXPECT_THAT(refusal("500,1\n510,1x\n").found, testing::HasSubstr("1x"));
    EXPECT_THAT(refusal("nm,power\n").problem, testing::HasSubstr("too short"));
    EXPECT_EQ(refusal("").file, "lamp.csv");
    EXPECT_THAT(error_of([] { spectrum_by_name("none_such.csv"); }).file,
                testing::HasSubstr("none_such.csv"));
}

}  // namespace
}  // namespace ghostlight
