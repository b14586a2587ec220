#include "widgets/panels/prescription_clipboard.h"

#include <QCoreApplication>

#include <QStringList>
#include <QTableView>

#include <algorithm>
#include <utility>

#include "core/error.h"

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct PrescriptionClipboard {
    Q_DECLARE_TR_FUNCTIONS(PrescriptionClipboard)
};

/// Columns that are shown, from the left.
std::vector<int> shown_columns(const QTableView& table) {
    std::vector<int> columns;
    for (int column = 0; column < table.model()->columnCount(); ++column) {
        if (!table.isColumnHidden(column)) {
            columns.push_back(column);
        }
    }
    return columns;
}

/// As spreadsheets write a cell with a tab, a line's end or a quote in it.
QString quoted(QString text) {
    if (!text.contains('\t') && !text.contains('\n') && !text.startsWith('"')) {
        return text;
    }
    return '"' + text.replace('"', "\"\"") + '"';
}

std::vector<QStringList> read_block(QString text) {
    text.replace("\r\n", "\n").replace('\r', '\n');
    std::vector<QStringList> rows(1);
    QString cell;
    bool in_quotes = false;
    for (qsizetype k = 0; k < text.size(); ++k) {
        const QChar c = text[k];
        if (in_quotes) {
            if (c == '"' && k + 1 < text.size() && text[k + 1] == '"') {
                cell += text[++k];
            } else if (c == '"') {
                in_quotes = false;
            } else {
                cell += c;
            }
        } else if (c == '"' && cell.isEmpty()) {
            in_quotes = true;
        } else if (c == '\t' || c == '\n') {
            rows.back() << std::exchange(cell, QString());
            if (c == '\n') {
                rows.emplace_back();
            }
        } else {
            cell += c;
        }
    }
    rows.back() << cell;
    // Spreadsheets end the last line, too.
    if (rows.size() > 1 && rows.back() == QStringList{QString()}) {
        rows.pop_back();
    }
    return rows;
}

QModelIndexList chosen_cells(const QTableView& table) {
    QModelIndexList chosen = table.selectionModel()->selectedIndexes();
    if (chosen.isEmpty() && table.currentIndex().isValid()) {
        chosen << table.currentIndex();
    }
    chosen.removeIf([&](const QModelIndex& cell) { return table.isColumnHidden(cell.column()); });
    return chosen;
}

CellText cell_text_of(const QModelIndex& index, const QString& text) {
    return {static_cast<std::size_t>(index.row()), index.column(), text};
}

}  // namespace

QString copied_cells(const QTableView& table) {
    const QModelIndexList chosen = chosen_cells(table);
    if (chosen.isEmpty()) {
        return {};
    }
    const auto [top, bottom] = std::ranges::minmax(chosen, {}, &QModelIndex::row);
    const auto [left, right] = std::ranges::minmax(chosen, {}, &QModelIndex::column);
    QStringList lines;
    for (int row = top.row(); row <= bottom.row(); ++row) {
        QStringList cells;
        for (const int column : shown_columns(table)) {
            if (column < left.column() || column > right.column()) {
                continue;
            }
            const QModelIndex cell = table.model()->index(row, column);
            cells << (chosen.contains(cell) ? quoted(cell.data(Qt::EditRole).toString())
                                            : QString());
        }
        lines << cells.join('\t');
    }
    return lines.join('\n');
}

std::vector<CellText> pasted_cells(const QTableView& table, const QString& text) {
    const QModelIndexList chosen = chosen_cells(table);
    if (chosen.isEmpty()) {
        throw Error(
            PrescriptionClipboard::tr("choose the cell where pasting begins").toStdString());
    }
    const std::vector<QStringList> block = read_block(text);
    const auto is_editable = [](const QModelIndex& cell) {
        return bool(cell.flags() & Qt::ItemIsEditable);
    };
    std::vector<CellText> cells;
    if (block.size() == 1 && block[0].size() == 1) {
        for (const QModelIndex& cell : chosen) {
            if (is_editable(cell)) {
                cells.push_back(cell_text_of(cell, block[0][0]));
            }
        }
        return cells;
    }
    const int top = std::ranges::min(chosen, {}, &QModelIndex::row).row();
    const int left = std::ranges::min(chosen, {}, &QModelIndex::column).column();
    const int room = table.model()->rowCount() - top;
    if (block.size() > static_cast<std::size_t>(room)) {
        throw Error(
            {PrescriptionClipboard::tr("more rows than there are surfaces").toStdString(),
             {},
             {},
             PrescriptionClipboard::tr("%n row(s)", nullptr, static_cast<int>(block.size()))
                 .toStdString(),
             PrescriptionClipboard::tr("at most %1 from surface %2 on; insert surfaces first")
                 .arg(room)
                 .arg(top + 1)
                 .toStdString()});
    }
    const std::vector<int> columns = shown_columns(table);
    const auto first = std::ranges::lower_bound(columns, left);
    for (std::size_t k = 0; k < block.size(); ++k) {
        auto column = first;
        for (const QString& value : block[k]) {
            if (column == columns.end()) {
                throw Error(
                    {PrescriptionClipboard::tr("more columns than the table shows").toStdString(),
                     {},
                     {},
                     PrescriptionClipboard::tr("%n column(s)", nullptr,
                                               static_cast<int>(block[k].size()))
                         .toStdString(),
                     PrescriptionClipboard::tr("at most %1 from the chosen one on")
                         .arg(columns.end() - first)
                         .toStdString()});
            }
            const QModelIndex cell = table.model()->index(top + static_cast<int>(k), *column++);
            if (is_editable(cell)) {
                cells.push_back(cell_text_of(cell, value));
            }
        }
    }
    return cells;
}

}  // namespace ghostlight
