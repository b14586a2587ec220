#include "core/io/lens_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/io/aside_file.h"
#include "tests/support/error_of.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

namespace fs = std::filesystem;

class LensFiles : public testing::Test {
   protected:
    LensFiles() {
        std::string name = (fs::temp_directory_path() / "ghostlight_test_XXXXXX").string();
        folder = ::mkdtemp(name.data());
    }
    ~LensFiles() override {
        fs::permissions(folder, fs::perms::owner_all);
        fs::remove_all(folder);
    }
    std::size_t entries() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }
    static std::string content(const fs::path& file) {
        std::ostringstream text;
        text << std::ifstream(file).rdbuf();
        return text.str();
    }

    fs::path folder;
};

TEST_F(LensFiles, WrittenLensReadsBack) {
    const Prescription lens = read_lens(lens_folder() / "tessar_brendel_100_f2.8.json").lens;
    const fs::path file = folder / "my lens.json";
    write_lens(lens, file);
    EXPECT_EQ(read_lens(file).lens, lens);
    EXPECT_EQ(entries(), 1u) << "nothing else is left";
}

TEST_F(LensFiles, LensWithoutANameIsCalledAfterItsFile) {
    std::string text = lens_to_json(read_lens(lens_folder() / "heliar_tronnier_100.json").lens);
    const auto at = text.find("  \"name\"");
    text.erase(at, text.find('\n', at) + 1 - at);
    write_file_safely(folder / "nameless.json", text);
    EXPECT_EQ(read_lens(folder / "nameless.json").lens.name, "nameless");
}

TEST_F(LensFiles, AFailingWriteLeavesTheOldFile) {
    const fs::path file = folder / "lens.json";
    write_file_safely(file, "old");
    {
        AsideFile aside(file);
        aside.write("half of the n");
        EXPECT_EQ(content(file), "old");
        EXPECT_EQ(entries(), 2u);
        // no commit: as when writing throws
    }
    EXPECT_EQ(content(file), "old");
    EXPECT_EQ(entries(), 1u);
    error_of([&] { write_file_safely(folder / "none" / "lens.json", "new"); });
    EXPECT_EQ(entries(), 1u);
}

TEST_F(LensFiles, ADiskThatFillsUpLeavesTheOldFile) {
    const fs::path file = folder / "lens.json";
    write_file_safely(file, "old");
    // A limit on the size of files stands for the full disk: writing stops half-way.
    struct rlimit unlimited {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &unlimited), 0);
    struct rlimit small = unlimited;
    small.rlim_cur = 100;
    const auto before = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const Error::Parts error = error_of([&] { write_file_safely(file, std::string(10000, 'x')); });
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &unlimited), 0);
    std::signal(SIGXFSZ, before);
    EXPECT_THAT(error.problem, testing::HasSubstr("cannot be written"));
    EXPECT_EQ(content(file), "old");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(LensFiles, AWriteThatTheDiskRefusesIsReported) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    const Error::Parts error = error_of([] { write_file_safely("/dev/full", "text"); });
    EXPECT_EQ(error.file, "/dev/full");
    EXPECT_THAT(error.problem, testing::HasSubstr("cannot be written"));
}

TEST_F(LensFiles, AReadOnlyFolderIsReportedAndKeepsTheFile) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    const fs::path file = folder / "lens.json";
    write_file_safely(file, "old");
    fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
    error_of([&] { write_file_safely(file, "new"); });
    EXPECT_EQ(content(file), "old");
}

TEST_F(LensFiles, PermissionsAreKept) {
    const fs::path file = folder / "lens.json";
    write_file_safely(file, "old");
    ::chmod(file.c_str(), 0640);
    write_file_safely(file, "new");
    struct stat status {};
    ASSERT_EQ(::stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777u, 0640u);
    EXPECT_EQ(content(file), "new");
}

TEST_F(LensFiles, NewFilesFollowTheUsersMask) {
    const mode_t old = ::umask(027);
    write_file_safely(folder / "lens.json", "new");
    ::umask(old);
    struct stat status {};
    ASSERT_EQ(::stat((folder / "lens.json").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777u, 0640u);
}

TEST_F(LensFiles, LinksAreFollowed) {
    fs::create_directory(folder / "real");
    const fs::path real = folder / "real" / "lens.json";
    fs::create_symlink("real/lens.json", folder / "link.json");
    write_file_safely(folder / "link.json", "through a link to nothing yet");
    EXPECT_TRUE(fs::is_symlink(folder / "link.json"));
    EXPECT_EQ(content(real), "through a link to nothing yet");
    write_file_safely(folder / "link.json", "again");
    EXPECT_TRUE(fs::is_symlink(folder / "link.json"));
    EXPECT_EQ(content(real), "again");
}

TEST_F(LensFiles, ADeviceIsWrittenToAndNotReplaced) {
    write_file_safely("/dev/null", "gone");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(LensFiles, FoldersAndMissingFilesAreRefused) {
    EXPECT_THAT(error_of([&] { read_lens(folder); }).problem, testing::HasSubstr("folder"));
    EXPECT_THAT(error_of([&] { read_lens(folder / "none.json"); }).problem,
                testing::HasSubstr("No such file"));
    error_of([&] { write_file_safely(folder, "text"); });
    EXPECT_THAT(error_of([] { read_lens("/dev/zero"); }).problem, testing::HasSubstr("too large"));
}

TEST_F(LensFiles, EveryMalformedFileIsRefusedByName) {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(test_data_folder() / "malformed")) {
        const Error::Parts error = error_of([&] { read_lens(entry.path()); });
        EXPECT_EQ(error.file, entry.path().string());
        EXPECT_FALSE(error.problem.empty());
        EXPECT_LT(error.problem.size(), 500u);
        ++count;
    }
    EXPECT_GE(count, 10);
}

TEST_F(LensFiles, TheEnvironmentMayNameTheData) {
    const char* before = std::getenv("GHOSTLIGHT_DATA");
    const std::string kept = before ? before : "";
    ::setenv("GHOSTLIGHT_DATA", folder.c_str(), 1);
    EXPECT_EQ(error_of([] { data_directory(); }).found, folder.string());
    ::setenv("GHOSTLIGHT_DATA", lens_folder().c_str(), 1);
    EXPECT_EQ(data_directory(), lens_folder());
    if (before)
        ::setenv("GHOSTLIGHT_DATA", kept.c_str(), 1);
    else
        ::unsetenv("GHOSTLIGHT_DATA");
    EXPECT_TRUE(fs::exists(data_directory() / "glasses" / "glasses.json"));
}

}  // namespace
}  // namespace ghostlight
