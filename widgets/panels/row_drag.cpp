#include "widgets/panels/row_drag.h"

#include <QApplication>
#include <QFrame>
#include <QMouseEvent>
#include <QScrollBar>
#include <QTableView>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "widgets/palette.h"
#include "widgets/panels/mouse_stroke.h"

namespace ghostlight {

namespace {
constexpr int line_height = 2;
}

RowDrag::RowDrag(QTableView& table)
    : QObject(&table), table_(table), line_(new QFrame(table.viewport())) {
    line_->setObjectName("row_drop_line");
    line_->setAttribute(Qt::WA_TransparentForMouseEvents);
    line_->hide();
    table.viewport()->installEventFilter(this);
}

int RowDrag::gap_at(int y) const {
    const int rows = table_.model()->rowCount();
    for (int row = 0; row < rows; ++row) {
        if (y < table_.rowViewportPosition(row) + table_.rowHeight(row) / 2) {
            return row;
        }
    }
    return rows;
}

void RowDrag::show_gap(int gap) {
    const int last = table_.model()->rowCount() - 1;
    const int y = gap > last ? table_.rowViewportPosition(last) + table_.rowHeight(last)
                             : table_.rowViewportPosition(gap);
    line_->setStyleSheet(QStringLiteral("background: %1;").arg(current_palette().teal.name()));
    line_->setGeometry(0, std::max(0, y - line_height / 2), table_.viewport()->width(),
                       line_height);
    line_->show();
    line_->raise();
}

bool RowDrag::eventFilter(QObject* watched, QEvent* event) {
    const QMouseEvent* mouse = mouse_stroke(event);
    if (mouse == nullptr) {
        return QObject::eventFilter(watched, event);
    }
    const auto type = event->type();
    const QPoint at = mouse->position().toPoint();
    if (type == QEvent::MouseButtonPress) {
        const QModelIndex index = table_.indexAt(at);
        row_ = mouse->button() == Qt::LeftButton && index.isValid() && index.column() == 0
                   ? index.row()
                   : -1;
        from_y_ = at.y();
        return false;
    }
    if (row_ < 0) {
        return false;
    }
    if (type == QEvent::MouseMove) {
        dragging_ = dragging_ || std::abs(at.y() - from_y_) >= QApplication::startDragDistance();
        if (dragging_) {
            // At the edge it scrolls on, a row at a time.
            QScrollBar* bar = table_.verticalScrollBar();
            if (at.y() < 0 || at.y() > table_.viewport()->height()) {
                bar->setValue(bar->value() + (at.y() < 0 ? -1 : 1));
            }
            table_.viewport()->setCursor(Qt::ClosedHandCursor);
            show_gap(gap_at(at.y()));
        }
        return true;  // no range is selected meanwhile
    }
    const int from = std::exchange(row_, -1);
    line_->hide();
    table_.viewport()->unsetCursor();
    if (std::exchange(dragging_, false)) {
        const int gap = gap_at(at.y());
        const int to = gap > from ? gap - 1 : gap;
        if (to != from) {
            Q_EMIT row_moved(from, to);
        }
    }
    return false;
}

}  // namespace ghostlight
