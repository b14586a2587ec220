#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/io/catalogued_glass.h"
#include "core/optics/glass.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// What a reader made of a file, and what it noticed.
struct LensFile {
    Prescription lens;
    Notes notes;
};

/// Reads a lens: our own JSON (docs/lens-format.md) or a listing JSON (radius, thickness, nd, vd
/// per surface). Throws Error naming the file, the field, what was found and what was expected.
LensFile read_lens(const std::filesystem::path& file);

/// The same from text; `file` only names it in messages.
LensFile lens_from_json(std::string_view text, const std::string& file);

/// Our own JSON: stable in order and formatting, shortest digits that read back exactly. The stop's
/// image is named relative to the folder the text will be in, where it lies in or below it.
std::string lens_to_json(const Prescription& lens, const std::filesystem::path& folder = {});

/// Writes aside, then renames: a crash or a full disk never loses the old file. Throws Error.
void write_lens(const Prescription& lens, const std::filesystem::path& file);

/// Writes any text that way.
void write_file_safely(const std::filesystem::path& file, std::string_view text);

/// Where the bundled lenses and glasses are: the environment's GHOSTLIGHT_DATA, share/ghostlight
/// next to the program, or the source tree's lenses folder. Throws Error when there is none.
std::filesystem::path data_directory();

/// The bundled glass catalogue (lenses/glasses) by maker, read once.
const std::vector<GlassFile>& bundled_catalogs();

/// The same in one list.
const GlassCatalog& bundled_glasses();

struct BundledLens {
    std::string name;
    std::filesystem::path file;
};
/// The bundled lenses, by name.
std::vector<BundledLens> bundled_lenses();

}  // namespace ghostlight
