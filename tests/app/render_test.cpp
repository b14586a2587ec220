// Pictures open in other programs: OpenImageIO's tool, and OpenEXR's where it is installed.

#include <algorithm>

#include "tests/app/program.h"

namespace ghostlight::test {
namespace {

class CommandLineRender : public InTemporaryFolder {
   protected:
    std::string file(const char* name) const { return (folder / name).string(); }
    std::vector<std::string> render(const std::string& out) const {
        return {"render", tessar(), "--field", "10", "--width", "64", "--out", out};
    }
    static bool has(const std::string& program) {
        return run_program({"sh", "-c", "command -v " + program}).status == 0;
    }
};

TEST_F(CommandLineRender, LayersOpenElsewhere) {
    auto arguments = render(file("flare.exr"));
    arguments.insert(arguments.end(), {"--per-ghost", "2", "--csv"});
    const std::string summary = cli_output(arguments);
    EXPECT_NE(summary.find("ghost.5-3"), std::string::npos) << summary;
    int opened = 0;
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"oiiotool", "--info", "-v", file("flare.exr")},
          std::vector<std::string>{"exrheader", file("flare.exr")}}) {
        if (!has(command.front())) continue;
        ++opened;
        const Outcome outcome = run_program(command);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        for (const char* word : {"ghost.5-3.R", "irradiance.Y", "Ghostlight ", "tessar_brendel",
                                 "irradiance / E0", "587.5618", "ghostlight:field_deg"})
            EXPECT_NE(outcome.out.find(word), std::string::npos)
                << command.front() << ": " << word << "\n"
                << outcome.out;
    }
    EXPECT_GE(opened, 1) << "neither oiiotool nor exrheader is installed";
}

TEST_F(CommandLineRender, FlareIsAnotherNameForIt) {
    auto arguments = render(file("flare.tif"));
    arguments.front() = "flare";
    cli_output(arguments);
    EXPECT_EQ(read_file(folder / "flare.tif").substr(0, 2), "II");  // a TIFF of this byte order
    const Outcome outcome = cli({"flares"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("render"), std::string::npos) << outcome.err;
}

TEST_F(CommandLineRender, OnlyAnExrHasLayers) {
    auto arguments = render(file("flare.png"));
    arguments.insert(arguments.end(), {"--per-ghost", "2"});
    const Outcome outcome = cli(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("--per-ghost"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace ghostlight::test
