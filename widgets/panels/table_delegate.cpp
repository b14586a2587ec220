#include "widgets/panels/table_delegate.h"

#include <QApplication>
#include <QPainter>

#include "widgets/palette.h"
#include "widgets/tabular_text.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

constexpr int margin = 6;
constexpr int first_margin = 12;  // in line with the panel's title
constexpr int chip = 12;
constexpr int bar_height = 10;
constexpr int bar_width = 64;

void draw_chip(QPainter& painter, const QRect& cell, int left, const QColor& color) {
    const QRect square(left, cell.center().y() - chip / 2 + 1, chip, chip);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(color);
    painter.drawRoundedRect(square, 3, 3);
}

}  // namespace

TableDelegate::TableDelegate(int bar_role, int stale_role, QObject* parent)
    : QStyledItemDelegate(parent), bar_role_(bar_role), stale_role_(stale_role) {}

void TableDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option,
                          const QModelIndex& index) const {
    QStyleOptionViewItem cell = option;
    initStyleOption(&cell, index);
    const QString text = cell.text;
    cell.text.clear();
    cell.icon = {};
    cell.features &= ~QStyleOptionViewItem::HasDecoration;
    // One selection colour over the whole row; no box around the current cell unless it can be
    // typed into.
    cell.state &= ~QStyle::State_HasFocus;
    const QStyle* style = cell.widget != nullptr ? cell.widget->style() : QApplication::style();
    style->drawPrimitive(QStyle::PE_PanelItemViewItem, &cell, painter, cell.widget);

    const Palette& colors = current_palette();
    painter->save();
    painter->setClipRect(option.rect);
    painter->setPen(QPen(colors.ground, 1));
    painter->drawLine(option.rect.bottomLeft(), option.rect.bottomRight());
    if ((option.state & QStyle::State_HasFocus) && (index.flags() & Qt::ItemIsEditable)) {
        painter->setPen(QPen(colors.teal, 1));
        painter->drawRect(option.rect.adjusted(0, 0, -1, -1));
    }

    const bool stale = stale_role_ >= 0 && index.data(stale_role_).toBool();
    const QVariant bar = bar_role_ >= 0 ? index.data(bar_role_) : QVariant();
    QRect inside = option.rect.adjusted(index.column() == 0 ? first_margin : margin, 0, -margin, 0);
    if (bar.isValid()) {
        QRect box(inside.left(), inside.center().y() - bar_height / 2 + 1,
                  std::max(2, static_cast<int>(inside.width() * bar.toDouble())), bar_height);
        QColor amber = colors.amber;
        amber.setAlphaF(stale ? 0.45F : 1.0F);
        painter->setRenderHint(QPainter::Antialiasing);
        painter->setPen(Qt::NoPen);
        painter->setBrush(amber);
        painter->drawRoundedRect(box, 2, 2);
    }
    const QVariant decoration = index.data(Qt::DecorationRole);
    if (decoration.canConvert<QColor>()) {
        draw_chip(*painter, option.rect, inside.left(), decoration.value<QColor>());
    }
    if (decoration.isValid()) {
        inside.setLeft(inside.left() + chip + margin);
    }
    const QVariant foreground = index.data(Qt::ForegroundRole);
    const QColor pen = foreground.isValid() ? foreground.value<QColor>() : colors.text;
    painter->setPen(stale ? colors.dim : pen);
    painter->setFont(cell.font);
    draw_tabular(*painter, inside, cell.displayAlignment, text);
    painter->restore();
}

QSize TableDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
    const QString text = index.data(Qt::DisplayRole).toString();
    int width = tabular_width(option.font, text) + 2 * margin + 2;
    if (index.column() == 0) {
        width += first_margin - margin;
    }
    if (index.data(Qt::DecorationRole).isValid()) {
        width += chip + margin;
    }
    if (bar_role_ >= 0 && index.data(bar_role_).isValid()) {
        width = bar_width;
    }
    return {width, with_text(table_row_height)};
}

}  // namespace ghostlight
