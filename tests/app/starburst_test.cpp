// The command starburst, and what overrides the stop.

#include <OpenImageIO/imageio.h>

#include <algorithm>

#include "tests/app/program.h"

namespace ghostlight::test {
namespace {

/// Of a picture's file, whose header has the time too.
std::vector<float> pixels_of(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) return {};
    const OIIO::ImageSpec spec = input->spec();
    std::vector<float> pixels(static_cast<std::size_t>(spec.width) *
                              static_cast<std::size_t>(spec.height) *
                              static_cast<std::size_t>(spec.nchannels));
    EXPECT_TRUE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()));
    EXPECT_FALSE(pixels.empty());
    return pixels;
}

class CommandLineStarburst : public InTemporaryFolder {
   protected:
    std::string file(const char* name) const { return (folder / name).string(); }
    Csv starburst(std::vector<std::string> more) const {
        std::vector<std::string> arguments = {
            "starburst", tessar(), "--width", "64", "--out", file("starburst.exr"), "--csv"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return cli_csv(arguments);
    }
    /// The one line that a refused option ends in.
    std::string refusal(std::vector<std::string> more) const {
        std::vector<std::string> arguments = {"starburst", tessar(), "--width",
                                              "64",        "--out",  file("starburst.png")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = cli(arguments);
        EXPECT_EQ(outcome.status, 2) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        return outcome.err;
    }
};

TEST_F(CommandLineStarburst, FluxIsThatOfTheDirectImage) {
    const Csv burst = starburst({"--field", "5", "--f-number", "8"});
    EXPECT_GT(burst.number(0, "flux_mm2"), 0.0);
    EXPECT_NEAR(burst.number(0, "flux_on_sensor_mm2") / burst.number(0, "flux_mm2"), 1.0, 5e-3);
    EXPECT_EQ(burst.number(0, "clear_share"), 1.0);
    EXPECT_EQ(burst.text(0, "vignetted"), "no");
    // 1.22 λN at 587.6 nm and f/8 is 5.73 µm; the exit pupil's f-number is not quite the lens's.
    EXPECT_NEAR(burst.number(0, "first_dark_um"), 5.73, 0.3);
}

TEST_F(CommandLineStarburst, TwiceTheFNumberTwiceTheSizeAndAQuarterOfTheLight) {
    const Csv open = starburst({"--f-number", "8"}), closed = starburst({"--f-number", "16"});
    EXPECT_NEAR(closed.number(0, "first_dark_um") / open.number(0, "first_dark_um"), 2.0, 1e-6);
    EXPECT_NEAR(open.number(0, "flux_mm2") / closed.number(0, "flux_mm2"), 4.0, 0.03);
}

TEST_F(CommandLineStarburst, DirtDimsItAndTheSeedMakesIt) {
    const Csv clean = starburst({"--f-number", "8"});
    const Csv dirty = starburst({"--f-number", "8", "--dust", "0.1:0.05:0.1", "--scratches", "5"});
    EXPECT_NEAR(dirty.number(0, "clear_share"), 0.9, 0.02);
    EXPECT_NEAR(dirty.number(0, "flux_mm2") / clean.number(0, "flux_mm2"),
                dirty.number(0, "clear_share"), 1e-6);
    const std::vector<float> once = pixels_of(folder / "starburst.exr");
    starburst({"--f-number", "8", "--dust", "0.1:0.05:0.1", "--scratches", "5"});
    EXPECT_TRUE(pixels_of(folder / "starburst.exr") == once);
    starburst(
        {"--f-number", "8", "--dust", "0.1:0.05:0.1", "--scratches", "5", "--dirt-seed", "2"});
    EXPECT_FALSE(pixels_of(folder / "starburst.exr") == once);
}

TEST_F(CommandLineStarburst, MaskIsAnImage) {
    // A picture of the program's own: what it shows white is open.
    cli_output({"starburst", tessar(), "--f-number", "8", "--width", "64", "--exposure", "10",
                "--out", file("mask.png")});
    const Csv masked = starburst({"--f-number", "8", "--stop-image", file("mask.png")});
    EXPECT_LT(masked.number(0, "flux_mm2"),
              0.5 * starburst({"--f-number", "8"}).number(0, "flux_mm2"));
    EXPECT_GT(masked.number(0, "flux_mm2"), 0.0);
}

TEST_F(CommandLineStarburst, WhatIsWrongIsNamed) {
    write_file(folder / "text.png", "no image");
    for (const auto& [option, value] : {std::pair{"--blades", "2"},
                                        {"--blades", "1000000"},
                                        {"--blades", "six"},
                                        {"--blade-curvature", "1.5"},
                                        {"--dust", "0.7"},
                                        {"--dust", "0.1:0.2"},
                                        {"--dust", "0.1:0.2:0.1"},
                                        {"--scratches", "-1"},
                                        {"--fingerprint", "2"},
                                        {"--dirt-seed", "1e99"},
                                        {"--smoothing", "-3"},
                                        {"--width", "1"}}) {
        const std::string message = refusal({option, value});
        EXPECT_NE(message.find(option), std::string::npos) << message;
    }
    EXPECT_NE(refusal({"--stop-image", file("text.png")}).find("text.png"), std::string::npos);
    EXPECT_NE(refusal({"--stop-image", file("absent.png")}).find("absent.png"), std::string::npos);
}

TEST_F(CommandLineStarburst, RingingSaysWhichGhostsGotIt) {
    const Csv rung = cli_csv({"render", tessar(), "--field", "5", "--f-number", "16", "--width",
                              "400", "--ringing", "--out", file("rung.exr"), "--csv"});
    EXPECT_NE(rung.text(0, "rung").find("N "), std::string::npos) << rung.text(0, "rung");
    const Csv plain = cli_csv({"render", tessar(), "--field", "5", "--f-number", "16", "--width",
                               "400", "--out", file("plain.exr"), "--csv"});
    EXPECT_EQ(plain.text(0, "rung"), "");
    EXPECT_NEAR(rung.number(0, "flux_on_sensor_mm2") / plain.number(0, "flux_on_sensor_mm2"), 1.0,
                0.02);
}

}  // namespace
}  // namespace ghostlight::test
