#include "core/io/open_lens_flare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <pugixml.hpp>

#include "core/io/import_notes.h"
#include "core/io/listed_surface.h"
#include "core/io/stated_glass.h"
#include "core/io/stated_heights.h"
#include "core/io/text_lines.h"

namespace ghostlight {
namespace {

/// The file's lines, to name where an element begins.
class LineCounter {
   public:
    LineCounter(std::string_view text, std::string file) : file_(std::move(file)) {
        for (std::size_t i = 0; i < text.size(); ++i)
            if (text[i] == '\n') ends_.push_back(i);
    }
    Place at(std::ptrdiff_t offset) const {
        if (offset < 0) return {file_, {}};
        const auto line = std::ranges::lower_bound(ends_, static_cast<std::size_t>(offset));
        return {file_, fmt::format("line {}", line - ends_.begin() + 1)};
    }
    Place at(const pugi::xml_node& node) const { return at(node.offset_debug()); }

   private:
    std::string file_;
    std::vector<std::size_t> ends_;
};

struct Field {
    Place place;
    std::string_view text;

    double number(std::string_view expected) const { return place.number(text, expected); }
};

/// A child's text; nothing when it is absent or empty. Throws Error when it is there twice.
std::optional<Field> field(const pugi::xml_node& parent, const char* name,
                           const LineCounter& lines) {
    const pugi::xml_node child = parent.child(name);
    if (!child) return std::nullopt;
    if (child.next_sibling(name))
        lines.at(child.next_sibling(name))
            .refuse("the field is given twice", name, "each field once");
    const std::string_view text = child.text().get();
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == text.npos) return std::nullopt;
    return Field{lines.at(child), text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1)};
}

std::optional<double> number(const pugi::xml_node& parent, const char* name,
                             const LineCounter& lines, std::string_view expected) {
    const auto found = field(parent, name, lines);
    return found ? std::optional(found->number(expected)) : std::nullopt;
}

void note_unknown_fields(const pugi::xml_node& parent, std::span<const std::string_view> known,
                         const LineCounter& lines, UnusedWords& unused) {
    for (const pugi::xml_node& child : parent.children())
        if (child.type() == pugi::node_element &&
            std::ranges::find(known, std::string_view(child.name())) == known.end())
            unused.add(child.name(), lines.at(child).where);
}

Coating coating_of(const pugi::xml_node& element, const LineCounter& lines, Notes& notes) {
    const double center_nm =
        number(element, "coatingLambda", lines, "a wavelength in nm").value_or(0.0);
    const double index = number(element, "coatingIor", lines, "an index").value_or(0.0);
    if (center_nm == 0.0 || index == 0.0) return Uncoated{};
    const Place place = lines.at(element);
    if (!(center_nm >= 100.0 && center_nm <= 10000.0) || !(index >= 1.0 && index <= 5.0))
        place.refuse("not a usable coating", fmt::format("{} nm, index {}", center_nm, index),
                     "100 to 10000 nm and an index from 1 to 5, or 0 for none");
    note_converted(notes, place.where,
                   fmt::format("coating: a quarter wave at {} nm of index {}", center_nm, index));
    return QuarterWave{center_nm, Medium{{}, ConstantIndex{index}}, 1.0};
}

void refuse_kind(const Field& type) {
    type.place.refuse("a kind of element that is not traced here: its ghosts would be wrong",
                      in_quotes(type.text), "lensSpherical, apertureStop or sensor");
}

void read_element(const pugi::xml_node& element, const LineCounter& lines, ImportedLens& result,
                  UnusedWords& unused, bool& has_sensor) {
    constexpr std::string_view known[] = {
        "type",       "height",        "thickness",  "radius", "refractiveIndex",
        "abbeNumber", "coatingLambda", "coatingIor", "mask",   "maskFT"};
    note_unknown_fields(element, known, lines, unused);
    const Place place = lines.at(element);
    if (has_sensor)
        place.refuse("an element behind the sensor", "a further element", "the sensor last");
    const auto type = field(element, "type", lines);
    if (!type) place.refuse("missing field", "nothing", "a type");
    if (is_same_name(type->text, "sensor")) {
        has_sensor = true;
        note_read(result.notes, place.where, "the sensor");
        return;
    }
    const bool is_stop = is_same_name(type->text, "apertureStop");
    if (!is_stop && !is_same_name(type->text, "lensSpherical")) refuse_kind(*type);
    ListedSurface listed;
    listed.place = place;
    listed.radius_mm = number(element, "radius", lines, "a radius in mm, 0 for flat").value_or(0.0);
    const auto thickness = field(element, "thickness", lines);
    if (!thickness) place.refuse("missing field", "nothing", "a thickness");
    listed.thickness_mm = thickness->number("a thickness in mm");
    listed.semi_diameter_mm = number(element, "height", lines, "a clear radius in mm");
    listed.coating = coating_of(element, lines, result.notes);
    listed.medium_after = medium_of({.nd = number(element, "refractiveIndex", lines, "an index"),
                                     .vd = number(element, "abbeNumber", lines, "an Abbe number")},
                                    place, result.notes);
    if (is_stop && !result.stop) {
        result.stop = result.lens.surfaces.size();
        listed.comment = "aperture stop";
    } else if (is_stop) {
        note_noticed(result.notes, place.where,
                     "a second aperture stop: the first is taken, this one is an opening", true);
    }
    if (is_stop && (field(element, "mask", lines) || field(element, "maskFT", lines)))
        note_left_out(result.notes, place.where,
                      "the picture of the stop's shape: the stop is round here", true,
                      "give the stop its blades");
    append_surface(result, listed);
}

void read_system(const pugi::xml_node& system, const LineCounter& lines, ImportedLens& result) {
    Published& published = result.lens.published;
    if (const auto name = field(system, "name", lines)) result.lens.name = clipped(name->text, 200);
    if (const auto efl = number(system, "effectiveFocalLength", lines, "a focal length in mm");
        efl && *efl > 0.0)
        result.stated_efl_mm = published.efl_mm = efl;
    if (const auto f = number(system, "fnumber", lines, "an f-number"); f && *f > 0.0) {
        result.lens.stop.f_number = published.f_number = f;
        note_read(result.notes, lines.at(system.child("fnumber")).where,
                  fmt::format("f/{}: the stop is closed to it, as far as its height allows", *f));
    }
    if (const auto view = number(system, "fieldOfView", lines, "a full angle in degrees");
        view && *view > 0.0 && *view < 180.0) {
        result.half_field_deg = published.half_field_deg = 0.5 * *view;
        note_converted(result.notes, lines.at(system.child("fieldOfView")).where,
                       fmt::format("field of view {} degrees: half of it each way", *view));
    }
    const auto width = number(system, "filmWidth", lines, "a width in mm");
    const auto height = number(system, "filmHeight", lines, "a height in mm");
    if (width && height && *width > 0.0 && *height > 0.0) {
        result.lens.sensor.width_mm = *width;
        result.lens.sensor.height_mm = *height;
        result.has_sensor_size = true;
        note_read(result.notes, lines.at(system.child("filmWidth")).where,
                  fmt::format("film {} by {} mm", *width, *height));
    }
}

}  // namespace

bool is_open_lens_flare(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    return begin != text.npos && text[begin] == '<' &&
           text.substr(0, 65536).find("<opticalSystem") != text.npos;
}

ImportedLens import_open_lens_flare(const FormatSource& source) {
    const std::string file = source.file.string();
    const LineCounter lines(source.text, file);
    // The library expands no entities but XML's own five; a file that declares some wants it to.
    if (const std::size_t declared = source.text.find("<!DOCTYPE"); declared != source.text.npos)
        lines.at(static_cast<std::ptrdiff_t>(declared))
            .refuse("a document type with its own entities is not read", "<!DOCTYPE",
                    "plain elements");
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(
        source.text.data(), source.text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!parsed)
        lines.at(parsed.offset).refuse("not valid XML", parsed.description(), "well-formed XML");
    const pugi::xml_node system = document.document_element();
    if (std::strcmp(system.name(), "opticalSystem") != 0)
        lines.at(system).refuse("not an OpenLensFlare lens", in_quotes(system.name()),
                                "opticalSystem");
    ImportedLens result;
    UnusedWords unused;
    constexpr std::string_view known[] = {"name",        "fnumber",   "effectiveFocalLength",
                                          "fieldOfView", "filmWidth", "filmHeight",
                                          "elements"};
    note_unknown_fields(system, known, lines, unused);
    read_system(system, lines, result);
    bool has_sensor = false;
    const pugi::xml_node elements = system.child("elements");
    for (const pugi::xml_node& element : elements.children("element"))
        read_element(element, lines, result, unused, has_sensor);
    constexpr std::string_view only_elements[] = {"element"};
    note_unknown_fields(elements, only_elements, lines, unused);
    if (result.lens.surfaces.empty())
        lines.at(system).refuse("the lens has no surfaces", "no element", "elements of a lens");
    if (!has_sensor)
        note_assumed(result.notes, {},
                     "no sensor element: it stands behind the last element's thickness");
    unused.report(result.notes);
    if (result.stop) result.lens.stop.surface = *result.stop;
    const double last_mm = result.lens.surfaces.back().thickness_mm;
    place_sensor(result, last_mm != 0.0 ? std::optional(last_mm) : std::nullopt, file);
    settle_heights(result, std::nullopt, false);
    note_surfaces(result);
    return result;
}

}  // namespace ghostlight
