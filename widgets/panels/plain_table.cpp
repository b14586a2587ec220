#include "widgets/panels/plain_table.h"

#include <QHeaderView>
#include <QTableView>

#include <algorithm>

#include "widgets/panels/table_delegate.h"

namespace ghostlight {

QTableView* plain_table(QAbstractItemModel* model, QAbstractItemDelegate* delegate) {
    auto* table = new QTableView;
    table->setModel(model);
    table->setItemDelegate(delegate);
    table->setShowGrid(false);
    table->setFrameShape(QFrame::NoFrame);
    table->setContextMenuPolicy(Qt::CustomContextMenu);
    table->setWordWrap(false);
    table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    table->verticalHeader()->hide();
    table->verticalHeader()->setDefaultSectionSize(table_row_height);
    table->verticalHeader()->setMinimumSectionSize(table_row_height);
    table->horizontalHeader()->setHighlightSections(false);
    table->horizontalHeader()->setMinimumSectionSize(28);
    return table;
}

void fit_columns(QTableView& table) {
    // The header's own size hint keeps room for a sort mark that is not shown.
    constexpr int header_padding = 14;
    constexpr int first_padding = 20;
    const QAbstractItemModel* model = table.model();
    const QAbstractItemView& cells = table;  // where the size hint is public
    for (int column = 0; column < model->columnCount(); ++column) {
        const QString header = model->headerData(column, Qt::Horizontal).toString();
        const int header_width = table.fontMetrics().horizontalAdvance(header) +
                                 (column == 0 ? first_padding : header_padding);
        table.setColumnWidth(column, std::max(cells.sizeHintForColumn(column), header_width));
    }
}

}  // namespace ghostlight
