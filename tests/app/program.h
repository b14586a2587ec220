#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ghostlight::test {

/// How a run of a program ended.
struct Outcome {
    int status = -1;  ///< exit status; 128 + the signal's number if one ended it
    std::string out, err;
};

struct RunOptions {
    std::string input;
    std::map<std::string, std::string> environment;  ///< added to ours
    std::filesystem::path directory;                 ///< empty: ours
};

/// Runs a program, its output read in full.
Outcome run_program(const std::vector<std::string>& command, const RunOptions& options = {});

/// Runs ghostlight-cli.
Outcome cli(std::vector<std::string> arguments, const RunOptions& options = {});

/// The same, and expects success and silence on standard error.
std::string cli_output(std::vector<std::string> arguments, const std::string& input = {});

/// A CSV as ghostlight-cli writes it (these tests meet no quoted fields with line ends).
struct Csv {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
    const std::string& text(std::size_t row, const std::string& column) const;
    double number(std::size_t row, const std::string& column) const;
    /// The row whose `column` is `value`; fails the test if there is none.
    std::size_t find(const std::string& column, const std::string& value) const;
};
Csv parse_csv(const std::string& text);
Csv read_csv(const std::filesystem::path& file);
Csv cli_csv(std::vector<std::string> arguments, const std::string& input = {});

std::string read_file(const std::filesystem::path& file);
void write_file(const std::filesystem::path& file, const std::string& text);

/// The expected values' folder and lens.
std::filesystem::path expected_data();
std::string tessar();

/// A folder of its own for each test, removed afterwards.
class InTemporaryFolder : public ::testing::Test {
   protected:
    void SetUp() override;
    void TearDown() override;
    std::filesystem::path folder;
};

}  // namespace ghostlight::test
