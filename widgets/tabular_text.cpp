#include "widgets/tabular_text.h"

#include <QFontMetrics>
#include <QPainter>

#include <algorithm>

#include "widgets/palette.h"

namespace ghostlight {

namespace {

bool in_digit_cell(QChar character) {
    return character.isDigit() || character == QChar(0x2212) || character == '+';
}

int digit_width(const QFontMetrics& metrics) {
    int width = 0;
    for (const char digit : {'0', '2', '4', '6', '8', '9'}) {
        width = std::max(width, metrics.horizontalAdvance(QChar(digit)));
    }
    return width;
}

/// Calls part(text, is_cell) for single characters in digit cells and for the runs between them.
template <class Part>
void for_parts(const QString& text, const Part& part) {
    qsizetype begin = 0;
    for (qsizetype k = 0; k <= text.size(); ++k) {
        if (k < text.size() && !in_digit_cell(text[k])) {
            continue;
        }
        if (k > begin) {
            part(text.mid(begin, k - begin), false);
        }
        if (k < text.size()) {
            part(QString(text[k]), true);
        }
        begin = k + 1;
    }
}

int measured(const QFontMetrics& metrics, const QString& text) {
    const int cell = digit_width(metrics);
    int width = 0;
    for_parts(text, [&](const QString& run, bool is_cell) {
        width += is_cell ? cell : metrics.horizontalAdvance(run);
    });
    return width;
}

void draw_at(QPainter& painter, int x, int baseline, const QString& text) {
    const QFontMetrics metrics = painter.fontMetrics();
    const int cell = digit_width(metrics);
    for_parts(text, [&](const QString& run, bool is_cell) {
        const int advance = metrics.horizontalAdvance(run);
        painter.drawText(QPointF(x + (is_cell ? (cell - advance) / 2.0 : 0.0), baseline), run);
        x += is_cell ? cell : advance;
    });
}

int centred_baseline(const QFontMetrics& metrics, const QRect& rect) {
    return rect.top() + (rect.height() + metrics.ascent() - metrics.descent()) / 2;
}

}  // namespace

int tabular_width(const QFont& font, const QString& text) {
    return measured(QFontMetrics(font), text);
}

void draw_tabular(QPainter& painter, const QRect& rect, Qt::Alignment alignment,
                  const QString& text) {
    const QFontMetrics metrics = painter.fontMetrics();
    QString shown = text;
    int width = measured(metrics, shown);
    if (width > rect.width()) {
        shown = metrics.elidedText(text, Qt::ElideRight, rect.width());
        width = std::min(measured(metrics, shown), rect.width());
    }
    int x = rect.left();
    if (alignment & Qt::AlignRight) {
        x = rect.right() + 1 - width;
    } else if (alignment & Qt::AlignHCenter) {
        x = rect.left() + (rect.width() - width) / 2;
    }
    draw_at(painter, x, centred_baseline(metrics, rect), shown);
}

TabularLabel::TabularLabel(QWidget* parent) : QWidget(parent) {
    setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
}

void TabularLabel::set_text(const QString& text) {
    if (text == text_) {
        return;
    }
    text_ = text;
    setAccessibleName(QString(text).remove('*'));
    updateGeometry();
    update();
}

void TabularLabel::set_warning(bool warning) {
    warning_ = warning;
    update();
}

QSize TabularLabel::sizeHint() const {
    return {tabular_width(font(), QString(text_).remove('*')), fontMetrics().height()};
}

QSize TabularLabel::minimumSizeHint() const { return {0, fontMetrics().height()}; }

void TabularLabel::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const Palette& colors = current_palette();
    const int baseline = centred_baseline(painter.fontMetrics(), rect());
    int x = 0;
    bool plain = false;
    for (const QString& part : text_.split('*')) {
        painter.setPen(warning_ ? colors.red_orange : plain ? colors.text : colors.dim);
        const int room = std::max(0, width() - x);
        draw_at(painter, x, baseline,
                measured(painter.fontMetrics(), part) <= room
                    ? part
                    : painter.fontMetrics().elidedText(part, Qt::ElideRight, room));
        x += measured(painter.fontMetrics(), part);
        plain = !plain;
    }
}

}  // namespace ghostlight
