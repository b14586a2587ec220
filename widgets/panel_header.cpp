#include "widgets/panel_header.h"

#include <QFontMetrics>
#include <QPainter>

#include <algorithm>
#include <utility>

#include "widgets/palette.h"

namespace ghostlight {

namespace {

constexpr int margin_px = 12;
constexpr int padding_px = 8;  // above and below the text
constexpr int gap_px = 24;     // at least, between title and state

QFont title_font(const QFont& base) {
    QFont font = base;
    font.setWeight(QFont::DemiBold);
    return font;
}

}  // namespace

PanelHeader::PanelHeader(const QString& title, QWidget* parent) : QWidget(parent), title_(title) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setAccessibleName(title);
}

void PanelHeader::set_state(const QString& state) {
    set_state(std::vector<Part>{{state, QColor()}});
}

void PanelHeader::set_state(std::vector<Part> parts) {
    parts_ = std::move(parts);
    setAccessibleDescription(state());
    update();
}

QString PanelHeader::state() const {
    QString text;
    for (const Part& part : parts_) {
        text += part.text;
    }
    return text;
}

void PanelHeader::set_warning(bool warning) {
    warning_ = warning;
    update();
}

void PanelHeader::set_dimmed(bool dimmed) {
    dimmed_ = dimmed;
    update();
}

QSize PanelHeader::sizeHint() const {
    const QFontMetrics metrics(title_font(font()));
    return {metrics.horizontalAdvance(title_) + 2 * margin_px, metrics.height() + 2 * padding_px};
}

QSize PanelHeader::minimumSizeHint() const { return sizeHint(); }

void PanelHeader::paintEvent(QPaintEvent*) {
    const Palette& colors = current_palette();
    QPainter painter(this);
    painter.fillRect(rect(), colors.panel);
    painter.setPen(colors.line);
    painter.drawLine(0, height() - 1, width(), height() - 1);

    const QRect inside = rect().adjusted(margin_px, 0, -margin_px, -1);
    painter.setFont(title_font(font()));
    painter.setPen(colors.text);
    painter.drawText(inside, Qt::AlignLeft | Qt::AlignVCenter, title_);
    const int title_width = painter.fontMetrics().horizontalAdvance(title_);

    painter.setFont(font());
    painter.setOpacity(dimmed_ ? 0.6 : 1.0);
    const QColor own = warning_ ? colors.red_orange : colors.dim;
    const QFontMetrics metrics = painter.fontMetrics();
    const int room = std::max(0, inside.width() - title_width - gap_px);
    const QString whole = state();
    const int wanted = metrics.horizontalAdvance(whole);
    if (wanted > room) {
        painter.setPen(own);
        painter.drawText(inside, Qt::AlignRight | Qt::AlignVCenter,
                         metrics.elidedText(whole, Qt::ElideRight, room));
        return;
    }
    int left = inside.right() + 1 - wanted;
    for (const Part& part : parts_) {
        painter.setPen(part.color.isValid() && !warning_ ? part.color : own);
        const int advance = metrics.horizontalAdvance(part.text);
        painter.drawText(QRect(left, inside.top(), advance + 1, inside.height()),
                         Qt::AlignLeft | Qt::AlignVCenter, part.text);
        left += advance;
    }
}

}  // namespace ghostlight
