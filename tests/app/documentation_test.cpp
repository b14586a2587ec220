// The examples of docs/command-line.md run as they are written.

#include <sstream>

#include "tests/app/program.h"
#include "tests/support/test_paths.h"

namespace ghostlight::test {
namespace {

std::vector<std::string> shell_blocks(const std::string& markdown) {
    std::vector<std::string> blocks;
    std::istringstream lines(markdown);
    bool inside = false;
    for (std::string line; std::getline(lines, line);) {
        if (line == "```sh") {
            inside = true;
            blocks.emplace_back();
        } else if (line == "```") {
            inside = false;
        } else if (inside) {
            blocks.back() += line + "\n";
        }
    }
    return blocks;
}

class CommandLineDocumentation : public InTemporaryFolder {};

TEST_F(CommandLineDocumentation, ExamplesRunAsWritten) {
    const auto blocks = shell_blocks(read_file(test_data_folder() / "../../docs/command-line.md"));
    ASSERT_GE(blocks.size(), 6U);
    const std::string path = cli_program().parent_path().string() + ":" + std::getenv("PATH");
    for (const std::string& block : blocks) {
        // One folder for all: later examples may use the files of earlier ones.
        const Outcome outcome =
            run_program({"sh", "-e", "-c", block},
                        {.input = {}, .environment = {{"PATH", path}}, .directory = folder});
        EXPECT_EQ(outcome.status, 0) << block << outcome.err;
        EXPECT_EQ(outcome.err.find("ghostlight-cli:"), std::string::npos) << block << outcome.err;
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "flare.exr"));
    EXPECT_TRUE(std::filesystem::exists(folder / "flare.png"));
}

}  // namespace
}  // namespace ghostlight::test
