// ghostlight_fuzz: every reader of files against mutated ones. ./dev fuzz builds it with the
// sanitizers and runs it.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <thread>

#include "core/error.h"
#include "tests/kits/reader_fuzz.h"

namespace {

using namespace ghostlight;
using Clock = std::chrono::steady_clock;

constexpr double longest_s = 2.0;         ///< for one file
constexpr double hang_s = 20.0;           ///< of processor time, after which it gives up on one
constexpr double most_memory_mb = 512.0;  ///< more than the program holds by itself

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// The memory that the process has (VmRSS) or ever had (VmHWM), MB.
double memory_mb(std::string_view kind) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(kind))
            return std::strtod(line.c_str() + kind.size(), nullptr) / 1024.0;
    return 0.0;
}
/// Forgets it, so that the next peak is the next reader's.
void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// What is being read, in a file that outlives a crash of this program.
class Current {
   public:
    explicit Current(const std::string& file) {
        const int handle = ::open(file.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0644);
        if (handle < 0 || ::ftruncate(handle, size) != 0) throw Error("cannot write " + file);
        text_ = static_cast<char*>(
            ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, handle, 0));
        ::close(handle);
        if (text_ == MAP_FAILED) throw Error("cannot map " + file);
    }
    void is(const std::string& text) {
        std::memset(text_, ' ', size - 1);
        std::memcpy(text_, text.data(), std::min(text.size(), size - 1));
        text_[size - 1] = '\n';
    }

   private:
    static constexpr std::size_t size = 256;
    char* text_ = nullptr;
};

struct Options {
    double minutes = 1.0;
    std::uint64_t mutations = 0, seed = 1;
    std::string reader, folder = "out/fuzz";
    std::optional<std::uint64_t> replay;
};

struct Result {
    std::uint64_t files = 0, read = 0, refused = 0, defects = 0, slowest = 0;
    double slowest_s = 0.0, memory_mb = 0.0;
};

std::string saved(const Options& options, const FuzzedReader& reader, std::uint64_t number,
                  const std::string& bytes) {
    const std::string extension = std::filesystem::path(reader.file).extension();
    const std::string file = fmt::format("{}/{}{}", options.folder, number, extension);
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
}

/// Processor time of the whole program: a busy machine is no hang.
double process_seconds() {
    timespec spent{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &spent);
    return static_cast<double>(spent.tv_sec) + 1e-9 * static_cast<double>(spent.tv_nsec);
}

/// When the file in hand began, by that clock; 0 between files.
std::atomic<double> began_s{0.0};

/// Ends the program when one file takes too long; the file's name is in `current`.
void watch(std::stop_token stop) {
    while (!stop.stop_requested()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        const double since_s = began_s.load();
        if (since_s == 0.0) continue;
        if (process_seconds() - since_s > hang_s) {
            fmt::print(stderr, "fuzz: one file takes more than {} s: see current.txt\n", hang_s);
            std::abort();
        }
    }
}

void report_defect(const Options& options, const FuzzedReader& reader, std::uint64_t number,
                   const std::string& bytes, const std::string& what, Result& result) {
    ++result.defects;
    constexpr std::uint64_t most_saved = 20;
    if (result.defects <= most_saved)
        fmt::print("  DEFECT {}: {}\n    {}\n", number, what,
                   saved(options, reader, number, bytes));
}

Result run(const FuzzedReader& reader, const Options& options, double seconds, Current& current) {
    Result result;
    reset_peak_memory();
    // The sanitizers keep some of what earlier readers had.
    const double held_mb = memory_mb("VmRSS:");
    const Clock::time_point begin = Clock::now();
    const std::uint64_t first = options.replay.value_or(options.seed << 32);
    for (std::uint64_t number = first;; ++number) {
        if (options.replay          ? number > first
            : options.mutations > 0 ? result.files >= options.mutations
                                    : seconds_since(begin) > seconds)
            break;
        const std::string bytes = mutated(reader, number);
        if (options.replay) fmt::print("  {}\n", saved(options, reader, number, bytes));
        current.is(fmt::format("--reader '{}' --replay {}", reader.name, number));
        began_s = process_seconds();
        const double start_s = thread_seconds();
        try {
            if (read_fuzzed(reader, bytes) == FuzzOutcome::read)
                ++result.read;
            else
                ++result.refused;
        } catch (const FuzzDefect& defect) {
            report_defect(options, reader, number, bytes, defect.what, result);
        }
        began_s = 0.0;
        const double took_s = thread_seconds() - start_s;
        if (took_s > result.slowest_s) {
            result.slowest_s = took_s;
            result.slowest = number;
        }
        if (took_s > longest_s)
            report_defect(options, reader, number, bytes,
                          fmt::format("takes {:.2f} s, more than {} s", took_s, longest_s), result);
        ++result.files;
    }
    result.memory_mb = memory_mb("VmHWM:") - held_mb;
    return result;
}

int fuzz(const Options& options) {
    std::filesystem::create_directories(options.folder);
    Current current(options.folder + "/current.txt");
    std::jthread watcher(watch);
    const std::vector<FuzzedReader> readers = fuzzed_readers();
    std::vector<const FuzzedReader*> chosen;
    for (const FuzzedReader& reader : readers)
        if (options.reader.empty() || reader.name == options.reader) chosen.push_back(&reader);
    if (chosen.empty()) throw Error("no such reader: " + options.reader);
    fmt::print("{:<32}{:>9}{:>9}{:>9}{:>9}{:>11}{:>14}{:>9}\n", "reader", "files", "read",
               "refused", "defects", "slowest_s", "its number", "peak_MB");
    bool fine = true;
    for (const FuzzedReader* reader : chosen) {
        if (reader->samples.empty()) throw Error("no sample file for the reader " + reader->name);
        const Result result = run(
            *reader, options, options.minutes * 60.0 / static_cast<double>(chosen.size()), current);
        fmt::print("{:<32}{:>9}{:>9}{:>9}{:>9}{:>11.3f}{:>14}{:>9.0f}\n", reader->name,
                   result.files, result.read, result.refused, result.defects, result.slowest_s,
                   result.slowest, result.memory_mb);
        std::fflush(stdout);
        if (result.memory_mb > most_memory_mb)
            fmt::print("  DEFECT: more than {} MB\n", most_memory_mb);
        fine = fine && result.defects == 0 && result.memory_mb <= most_memory_mb;
    }
    return fine ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app{"Reads mutated files with every reader of Ghostlight"};
    app.add_option("minutes", options.minutes, "how long, over all readers");
    app.add_option("--mutations", options.mutations, "files for each reader, instead of minutes");
    app.add_option("--reader", options.reader, "only this one");
    app.add_option("--seed", options.seed, "other files than those of seed 1");
    app.add_option("--replay", options.replay, "only the file of this number, saved in the folder");
    app.add_option("--folder", options.folder, "where defects go");
    CLI11_PARSE(app, argc, argv);
    try {
        return fuzz(options);
    } catch (const std::exception& error) {
        fmt::print(stderr, "fuzz: {}\n", error.what());
        return 2;
    }
}
