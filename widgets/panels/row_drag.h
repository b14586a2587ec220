#pragma once

#include <QObject>

class QFrame;
class QTableView;

namespace ghostlight {

/// Rows of a table that are dragged by their number, the first column, to another place.
class RowDrag : public QObject {
    Q_OBJECT
   public:
    explicit RowDrag(QTableView& table);

   Q_SIGNALS:
    void row_moved(int from, int to);

   protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

   private:
    /// The gap between rows nearest to a height in the viewport: 0 above the first row.
    int gap_at(int y) const;
    void show_gap(int gap);

    QTableView& table_;
    QFrame* line_;
    int row_ = -1;
    int from_y_ = 0;
    bool dragging_ = false;
};

}  // namespace ghostlight
