#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

// Files that were never meant, for every reader there is.

namespace ghostlight {

/// A reader and files that it reads.
struct FuzzedReader {
    std::string name;
    std::string file;  ///< what the reader is told that the file is called
    std::vector<std::string> samples;
    /// Reads, and does with what was read whatever a program does next. Throws Error for what it
    /// refuses; anything else that leaves it is a defect.
    std::function<void(std::string_view bytes, const std::string& file)> read;
};

/// Every format of lens_formats() with the bundled lenses and the files of tests/data that it
/// recognises, and the readers of other files.
std::vector<FuzzedReader> fuzzed_readers();

/// Thrown by FuzzedReader::read for a reader that accepts and then contradicts itself.
struct FuzzDefect {
    std::string what;
};

/// One mutated file: the same for the same reader and number, on every machine.
std::string mutated(const FuzzedReader& reader, std::uint64_t number);

/// What became of a file.
enum class FuzzOutcome { read, refused };
/// Reads it. Throws FuzzDefect for an error without a file's name, for what is not an Error, and
/// for what read() throws.
FuzzOutcome read_fuzzed(const FuzzedReader& reader, const std::string& bytes);

/// What this thread has computed so far, s: not what it waited for on a busy machine.
double thread_seconds();

}  // namespace ghostlight
