#pragma once

#include <QStyledItemDelegate>

namespace ghostlight {

/// Cells with tabular figures, a colour chip for a decoration and an amber bar for a magnitude.
class TableDelegate : public QStyledItemDelegate {
    Q_OBJECT
   public:
    /// `bar_role` gives 0 to 1 for a bar instead of text, `stale_role` true for dimmed numbers;
    /// −1 for none.
    TableDelegate(int bar_role, int stale_role, QObject* parent);

    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override;
    QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;

   private:
    int bar_role_;
    int stale_role_;
};

inline constexpr int table_row_height = 26;  ///< at the usual size of letters

}  // namespace ghostlight
