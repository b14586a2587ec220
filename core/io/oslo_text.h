#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/io/text_lines.h"

namespace ghostlight {

/// One command of an OSLO file: `RD 20`, `LEN NEW "name" 50 7`.
struct OsloCommand {
    Place place;
    std::string word;                ///< in capitals
    std::vector<std::string> parts;  ///< what follows; a text in quotes is one part, without them
};

/// The commands one after the other, which line ends and ";" separate; "//" begins a comment
/// outside quotes.
void for_each_oslo_command(std::string_view text, const std::string& file,
                           const std::function<void(const OsloCommand&)>& work);

/// What an OSLO file says of one surface, in its own units.
struct OsloSurface {
    Place place;  ///< of its first command
    std::optional<double> radius, curvature, thickness;
    double conic = 0.0;
    std::map<int, double> terms;  ///< power of r → coefficient
    std::string asphere;          ///< ASR, ARA; empty: AD … AG
    std::vector<std::string> glass;
    Place glass_place;
    std::vector<double> glass_wavelengths_um;  ///< of the WV before a GLA MOD
    std::optional<double> aperture;
    Place aperture_place;
    bool aperture_checked = false;
    bool is_stop = false;
    std::optional<double> height_solve;  ///< PY: the thickness that brings the marginal ray there
    std::optional<double> slope_solve;   ///< PU: the curvature that gives the marginal ray it
    std::string note;
};

/// What an OSLO file says, with pickups done and nothing else worked out.
struct OsloText {
    std::string name;
    std::optional<double> efl;  ///< of LEN NEW; 100 stands for nothing
    double unit_mm = 1.0;       ///< UNI
    bool has_unit = false;
    std::optional<double> beam_radius, object_na, f_number, field_deg, object_height, image_height;
    std::vector<double> wavelengths_um;  ///< the first is the primary one
    std::vector<OsloSurface> surfaces;   ///< 0 is the object, the last the image
};

/// Throws Error for what is not an OSLO file and for what cannot be traced here.
OsloText read_oslo_text(std::string_view text, const std::string& file, Notes& notes);

}  // namespace ghostlight
