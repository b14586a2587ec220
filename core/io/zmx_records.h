#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace ghostlight {

// A Zemax file as it stands, in its own units and numbering. What it means for a lens is worked
// out in zmx_read.cpp.

/// GLAS: name, how it is meant, and what the file holds beside it.
struct ZmxGlass {
    std::string name;
    int kind = 0;  ///< 0 catalogue, 1 model, 2 pick-up; others are solves on top of a glass
    int pickup_from = 0;
    std::optional<double> nd, vd, dpgf;
    std::string where;
};

struct ZmxDiameter {
    double semi = 0.0;
    bool by_user = false;  ///< else the program's own, from the rays of the fields
};

/// An aperture that cuts light: CLAP, FLAP, OBSC, SQAP, ….
struct ZmxAperture {
    std::string word, where;
    std::vector<double> numbers;
};

struct ZmxSurface {
    std::string where;  ///< "SURF 5 (line 80)"
    std::string type = "STANDARD";
    double curvature = 0.0, conic = 0.0, thickness = 0.0;
    bool infinite = false;  ///< DISZ INFINITY
    bool stop = false;
    std::optional<ZmxDiameter> diameter;
    std::optional<ZmxGlass> glass;
    std::vector<ZmxAperture> apertures;
    std::map<int, double> parameters, extra;  ///< PARM, XDAT by number
    std::string comment, coating, coating_where;
    /// Thickness solves: TCOM i total, TOLE i total, MAZH height zone.
    std::optional<std::pair<int, double>> complement, position;
    bool at_paraxial_focus = false;  ///< MAZH 0 0
};

/// A line of the multi-configuration editor: THIC 5 2 17.3.
struct ZmxOperand {
    std::string word, where;
    int target = 0, configuration = 0;
    std::optional<double> value;
    std::string text;  ///< of LTTL, GLSS
};

struct ZmxFile {
    std::string mode = "SEQ", mode_where, name, unit = "MM", unit_where, version;
    std::vector<std::string> notes, catalogs;
    std::string coating_file;  ///< COFN
    enum class Aperture { none, entrance_pupil, f_number, object_na, stop_size };
    Aperture aperture = Aperture::none;
    double aperture_value = 0.0;
    int aperture_flag = 0;
    std::string aperture_where;
    int field_type = 0;
    std::optional<std::size_t> field_count, wave_count;
    bool telecentric = false;
    bool afocal = false;
    std::vector<double> x_fields, y_fields, vdx, vdy, vcx, vcy;
    std::string fields_where;
    std::map<int, double> waves_um;
    std::optional<int> primary_wave;
    double temperature_c = 20.0, pressure_atm = 1.0;
    std::string environment_where;
    std::vector<ZmxSurface> surfaces;  ///< the first is the object, the last the image
    int configurations = 1, active = 1;
    std::vector<ZmxOperand> operands;
};

/// Reads the records. Words that are not used go to the notes, each once. Throws Error naming the
/// line for a record whose number is none.
ZmxFile zmx_records(std::string_view text, const std::string& file, Notes& notes);

}  // namespace ghostlight
