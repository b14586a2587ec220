#pragma once

#include <QString>

#include <cstddef>
#include <string>
#include <vector>

#include "core/optics/prescription.h"

namespace ghostlight {

struct PrescriptionColumns {
    enum Column {
        number,
        radius,
        thickness,
        medium,
        dispersion,  ///< what the glass in `medium` is; to be read, not edited
        semi_diameter,
        conic,
        aspheric,
        coating,
        comment,
        column_count
    };
};

/// A lens as its table shows it.
struct ShownLens {
    const Prescription& lens;
    std::string configuration;
    bool curvatures = false;  ///< the column of radii shows 1/mm
};

/// What a cell says, what its editor begins with, and its tool tip. Rows count from 0.
QString cell_text(const ShownLens& shown, std::size_t row, int column);
QString cell_edit_text(const ShownLens& shown, std::size_t row, int column);
QString cell_tool_tip(const ShownLens& shown, std::size_t row, int column);

/// The lens with a text typed into a cell. Automatic semi-diameters follow. Throws Error for what
/// cannot be taken, or what would spoil a lens that was sound.
Prescription with_cell_text(const ShownLens& shown, std::size_t row, int column,
                            const QString& text);
/// Several at once: each is read on its own, and the lens is judged when all are in.
struct CellText {
    std::size_t row = 0;
    int column = 0;
    QString text;
};
Prescription with_cell_texts(const ShownLens& shown, const std::vector<CellText>& cells);

/// A number in a cell that can be drawn up and down; an asphere or a glass has several.
struct CellNumber {
    QString name;  ///< "Radius", "A6"
    QString unit;  ///< "mm", or empty
    double value = 0.0;
    double reach = 1.0;  ///< how far a slider goes to either side
};
std::vector<CellNumber> cell_numbers(const ShownLens& shown, std::size_t row, int column);
/// Throws Error as with_cell_text().
Prescription with_cell_number(const ShownLens& shown, std::size_t row, int column,
                              std::size_t which, double value);

/// The kind of fit parameter that a cell is (core/fit/fit_parameters.h); empty for none.
std::string vary_kind(const Surface& surface, int column);

}  // namespace ghostlight
