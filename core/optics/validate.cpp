#include <fmt/format.h>

#include <cmath>
#include <set>

#include "core/error.h"
#include "core/optics/dispersion_formula.h"
#include "core/optics/prescription.h"

namespace ghostlight {
namespace {

// Bounds on what can be meant: beyond them a number is a slip of units or of a digit, and the
// squares that tracing takes of it would lose the lens in rounding.
constexpr double largest_length_mm = 1e6;
constexpr double smallest_radius_mm = 1e-6;
constexpr double largest_index = 10.0;
constexpr double largest_layer_index = 1000.0;
constexpr double largest_conic = 1e9;
constexpr std::size_t most_surfaces = 1000;
constexpr std::size_t most_aspheric_terms = 20;

[[noreturn]] void refuse(const std::string& where, std::string_view problem, std::string found,
                         std::string_view expected) {
    throw Error({.problem = std::string(problem),
                 .file = {},
                 .where = where,
                 .found = std::move(found),
                 .expected = std::string(expected)});
}

void require(bool fine, const std::string& where, double value, std::string_view problem,
             std::string_view expected) {
    if (!fine) refuse(where, problem, fmt::format("{}", value), expected);
}

// Every comparison is written so that NaN fails it.
void require_finite(const std::string& where, double value) {
    require(std::isfinite(value), where, value, "not a finite number", "a finite number");
}
void require_length(const std::string& where, double value_mm) {
    require(value_mm > 0.0 && value_mm <= largest_length_mm, where, value_mm, "not a usable length",
            "a length above 0 and up to 1e6 mm");
}
void require_thickness(const std::string& where, double value_mm) {
    require(value_mm >= 0.0 && value_mm <= largest_length_mm, where, value_mm,
            "not a usable thickness", "0 to 1e6 mm (mirrors are not supported)");
}
void require_f_number(const std::string& where, double value) {
    require(value > 0.0 && value <= 1e6, where, value, "not a usable f-number",
            "an f-number above 0");
}

struct CheckCurve {
    const std::string& where;
    void operator()(const Plane&) const {}
    void operator()(const Radius& radius) const {
        require(std::isfinite(radius.mm) && std::abs(radius.mm) >= smallest_radius_mm,
                where + ".radius_mm", radius.mm, "not a usable radius",
                "a radius other than 0, or none for a plane");
    }
    void operator()(const Curvature& curvature) const {
        require(std::abs(curvature.per_mm) <= 1.0 / smallest_radius_mm, where + ".curvature_per_mm",
                curvature.per_mm, "not a usable curvature", "a finite curvature (0 is a plane)");
    }
};

struct CheckDispersion {
    const std::string& where;
    double smallest_index;

    void operator()(const ConstantIndex& glass) const { index(where + ".index", glass.n); }
    void operator()(const ModelGlass& glass) const {
        index(where + ".model.nd", glass.nd);
        require(glass.vd > 0.0 && std::isfinite(glass.vd), where + ".model.vd", glass.vd,
                "not a usable Abbe number", "an Abbe number above 0");
    }
    void operator()(const FormulaGlass& glass) const {
        closed_form(where + ".formula", glass, last_formula);
    }
    void operator()(const AgfGlass& glass) const {
        closed_form(where + ".agf", glass, last_agf_formula);
    }
    void operator()(const TabulatedGlass& glass) const {
        if (!has_rising_wavelengths(glass.index))
            refuse(where + ".table.nm", "not a usable table of indices",
                   fmt::format("{} entries", glass.index.size()),
                   "at least one entry, wavelengths above 0 and rising");
        // Metals, as layers, go below 1 and beyond what glasses have.
        const double largest = smallest_index > 0.0 ? largest_index : largest_layer_index;
        for (const SpectralValue& entry : glass.index)
            require(
                entry.value >= smallest_index && entry.value > 0.0 && entry.value <= largest,
                where + ".table.n", entry.value, "not a usable index",
                smallest_index > 0.0 ? "an index from 1 to 10" : "an index above 0, up to 1000");
    }
    template <class Glass>
    void closed_form(const std::string& field, const Glass& glass, int last) const {
        if (glass.formula < 1 || glass.formula > last)
            refuse(field + ".number", "not a known dispersion formula",
                   fmt::format("{}", glass.formula), fmt::format("1 to {}", last));
        if (glass.coefficients.empty())
            refuse(field + ".coefficients", "no coefficients", "none", "at least one");
        for (const double c : glass.coefficients) require_finite(field + ".coefficients", c);
        require_finite(field + ".range_nm", glass.min_nm);
        require(!std::isnan(glass.max_nm), field + ".range_nm", glass.max_nm, "not a number",
                "a wavelength in nm");
    }
    // It can be opened and mended, though not traced: refractive_index() says so.
    void operator()(const UnknownGlass&) const {}
    void index(const std::string& field, double n) const {
        require(n >= smallest_index && n > 0.0 && n <= largest_index, field, n,
                "not a usable index",
                smallest_index > 0.0 ? "an index from 1 to 10" : "an index above 0, up to 10");
    }
};

void check_medium(const Medium& medium, const std::string& where, double smallest_index) {
    std::visit(CheckDispersion{where, smallest_index}, medium.dispersion);
    for (const InternalTransmittance& at : medium.transmittance)
        require(at.wavelength_nm > 0.0 && at.share >= 0.0 && at.share <= 1.0 &&
                    at.thickness_mm > 0.0 &&
                    std::isfinite(at.wavelength_nm + at.share + at.thickness_mm),
                where + ".transmittance", at.share, "not a usable transmittance",
                "[nm, share from 0 to 1, mm], wavelength and thickness above 0");
}

struct CheckCoating {
    const std::string& where;

    void operator()(const Uncoated&) const {}
    void operator()(const QuarterWave& coating) const {
        const std::string field = where + ".quarter_wave";
        require(coating.center_nm > 0.0 && std::isfinite(coating.center_nm), field + ".center_nm",
                coating.center_nm, "not a usable wavelength", "a wavelength above 0 nm");
        require(coating.thickness_factor >= 0.0 && std::isfinite(coating.thickness_factor),
                field + ".thickness_factor", coating.thickness_factor,
                "not a usable thickness factor", "0 or more (1 = nominal)");
        if (const auto* medium = std::get_if<Medium>(&coating.layer))
            check_medium(*medium, field + ".layer", 0.0);
    }
    void operator()(const LayerStack& stack) const {
        for (std::size_t i = 0; i < stack.layers.size(); ++i) {
            const Layer& layer = stack.layers[i];
            const std::string field = fmt::format("{}.layers[{}]", where, i + 1);
            check_medium(layer.medium, field, 0.0);
            require(layer.thickness_nm >= 0.0 && std::isfinite(layer.thickness_nm),
                    field + ".thickness_nm", layer.thickness_nm, "not a usable thickness",
                    "0 nm or more");
            require(layer.extinction >= 0.0 && std::isfinite(layer.extinction), field + ".k",
                    layer.extinction, "not a usable extinction", "0 or more (0 = clear)");
            if (!layer.extinction_table.empty() && !has_rising_wavelengths(layer.extinction_table))
                refuse(field + ".k.nm", "not a usable table of extinctions",
                       fmt::format("{} entries", layer.extinction_table.size()),
                       "wavelengths above 0 and rising");
            for (const SpectralValue& entry : layer.extinction_table)
                require(entry.value >= 0.0 && std::isfinite(entry.value), field + ".k.k",
                        entry.value, "not a usable extinction", "0 or more (0 = clear)");
        }
    }
    void operator()(const MeasuredReflectance& table) const {
        const std::string field = where + ".measured";
        check_axis(table.wavelengths_nm, field + ".nm", 1e-9, 1e9, "wavelengths above 0, rising");
        check_axis(table.angles_deg, field + ".angles_deg", 0.0, 90.0,
                   "angles from 0 to 90 degrees, rising");
        if (table.shares.size() != table.wavelengths_nm.size() * table.angles_deg.size())
            refuse(field, "the table is not complete", fmt::format("{}", table.shares.size()),
                   "a value for every wavelength and angle");
        for (const MeasuredShares& at : table.shares) {
            check_shares(field, at.r_s, at.t_s);
            check_shares(field, at.r_p, at.t_p);
        }
    }
    void operator()(const ConstantReflectance& fixed) const {
        check_shares(where + ".constant", fixed.reflectance, fixed.transmittance);
    }
    void check_axis(const std::vector<double>& values, const std::string& field, double least,
                    double most, std::string_view expected) const {
        if (values.empty()) refuse(field, "no values", "none", expected);
        double before = -1.0;
        for (const double value : values) {
            require(value > before && value >= least && value <= most, field, value,
                    "not a usable value", expected);
            before = value;
        }
    }
    void check_shares(const std::string& field, double r, double t) const {
        // Energy to within what tables are printed with.
        require(r >= 0.0 && t >= 0.0 && r + t <= 1.0 + 1e-6, field, r + t,
                "not a usable reflectance and transmittance", "R ≥ 0, T ≥ 0, R + T ≤ 1");
    }
};

struct CheckReflectance {
    std::string where = "sensor.reflectance";

    void share(const std::string& field, double value) const {
        require(value >= 0.0 && value <= 1.0, field, value, "not a usable reflectance",
                "a share from 0 to 1");
    }
    void operator()(const UniformReflectance& uniform) const { share(where, uniform.share); }
    void operator()(const ReflectanceTable& table) const {
        if (table.entries.empty())
            refuse(where + ".table", "no entries", "none", "at least one [nm, share]");
        double before = 0.0;
        for (std::size_t i = 0; i < table.entries.size(); ++i) {
            const ReflectanceAt& at = table.entries[i];
            const std::string field = fmt::format("{}.table[{}]", where, i + 1);
            require(at.wavelength_nm > before && std::isfinite(at.wavelength_nm), field,
                    at.wavelength_nm, "not a usable wavelength", "wavelengths in nm that rise");
            share(field, at.share);
            before = at.wavelength_nm;
        }
    }
    void operator()(const SensorFilms& films) const {
        CheckCoating{where}(films.stack);
        check_medium(films.substrate, where + ".substrate", 0.0);
    }
};

void check_surface(const Surface& surface, const std::string& where) {
    std::visit(CheckCurve{where}, surface.curve);
    require(std::abs(surface.conic) <= largest_conic, where + ".conic", surface.conic,
            "not a usable conic constant", "a finite number (0 = sphere)");
    if (surface.aspheric.size() > most_aspheric_terms)
        refuse(where + ".aspheric", "too many terms", fmt::format("{}", surface.aspheric.size()),
               "at most 20 (A4 to A42)");
    for (const double term : surface.aspheric) require_finite(where + ".aspheric", term);
    require_thickness(where + ".thickness_mm", surface.thickness_mm);
    check_medium(surface.medium_after, where, 1.0);
    require_length(where + ".semi_diameter_mm", surface.semi_diameter_mm);
    std::visit(CheckCoating{where + ".coating"}, surface.coating);
}

void check_dirt(const StopDirt& dirt) {
    constexpr double most_coverage = 0.5;  // beyond this specks lie on specks, and it is no dust
    constexpr int most_scratches = 10'000;
    require(dirt.dust_coverage >= 0.0 && dirt.dust_coverage <= most_coverage,
            "stop.dirt.dust_coverage", dirt.dust_coverage, "not a usable coverage",
            "a share of the stop from 0 to 0.5");
    require_length("stop.dirt.dust_smallest_mm", dirt.dust_smallest_mm);
    require_length("stop.dirt.dust_largest_mm", dirt.dust_largest_mm);
    require(dirt.dust_smallest_mm <= dirt.dust_largest_mm, "stop.dirt.dust_smallest_mm",
            dirt.dust_smallest_mm, "the smallest speck is larger than the largest",
            fmt::format("at most {} mm", dirt.dust_largest_mm));
    if (dirt.scratches < 0 || dirt.scratches > most_scratches)
        refuse("stop.dirt.scratches", "not a usable number of scratches",
               fmt::format("{}", dirt.scratches), "0 to 10000");
    require_length("stop.dirt.scratch_thinnest_mm", dirt.scratch_thinnest_mm);
    require_length("stop.dirt.scratch_widest_mm", dirt.scratch_widest_mm);
    require(dirt.scratch_thinnest_mm <= dirt.scratch_widest_mm, "stop.dirt.scratch_thinnest_mm",
            dirt.scratch_thinnest_mm, "the thinnest scratch is wider than the widest",
            fmt::format("at most {} mm", dirt.scratch_widest_mm));
    require(dirt.fingerprint >= 0.0 && dirt.fingerprint <= 1.0, "stop.dirt.fingerprint",
            dirt.fingerprint, "not a usable share", "0 to 1");
}

void check_stop(const Stop& stop, std::size_t surfaces) {
    if (stop.surface >= surfaces)
        refuse("stop.surface", "the stop's row does not exist", fmt::format("{}", stop.surface + 1),
               fmt::format("a row from 1 to {}", surfaces));
    if (stop.f_number) require_f_number("stop.f_number", *stop.f_number);
    if (stop.semi_diameter_mm) require_length("stop.semi_diameter_mm", *stop.semi_diameter_mm);
    if (stop.blades < 0 || stop.blades == 1 || stop.blades == 2 || stop.blades > 1000)
        refuse("stop.blades", "not a usable number of blades", fmt::format("{}", stop.blades),
               "0 (round), or 3 to 1000");
    require_finite("stop.rotation_deg", stop.rotation_deg);
    require(stop.blade_curvature >= 0.0 && stop.blade_curvature <= 1.0, "stop.blade_curvature",
            stop.blade_curvature, "not a usable blade curvature",
            "0 (straight edges) to 1 (round)");
    if (stop.image && stop.image->picture->mean_over_circle() <= 0.0)
        refuse("stop.image", "the image lets no light through the stop",
               fmt::format("'{}'", stop.image->file),
               "an image that is white somewhere within the circle that fits it");
    check_dirt(stop.dirt);
}

void check_configurations(const Prescription& lens) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < lens.configurations.size(); ++i) {
        const Configuration& each = lens.configurations[i];
        const std::string where = fmt::format("configurations[{}]", i + 1);
        if (each.name.empty())
            refuse(where + ".name", "a configuration without a name", "an empty name",
                   "a name such as 'wide'");
        if (!names.insert(each.name).second)
            refuse(where + ".name", "two configurations have the same name",
                   fmt::format("'{}'", each.name), "a name of its own for each");
        for (const auto& [row, thickness_mm] : each.thickness_mm) {
            if (row >= lens.surfaces.size())
                refuse(where + ".thickness_mm", "the row does not exist",
                       fmt::format("{}", row + 1),
                       fmt::format("a row from 1 to {}", lens.surfaces.size()));
            require_thickness(fmt::format("{}.thickness_mm.{}", where, row + 1), thickness_mm);
        }
        if (each.f_number) require_f_number(where + ".f_number", *each.f_number);
        if (each.stop_semi_diameter_mm)
            require_length(where + ".stop_semi_diameter_mm", *each.stop_semi_diameter_mm);
    }
}

}  // namespace

void validate(const Prescription& lens) {
    if (lens.surfaces.empty())
        refuse("surfaces", "the lens has no surfaces", "none", "at least one surface");
    if (lens.surfaces.size() > most_surfaces)
        refuse("surfaces", "the lens has too many surfaces",
               fmt::format("{}", lens.surfaces.size()), "at most 1000");
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
        check_surface(lens.surfaces[row], fmt::format("surfaces[{}]", row + 1));
    check_stop(lens.stop, lens.surfaces.size());
    require_length("sensor.width_mm", lens.sensor.width_mm);
    require_length("sensor.height_mm", lens.sensor.height_mm);
    if (lens.sensor.reflectance) std::visit(CheckReflectance{}, *lens.sensor.reflectance);
    check_configurations(lens);
}

}  // namespace ghostlight
