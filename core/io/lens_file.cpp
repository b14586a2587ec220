#include "core/io/lens_file.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/formats.h"
#include "core/io/json_value.h"
#include "core/io/lens_json.h"
#include "core/io/read_text.h"

namespace ghostlight {

void validate_in_file(const Prescription& lens, const std::string& file) {
    try {
        validate(lens);
    } catch (const Error& error) {
        Error::Parts parts = error.parts();
        parts.file = file;
        throw Error(std::move(parts));
    }
}

Notes findings(const Prescription& lens) {
    Notes notes;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        const Surface& surface = lens.surfaces[row];
        const double reach = curvature_per_mm(surface.curve) * surface.semi_diameter_mm;
        if ((1.0 + surface.conic) * reach * reach > 1.0)
            notes.push_back({Note::Severity::warning, fmt::format("surfaces[{}]", row + 1),
                             fmt::format("the clear radius {} mm is beyond the surface's edge",
                                         format_number(surface.semi_diameter_mm))});
    }
    return notes;
}

LensFile lens_from_json(std::string_view text, const std::string& file) {
    const Json json = parse_json(text, file);
    const JsonAt root(json, file);
    root.require_object("a lens {…}");
    if (root.has("ghostlight_lens")) return lens_from_own_json(root);
    if (root.has("surfaces")) return lens_from_listing(root);
    throw Error({.problem = "not a lens file",
                 .file = file,
                 .where = {},
                 .found = excerpt(json),
                 .expected = "the field \"ghostlight_lens\", or a listing with \"surfaces\""});
}

LensFile read_lens(const std::filesystem::path& file) {
    const std::string text = utf8_text(read_text(file));
    const FormatSource source{text, file};
    LensFile result = format_of(source).read(source);
    if (result.lens.name.empty()) result.lens.name = file.stem().string();
    return result;
}

}  // namespace ghostlight
