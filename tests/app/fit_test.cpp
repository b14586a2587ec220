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

}  // namespace
}  // namespace ghostlight::test
