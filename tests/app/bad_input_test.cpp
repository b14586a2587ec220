// Every kind of bad input: exit status 2, one line on standard error that says what is wrong.

#include <algorithm>

#include "tests/app/program.h"
#include "tests/support/test_paths.h"

namespace ghostlight::test {
namespace {

using Arguments = std::vector<std::string>;

void expect_refused(const Arguments& arguments, const std::vector<std::string>& words,
                    const std::string& input = {}) {
    const Outcome outcome = cli(arguments, {.input = input, .environment = {}, .directory = {}});
    std::string command;
    for (const std::string& argument : arguments) command += " " + argument;
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_EQ(outcome.out, "") << command;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << command << '\n'
                                                                           << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("ghostlight-cli: ")) << outcome.err;
    for (const std::string& word : words)
        EXPECT_NE(outcome.err.find(word), std::string::npos)
            << command << " should mention " << word << ":\n"
            << outcome.err;
}

Arguments info(const Arguments& more) {
    Arguments all = {"info", tessar()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

Arguments trace(const Arguments& more) {
    Arguments all = {"trace", tessar(), "--rays", "-"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

Arguments coating(const std::string& wavelengths, const std::string& angles) {
    return {"coating", "--stack", "1 | 1.5", "--wavelengths", wavelengths, "--angles", angles};
}

TEST(CommandLineRefuses, Commands) {
    expect_refused({}, {"no command", "info", "ghosts"});
    expect_refused({"inform"}, {"'inform'", "info"});
    expect_refused({"--nonsense"}, {"--nonsense"});
    expect_refused(info({"--nonsense"}), {"--nonsense"});
    expect_refused(info({"surplus"}), {"surplus"});
    expect_refused({"info"}, {"LENS"});
    expect_refused(info({"--csv", "--json"}), {"--csv", "--json"});
    expect_refused(info({"--wavelength"}), {"--wavelength"});
}

TEST(CommandLineRefuses, LensFiles) {
    expect_refused({"info", "no-such-lens"}, {"no-such-lens", "path of a lens file"});
    expect_refused({"info", "/"}, {"'/'"});
    expect_refused({"info", ""}, {"LENS"});
    expect_refused({"info", cli_program()}, {cli_program()});
}

TEST(CommandLineRefuses, Wavelengths) {
    for (const std::string text :
         {"red", "0", "-550", "nan", "inf", "550nm", "1e400", " ", "99", "1e-300", "1e6"})
        expect_refused(info({"--wavelength", text}), {"--wavelength", "'" + text + "'", "nm"});
    expect_refused({"ghosts", tessar(), "--field", "0", "--wavelength", "550", "--spectrum", "D65"},
                   {"--wavelength", "--spectrum"});
    expect_refused({"ghosts", tessar(), "--field", "0", "--spectrum", "moonlight"},
                   {"--spectrum", "moonlight"});
}

TEST(CommandLineRefuses, WavelengthsOutsideTheRangeOfALayer) {
    // MgF2's formula is not valid in the far infrared.
    expect_refused(info({"--wavelength", "20000", "--coating", "qw:550"}), {"MgF2", "20000"});
}

TEST(CommandLineRefuses, Overrides) {
    for (const std::string text : {"0", "-2", "nan", "wide", "f/2", "", "1e9"})
        expect_refused(info({"--f-number", text}), {"--f-number"});
    for (const std::string text : {"0", "-2", "inf"})
        expect_refused(info({"--stop-semi-diameter", text}), {"--stop-semi-diameter", text});
    expect_refused(info({"--f-number", "4", "--stop-semi-diameter", "5"}),
                   {"--f-number", "--stop-semi-diameter"});
    for (const std::string text : {"36", "36x", "x24", "36x-24", "0x0", "36x24x1", "36 24", "axb"})
        expect_refused(info({"--sensor", text}), {"--sensor", text, "36x24"});
    for (const std::string text :
         {"qw", "qw:", "qw:0", "qw:550:", "qw:550:0", "qw:550:1.38:1", "mgf2", "none:1", "QW:x"})
        expect_refused(info({"--coating", text}), {"--coating", text, "qw:NM"});
    expect_refused(info({"--config", "tele"}), {"--config", "tele"});
}

TEST(CommandLineRefuses, Light) {
    const Arguments direct = {"--ghost", "direct", "--field"};
    for (const std::string text : {"90.001", "-91", "nan", "inf", "15deg", "1,5"}) {
        Arguments arguments = trace(direct);
        arguments.push_back(text);
        expect_refused(arguments, {"--field", "'" + text + "'", "-90 to 90"});
    }
    expect_refused(trace({"--ghost", "direct", "--field", "0", "--azimuth", "north"}),
                   {"--azimuth", "north", "degrees"});
    expect_refused({"ghosts", tessar()}, {"--field"});
    expect_refused(trace({"--ghost", "direct"}), {"--field"});
}

TEST(CommandLineRefuses, Ghosts) {
    for (const std::string text : {"3-5", "5-5", "9-1", "5-0", "4-1", "5", "5-3-1", "five-three",
                                   "5-", "-", "5--3", "Direct", "5-3 ", "99999999999999999999-1"})
        expect_refused(trace({"--field", "0", "--ghost", text}), {"--ghost", text},
                       "px_mm,py_mm\n0,0\n");
    for (const std::string text : {"0", "-1", "1.5", "all"})
        expect_refused({"ghosts", tessar(), "--field", "0", "--top", text}, {"--top", text});
    for (const std::string text : {"0", "-1", "2", "nan", "1%", "1e-9"})
        expect_refused({"ghosts", tessar(), "--field", "0", "--tolerance", text},
                       {"--tolerance", text});
}

TEST(CommandLineRefuses, Rays) {
    const Arguments arguments = trace({"--ghost", "direct", "--field", "0"});
    expect_refused(arguments, {"standard input", "px_mm,py_mm"}, "");
    expect_refused(arguments, {"standard input", "px_mm,py_mm"}, "# only a comment\n\n");
    expect_refused(arguments, {"line 1", "'x,y'", "px_mm,py_mm"}, "x,y\n0,0\n");
    expect_refused(arguments, {"line 1", "'0,0'"}, "0,0\n1,1\n");
    expect_refused(arguments, {"line 3", "py_mm", "'abc'"}, "px_mm,py_mm\n0,0\n1,abc\n");
    expect_refused(arguments, {"line 4", "px_mm", "''"}, "px_mm,py_mm\n# a\n\n,1\n");
    expect_refused(arguments, {"line 2", "py_mm"}, "px_mm,py_mm\n7\n");
    expect_refused(arguments, {"line 2", "nan"}, "px_mm,py_mm\nnan,1\n");
    expect_refused(arguments, {"line 2", "1e999"}, "px_mm,py_mm\n1e999,1\n");
    expect_refused(
        {"trace", tessar(), "--ghost", "direct", "--field", "0", "--rays", "no-such.csv"},
        {"no-such.csv"});
    expect_refused({"trace", tessar(), "--ghost", "direct", "--field", "0", "--rays", "/"}, {"/:"});
    expect_refused({"trace", tessar(), "--ghost", "direct", "--field", "0"}, {"--rays"});
}

TEST(CommandLineRefuses, Ranges) {
    for (const std::string text : {"400:700:0", "400:700:-10", "700:400:10", "400:700", "400:700:x",
                                   "400:700:10:1", "", "550,", "0:10:1", "-1", "nan"})
        expect_refused(coating(text, "0"), {"--wavelengths"});
    for (const std::string text : {"0:80:0", "80:0:20", "91", "-1", "0:91:1", "steep"})
        expect_refused(coating("550", text), {"--angles"});
    expect_refused(coating("400:700:1e-9", "0"), {"--wavelengths", "at most"});
    expect_refused(coating("1:1e300:1", "0"), {"--wavelengths", "at most"});
    expect_refused(coating("400:700:0.01", "0:90:0.01"), {"--wavelengths", "--angles", "at most"});
}

TEST(CommandLineRefuses, Coatings) {
    const auto with_lens = [](const Arguments& more) {
        Arguments all = {"coating", tessar(), "--wavelengths", "550", "--angles", "0"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    expect_refused(with_lens({}), {"--surface"});
    for (const std::string text : {"0", "9", "-1", "1.5", "first"})
        expect_refused(with_lens({"--surface", text}), {"--surface", text, "1 to 8"});
    expect_refused(with_lens({"--surface", "1", "--direction", "sideways"}),
                   {"--direction", "sideways", "backward"});
    expect_refused(with_lens({"--stack", "1 | 1.5"}), {"--stack"});
    expect_refused({"coating", "--wavelengths", "550", "--angles", "0"}, {"LENS", "--stack"});
    expect_refused({"coating", "--stack", "1 | 1.5", "--angles", "0"}, {"--wavelengths"});
    for (const std::string stack : {"1", "1 | glass", "1 | 1.38 | 1.5", "1 | 1.38:-5 | 1.5",
                                    "| 1.5", "1 | 1.38,-1:50 | 1.5", "0 | 1.5"})
        expect_refused({"coating", "--stack", stack, "--wavelengths", "550", "--angles", "0"},
                       {"--stack"});
}

TEST(CommandLineRefuses, StacksBeyondNumbers) {
    expect_refused(
        {"coating", "--stack", "1 | 1e300:1e300 | 1.5", "--wavelengths", "550", "--angles", "0"},
        {"550 nm"});
}

TEST(CommandLineRefuses, Pictures) {
    expect_refused({"flare", tessar()}, {"--out"});
    expect_refused({"flare", tessar(), "-o", "flare.jpg"}, {"flare.jpg", ".exr"});
    expect_refused({"flare", tessar(), "-o", "/no/such/folder/flare.exr", "--width", "32"},
                   {"/no/such/folder/flare.exr"});
    for (const std::string text : {"0", "-5", "1e9", "99999999999", "wide"})
        expect_refused({"flare", tessar(), "-o", "flare.exr", "--width", text}, {"--width", text});
    expect_refused({"flare", tessar(), "-o", "flare.exr", "--exposure", "3"}, {"--exposure"});
    expect_refused({"flare", tessar(), "-o", "flare.png", "--exposure", "bright"},
                   {"--exposure", "bright"});
}

TEST(CommandLineRefuses, KeepsToOneLineWhateverIsInTheArguments) {
    expect_refused({"info", "no\nsuch\r\nlens"}, {"such"});
    expect_refused(info({"--wavelength", "5\n5"}), {"--wavelength"});
    expect_refused(info({"--a\nb"}), {});
}

}  // namespace
}  // namespace ghostlight::test
