#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/io/coating_dat.h"
#include "core/io/import_notes.h"
#include "core/io/imported_fields.h"
#include "core/io/imported_glass.h"
#include "core/io/json_value.h"
#include "core/io/text_lines.h"
#include "core/io/zmx.h"
#include "core/io/zmx_records.h"
#include "core/io/zmx_surface.h"
#include "core/units.h"

namespace ghostlight {
namespace {

struct Unit {
    std::string_view word;
    double mm;
};
constexpr std::array units = {Unit{"MM", 1.0},     Unit{"CM", 10.0},   Unit{"IN", 25.4},
                              Unit{"FT", 304.8},   Unit{"METER", 1e3}, Unit{"M", 1e3},
                              Unit{"METERS", 1e3}, Unit{"INCH", 25.4}, Unit{"INCHES", 25.4}};

/// What programs write for infinity begins here, mm.
constexpr double far_away_mm = 1e8;

/// A wavelength as the file's decimals have it: 0.5875618 µm is 587.5618 nm, without the binary
/// remainder of the conversion.
double whole_digits(double nm) { return std::round(nm * 1e9) / 1e9; }

class ZmxImport {
   public:
    explicit ZmxImport(const FormatSource& source) : file_(source.file.string()) {
        zmx_ = zmx_records(source.text, file_, imported_.notes);
    }

    ImportedLens run() {
        check_mode();
        if (zmx_.surfaces.size() < 3)
            Place{file_, {}}.refuse("no lens: there is no surface between object and image",
                                    fmt::format("{} surfaces", zmx_.surfaces.size()),
                                    "SURF 0 (object), at least SURF 1, and the image");
        read_unit();
        imported_.lens.name = clipped(zmx_.name, 300);
        for (const std::string& note : zmx_.notes)
            imported_.lens.notes += (imported_.lens.notes.empty() ? "" : "\n") + note;
        check_object();
        const std::size_t rows = zmx_.surfaces.size() - 2;
        imported_.lens.surfaces.resize(rows);
        imported_.surfaces.resize(rows);
        read_waves();
        find_last_glass();
        for (std::size_t row = 0; row < rows; ++row) read_diameter(row);
        for (std::size_t row = 0; row < rows; ++row) read_row(row);
        read_stop();
        read_image_distance();
        read_environment();
        read_aperture();
        read_configurations();
        read_fields();
        report_automatic_sizes();
        note_read(
            imported_.notes, {},
            fmt::format("{} surfaces between object and image, numbered as in the file", rows));
        return std::move(imported_);
    }

   private:
    const ZmxSurface& surface(std::size_t row) const { return zmx_.surfaces[row + 1]; }
    const ZmxSurface& image() const { return zmx_.surfaces.back(); }
    Notes& notes() { return imported_.notes; }

    void check_mode() {
        if (!zmx_.mode.starts_with("SEQ"))
            Place{file_, zmx_.mode_where}.refuse(
                "a non-sequential file cannot be read", "MODE " + in_quotes(zmx_.mode),
                "MODE SEQ: surfaces in the order in which light meets them");
    }

    void read_unit() {
        const auto unit = std::ranges::find(units, zmx_.unit, &Unit::word);
        if (unit == units.end())
            Place{file_, zmx_.unit_where}.refuse("not a known unit", in_quotes(zmx_.unit),
                                                 "MM, CM, IN, FT or METER");
        mm_ = unit->mm;
        if (mm_ != 1.0)
            note_converted(notes(), zmx_.unit_where,
                           fmt::format("lengths in {}: times {} to mm", zmx_.unit, mm_));
    }

    void check_object() {
        const ZmxSurface& object = zmx_.surfaces.front();
        object_distance_mm_ = object.thickness * mm_;
        is_far_ = object.infinite || std::abs(object_distance_mm_) >= far_away_mm;
        if (!is_far_)
            note_noticed(notes(), object.where,
                         fmt::format("the object is {} mm in front of the first surface",
                                     format_number(object_distance_mm_)),
                         true,
                         "lights are infinitely far here; the sensor stays where the file "
                         "focuses");
        if (object.glass)
            note_left_out(notes(), object.glass->where,
                          "a medium in front of the lens: light comes through air here", true);
    }

    void find_last_glass() {
        for (std::size_t row = 0; row < imported_.lens.surfaces.size(); ++row)
            if (surface(row).glass || (surface(row).curvature != 0.0)) last_lens_row_ = row;
    }

    void read_row(std::size_t row) {
        const ZmxSurface& from = surface(row);
        Surface& made = imported_.lens.surfaces[row];
        imported_.surfaces[row].where = from.where;
        if (from.infinite && row + 1 < imported_.lens.surfaces.size())
            Place{file_, from.where}.refuse("an infinite thickness inside the lens", "INFINITY",
                                            "a thickness");
        made.thickness_mm = from.infinite ? 0.0 : from.thickness * mm_;
        made.comment = clipped(from.comment, 300);
        if (from.glass) made.medium_after = medium(*from.glass, row);
        set_zmx_shape(imported_, row, from, mm_, row < last_lens_row_, file_);
        if (!from.coating.empty()) made.coating = coating(from, row);
    }

    /// By name: of the lens's coating file, else of the coating library.
    Coating coating(const ZmxSurface& from, std::size_t row) {
        const std::string label =
            fmt::format("surface {}: coating {}", row + 1, in_quotes(from.coating));
        std::string why = "neither the coating library nor a coating file beside the lens has it";
        try {
            if (auto found = resolve_coating(from.coating, coating_file(),
                                             primary_nm_.value_or(d_line_nm))) {
                note_read(notes(), from.coating_where, label + ": " + found->origin);
                for (Note& each : found->notes) {
                    if (each.where.empty()) each.where = from.coating_where;
                    notes().push_back(std::move(each));
                }
                return std::move(found->coating);
            }
        } catch (const Error& error) {
            why = error.what();
        }
        note_left_out(notes(), from.coating_where,
                      fmt::format("{}: taken as uncoated ({})", label, why), true,
                      fmt::format("choose the coating, or put {} beside the lens",
                                  zmx_.coating_file.empty() ? "COATING.DAT" : zmx_.coating_file));
        return Uncoated{};
    }

    /// Read once; null when there is none.
    const CoatingFile* coating_file() {
        if (!looked_for_coatings_) {
            looked_for_coatings_ = true;
            const std::string name = zmx_.coating_file.empty() ? "COATING.DAT" : zmx_.coating_file;
            if (const auto found = find_coating_file(file_, name))
                coating_file_ = read_coating_file(*found);
        }
        return coating_file_ ? &*coating_file_ : nullptr;
    }

    Medium medium(const ZmxGlass& glass, std::size_t row) {
        if (is_same_name(glass.name, "MIRROR"))
            Place{file_, glass.where}.refuse("a mirror: lenses with mirrors cannot be traced here",
                                             fmt::format("surface {} is a MIRROR", row + 1),
                                             "refracting surfaces");
        if (glass.kind == 2) return picked_up(glass, row);
        if (glass.dpgf.value_or(0.0) != 0.0 && glass.kind == 1)
            note_left_out(notes(), glass.where,
                          "the model glass's deviation of partial dispersion (dPgF)");
        const bool is_model = glass.kind == 1 || glass.name.starts_with("___BLANK");
        if (is_model && glass.nd && *glass.nd > 0.0) {
            const std::string label = glass.name.starts_with("___") ? "" : glass.name;
            if (!(*glass.nd >= 1.0 && *glass.nd <= 10.0))
                Place{file_, glass.where}.refuse("not a usable index", fmt::format("{}", *glass.nd),
                                                 "an index from 1 to 10");
            note_read(notes(), glass.where,
                      fmt::format("model glass, nd {}, Vd {}", format_number(*glass.nd),
                                  format_number(glass.vd.value_or(0.0))));
            return numbered_glass(label, *glass.nd, glass.vd, glass.where, notes());
        }
        if (glass.kind > 2)
            note_noticed(notes(), glass.where,
                         fmt::format("the glass has a solve of kind {} (substitution or offset), "
                                     "which is not worked out: the glass is used as it is named",
                                     glass.kind),
                         true);
        return resolve_glass(
            {clipped(glass.name, 60), zmx_.catalogs, glass.nd, glass.vd, glass.where}, notes());
    }

    Medium picked_up(const ZmxGlass& glass, std::size_t row) {
        const int from = glass.pickup_from;
        if (from < 1 || from > static_cast<int>(row))
            Place{file_, glass.where}.refuse(
                "the glass is picked up from a surface that is not before this one",
                fmt::format("surface {}", from), fmt::format("a surface from 1 to {}", row));
        note_read(notes(), glass.where, fmt::format("the glass of surface {} (pick-up)", from));
        return imported_.lens.surfaces[static_cast<std::size_t>(from) - 1].medium_after;
    }

    /// The rim: a circular aperture, else the user's semi-diameter, else the program's own.
    void read_diameter(std::size_t row) {
        const ZmxSurface& from = surface(row);
        auto& semi = imported_.surfaces[row].semi_diameter_mm;
        const bool glass_on_a_side = from.glass || zmx_.surfaces[row].glass;
        if (from.diameter && from.diameter->semi > 0.0) {
            const bool own = from.diameter->by_user ||
                             (from.stop && zmx_.aperture == ZmxFile::Aperture::stop_size);
            // The program's own size of the stop follows from the aperture, and that of a plane
            // in the air is no rim.
            if (own || (!from.stop && glass_on_a_side)) {
                semi = from.diameter->semi * mm_;
                if (!own) {
                    imported_.lens.surfaces[row].semi_diameter_sized = true;
                    automatic_ += fmt::format("{}{}", automatic_.empty() ? "" : ", ", row + 1);
                }
            }
        }
        for (const ZmxAperture& aperture : from.apertures) read_opening(row, aperture);
    }

    void read_opening(std::size_t row, const ZmxAperture& aperture) {
        const auto number = [&](std::size_t index) {
            return index < aperture.numbers.size() ? aperture.numbers[index] : 0.0;
        };
        auto& semi = imported_.surfaces[row].semi_diameter_mm;
        const std::string surface_text = fmt::format("surface {}", row + 1);
        if (aperture.word == "CLAP" || aperture.word == "FLAP") {
            // A floating aperture is the surface's semi-diameter, whoever gave that.
            const bool floats = aperture.word == "FLAP" && surface(row).diameter;
            if (number(1) > 0.0 && !floats) {
                semi = number(1) * mm_;
                imported_.lens.surfaces[row].semi_diameter_sized = false;
                if (aperture.word == "CLAP")
                    note_read(notes(), aperture.where,
                              fmt::format("{}: circular aperture, {} mm", surface_text,
                                          format_number(*semi)));
            }
            if (number(0) > 0.0)
                note_left_out(notes(), aperture.where,
                              surface_text + ": the opening's central obstruction", true);
        } else if (aperture.word == "SQAP" || aperture.word == "ELAP") {
            const double half = std::hypot(number(0), number(1)) * mm_;
            const double round =
                aperture.word == "SQAP" ? half : std::max(number(0), number(1)) * mm_;
            if (!semi && round > 0.0) semi = round;
            note_left_out(
                notes(), aperture.where,
                fmt::format("{}: {} opening of half widths {} and {} mm: the clear edge "
                            "is round here",
                            surface_text,
                            aperture.word == "SQAP" ? "a rectangular" : "an elliptical",
                            format_number(number(0) * mm_), format_number(number(1) * mm_)),
                true);
        } else if (aperture.word == "OBDC") {
            if (number(0) != 0.0 || number(1) != 0.0)
                note_left_out(
                    notes(), aperture.where,
                    fmt::format("{}: the opening is decentred by {}, {} mm", surface_text,
                                format_number(number(0) * mm_), format_number(number(1) * mm_)),
                    true);
        } else {
            note_left_out(notes(), aperture.where,
                          fmt::format("{}: {} ({})", surface_text,
                                      aperture.word == "UDAD" ? "an opening drawn by the user"
                                                              : "an obstruction",
                                      aperture.word),
                          true);
        }
    }

    void report_automatic_sizes() {
        if (automatic_.empty()) return;
        note_noticed(notes(), {},
                     "the semi-diameters of surfaces " + automatic_ +
                         " are the program's own, from the rays of the file's fields: they are "
                         "marked as sized",
                     true, "put in the real rims: they cut ghosts");
    }

    void read_stop() {
        for (std::size_t i = 0; i < zmx_.surfaces.size(); ++i) {
            if (!zmx_.surfaces[i].stop) continue;
            if (i == 0 || i + 1 == zmx_.surfaces.size())
                note_noticed(notes(), zmx_.surfaces[i].where,
                             "the stop is on the object or the image: not used", true);
            else if (imported_.stop)
                note_noticed(notes(), zmx_.surfaces[i].where, "a second stop: the first is used",
                             true);
            else
                imported_.stop = i - 1;
        }
    }

    void read_image_distance() {
        const ZmxSurface& last = surface(imported_.lens.surfaces.size() - 1);
        if (last.infinite) return;
        imported_.sensor_distance_mm = last.thickness * mm_;
        // Kept at the focus by a solve. At another wavelength the stored number says it better.
        constexpr double same_wavelength_nm = 0.5;
        if (last.at_paraxial_focus && primary_nm_ &&
            std::abs(*primary_nm_ - d_line_nm) < same_wavelength_nm) {
            imported_.sensor_distance_mm.reset();
            note_read(notes(), last.where,
                      fmt::format("a solve keeps the image at the paraxial focus, {} mm behind the "
                                  "last surface in the file",
                                  format_number(last.thickness * mm_)));
        }
        read_sensor();
        if (image().curvature != 0.0)
            note_left_out(notes(), image().where, "the image surface is curved: the sensor is flat",
                          true);
        if (zmx_.afocal)
            note_noticed(notes(), zmx_.fields_where, "the file is afocal in image space", true,
                         "set the sensor's distance");
    }

    /// A rectangular aperture of the image is the sensor's.
    void read_sensor() {
        for (const ZmxAperture& aperture : image().apertures) {
            if (aperture.word != "SQAP" || aperture.numbers.size() < 2 ||
                !(aperture.numbers[0] > 0.0) || !(aperture.numbers[1] > 0.0))
                continue;
            imported_.lens.sensor.width_mm = 2.0 * aperture.numbers[0] * mm_;
            imported_.lens.sensor.height_mm = 2.0 * aperture.numbers[1] * mm_;
            imported_.has_sensor_size = true;
            note_read(notes(), aperture.where,
                      fmt::format("sensor {} x {} mm, the image's rectangular aperture",
                                  format_number(imported_.lens.sensor.width_mm),
                                  format_number(imported_.lens.sensor.height_mm)));
        }
    }

    void read_environment() {
        if (zmx_.environment_where.empty()) return;
        if (zmx_.temperature_c != 20.0 || zmx_.pressure_atm != 1.0)
            note_left_out(notes(), zmx_.environment_where,
                          fmt::format("{} degrees C and {} atm: indices are those at 20 degrees C "
                                      "and 1 atm",
                                      zmx_.temperature_c, zmx_.pressure_atm));
    }

    void read_waves() {
        std::string list;
        std::size_t count = 0;
        for (const auto& [number, um] : zmx_.waves_um) {
            if (number < 1 ||
                (zmx_.wave_count && static_cast<std::size_t>(number) > *zmx_.wave_count))
                continue;
            if (++count > 24) break;
            list += fmt::format("{}{:.6g}", list.empty() ? "" : ", ", nm_from_um(um));
            if (zmx_.primary_wave == number) primary_nm_ = whole_digits(nm_from_um(um));
        }
        if (list.empty()) return;
        note_left_out(
            notes(), {},
            fmt::format(
                "wavelengths {} nm{}: lights choose their own here", list,
                primary_nm_ ? fmt::format(", of which {:.6g} is primary", *primary_nm_) : ""));
    }

    void read_aperture() {
        const double value = zmx_.aperture_value;
        const std::string& where = zmx_.aperture_where;
        using Aperture = ZmxFile::Aperture;
        if (zmx_.aperture != Aperture::none && zmx_.aperture != Aperture::stop_size &&
            !(value > 0.0)) {
            note_noticed(notes(), where, fmt::format("the aperture is {}: not used", value), true);
            return;
        }
        switch (zmx_.aperture) {
            case Aperture::none:
            case Aperture::stop_size:
                break;
            case Aperture::entrance_pupil:
                imported_.entrance_pupil_diameter_mm = value * mm_;
                note_read(notes(), where,
                          fmt::format("entrance pupil diameter {} mm", format_number(value * mm_)));
                break;
            case Aperture::f_number:
                imported_.f_number = value;
                if (zmx_.aperture_flag == 1 && !is_far_)
                    note_converted(notes(), where,
                                   fmt::format("working f-number {} at the file's finite distance: "
                                               "taken as that at infinity",
                                               format_number(value)),
                                   true, "set the stop's size if it is known");
                else
                    note_read(notes(), where, fmt::format("f-number {}", format_number(value)));
                break;
            case Aperture::object_na: {
                const auto first = first_order_so_far(imported_);
                const double na = zmx_.aperture_flag == 1 ? std::sin(rad_from_deg(value)) : value;
                if (is_far_ || !first || !(na < 1.0)) {
                    note_left_out(notes(), where,
                                  fmt::format("object-side aperture {} has no meaning here", value),
                                  true, "set the f-number or the stop's size");
                    break;
                }
                const double to_pupil = object_distance_mm_ + first->entrance_pupil_z_mm;
                imported_.entrance_pupil_diameter_mm =
                    2.0 * std::abs(to_pupil) * std::tan(std::asin(na));
                note_converted(
                    notes(), where,
                    fmt::format("object-side NA {:.6g}: an entrance pupil {:.6g} mm wide", na,
                                *imported_.entrance_pupil_diameter_mm),
                    true);
            }
        }
    }

    void read_configurations() {
        if (zmx_.configurations <= 1) return;
        std::map<int, Configuration> made;
        std::map<int, double> pupils;
        std::map<std::string, std::string> left_out;
        for (const ZmxOperand& each : zmx_.operands) {
            if (each.configuration < 1 || each.configuration > zmx_.configurations) continue;
            Configuration& configuration = made[each.configuration];
            const auto rows = static_cast<int>(imported_.lens.surfaces.size());
            if (each.word == "LTTL") {
                configuration.name = clipped(each.text, 60);
            } else if (each.word == "THIC" && each.value && each.target >= 1 &&
                       each.target <= rows) {
                configuration.thickness_mm[static_cast<std::size_t>(each.target) - 1] =
                    *each.value * mm_;
            } else if (each.word == "APER" && each.value && *each.value > 0.0 &&
                       zmx_.aperture == ZmxFile::Aperture::f_number) {
                configuration.f_number = *each.value;
            } else if (each.word == "APER" && each.value && *each.value > 0.0 &&
                       zmx_.aperture == ZmxFile::Aperture::entrance_pupil) {
                pupils[each.configuration] = *each.value * mm_;
            } else if (each.word != "MOFF") {
                left_out.emplace(each.word, each.where);
            }
        }
        std::set<std::string> names;
        for (int number = 1; number <= zmx_.configurations; ++number) {
            Configuration& configuration = made[number];
            if (configuration.name.empty() || names.contains(configuration.name))
                configuration.name = fmt::format("configuration {}", number);
            names.insert(configuration.name);
            if (pupils.contains(number))
                imported_.configuration_pupils_mm[configuration.name] = pupils[number];
            solve_thicknesses(configuration);
            imported_.lens.configurations.push_back(configuration);
        }
        note_read(notes(), {},
                  fmt::format("{} configurations; the rows hold number {}", zmx_.configurations,
                              zmx_.active));
        for (const auto& [word, where] : left_out) {
            const bool of_rays = word.starts_with("FV") || word == "YFIE" || word == "XFIE" ||
                                 word.starts_with("WAV") || word.starts_with("WLW") ||
                                 word == "FLWT" || word == "PRWV" || word == "FTYP";
            note_left_out(notes(), where,
                          fmt::format("{} changes with the configuration", in_quotes(word)),
                          !of_rays);
        }
    }

    double thickness_in(const Configuration& configuration, int number) const {
        if (number < 1 || number > static_cast<int>(imported_.lens.surfaces.size())) return 0.0;
        const auto row = static_cast<std::size_t>(number) - 1;
        const auto found = configuration.thickness_mm.find(row);
        return found != configuration.thickness_mm.end() ? found->second
               : surface(row).infinite                   ? 0.0
                                                         : surface(row).thickness * mm_;
    }

    /// Thicknesses that the program keeps by solves: a sum of two (TCOM), a sum of a range (TOLE).
    void solve_thicknesses(Configuration& configuration) {
        for (std::size_t row = 0; row < imported_.lens.surfaces.size(); ++row) {
            if (configuration.thickness_mm.contains(row)) continue;
            const ZmxSurface& from = surface(row);
            const auto number = static_cast<int>(row) + 1;
            double solved = 0.0;
            if (from.complement) {
                solved = from.complement->second * mm_ -
                         thickness_in(configuration, from.complement->first);
            } else if (from.position) {
                solved = from.position->second * mm_;
                for (int i = std::max(from.position->first, 1); i < number; ++i)
                    solved -= thickness_in(configuration, i);
            } else {
                continue;
            }
            configuration.thickness_mm[row] = solved;
            if (configuration.name == "configuration 1" || !solve_said_) {
                note_converted(notes(), from.where,
                               fmt::format("the thickness of surface {} follows the others by a "
                                           "solve: worked out for each configuration",
                                           number),
                               true);
                solve_said_ = true;
            }
        }
    }

    void read_fields() {
        const std::size_t listed = std::max(zmx_.x_fields.size(), zmx_.y_fields.size());
        const std::size_t count = std::min(zmx_.field_count.value_or(listed), listed);
        const auto entry = [](const std::vector<double>& all, std::size_t i) {
            return i < all.size() ? all[i] : 0.0;
        };
        using Kind = ListedFields::Kind;
        ListedFields fields;
        fields.kind = zmx_.field_type == 1                           ? Kind::object_height_mm
                      : zmx_.field_type == 2 || zmx_.field_type == 3 ? Kind::image_height_mm
                                                                     : Kind::angle_deg;
        fields.where = zmx_.fields_where;
        const double scale = fields.kind == Kind::angle_deg ? 1.0 : mm_;
        for (std::size_t i = 0; i < count; ++i) {
            fields.x.push_back(scale * entry(zmx_.x_fields, i));
            fields.y.push_back(scale * entry(zmx_.y_fields, i));
            // An ellipse, decentred and compressed.
            fields.cut_upper.push_back(entry(zmx_.vcy, i) - entry(zmx_.vdy, i));
            fields.cut_lower.push_back(entry(zmx_.vcy, i) + entry(zmx_.vdy, i));
            fields.cut_sides.push_back(entry(zmx_.vcx, i));
        }
        set_fields(imported_, fields, is_far_ ? std::nullopt : std::optional(object_distance_mm_));
        const bool has_field =
            imported_.half_field_deg.has_value() || imported_.image_height_mm.has_value();
        if (!imported_.image_height_mm && image().diameter && image().diameter->semi > 0.0 &&
            (has_field || image().diameter->by_user)) {
            imported_.image_height_mm = image().diameter->semi * mm_;
            note_read(notes(), image().where,
                      fmt::format("the image reaches {} mm from the axis",
                                  format_number(*imported_.image_height_mm)));
        }
    }

    std::string file_;
    ZmxFile zmx_;
    ImportedLens imported_;
    double mm_ = 1.0, object_distance_mm_ = 0.0;
    bool is_far_ = true, solve_said_ = false;
    std::size_t last_lens_row_ = 0;
    std::optional<double> primary_nm_;
    std::optional<CoatingFile> coating_file_;
    bool looked_for_coatings_ = false;
    std::string automatic_;
};

}  // namespace

bool is_zmx(std::string_view text) {
    bool surface = false, other = false;
    for (const TextLine& line : text_lines(text.substr(0, 65536))) {
        const auto all = words(line.text);
        if (all.empty()) continue;
        const std::string word = upper_case(all.front());
        surface = surface || (word == "SURF" && all.size() >= 2);
        other = other || word == "CURV" || word == "DISZ" || word == "VERS" || word == "UNIT" ||
                (word == "MODE" && all.size() >= 2);
    }
    return surface && other;
}

ImportedLens import_zmx(const FormatSource& source) { return ZmxImport(source).run(); }

}  // namespace ghostlight
