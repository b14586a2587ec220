#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/io/lens_file.h"
#include "core/optics/prescription.h"
#include "core/units.h"
#include "tests/support/test_paths.h"

// For tests of readers: samples, their reports, and first-order data by another way.

namespace ghostlight {

/// A file of tests/data, through the list of formats.
inline LensFile read_sample(const std::string& name) {
    return read_lens(test_data_folder() / name);
}

/// The first note whose text has the words; null, and a failed test, when there is none.
inline const Note* note_with(const Notes& notes, std::string_view words) {
    const auto found = std::ranges::find_if(
        notes, [&](const Note& note) { return note.text.find(words) != std::string::npos; });
    if (found != notes.end()) return &*found;
    std::string all;
    for (const Note& note : notes) all += note.where + ": " + note.text + "\n";
    ADD_FAILURE() << "no note has \"" << words << "\" among\n" << all;
    return nullptr;
}

/// A row as a table in a book has it; a radius of 0 is a plane.
struct BookRow {
    double radius_mm, thickness_mm, index;
};
struct BookFocus {
    double efl_mm, bfd_mm;
};
/// Gauss' step by step: the power of each surface and the slope it leaves.
inline BookFocus book_focus(const std::vector<BookRow>& rows) {
    double height = 1.0, n_slope = 0.0, before = 1.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double power =
            rows[i].radius_mm == 0.0 ? 0.0 : (rows[i].index - before) / rows[i].radius_mm;
        n_slope -= height * power;
        before = rows[i].index;
        if (i + 1 < rows.size()) height += rows[i].thickness_mm * n_slope / before;
    }
    return {-1.0 / n_slope, -height / n_slope};
}

/// Tronnier's double Gauss, US 2,673,491 (f 100, f/2), as printed.
inline const std::vector<BookRow> double_gauss_rows = {
    {58.95, 7.52, 1.67}, {169.66, 0.24, 1.0},   {38.55, 8.05, 1.67},   {81.54, 6.55, 1.699},
    {25.5, 11.41, 1.0},  {0.0, 9.0, 1.0},       {-28.99, 2.36, 1.603}, {81.54, 12.13, 1.658},
    {-40.77, 0.38, 1.0}, {874.13, 6.44, 1.717}, {-79.46, 72.228, 1.0}};
inline const std::vector<double> double_gauss_clear_radii = {25.2, 25.2, 23, 23, 18, 17.1,
                                                             17,   20,   20, 20, 20};

/// That the lens has those radii, thicknesses, indices at d and clear radii.
inline void expect_rows(const Prescription& lens, const std::vector<BookRow>& rows,
                        const std::vector<double>& clear_radii) {
    ASSERT_EQ(lens.surfaces.size(), rows.size());
    ASSERT_EQ(clear_radii.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Surface& surface = lens.surfaces[i];
        const BaseCurve curve =
            rows[i].radius_mm == 0.0 ? BaseCurve(Plane{}) : BaseCurve(Radius{rows[i].radius_mm});
        EXPECT_EQ(surface.curve, curve) << "row " << i + 1;
        if (i + 1 < rows.size()) {
            EXPECT_DOUBLE_EQ(surface.thickness_mm, rows[i].thickness_mm) << "row " << i + 1;
        }
        EXPECT_NEAR(refractive_index(surface.medium_after, d_line_nm), rows[i].index, 1e-12)
            << "row " << i + 1;
        EXPECT_DOUBLE_EQ(surface.semi_diameter_mm, clear_radii[i]) << "row " << i + 1;
    }
}

}  // namespace ghostlight
