#include "core/io/read_text.h"

#include <cstdint>
#include <fstream>
#include <system_error>

#include "core/io/refuse_file.h"

namespace ghostlight {
namespace {

void append_utf8(std::uint32_t point, std::string& text) {
    auto put = [&](std::uint32_t byte) { text.push_back(static_cast<char>(byte)); };
    if (point < 0x80) return put(point);
    if (point < 0x800) {
        put(0xc0 | point >> 6);
    } else if (point < 0x10000) {
        put(0xe0 | point >> 12);
        put(0x80 | (point >> 6 & 0x3f));
    } else {
        put(0xf0 | point >> 18);
        put(0x80 | (point >> 12 & 0x3f));
        put(0x80 | (point >> 6 & 0x3f));
    }
    put(0x80 | (point & 0x3f));
}

std::string from_utf16(std::string_view bytes, bool little_endian) {
    std::string text;
    auto unit = [&](std::size_t i) {
        const auto low = static_cast<unsigned char>(bytes[i + (little_endian ? 0 : 1)]);
        const auto high = static_cast<unsigned char>(bytes[i + (little_endian ? 1 : 0)]);
        return static_cast<std::uint32_t>(high << 8 | low);
    };
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        std::uint32_t point = unit(i);
        const bool first_of_pair = point >= 0xd800 && point < 0xdc00;
        if (first_of_pair && i + 3 < bytes.size() && unit(i + 2) >= 0xdc00 &&
            unit(i + 2) < 0xe000) {
            point = 0x10000 + ((point - 0xd800) << 10) + (unit(i + 2) - 0xdc00);
            i += 2;
        } else if (point >= 0xd800 && point < 0xe000) {
            point = 0xfffd;
        }
        append_utf8(point, text);
    }
    return text;
}

bool is_utf8(std::string_view bytes) {
    for (std::size_t i = 0; i < bytes.size();) {
        const auto byte = static_cast<unsigned char>(bytes[i]);
        const std::size_t length = byte < 0x80   ? 1
                                   : byte < 0xc2 ? 0
                                   : byte < 0xe0 ? 2
                                   : byte < 0xf0 ? 3
                                   : byte < 0xf5 ? 4
                                                 : 0;
        if (length == 0 || i + length > bytes.size()) return false;
        for (std::size_t k = 1; k < length; ++k)
            if ((static_cast<unsigned char>(bytes[i + k]) & 0xc0) != 0x80) return false;
        i += length;
    }
    return true;
}

constexpr std::size_t largest_file = std::size_t{16} << 20;

}  // namespace

std::string read_text(const std::filesystem::path& file) {
    std::error_code status;
    if (std::filesystem::is_directory(file, status))
        refuse_file(file, "this is a folder, not a file");
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) refuse_file(file, "cannot be opened: " + std::generic_category().message(errno));
    std::string text;
    char block[1 << 16];
    // Block by block: what is not a plain file (a device) may have no size, and no end.
    while (stream.read(block, sizeof block) || stream.gcount() > 0) {
        text.append(block, static_cast<std::size_t>(stream.gcount()));
        if (text.size() > largest_file) refuse_file(file, "the file is too large (above 16 MiB)");
    }
    if (stream.bad()) refuse_file(file, "cannot be read to its end");
    return text;
}

std::string utf8_text(std::string_view bytes) {
    if (bytes.starts_with("\xff\xfe")) return from_utf16(bytes.substr(2), true);
    if (bytes.starts_with("\xfe\xff")) return from_utf16(bytes.substr(2), false);
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
    // UTF-16 without a mark: plain words have a zero in every second byte.
    if (bytes.size() >= 4 && bytes[1] == '\0' && bytes[3] == '\0' && bytes[0] != '\0')
        return from_utf16(bytes, true);
    if (bytes.size() >= 4 && bytes[0] == '\0' && bytes[2] == '\0' && bytes[1] != '\0')
        return from_utf16(bytes, false);
    if (is_utf8(bytes)) return std::string(bytes);
    std::string text;
    for (const char byte : bytes) append_utf8(static_cast<unsigned char>(byte), text);
    return text;
}

}  // namespace ghostlight
