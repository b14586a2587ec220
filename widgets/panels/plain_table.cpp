#include "widgets/panels/plain_table.h"

#include <QHeaderView>
#include <QTableView>
#include <QTreeView>

#include <algorithm>

#include "widgets/panels/table_delegate.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

/// Columns keep what they show when letters get larger or smaller.
void scale_columns_with_text(QHeaderView& header) {
    follow_text_scale(header, [&header, last = text_scale()]() mutable {
        const double now = text_scale();
        if (now != last) {
            for (int column = 0; column < header.count(); ++column) {
                header.resizeSection(column, qRound(header.sectionSize(column) * now / last));
            }
            last = now;
        }
    });
}

}  // namespace

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
    follow_text_scale(*table, [table] {
        table->verticalHeader()->setMinimumSectionSize(with_text(table_row_height));
        table->verticalHeader()->setDefaultSectionSize(with_text(table_row_height));
    });
    table->horizontalHeader()->setHighlightSections(false);
    table->horizontalHeader()->setMinimumSectionSize(28);
    scale_columns_with_text(*table->horizontalHeader());
    return table;
}

namespace {

/// The least width of a column; the header's own size hint keeps room for a sort mark that is not
/// shown. `view` as its base class, where the size hint is public.
int fitted_width(const QAbstractItemView& view, int column) {
    constexpr int header_padding = 14;
    constexpr int first_padding = 20;
    const QString header = view.model()->headerData(column, Qt::Horizontal).toString();
    const int header_width = view.fontMetrics().horizontalAdvance(header) +
                             (column == 0 ? first_padding : header_padding);
    return std::max(view.sizeHintForColumn(column), header_width);
}

}  // namespace

void fit_columns(QTableView& table) {
    for (int column = 0; column < table.model()->columnCount(); ++column) {
        table.setColumnWidth(column, fitted_width(table, column));
    }
}

void fit_columns(QTreeView& tree) {
    for (int column = 0; column < tree.model()->columnCount(); ++column) {
        const int branches = column == 0 ? 2 * tree.indentation() : 0;
        tree.setColumnWidth(column, fitted_width(tree, column) + branches);
    }
}

QTreeView* plain_tree(QAbstractItemModel* model, QAbstractItemDelegate* delegate) {
    auto* tree = new QTreeView;
    tree->setModel(model);
    tree->setItemDelegate(delegate);
    tree->setUniformRowHeights(true);
    tree->setFrameShape(QFrame::NoFrame);
    tree->setContextMenuPolicy(Qt::CustomContextMenu);
    tree->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    tree->setIndentation(16);
    tree->setExpandsOnDoubleClick(false);
    tree->header()->setHighlightSections(false);
    tree->header()->setMinimumSectionSize(28);
    tree->header()->setStretchLastSection(false);
    scale_columns_with_text(*tree->header());
    return tree;
}

}  // namespace ghostlight
