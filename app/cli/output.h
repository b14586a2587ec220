#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

namespace ghostlight::cli {

/// Before anything else: no signal for a closed pipe, and no file may get the number of a standard
/// stream that the caller closed.
void prepare_streams();

/// Writes everything, or throws Error. A reader that has gone away wants no more: no error.
void write_standard_output(std::string_view text);

/// One line, whatever is in the text.
void write_standard_error(std::string_view line);

/// All of a file, or of standard input for "-". Throws Error.
std::string read_input(const std::string& file);

/// A line "label  42 %" on standard error that is rewritten as the work goes on, if that is a
/// terminal and the work takes long enough to care.
class ProgressLine {
   public:
    explicit ProgressLine(std::string label);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// From any thread, with the share done, 0 to 1.
    void operator()(double share);

   private:
    using Clock = std::chrono::steady_clock;
    std::string label_;
    bool terminal_;
    bool shown_ = false;
    int percent_ = -1;
    Clock::time_point begin_;
    std::mutex mutex_;
};

}  // namespace ghostlight::cli
