#pragma once

class QAbstractItemModel;
class QAbstractItemDelegate;
class QTableView;
class QTreeView;

namespace ghostlight {

/// A table as all panels have it: no grid, no row headers, one line a row.
QTableView* plain_table(QAbstractItemModel* model, QAbstractItemDelegate* delegate);

/// Each shown column as wide as its header or its widest cell, and no wider.
void fit_columns(QTableView& table);
void fit_columns(QTreeView& tree);

/// Rows in groups, looking as plain_table() does.
QTreeView* plain_tree(QAbstractItemModel* model, QAbstractItemDelegate* delegate);

}  // namespace ghostlight
