#include "app/cli/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>

#include "core/error.h"

namespace ghostlight::cli {
namespace {

// Returns the error of the write that failed, or 0.
int write_all(int stream, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(stream, text.data(), text.size());
        if (written > 0)
            text.remove_prefix(static_cast<std::size_t>(written));
        else if (written < 0 && errno != EINTR)
            return errno;
    }
    return 0;
}

}  // namespace

void prepare_streams() {
    std::signal(SIGPIPE, SIG_IGN);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        // The lowest free number is the one that is missing. Opened the wrong way round, it fails
        // like a closed stream when it is used.
        if (::fcntl(stream, F_GETFD) == -1 && errno == EBADF)
            static_cast<void>(::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
    }
}

void write_standard_output(std::string_view text) {
    const int error = write_all(STDOUT_FILENO, text);
    if (error != 0 && error != EPIPE)
        throw Error("cannot write to standard output: " + std::generic_category().message(error));
}

void write_standard_error(std::string_view line) {
    std::string text(line);
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
    text += '\n';
    write_all(STDERR_FILENO, text);
}

std::string read_input(const std::string& file) {
    const bool standard = file == "-";
    const int stream = standard ? STDIN_FILENO : ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    std::string text;
    char buffer[1 << 16];
    int error = stream < 0 ? errno : 0;
    while (error == 0) {
        const ssize_t count = ::read(stream, buffer, sizeof buffer);
        if (count == 0) break;
        if (count > 0)
            text.append(buffer, static_cast<std::size_t>(count));
        else if (errno != EINTR)
            error = errno;
    }
    if (!standard && stream >= 0) ::close(stream);
    if (error != 0)
        throw Error({.problem = "cannot be read: " + std::generic_category().message(error),
                     .file = standard ? "standard input" : file,
                     .where = {},
                     .found = {},
                     .expected = {}});
    return text;
}

ProgressLine::ProgressLine(std::string label)
    : label_(std::move(label)), terminal_(::isatty(STDERR_FILENO) != 0), begin_(Clock::now()) {}

ProgressLine::~ProgressLine() {
    if (shown_) write_all(STDERR_FILENO, "\r\033[K");
}

void ProgressLine::operator()(double share) {
    if (!terminal_) return;
    const std::lock_guard lock(mutex_);
    const int percent = static_cast<int>(100.0 * share);
    if (percent <= percent_ || Clock::now() - begin_ < std::chrono::milliseconds(500)) return;
    percent_ = percent;
    shown_ = true;
    write_all(STDERR_FILENO, fmt::format("\r{}  {} %", label_, percent));
}

}  // namespace ghostlight::cli
