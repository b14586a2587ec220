#include "tests/app/program.h"
#include "tests/support/test_paths.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

namespace ghostlight::test {
namespace {

std::filesystem::path new_temporary_folder() {
    std::string name = (std::filesystem::temp_directory_path() / "ghostlight-cli-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
    return name;
}

void redirect(const std::filesystem::path& file, int flags, int stream) {
    const int opened = ::open(file.c_str(), flags, 0600);
    if (opened < 0 || ::dup2(opened, stream) < 0) ::_exit(126);
    ::close(opened);
}

std::vector<std::string> split_line(const std::string& line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

}  // namespace

Outcome run_program(const std::vector<std::string>& command, const RunOptions& options) {
    // Files instead of pipes: neither side can wait for the other.
    const auto folder = new_temporary_folder();
    write_file(folder / "in", options.input);
    std::vector<char*> arguments;
    for (const std::string& argument : command)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);

    const pid_t child = ::fork();
    if (child == 0) {
        redirect(folder / "in", O_RDONLY, STDIN_FILENO);
        redirect(folder / "out", O_WRONLY | O_CREAT, STDOUT_FILENO);
        redirect(folder / "err", O_WRONLY | O_CREAT, STDERR_FILENO);
        for (const auto& [name, value] : options.environment)
            ::setenv(name.c_str(), value.c_str(), 1);
        if (!options.directory.empty() && ::chdir(options.directory.c_str()) != 0) ::_exit(126);
        ::execvp(arguments[0], arguments.data());
        ::_exit(127);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    Outcome outcome;
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = read_file(folder / "out");
    outcome.err = read_file(folder / "err");
    std::filesystem::remove_all(folder);
    return outcome;
}

Outcome cli(std::vector<std::string> arguments, const RunOptions& options) {
    arguments.insert(arguments.begin(), cli_program());
    return run_program(arguments, options);
}

std::string cli_output(std::vector<std::string> arguments, const std::string& input) {
    const Outcome outcome =
        cli(std::move(arguments), {.input = input, .environment = {}, .directory = {}});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
}

const std::string& Csv::text(std::size_t row, const std::string& column) const {
    const auto found = std::find(columns.begin(), columns.end(), column);
    if (found == columns.end()) throw std::runtime_error("no column " + column);
    return rows.at(row).at(static_cast<std::size_t>(found - columns.begin()));
}

double Csv::number(std::size_t row, const std::string& column) const {
    const std::string& field = text(row, column);
    double value = std::numeric_limits<double>::quiet_NaN();
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    EXPECT_TRUE(error == std::errc() && end == field.data() + field.size())
        << column << " is '" << field << "'";
    return value;
}

std::size_t Csv::find(const std::string& column, const std::string& value) const {
    for (std::size_t row = 0; row < rows.size(); ++row)
        if (text(row, column) == value) return row;
    throw std::runtime_error("no row with " + column + " = " + value);
}

Csv parse_csv(const std::string& text) {
    Csv csv;
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    csv.columns = split_line(line);
    while (std::getline(lines, line)) {
        csv.rows.push_back(split_line(line));
        EXPECT_EQ(csv.rows.back().size(), csv.columns.size()) << line;
    }
    return csv;
}

Csv read_csv(const std::filesystem::path& file) { return parse_csv(read_file(file)); }

Csv cli_csv(std::vector<std::string> arguments, const std::string& input) {
    arguments.emplace_back("--csv");
    return parse_csv(cli_output(std::move(arguments), input));
}

std::string read_file(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    EXPECT_TRUE(stream.is_open()) << file;
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write_file(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

std::filesystem::path expected_data() { return test_data_folder() / "expected"; }

std::string tessar() { return (expected_data() / "tessar_brendel_100_f2.8.json").string(); }

void InTemporaryFolder::SetUp() { folder = new_temporary_folder(); }

void InTemporaryFolder::TearDown() { std::filesystem::remove_all(folder); }

}  // namespace ghostlight::test
