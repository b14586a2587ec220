#include "core/io/pbrt_lens.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/import_notes.h"
#include "core/io/listed_surface.h"
#include "core/io/stated_glass.h"
#include "core/io/text_lines.h"

namespace ghostlight {
namespace {

constexpr std::string_view row_expected = "radius, thickness, index, diameter in mm";

std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

struct Row {
    Place place;
    double radius_mm, thickness_mm, index, diameter_mm;
    bool is_in_air = false;  ///< on both sides
};

/// "# D-GAUSS F/2 22deg HFOV": the first comment names the lens, all of them say where it is from.
void read_comments(TextLines lines, Prescription& lens) {
    constexpr std::size_t longest_source = 2000;
    for (const TextLine& line : lines) {
        const std::size_t hash = line.text.find('#');
        if (hash == line.text.npos || !trimmed(without_comment(line.text)).empty()) continue;
        std::string_view comment = line.text.substr(hash + 1);
        while (comment.starts_with('#')) comment.remove_prefix(1);
        comment = trimmed(comment);
        while (comment.ends_with('"')) comment.remove_suffix(1);
        const bool names_columns = comment.find("radius") != comment.npos;
        if (comment.empty() || names_columns) continue;
        if (lens.name.empty())
            lens.name = clipped(comment, 200);
        else if (lens.source.size() < longest_source)
            lens.source += (lens.source.empty() ? "" : "; ") + clipped(comment, 200);
    }
}

std::vector<Row> read_rows(TextLines lines, const std::string& file, ImportedLens& result) {
    std::vector<Row> rows;
    std::optional<double> lone;
    Place lone_place;
    for (const TextLine& line : lines) {
        const auto row = words(without_comment(line.text));
        if (row.empty()) continue;
        const Place place{file, fmt::format("line {}", line.number)};
        if (row.size() == 1 && rows.empty() && !lone) {
            lone = place.number(row[0], row_expected);
            lone_place = place;
            continue;
        }
        if (row.size() != 4)
            place.refuse("not a row of a pbrt lens", fmt::format("{} numbers", row.size()),
                         row_expected);
        if (rows.size() >= 1000)
            place.refuse("the lens has too many surfaces", "a further row", "at most 1000");
        rows.push_back({place, place.number(row[0], "a radius in mm, 0 for the stop"),
                        place.number(row[1], "a thickness in mm"),
                        place.number(row[2], "an index, 0 for air"),
                        place.number(row[3], "a diameter in mm")});
        if (rows.back().index == 0.0) rows.back().index = 1.0;
        rows.back().is_in_air =
            rows.back().index == 1.0 && (rows.size() < 2 || rows[rows.size() - 2].index == 1.0);
    }
    if (rows.empty())
        Place{file, {}}.refuse("the lens has no surfaces", "no rows", std::string(row_expected));
    if (lone && *lone == static_cast<double>(rows.size())) {
        note_read(result.notes, lone_place.where, fmt::format("{} rows", rows.size()));
    } else if (lone) {
        note_read(result.notes, lone_place.where, fmt::format("focal length {} mm", *lone));
        result.stated_efl_mm = result.lens.published.efl_mm = lone;
    }
    return rows;
}

/// pbrt takes every radius 0 for the stop. The narrowest in air is one; others are flat.
std::optional<std::size_t> stop_of(std::span<const Row> rows, Notes& notes) {
    std::optional<std::size_t> stop;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].radius_mm == 0.0 && rows[i].is_in_air &&
            (!stop || rows[i].diameter_mm < rows[*stop].diameter_mm))
            stop = i;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].radius_mm == 0.0 && stop != i)
            note_noticed(notes, rows[i].place.where,
                         rows[i].is_in_air
                             ? "radius 0 is the stop for pbrt; a narrower row is taken for it, and "
                               "this one as an opening"
                             : "radius 0 is the stop for pbrt; this row has glass beside it and is "
                               "taken for a plane surface",
                         true, "check which row is the stop");
    return stop;
}

}  // namespace

bool is_pbrt_lens(std::string_view text) {
    std::size_t rows = 0;
    for (const TextLine& line : text_lines(text.substr(0, 4096))) {
        const auto row = words(without_comment(line.text));
        if (row.empty()) continue;
        if (row.size() == 1 && rows == 0 && parse_number(row[0])) continue;
        if (row.size() != 4) return rows >= 3;  // the first piece may end within a row
        for (const std::string_view word : row)
            if (!parse_number(word)) return rows >= 3;
        ++rows;
    }
    return rows > 0;
}

ImportedLens import_pbrt_lens(const FormatSource& source) {
    const std::string file = source.file.string();
    const auto lines = text_lines(source.text);
    ImportedLens result;
    read_comments(lines, result.lens);
    const auto rows = read_rows(lines, file, result);
    result.stop = stop_of(rows, result.notes);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& row = rows[i];
        const bool is_last = i + 1 == rows.size();
        ListedSurface listed;
        listed.place = row.place;
        listed.radius_mm = row.radius_mm;
        listed.thickness_mm = is_last ? 0.0 : row.thickness_mm;
        listed.semi_diameter_mm = 0.5 * row.diameter_mm;
        listed.medium_after = medium_of({.nd = row.index}, row.place, result.notes);
        append_surface(result, listed);
        if (is_last && row.thickness_mm != 0.0)
            note_left_out(result.notes, row.place.where,
                          fmt::format("the last thickness, {} mm: pbrt focuses by itself, and so "
                                      "does this: the sensor goes to the paraxial focus",
                                      row.thickness_mm));
    }
    note_converted(result.notes, {}, "diameters are halved to clear radii");
    note_assumed(result.notes, {},
                 "the file has no dispersion: every index holds at every wavelength, and ghosts "
                 "have no coloured rims",
                 true, "give the glasses their Abbe numbers");
    if (result.stop) result.lens.stop.surface = *result.stop;
    place_sensor(result, std::nullopt, file);
    note_surfaces(result);
    return result;
}

}  // namespace ghostlight
