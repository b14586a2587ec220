#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/import_notes.h"
#include "core/io/imported_asphere.h"
#include "core/io/imported_fields.h"
#include "core/io/json_value.h"
#include "core/io/seq.h"
#include "core/io/seq_commands.h"
#include "core/io/seq_contents.h"
#include "core/io/text_lines.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr double far_away_mm = 1e8;

class SeqLens {
   public:
    explicit SeqLens(SeqContents contents) : read_(std::move(contents)) {}
    ImportedLens finish();

   private:
    Notes& notes() { return read_.imported.notes; }

    bool decide_radius_mode();
    bool is_reference_d_line() const;
    void build_row(std::size_t number);
    void set_aperture(std::optional<double> object_mm);
    void set_zoom();
    void check_displacements();

    SeqContents read_;
};

/// Without RDM the format's default is curvatures, but files of other programs mean radii: what
/// can only be one of them decides, else their size.
bool SeqLens::decide_radius_mode() {
    bool radii_possible = true, curvatures_possible = true, all_small = true, any_large = false;
    std::size_t curved = 0;
    const double pupil = read_.aperture == "EPD" ? 0.5 * read_.aperture_value : 0.0;
    for (std::size_t i = 1; i < read_.rows.size(); ++i) {
        const double value = std::abs(read_.rows[i].first.value_or(0.0));
        if (value == 0.0) continue;
        ++curved;
        const double height = read_.rows[i].semi_diameter.value_or(pupil);
        // No sphere is wider than its radius. 0.7: heights inside the lens are a little smaller
        // than in the pupil.
        if (value < 0.7 * height) radii_possible = false;
        if (1.0 / value < 0.7 * height) curvatures_possible = false;
        all_small = all_small && value < 0.2;
        any_large = any_large || value > 2.0;
    }
    if (curved == 0) return true;
    bool radii = any_large;
    std::string why =
        any_large ? "some are far too large for curvatures" : "which is the format's default";
    if (radii_possible != curvatures_possible) {
        radii = radii_possible;
        why = radii ? "as curvatures the surfaces would be too small for the beam"
                    : "as radii the surfaces would be too small for the beam";
    } else if (all_small) {
        radii = false;
        why = "all are below 0.2";
    }
    note_assumed(notes(), {},
                 fmt::format("the file does not say whether its surfaces are given by radius or "
                             "curvature (RDM): they are taken as {} ({})",
                             radii ? "radii" : "curvatures", why),
                 true,
                 "check the focal length; convert --radii-are-curvatures reads them the other way");
    return radii;
}

bool SeqLens::is_reference_d_line() const {
    constexpr double same_nm = 0.5;
    const double index = read_.reference.value_or(1.0) - 1.0;
    return index >= 0.0 && index < static_cast<double>(read_.wavelengths_nm.size()) &&
           std::abs(read_.wavelengths_nm[static_cast<std::size_t>(index)] - d_line_nm) < same_nm;
}

void SeqLens::build_row(std::size_t number) {
    const SeqSurface& from = read_.rows[number];
    const std::size_t row = number - 1;
    Surface& made = read_.imported.lens.surfaces[row];
    read_.imported.surfaces[row].where = from.where;
    double curvature = from.curvature.value_or(0.0);
    if (!from.curvature && from.first && *from.first != 0.0)
        curvature = *read_.radius_mode ? 1.0 / *from.first : *from.first;
    constexpr double flat_radius = 1e15;  // programs write planes as such radii
    if (curvature != 0.0 && std::abs(curvature) > 1.0 / flat_radius) {
        const bool by_radius = !from.curvature && *read_.radius_mode;
        made.curve = by_radius ? BaseCurve{Radius{*from.first * read_.mm}}
                               : BaseCurve{Curvature{curvature / read_.mm}};
    } else {
        curvature = 0.0;
    }
    made.conic = from.conic;
    made.thickness_mm = from.thickness * read_.mm;
    made.comment = from.label;
    if (!from.glass.empty()) {
        const auto nd = parse_number(from.glass);
        made.medium_after =
            from.glass_vd && nd
                ? seq_glass(fmt::format("{}:{}", from.glass, *from.glass_vd), read_.private_glasses,
                            read_.file, from.glass_where, notes())
                : seq_glass(from.glass, read_.private_glasses, read_.file, from.glass_where,
                            notes());
    }
    RadialSurface radial{curvature / read_.mm, from.conic, {}};
    for (const auto& [power, value] : from.terms)
        if (value != 0.0) radial.terms[power] = value * std::pow(read_.mm, 1 - power);
    if (!radial.terms.empty()) set_asphere(read_.imported, row, radial, {read_.file, from.where});
}

void SeqLens::set_aperture(std::optional<double> object_mm) {
    if (read_.aperture.empty()) return;
    if (!(read_.aperture_value > 0.0)) {
        note_noticed(notes(), read_.aperture_where,
                     fmt::format("{} is {}: not used", read_.aperture, read_.aperture_value), true);
    } else if (read_.aperture == "EPD") {
        read_.imported.entrance_pupil_diameter_mm = read_.aperture_value * read_.mm;
        note_read(notes(), read_.aperture_where,
                  fmt::format("entrance pupil diameter {} mm",
                              format_number(read_.aperture_value * read_.mm)));
    } else if (read_.aperture == "FNO" || read_.aperture == "NA") {
        read_.imported.f_number =
            read_.aperture == "FNO" ? read_.aperture_value : 0.5 / read_.aperture_value;
        const std::string text = fmt::format("f-number {:.6g}", *read_.imported.f_number);
        if (read_.aperture == "NA" || object_mm)
            note_converted(notes(), read_.aperture_where,
                           text + (object_mm ? " at the file's finite distance: taken as that at "
                                               "infinity"
                                             : " from the image-side NA"),
                           object_mm.has_value());
        else
            note_read(notes(), read_.aperture_where, text);
    } else {
        const auto order = first_order_so_far(read_.imported);
        if (!object_mm || !order || !(read_.aperture_value < 1.0)) {
            note_left_out(notes(), read_.aperture_where, "object-side NA has no meaning here", true,
                          "set the f-number or the stop's size");
            return;
        }
        read_.imported.entrance_pupil_diameter_mm =
            2.0 * std::abs(*object_mm + order->entrance_pupil_z_mm) *
            std::tan(std::asin(read_.aperture_value));
        note_converted(notes(), read_.aperture_where,
                       fmt::format("object-side NA {}: an entrance pupil {:.6g} mm wide",
                                   format_number(read_.aperture_value),
                                   *read_.imported.entrance_pupil_diameter_mm),
                       true);
    }
}

void SeqLens::set_zoom() {
    if (read_.positions > 1) {
        const std::size_t count = read_.imported.lens.surfaces.size();
        std::set<std::string> names;
        for (std::size_t zoom = 1; zoom <= read_.positions; ++zoom) {
            Configuration made;
            const auto name = read_.zoom_names.find(zoom);
            if (name != read_.zoom_names.end()) made.name = name->second;
            if (made.name.empty() || names.contains(made.name))
                made.name = fmt::format("zoom {}", zoom);
            names.insert(made.name);
            for (const auto& [surface, values] : read_.zoom_thickness)
                if (const auto value = values.find(zoom);
                    value != values.end() && surface >= 1 && surface <= count)
                    made.thickness_mm[surface - 1] = value->second * read_.mm;
            if (const auto f = read_.zoom_f_number.find(zoom);
                f != read_.zoom_f_number.end() && f->second > 0.0)
                made.f_number = f->second;
            if (const auto pupil = read_.zoom_pupil.find(zoom);
                pupil != read_.zoom_pupil.end() && pupil->second > 0.0)
                read_.imported.configuration_pupils_mm[made.name] = pupil->second * read_.mm;
            read_.imported.lens.configurations.push_back(std::move(made));
        }
        note_read(notes(), {}, fmt::format("{} zoom positions", read_.positions));
        if (read_.zoom_thickness.contains(0)) read_.zoom_left_out.emplace("THI of the object", "");
    }
    for (const auto& [word, where] : read_.zoom_left_out) {
        const bool of_rays = word.find("VU") != word.npos || word.find("VL") != word.npos ||
                             word.find("AN") != word.npos || word.find("WT") != word.npos;
        note_left_out(notes(), where,
                      fmt::format("{} changes with the zoom position", in_quotes(word)), !of_rays);
    }
}

void SeqLens::check_displacements() {
    std::size_t last_lens = 0;
    for (std::size_t i = 1; i + 1 < read_.rows.size(); ++i)
        if (!read_.rows[i].glass.empty() || read_.rows[i].first.value_or(0.0) != 0.0) last_lens = i;
    for (const auto& [surface, word, where] : read_.displaced) {
        if (surface <= last_lens)
            Place{read_.file, where}.refuse(
                "a surface is decentred or tilted: ghosts of a lens off its axis would be wrong "
                "here",
                fmt::format("{} of surface {}", word, surface),
                "refracting surfaces of revolution about one axis");
        note_left_out(notes(), where,
                      fmt::format("{} behind the lens: the sensor stands upright on "
                                  "the axis here",
                                  word),
                      true);
    }
}

ImportedLens SeqLens::finish() {
    if (read_.rows.size() < 3)
        Place{read_.file, {}}.refuse("no lens: there is no surface between object and image",
                                     fmt::format("{} surfaces", read_.rows.size()),
                                     "SO, at least one S, SI");
    if (!read_.has_image)
        note_noticed(notes(), read_.rows.back().where,
                     "the file has no image surface (SI): the last surface is taken for it", true);
    if (!read_.radius_mode) read_.radius_mode = decide_radius_mode();
    check_displacements();
    const std::size_t count = read_.rows.size() - 2;
    read_.imported.lens.surfaces.resize(count);
    read_.imported.surfaces.resize(count);
    for (std::size_t row = 0; row < count; ++row)
        if (read_.rows[row + 1].semi_diameter)
            read_.imported.surfaces[row].semi_diameter_mm =
                *read_.rows[row + 1].semi_diameter * read_.mm;
    for (std::size_t number = 1; number <= count; ++number) build_row(number);
    if (!read_.rows.front().glass.empty() && !is_same_name(read_.rows.front().glass, "AIR"))
        note_left_out(notes(), read_.rows.front().where,
                      "a medium in front of the lens: light comes through air here", true);
    if (read_.imported_stop && *read_.imported_stop >= 1 && *read_.imported_stop <= count) {
        read_.imported.stop = *read_.imported_stop - 1;
    } else if (!read_.imported_stop) {
        read_.imported.stop = 0;
        note_assumed(notes(), {}, "no STO: the stop is on surface 1, the format's default", true,
                     "set the stop to the surface where the iris is");
    }
    // The image plane's own thickness is its defocus from where the last one ends.
    const double defocus_mm = read_.rows.back().thickness * read_.mm;
    read_.imported.sensor_distance_mm = read_.rows[count].thickness * read_.mm + defocus_mm;
    // PIM keeps the image at the paraxial focus of the reference wavelength. At another one than d
    // the thickness that it gave says it better.
    if (read_.paraxial_image && defocus_mm == 0.0 &&
        (read_.rows[count].thickness == 0.0 || is_reference_d_line())) {
        read_.imported.sensor_distance_mm.reset();
        note_read(notes(), read_.rows[count].where,
                  fmt::format("PIM keeps the image at the paraxial focus, {} mm behind the last "
                              "surface in the file",
                              format_number(read_.rows[count].thickness * read_.mm)));
    }
    if (defocus_mm != 0.0)
        note_converted(notes(), read_.rows.back().where,
                       fmt::format("the image's defocus of {} mm is added to the last thickness",
                                   format_number(defocus_mm)));
    if (read_.rows.back().first.value_or(0.0) != 0.0)
        note_left_out(notes(), read_.rows.back().where,
                      "the image surface is curved: the sensor is flat", true);
    const double object_mm = read_.rows.front().thickness * read_.mm;
    std::optional<double> finite_object_mm;
    if (std::abs(object_mm) < far_away_mm) {
        finite_object_mm = object_mm;
        note_noticed(notes(), read_.rows.front().where,
                     fmt::format("the object is {} mm in front of the first surface",
                                 format_number(object_mm)),
                     true,
                     "lights are infinitely far here; the sensor stays where the file focuses");
    }
    set_aperture(finite_object_mm);
    set_zoom();
    using Kind = ListedFields::Kind;
    read_.fields.kind = read_.field_kind == "OB" ? Kind::object_height_mm
                        : read_.field_kind == "IM" || read_.field_kind == "RI"
                            ? Kind::image_height_mm
                            : Kind::angle_deg;
    if (read_.fields.kind != Kind::angle_deg)
        for (auto* values : {&read_.fields.x, &read_.fields.y})
            for (double& value : *values) value *= read_.mm;
    set_fields(read_.imported, read_.fields, finite_object_mm);
    if (!read_.skipped.empty()) {
        std::string list;
        for (const std::string& word : read_.skipped) list += (list.empty() ? "" : " ") + word;
        note_left_out(
            notes(), {},
            "labels, settings and solves, which do not change the lens as it stands: " + list);
    }
    read_.unused.report(notes());
    note_read(notes(), {},
              fmt::format("{} surfaces between object and image, numbered as in the file", count));
    return std::move(read_.imported);
}
}  // namespace

ImportedLens seq_lens(SeqContents contents) { return SeqLens(std::move(contents)).finish(); }

bool is_seq(std::string_view text) {
    bool object = false, surface = false, image = false;
    for_each_seq_command(text.substr(0, 65536), [&](const SeqCommand& command) {
        const std::size_t words = command.words.size();
        object = object || ((command.name == "SO" || command.name == "RDM" ||
                             command.name == "LEN" || command.name == "DIM"));
        surface = surface || ((command.name == "S" || command.name == "S1") && words >= 1 &&
                              parse_number(command.words[0].text));
        image = image || command.name == "SI";
    });
    return surface && (object || image);
}

ImportedLens import_seq(const FormatSource& source) { return seq_lens(seq_contents(source)); }

}  // namespace ghostlight
