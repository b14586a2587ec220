#include "core/io/read_text.h"

#include <fstream>
#include <system_error>

#include "core/error.h"

namespace ghostlight {
namespace {

constexpr std::size_t largest_file = std::size_t{16} << 20;

[[noreturn]] void refuse(const std::filesystem::path& file, std::string problem) {
    throw Error({.problem = std::move(problem),
                 .file = file.string(),
                 .where = {},
                 .found = {},
                 .expected = {}});
}

}  // namespace

std::string read_text(const std::filesystem::path& file) {
    std::error_code status;
    if (std::filesystem::is_directory(file, status)) refuse(file, "this is a folder, not a file");
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) refuse(file, "cannot be opened: " + std::generic_category().message(errno));
    std::string text;
    char block[1 << 16];
    // Block by block: what is not a plain file (a device) may have no size, and no end.
    while (stream.read(block, sizeof block) || stream.gcount() > 0) {
        text.append(block, static_cast<std::size_t>(stream.gcount()));
        if (text.size() > largest_file) refuse(file, "the file is too large (above 16 MiB)");
    }
    if (stream.bad()) refuse(file, "cannot be read to its end");
    return text;
}

}  // namespace ghostlight
