#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/optics/coating.h"
#include "core/optics/glass.h"
#include "core/optics/stop_picture.h"

namespace ghostlight {

/// Fields of a file that this version does not know, kept as they were: name → JSON text.
using UnknownFields = std::map<std::string, std::string>;

struct Plane {
    bool operator==(const Plane&) const = default;
};
/// Positive when the centre of curvature lies towards the sensor.
struct Radius {
    double mm = 0.0;
    bool operator==(const Radius&) const = default;
};
struct Curvature {
    double per_mm = 0.0;
    bool operator==(const Curvature&) const = default;
};
/// A surface's base curve, as its author gave it.
using BaseCurve = std::variant<Plane, Radius, Curvature>;

double curvature_per_mm(const BaseCurve& curve);

/// One row of the prescription: a surface and what follows it.
struct Surface {
    BaseCurve curve = Plane{};
    double conic = 0.0;              ///< conic constant k; 0 = sphere, −1 = paraboloid
    std::vector<double> aspheric;    ///< A4, A6, A8, …: sag terms in mm^(1−power)
    double thickness_mm = 0.0;       ///< to the next vertex; the last one to the sensor
    Medium medium_after;             ///< air by default
    double semi_diameter_mm = 10.0;  ///< clear radius; of the stop's row, its listed radius
    /// The radius is not the source's: sized to let the direct beam through.
    bool semi_diameter_sized = false;
    Coating coating = Uncoated{};
    std::string comment;
    UnknownFields unknown;
    bool operator==(const Surface&) const = default;
};

/// z of a surface relative to its vertex at a height; beyond the end of a sphere or an ellipsoid,
/// of that end.
double sag_mm(const Surface& surface, double y_mm);

/// An image that is laid over the stop's opening and clips it further.
struct StopImage {
    std::string file;  ///< where it was read from: absolute, or as it was given
    std::shared_ptr<const StopPicture> picture;  ///< never null
    bool operator==(const StopImage& other) const {
        return file == other.file && *picture == *other.picture;
    }
};

/// What lies on the glass at the stop, scattered by a seed: the same seed, the same dirt.
struct StopDirt {
    double dust_coverage = 0.0;  ///< share of the stop's circle that opaque specks cover
    /// Their diameters, spread evenly over the logarithm.
    double dust_smallest_mm = 0.02, dust_largest_mm = 0.2;
    int scratches = 0;  ///< how many, each opaque and 0.1 to 1 times the stop's radius long
    double scratch_thinnest_mm = 0.005, scratch_widest_mm = 0.02;
    double fingerprint = 0.0;  ///< share of the light that the ridges of one print take, at most
    int seed = 1;
    bool is_clean() const { return dust_coverage <= 0.0 && scratches == 0 && fingerprint <= 0.0; }
    bool operator==(const StopDirt&) const = default;
};

/// The aperture stop: which row, how far it is closed, its blades, and what is on it.
struct Stop {
    std::size_t surface = 0;                 ///< row, from 0
    std::optional<double> f_number;          ///< wins over semi_diameter_mm; capped by the row's
    std::optional<double> semi_diameter_mm;  ///< none = the row's own
    int blades = 0;                          ///< 0 = round, else 3 or more
    double rotation_deg = 0.0;
    double blade_curvature = 0.0;         ///< 0 = straight edges, 1 = the full circle
    std::optional<StopImage> image = {};  ///< turned with rotation_deg, as wide as the stop
    StopDirt dirt = {};
    UnknownFields unknown;
    bool operator==(const Stop&) const = default;
};

/// The same share of the light at every wavelength, angle and polarisation.
struct UniformReflectance {
    double share = 0.0;
    bool operator==(const UniformReflectance&) const = default;
};
/// One entry of a table of reflectances.
struct ReflectanceAt {
    double wavelength_nm = 0.0;
    double share = 0.0;
    bool operator==(const ReflectanceAt&) const = default;
};
/// Over wavelength, the same at every angle: linear between the entries, the nearest one beyond.
struct ReflectanceTable {
    std::vector<ReflectanceAt> entries;  ///< wavelengths rising
    bool operator==(const ReflectanceTable&) const = default;
};
/// Films on the sensor's material, ordered from the incoming side.
struct SensorFilms {
    LayerStack stack;
    Medium substrate;
    bool operator==(const SensorFilms&) const = default;
};
/// What a sensor sends back into the lens.
using SensorReflectance = std::variant<UniformReflectance, ReflectanceTable, SensorFilms>;

struct Sensor {
    double width_mm = 36.0;
    double height_mm = 24.0;
    bool at_paraxial_focus = false;                ///< else at the last surface's thickness
    std::optional<SensorReflectance> reflectance;  ///< none: the sensor is not a ghost's surface
    UnknownFields unknown;
    bool operator==(const Sensor&) const = default;
};

/// What the source states; not used in any computation.
struct Published {
    std::optional<double> efl_mm, f_number, bfd_mm, half_field_deg;
    UnknownFields unknown;
    bool operator==(const Published&) const = default;
};

/// A zoom or focus position: what it overrides.
struct Configuration {
    std::string name;
    std::map<std::size_t, double> thickness_mm;  ///< row from 0 → thickness
    std::optional<double> f_number;              ///< wins over stop_semi_diameter_mm
    std::optional<double> stop_semi_diameter_mm;
    Published published;  ///< of this position
    UnknownFields unknown;
    bool operator==(const Configuration&) const = default;
};

/// A lens, as a person edits it and as a file holds it.
struct Prescription {
    std::string name;
    std::string source;
    std::string notes;
    Published published;
    std::vector<Surface> surfaces;
    Stop stop;
    Sensor sensor;
    std::vector<Configuration> configurations;
    /// Glasses absorb as their catalogue says; else, and where it says nothing, they are lossless.
    bool internal_transmittance = false;
    UnknownFields unknown;
    bool operator==(const Prescription&) const = default;
};

/// Throws Error naming the field if the lens cannot be traced as it stands (no surface, stop row
/// out of range, a semi-diameter that is not positive, a number that is not finite, …).
void validate(const Prescription& lens);

/// The lens in one of its positions: the configuration's values written into the rows, and no
/// configurations left. An empty name is the lens as listed. Throws Error naming the known ones.
Prescription configured(const Prescription& lens, std::string_view configuration);

/// Writes one coating on every surface with air on exactly one side, and none on the others.
Prescription with_air_coating(const Prescription& lens, const Coating& coating);

/// Medium in front of a row (air before the first).
const Medium& medium_before(const Prescription& lens, std::size_t row);

}  // namespace ghostlight
