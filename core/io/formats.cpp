#include "core/io/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/error.h"
#include "core/io/flaresim_lens.h"
#include "core/io/flaresim_write.h"
#include "core/io/imported_lens.h"
#include "core/io/open_lens_flare.h"
#include "core/io/optical_bench.h"
#include "core/io/oslo.h"
#include "core/io/pbrt_lens.h"
#include "core/io/realflare.h"
#include "core/io/seq.h"
#include "core/io/zmx.h"

namespace ghostlight {
namespace {

LensFile read_json(const FormatSource& source) {
    return lens_from_json(source.text, source.file.string());
}
bool looks_like_json(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && text[first] == '{';
}
std::string write_json(const Prescription& lens, Notes&) { return lens_to_json(lens); }

/// A reader of a foreign format, with what its file leaves open worked out.
template <ImportedLens (*import)(const FormatSource&)>
LensFile read_foreign(const FormatSource& source) {
    try {
        return complete_import(import(source), source.file.string());
    } catch (const Error& error) {
        if (!error.parts().file.empty()) throw;
        // From a lens that cannot be worked with at all, by what works with lenses from anywhere.
        Error::Parts parts = error.parts();
        parts.file = source.file.string();
        throw Error(std::move(parts));
    }
}

constexpr std::array formats = {
    LensFormat{"realflare", ".json", is_realflare, read_foreign<import_realflare>, nullptr},
    LensFormat{"Ghostlight or listing JSON", ".json", looks_like_json, read_json, write_json},
    LensFormat{"Zemax", ".zmx", is_zmx, read_foreign<import_zmx>, write_zmx},
    LensFormat{"CODE V", ".seq", is_seq, read_foreign<import_seq>, write_seq},
    LensFormat{"OSLO", ".len", is_oslo, read_foreign<import_oslo>, nullptr},
    LensFormat{"PhotonsToPhotos Optical Bench", ".txt", is_optical_bench,
               read_foreign<import_optical_bench>, nullptr},
    LensFormat{"FlareSim", ".lens", is_flaresim_lens, read_foreign<import_flaresim_lens>,
               write_flaresim_lens},
    LensFormat{"OpenLensFlare", ".xml", is_open_lens_flare, read_foreign<import_open_lens_flare>,
               nullptr},
    LensFormat{"pbrt", ".dat", is_pbrt_lens, read_foreign<import_pbrt_lens>, nullptr},
};

std::string lower_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool has_extension(const LensFormat& format, std::string_view extension) {
    return !extension.empty() &&
           fmt::format(" {} ", format.extensions).find(fmt::format(" {} ", extension)) !=
               std::string::npos;
}

template <class Chosen>
std::string listed(Chosen chosen) {
    std::string text;
    for (const LensFormat& format : formats)
        if (chosen(format))
            text +=
                fmt::format("{}{} ({})", text.empty() ? "" : ", ", format.name, format.extensions);
    return text;
}

}  // namespace

std::span<const LensFormat> lens_formats() { return formats; }

const LensFormat& format_of(const FormatSource& source) {
    const std::string extension = lower_extension(source.file);
    for (const bool by_extension : {true, false})
        for (const LensFormat& format : formats)
            if ((!by_extension || has_extension(format, extension)) &&
                format.recognises(source.text))
                return format;
    // What has a known extension is read as that, for the sake of the message.
    for (const LensFormat& format : formats)
        if (has_extension(format, extension)) return format;
    throw Error({.problem = "not a lens file",
                 .file = source.file.string(),
                 .where = {},
                 .found = {},
                 .expected = "one of " + listed([](const LensFormat&) { return true; })});
}

const LensFormat& writable_format(const std::filesystem::path& file) {
    const std::string extension = lower_extension(file);
    for (const LensFormat& format : formats)
        if (format.write != nullptr && has_extension(format, extension)) return format;
    throw Error(
        {.problem = "no format to write by this name",
         .file = file.string(),
         .where = {},
         .found = extension.empty() ? "no extension" : extension,
         .expected = "one of " + listed([](const LensFormat& f) { return f.write != nullptr; })});
}

}  // namespace ghostlight
