// What `fit` refuses, and with which words.

#include <algorithm>

#include "tests/app/program.h"

namespace ghostlight::test {
namespace {

class CommandLineFit : public InTemporaryFolder {
   protected:
    void synth(const std::string& name, const std::vector<std::string>& more) const {
        std::vector<std::string> command = {
            "synth",   tessar(), "--field",      "5",   "--noise", "0.01",
            "--width", "64",     "--wavelength", "620", "--out",   (folder / name).string()};
        command.insert(command.end(), more.begin(), more.end());
        cli_output(command);
    }
    void refused(const std::string& photo, const std::vector<std::string>& more,
                 const std::vector<std::string>& words) const {
        std::vector<std::string> command = {
            "fit",       tessar(), "--photo",      (folder / photo).string(),
            "--coating", "qw:550", "--wavelength", "620",
            "--starts",  "1"};
        command.insert(command.end(), more.begin(), more.end());
        const Outcome outcome = cli(command);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        for (const std::string& word : words)
            EXPECT_NE(outcome.err.find(word), std::string::npos)
                << "should mention " << word << ": " << outcome.err;
    }
};

TEST_F(CommandLineFit, RefusesWhatItCannotUse) {
    synth("photo.exr", {});
    const std::vector<std::string> vary = {"--vary", "center@1"};
    refused("none.exr", vary, {"no such photograph"});
    write_file(folder / "raw.nef", "not a picture");
    refused("raw.nef", vary, {"raw.nef"});
    refused("photo.exr", {"--vary", "center@99"}, {"there is no such surface", "surfaces 1 to"});
    refused("photo.exr", {"--vary", "center@1=600..500"}, {"lower bound"});
    refused("photo.exr", {"--vary", "colour@1"}, {"unknown kind", "center"});
    refused("photo.exr", {"--vary", "center@1", "--sensor", "24x36"}, {"90 degrees"});
    refused("photo.exr", {"--vary", "center@1", "--sensor", "36x36"}, {"sensor's shape"});
    refused("photo.exr", {"--vary", "center@1", "--light", "9999,9999"}, {"light"});
}

TEST_F(CommandLineFit, RefusesWhatOfAPhotographCannotCount) {
    synth("photo.exr", {});
    const auto expect = [&](const std::vector<std::string>& more,
                            const std::vector<std::string>& words) {
        std::vector<std::string> all = {"--vary", "center@1"};
        all.insert(all.end(), more.begin(), more.end());
        refused("photo.exr", all, words);
    };
    expect({"--mask-region", "1,2,3"}, {"--mask-region", "brush"});
    expect({"--crop", "1,2,0,3"}, {"--crop", "WIDTH,HEIGHT"});
    expect({"--crop", "900,2,10,10"}, {"nothing of the photograph"});
    expect({"--photo-noise", "1"}, {"--photo-noise", "SHOT,READ"});
    expect({"--saturation", "0"}, {"--saturation"});
    expect({"--rotation", "0;1"}, {"--rotation", "semicolons"});
    expect({"--leave-out", "99-1"}, {"--leave-out", "99"});
    expect({"--use-ghosts", "x"}, {"--use-ghosts"});
    expect({"--mask-region", "0,0,64,0,64,43,0,43"}, {"too little of the photograph"});
}

class CommandLineFitted : public CommandLineFit {
   protected:
    std::string path(const std::string& name) const { return (folder / name).string(); }
    /// The table's one row.
    Csv fitted(const std::vector<std::string>& more) const {
        std::vector<std::string> command = {
            "fit", tessar(),    "--coating", "qw:550",    "--starts", "1",      "--wavelength",
            "620", "--suggest", "0",         "--samples", "24",       "--vary", "center@1"};
        command.insert(command.end(), more.begin(), more.end());
        return cli_csv(command);
    }
};

TEST_F(CommandLineFitted, TwoExposuresAreMergedToOne) {
    synth("a.exr", {"--seed", "1"});
    synth("b.exr", {"--seed", "2"});
    const Csv one = fitted({"--photo", path("a.exr")});
    const Csv both = fitted({"--photo", path("a.exr") + "," + path("b.exr"), "--merge"});
    // Twice the light of the same flare moves the number by less than one of the single one's
    // errors.
    EXPECT_NEAR(both.number(0, "value"), one.number(0, "value"), one.number(0, "standard_error"));
}

TEST_F(CommandLineFitted, ReportSaysWhichRegionsWereLeftOut) {
    synth("a.exr", {});
    const double all = fitted({"--photo", path("a.exr")}).number(0, "standard_error");
    const double part =
        fitted({"--photo", path("a.exr"), "--mask-region", "2,2,30,2,30,30,2,30/brush:3:40,30",
                "--crop", "0,0,48,43", "--report", path("fit.html")})
            .number(0, "standard_error");
    EXPECT_GT(part, all);  // less of the photograph tells less
    // It says how to make the same again.
    const std::string page = read_file(path("fit.html"));
    EXPECT_NE(page.find("brush:3:40,30"), std::string::npos);
    EXPECT_NE(page.find("--crop"), std::string::npos);
}

}  // namespace
}  // namespace ghostlight::test
