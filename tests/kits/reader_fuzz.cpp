#include "tests/kits/reader_fuzz.h"

#include <time.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <typeinfo>

#include "core/error.h"
#include "core/io/agf.h"
#include "core/io/coating_csv.h"
#include "core/io/coating_dat.h"
#include "core/io/formats.h"
#include "core/io/lens_file.h"
#include "core/io/read_text.h"
#include "core/io/refractive_index_yaml.h"
#include "tests/support/test_paths.h"

namespace ghostlight {
namespace {

namespace fs = std::filesystem;

class Dice {
   public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    std::size_t below(std::size_t limit) { return limit == 0 ? 0 : engine_() % limit; }
    bool one_in(std::size_t count) { return below(count) == 0; }
    template <std::size_t N>
    std::string_view of(const std::string_view (&choices)[N]) {
        return choices[below(N)];
    }

   private:
    std::mt19937_64 engine_;
};

constexpr std::size_t largest_grown = std::size_t{10} << 20;

constexpr std::string_view odd_numbers[] = {"0",
                                            "-0",
                                            "1",
                                            "-1",
                                            "1e308",
                                            "-1e308",
                                            "1e309",
                                            "1e-320",
                                            "nan",
                                            "NaN",
                                            "inf",
                                            "-inf",
                                            "Infinity",
                                            "1e6",
                                            "-1e6",
                                            "1e-7",
                                            "1,5",
                                            "1.5.2",
                                            "0x10",
                                            "--3",
                                            "1e",
                                            "1e999999999",
                                            "undefined",
                                            "99999999999999999999999999999999999999",
                                            "0.00000000000000000000000000000000001",
                                            "1.0000001",
                                            "9.99",
                                            "1e9",
                                            "2147483648",
                                            "18446744073709551616"};
constexpr std::string_view odd_pieces[] = {"\n",
                                           "\r",
                                           "\r\n\r\n",
                                           "\t",
                                           "\t\t\t",
                                           "\0",
                                           " ",
                                           ";",
                                           "//",
                                           "#",
                                           "!",
                                           "&",
                                           "\"",
                                           "'",
                                           "[",
                                           "]",
                                           "{",
                                           "}",
                                           "<",
                                           ">",
                                           "</",
                                           "<!--",
                                           "&amp;",
                                           "&#0;",
                                           "[!",
                                           ":",
                                           ",",
                                           "\\",
                                           "\xff",
                                           "\xc3",
                                           "\xe2\x82\xac",
                                           "\xff\xfe",
                                           "\xfe\xff",
                                           "\xef\xbb\xbf",
                                           "NXT\n",
                                           "END\n",
                                           "SURF 1\n",
                                           "STO\n",
                                           "surfaces:\n",
                                           "[lens data]\n",
                                           "<!DOCTYPE a>",
                                           "null",
                                           "true",
                                           "1e400",
                                           "AS",
                                           "stop"};
constexpr std::string_view nested[] = {"[", "{\"a\":", "<a>", "(", "\"", "[[", "&", "/*"};

bool is_number_start(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.'; }
bool is_number_part(char c) { return is_number_start(c) || c == 'e' || c == 'E'; }

/// The numbers of a text are where readers decide; most mutations go there.
void replace_a_number(std::string& text, Dice& dice) {
    if (text.empty()) return;
    std::size_t at = dice.below(text.size());
    while (at < text.size() && !is_number_start(text[at])) ++at;
    std::size_t end = at;
    while (end < text.size() && is_number_part(text[end])) ++end;
    if (at == end) return;
    if (dice.one_in(3)) {  // a digit only
        text[at + dice.below(end - at)] = static_cast<char>('0' + dice.below(10));
    } else {
        text.replace(at, end - at, dice.of(odd_numbers));
    }
}

std::pair<std::size_t, std::size_t> some_lines(const std::string& text, Dice& dice) {
    std::size_t begin = dice.below(text.size());
    begin = begin == 0 ? 0 : text.rfind('\n', begin - 1);
    begin = begin == std::string::npos ? 0 : begin;
    std::size_t end = begin;
    for (std::size_t lines = 1 + dice.below(4); lines > 0 && end != std::string::npos; --lines)
        end = text.find('\n', end + 1);
    return {begin, end == std::string::npos ? text.size() : end};
}

std::string as_utf16(const std::string& text, bool little_endian, bool marked) {
    std::string wide = !marked ? "" : little_endian ? "\xff\xfe" : "\xfe\xff";
    for (const char c : text) {
        if (little_endian) wide += c;
        wide += '\0';
        if (!little_endian) wide += c;
    }
    return wide;
}

void mutate_once(std::string& text, const FuzzedReader& reader, Dice& dice) {
    if (text.empty()) text = " ";
    switch (dice.below(14)) {
        case 0:
        case 1:
        case 2:
        case 3:
            return replace_a_number(text, dice);
        case 4:
            text[dice.below(text.size())] = static_cast<char>(dice.below(256));
            return;
        case 5:
            text.insert(dice.below(text.size()), dice.of(odd_pieces));
            return;
        case 6:
            text.resize(dice.below(text.size()));
            return;
        case 7:
            text.erase(dice.below(text.size()), 1 + dice.below(20));
            return;
        case 8: {  // lines gone
            const auto [begin, end] = some_lines(text, dice);
            text.erase(begin, end - begin);
            return;
        }
        case 9: {  // lines twice, or elsewhere
            const auto [begin, end] = some_lines(text, dice);
            const std::string lines = text.substr(begin, end - begin);
            text.insert(dice.one_in(2) ? begin : dice.below(text.size()), lines);
            return;
        }
        case 10: {  // the rest from another file
            const std::string& other = reader.samples[dice.below(reader.samples.size())];
            text = text.substr(0, dice.below(text.size())) + other.substr(dice.below(other.size()));
            return;
        }
        case 11: {  // nested
            if (!dice.one_in(8)) return;
            const std::string_view opening = dice.of(nested);
            std::string deep;
            for (std::size_t count = dice.below(5000); count > 0; --count) deep += opening;
            text.insert(dice.below(text.size()), deep);
            return;
        }
        case 12: {  // long
            if (!dice.one_in(40)) return;
            const auto [begin, end] = some_lines(text, dice);
            const std::string lines = text.substr(begin, std::max<std::size_t>(end - begin, 1));
            std::string many;
            const std::size_t size = std::size_t{1} << (10 + dice.below(dice.one_in(20) ? 14 : 9));
            while (many.size() < std::min(size, largest_grown)) many += lines;
            text.insert(begin, many);
            return;
        }
        default:
            if (dice.one_in(4)) text = as_utf16(text, dice.one_in(2), dice.one_in(2));
            return;
    }
}

std::string bytes_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

/// The bundled lenses and the test data, but for what is no lens or meant to be refused.
std::vector<fs::path> sample_files() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(lens_folder()))
        if (entry.is_regular_file()) files.push_back(entry.path());
    for (auto entry = fs::recursive_directory_iterator(test_data_folder());
         entry != fs::recursive_directory_iterator(); ++entry) {
        const std::string name = entry->path().filename().string();
        if (entry->is_directory() && (name == "malformed" || name == "expected"))
            entry.disable_recursion_pending();
        if (entry->is_regular_file()) files.push_back(entry->path());
    }
    std::ranges::sort(files);  // so that a number means the same file everywhere
    return files;
}

/// A lens that was read can be saved and read again, and be written as whatever it can be.
void use(const LensFile& read, const LensFormat& format) {
    const std::string written = lens_to_json(read.lens);
    if (lens_from_json(written, "again").lens != read.lens)
        throw FuzzDefect{"the lens changes when it is saved and read again: " + written};
    if (format.write != nullptr) {
        Notes notes;
        format.write(read.lens, notes);
    }
}

/// A reader of files that are not lenses, with the samples of a folder that have its extension.
template <typename Read>
FuzzedReader other_reader(std::string name, std::string_view folder, std::string_view extension,
                          const std::vector<fs::path>& files, Read read) {
    FuzzedReader reader{std::move(name), "fuzz" + std::string(extension), {}, {}};
    for (const fs::path& file : files)
        if (file.parent_path().filename() == folder && file.extension() == extension)
            reader.samples.push_back(bytes_of(file));
    reader.read = [read](std::string_view bytes, const std::string& file) {
        read(utf8_text(bytes), fs::path(file));
    };
    return reader;
}

}  // namespace

std::vector<FuzzedReader> fuzzed_readers() {
    const std::vector<fs::path> files = sample_files();
    std::vector<FuzzedReader> readers;
    for (const LensFormat& format : lens_formats()) {
        FuzzedReader reader{std::string(format.name), {}, {}, {}};
        const std::string extensions(format.extensions);
        reader.file = "fuzz" + extensions.substr(0, extensions.find(' '));
        for (const fs::path& file : files) {
            std::string bytes = bytes_of(file);
            const std::string text = utf8_text(bytes);
            const FormatSource source{text, file};
            if (file.has_extension() &&
                extensions.find(file.extension().string()) != std::string::npos &&
                format.recognises(text) && &format_of(source) == &format)
                reader.samples.push_back(std::move(bytes));
        }
        reader.read = [&format](std::string_view bytes, const std::string& name) {
            const std::string text = utf8_text(bytes);
            format.recognises(text);
            use(format.read({text, name}), format);
        };
        readers.push_back(std::move(reader));
    }
    readers.push_back(other_reader("AGF", "agf", ".AGF", files, agf_from_text));
    readers.push_back(
        other_reader("refractiveindex.info", "materials", ".yml", files, material_from_yaml));
    readers.push_back(
        other_reader("COATING.DAT", "coatings", ".DAT", files, coating_file_from_text));
    readers.push_back(
        other_reader("reflectance CSV", "coatings", ".csv", files, measured_from_csv));
    return readers;
}

double thread_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string mutated(const FuzzedReader& reader, std::uint64_t number) {
    Dice dice(number * 0x9e3779b97f4a7c15 + 1);
    std::string text = reader.samples[dice.below(reader.samples.size())];
    if (dice.one_in(200)) {  // nothing of it at all
        text.clear();
        for (std::size_t count = dice.below(4000); count > 0; --count)
            text += static_cast<char>(dice.below(256));
    }
    for (std::size_t count = 1 + dice.below(dice.one_in(4) ? 12 : 3); count > 0; --count)
        mutate_once(text, reader, dice);
    return text;
}

FuzzOutcome read_fuzzed(const FuzzedReader& reader, const std::string& bytes) {
    try {
        reader.read(bytes, reader.file);
        return FuzzOutcome::read;
    } catch (const Error& error) {
        if (error.parts().file != reader.file)
            throw FuzzDefect{std::string("an error does not name the file: ") + error.what()};
        if (error.parts().problem.empty()) throw FuzzDefect{"an error does not say what is wrong"};
        if (std::string_view(error.what()).size() > 4000)
            throw FuzzDefect{std::string("an error of many pages: ") +
                             std::string(error.what()).substr(0, 200)};
        return FuzzOutcome::refused;
    } catch (const std::exception& other) {
        throw FuzzDefect{std::string("not an Error: ") + typeid(other).name() + ": " +
                         other.what()};
    }
}

}  // namespace ghostlight
