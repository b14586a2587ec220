#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "core/io/formats.h"
#include "core/io/import_notes.h"
#include "core/io/imported_fields.h"
#include "core/io/imported_lens.h"
#include "core/io/seq_glass.h"

namespace ghostlight {

/// A surface as the commands of a .seq give it; lengths are in the file's unit.
struct SeqSurface {
    std::string where;
    std::optional<double> first;      ///< of the S row: radius or curvature
    std::optional<double> curvature;  ///< by RDY or CUY, per unit
    double thickness = 0.0;
    std::string glass, glass_where, label;
    std::optional<double> glass_vd;  ///< S radius thickness nd vd
    double conic = 0.0;
    bool is_asphere = false;
    std::map<int, double> terms;
    std::optional<double> semi_diameter;
};

/// What the commands of a .seq say, before a lens is made of it.
struct SeqContents {
    std::string file;
    ImportedLens imported;  ///< what needs no more than one command, and the notes
    PrivateGlasses private_glasses;
    std::vector<SeqSurface> rows;  ///< 0 is the object, the last one the image
    bool has_image = false, paraxial_image = false;
    std::optional<bool> radius_mode;
    double mm = 1.0;  ///< of the file's unit
    std::string aperture, aperture_where;
    double aperture_value = 0.0;
    std::vector<double> wavelengths_nm;
    std::optional<double> reference;
    std::string field_kind;
    ListedFields fields;
    std::optional<std::size_t> imported_stop;
    std::vector<std::tuple<std::size_t, std::string, std::string>> displaced;
    std::size_t positions = 1;
    std::map<std::size_t, std::string> zoom_names;
    std::map<std::size_t, std::map<std::size_t, double>> zoom_thickness;  ///< surface → zoom
    std::map<std::size_t, double> zoom_f_number, zoom_pupil;
    std::map<std::string, std::string> zoom_left_out;
    std::set<std::string> skipped;
    UnusedWords unused;
};

/// Reads the commands one by one. Throws Error like import_seq().
SeqContents seq_contents(const FormatSource& source);

/// The lens that they describe. Throws Error like import_seq().
ImportedLens seq_lens(SeqContents contents);

}  // namespace ghostlight
