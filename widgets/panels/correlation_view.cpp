#include "widgets/panels/correlation_view.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <cmath>
#include <utility>

#include "widgets/number_text.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

constexpr double least_labelled_px = 13.0;  ///< rows lower than this have no room for a name
constexpr double least_numbered_px = 34.0;

}  // namespace

CorrelationView::CorrelationView(QWidget* parent) : QWidget(parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void CorrelationView::set_correlations(std::vector<QString> names, std::vector<double> values) {
    names_ = std::move(names);
    values_ = std::move(values);
    if (values_.size() != names_.size() * names_.size()) {
        names_.clear();
        values_.clear();
    }
    update();
}

QRectF CorrelationView::square() const {
    int label = 0;
    for (const QString& name : names_) {
        label = std::max(label, fontMetrics().horizontalAdvance(name));
    }
    const double left = 16.0 + label;
    const double side = std::max(10.0, std::min(width() - left - 12.0, height() - 44.0));
    return {left, 10.0, side, side};
}

void CorrelationView::paintEvent(QPaintEvent*) {
    const Palette& colors = current_palette();
    QPainter painter(this);
    painter.fillRect(rect(), colors.panel);
    if (names_.empty()) {
        painter.setPen(colors.dim);
        painter.drawText(rect(), Qt::AlignCenter,
                         tr("Which fitted numbers go together; after a fit."));
        return;
    }
    const QRectF at = square();
    const double cell = at.width() / static_cast<double>(names_.size());
    for (std::size_t i = 0; i < names_.size(); ++i) {
        for (std::size_t k = 0; k < names_.size(); ++k) {
            const double value = std::clamp(values_[i * names_.size() + k], -1.0, 1.0);
            QColor color = value >= 0.0 ? colors.amber : colors.teal;
            color.setAlphaF(static_cast<float>(std::abs(value)));
            const QRectF box(at.left() + cell * static_cast<double>(k),
                             at.top() + cell * static_cast<double>(i), cell, cell);
            painter.fillRect(box.adjusted(0.5, 0.5, -0.5, -0.5), colors.ground);
            painter.fillRect(box.adjusted(0.5, 0.5, -0.5, -0.5), color);
            if (cell >= least_numbered_px) {
                painter.setPen(std::abs(value) > 0.6 ? colors.ground : colors.text);
                painter.drawText(box, Qt::AlignCenter, QString::number(value, 'f', 2));
            }
        }
        if (cell >= least_labelled_px) {
            painter.setPen(colors.text);
            painter.drawText(
                QRectF(4, at.top() + cell * static_cast<double>(i), at.left() - 10, cell),
                Qt::AlignRight | Qt::AlignVCenter, names_[i]);
        }
    }
    painter.setPen(colors.dim);
    painter.drawText(QRectF(at.left(), at.bottom() + 6, width() - at.left(), 20),
                     Qt::AlignLeft | Qt::AlignVCenter,
                     tr("amber +1 · teal −1 · the mouse tells the pair"));
}

QString CorrelationView::text_at(const QPoint& at) const {
    const QRectF area = square();
    if (names_.empty() || !area.contains(at)) {
        return {};
    }
    const auto count = static_cast<double>(names_.size());
    const auto index = [&](double share) {
        return std::min(names_.size() - 1, static_cast<std::size_t>(share * count));
    };
    const std::size_t i = index((at.y() - area.top()) / area.height());
    const std::size_t k = index((at.x() - area.left()) / area.width());
    return QStringLiteral("%1 with %2: %3")
        .arg(names_[i], names_[k], significant(values_[i * names_.size() + k], 3));
}

bool CorrelationView::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        QToolTip::showText(help->globalPos(), text_at(help->pos()), this);
        return true;
    }
    return QWidget::event(event);
}

}  // namespace ghostlight
