#pragma once

#include <QModelIndexList>
#include <QString>

#include <vector>

#include "widgets/models/prescription_cells.h"

class QTableView;

namespace ghostlight {

/// The chosen cells as spreadsheets take them: rows by lines, columns by tabs, every digit. What
/// lies between chosen cells and is not chosen is left empty; hidden columns are not there.
QString copied_cells(const QTableView& table);

/// What a text from a spreadsheet puts where: one value into every chosen cell, a block from the
/// first chosen cell on, over the columns that are shown. Columns that cannot be edited are passed
/// over. Throws Error for a block that does not fit.
std::vector<CellText> pasted_cells(const QTableView& table, const QString& text);

}  // namespace ghostlight
