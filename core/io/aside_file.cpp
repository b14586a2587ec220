#include "core/io/aside_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "core/error.h"
#include "core/io/lens_file.h"

namespace ghostlight {
namespace {

namespace fs = std::filesystem;

/// A descriptor that closes itself.
class Descriptor {
   public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return number_; }

   private:
    int number_;
};

/// Follows links by hand, since the file they lead to need not exist yet.
fs::path link_target(fs::path file) {
    std::error_code status;
    for (int links = 0; links < 40 && fs::is_symlink(file, status); ++links) {
        const fs::path next = fs::read_symlink(file, status);
        if (status) break;
        file = next.is_absolute() ? next : file.parent_path() / next;
    }
    return file;
}

mode_t mode_of_new_files() {
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return 0666 & ~mask;
}

}  // namespace

AsideFile::AsideFile(const fs::path& file) : file_(file), target_(link_target(file)) {
    struct stat old {};
    const bool exists = ::stat(target_.c_str(), &old) == 0;
    if (exists && S_ISDIR(old.st_mode)) fail("cannot be written", EISDIR);
    if (exists && !S_ISREG(old.st_mode)) {
        // A device or a pipe is written to; renaming would replace it.
        aside_ = target_;
        return;
    }
    if (exists && ::access(target_.c_str(), W_OK) != 0) fail("cannot be written", errno);
    const fs::path folder = target_.parent_path().empty() ? "." : target_.parent_path();
    std::string name = (folder / ("." + target_.filename().string() + ".XXXXXX")).string();
    const Descriptor made(::mkstemp(name.data()));
    if (made.get() < 0) fail("cannot be written", errno);
    aside_ = name;
    pending_ = true;
    const mode_t mode = exists ? old.st_mode & 07777 : mode_of_new_files();
    if (::fchmod(made.get(), mode) != 0) {
        const int why = errno;
        ::unlink(aside_.c_str());
        fail("cannot keep its permissions", why);
    }
}

AsideFile::~AsideFile() {
    if (pending_) ::unlink(aside_.c_str());
}

void AsideFile::write(std::string_view text) {
    const Descriptor out(::open(aside_.c_str(), O_WRONLY | O_CLOEXEC));
    if (out.get() < 0) fail("cannot be written", errno);
    while (!text.empty()) {
        const ssize_t written = ::write(out.get(), text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) fail("cannot be written", written < 0 ? errno : EIO);
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

void AsideFile::commit() {
    if (!pending_) return;
    {
        const Descriptor data(::open(aside_.c_str(), O_RDONLY | O_CLOEXEC));
        if (data.get() < 0 || ::fsync(data.get()) != 0) fail("cannot be written to disk", errno);
    }
    if (::rename(aside_.c_str(), target_.c_str()) != 0) fail("cannot be replaced", errno);
    pending_ = false;
    const fs::path folder = target_.parent_path().empty() ? "." : target_.parent_path();
    const Descriptor entry(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    // The new file is in place; a folder that cannot be synchronised loses at most the renaming.
    if (entry.get() >= 0) ::fsync(entry.get());
}

void AsideFile::fail(const char* doing, int error_number) const {
    throw Error(
        {.problem = std::string(doing) + ": " + std::generic_category().message(error_number),
         .file = file_.string(),
         .where = {},
         .found = {},
         .expected = {}});
}

void write_file_safely(const fs::path& file, std::string_view text) {
    AsideFile aside(file);
    aside.write(text);
    aside.commit();
}

void write_lens(const Prescription& lens, const fs::path& file) {
    const fs::path folder = file.parent_path().empty() ? "." : file.parent_path();
    write_file_safely(file, lens_to_json(lens, folder));
}

}  // namespace ghostlight
