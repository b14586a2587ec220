#include "widgets/panels/ghost_matrix.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <cmath>

#include "core/flare/false_color.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"
#include "widgets/tabular_text.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

constexpr double decades = 6.0;  // below the strongest
constexpr double margin_px = 12.0, axis_px = 30.0, scale_px = 46.0, largest_cell_px = 34.0;
constexpr int steps_of_scale = 64;

QColor color_at(double place) {
    const auto rgb = false_color(static_cast<float>(place));
    return QColor::fromRgbF(rgb[0], rgb[1], rgb[2]);
}

QString surface_name(std::size_t row, const GhostTable& table) {
    return row == table.surface_count ? QStringLiteral("S") : QString::number(row + 1);
}

}  // namespace

QRectF GhostMatrix::Grid::at(std::size_t first, std::size_t second, std::size_t lowest) const {
    return {left + static_cast<double>(second - lowest) * cell,
            top + static_cast<double>(first - lowest) * cell, cell, cell};
}

GhostMatrix::GhostMatrix(QWidget* parent) : QWidget(parent) {
    setObjectName("ghost_matrix");
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Ghosts by their two surfaces"));
}

void GhostMatrix::show_table(std::shared_ptr<const GhostTable> table) {
    table_ = std::move(table);
    stale_ = false;
    rows_.clear();
    lowest_ = highest_ = 0;
    bool first = true;
    if (table_) {
        for (const GhostRow& row : table_->ghosts) {
            if (row.path.reflections.size() != 2) {
                continue;
            }
            rows_[row.path] = &row;
            const auto [low, high] = std::minmax(row.path.reflections[0], row.path.reflections[1]);
            lowest_ = first ? low : std::min(lowest_, low);
            highest_ = first ? high : std::max(highest_, high);
            first = false;
        }
    }
    update();
}

void GhostMatrix::set_selected(const std::vector<GhostPath>& ghosts) {
    selected_ = ghosts;
    update();
}

void GhostMatrix::set_stale(bool stale) {
    stale_ = stale;
    update();
}

GhostMatrix::Grid GhostMatrix::grid() const {
    const auto count = static_cast<double>(highest_ - lowest_ + 1);
    const double room = std::min(width() - 2.0 * margin_px - axis_px - scale_px,
                                 height() - 2.0 * margin_px - axis_px);
    Grid grid;
    grid.cell = std::clamp(room / count, 4.0, largest_cell_px);
    grid.left = margin_px + axis_px;
    grid.top = margin_px;
    return grid;
}

QColor GhostMatrix::color_of(double flux_mm2) const {
    const double strongest =
        table_ && !table_->ghosts.empty() ? table_->ghosts.front().flux_mm2 : 0.0;
    if (!(strongest > 0.0)) {
        return color_at(0.0);
    }
    const auto high = static_cast<float>(std::log10(strongest));
    return color_at(static_cast<double>(
        log_place(static_cast<float>(flux_mm2), high - static_cast<float>(decades), high)));
}

std::optional<QRectF> GhostMatrix::cell_of(const GhostPath& path) const {
    if (!rows_.contains(path)) {
        return std::nullopt;
    }
    return grid().at(path.reflections[0], path.reflections[1], lowest_);
}

const GhostRow* GhostMatrix::ghost_at(QPointF position) const {
    for (const auto& [path, row] : rows_) {
        if (grid().at(path.reflections[0], path.reflections[1], lowest_).contains(position)) {
            return row;
        }
    }
    return nullptr;
}

void GhostMatrix::paint_scale(QPainter& painter, const QRectF& place) const {
    const double high = std::log10(table_->ghosts.front().flux_mm2);
    const double step = place.height() / steps_of_scale;
    for (int k = 0; k < steps_of_scale; ++k) {
        painter.fillRect(
            QRectF(place.left(), place.bottom() - (k + 1) * step, place.width(), step + 0.5),
            color_at((k + 0.5) / steps_of_scale));
    }
    painter.setPen(current_palette().dim);
    for (int decade = static_cast<int>(std::ceil(high - decades));
         decade <= static_cast<int>(std::floor(high)); ++decade) {
        const double y = place.bottom() - (decade - high + decades) / decades * place.height();
        painter.drawText(QRectF(place.right() + 5.0, y - 8.0, 40.0, 16.0),
                         Qt::AlignLeft | Qt::AlignVCenter, significant(std::pow(10.0, decade), 1));
    }
    painter.drawText(QRectF(place.left() - 10.0, place.bottom() + 4.0, 60.0, 16.0), Qt::AlignLeft,
                     "mm²");
}

void GhostMatrix::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const Palette& colors = current_palette();
    painter.fillRect(rect(), colors.panel);
    if (rows_.empty()) {
        return;
    }
    painter.setFont(small_font());
    const Grid place = grid();
    const double gap = place.cell > 8.0 ? 1.0 : 0.0;
    painter.setOpacity(stale_ ? 0.55 : 1.0);
    for (const auto& [path, row] : rows_) {
        const QRectF cell = place.at(path.reflections[0], path.reflections[1], lowest_);
        painter.fillRect(cell.adjusted(0.0, 0.0, -gap, -gap), color_of(row->flux_mm2));
    }
    painter.setPen(QPen(colors.teal, 2.0));
    painter.setBrush(Qt::NoBrush);
    for (const GhostPath& path : selected_) {
        if (const auto cell = cell_of(path)) {
            painter.drawRect(cell->adjusted(-1.0, -1.0, 0.0, 0.0));
        }
    }
    painter.setPen(colors.dim);
    // As many numbers as there is room for.
    const auto every = static_cast<std::size_t>(std::max(1.0, std::ceil(16.0 / place.cell)));
    const double bottom = place.top + static_cast<double>(highest_ - lowest_ + 1) * place.cell;
    for (std::size_t surface = lowest_; surface <= highest_; surface += every) {
        const QRectF diagonal = place.at(surface, surface, lowest_);
        const QString text = surface_name(surface, *table_);
        painter.drawText(QRectF(margin_px, diagonal.top(), axis_px - 6.0, diagonal.height()),
                         Qt::AlignRight | Qt::AlignVCenter, text);
        painter.drawText(
            QRectF(diagonal.left() - 10.0, bottom + 2.0, diagonal.width() + 20.0, 14.0),
            Qt::AlignHCenter | Qt::AlignTop, text);
    }
    painter.drawText(QRectF(place.left, bottom + 16.0, width() - place.left, 16.0), Qt::AlignLeft,
                     tr("second reflection →   (rows: first reflection)"));
    if (table_->ghosts.front().flux_mm2 > 0.0) {
        const double right = place.left + static_cast<double>(highest_ - lowest_ + 1) * place.cell;
        const double low = std::min<double>(bottom, place.top + 160.0);
        paint_scale(painter, {std::min(right + 14.0, width() - scale_px), place.top, 10.0,
                              std::max(60.0, low - place.top)});
    }
}

void GhostMatrix::mousePressEvent(QMouseEvent* event) {
    const GhostRow* row = ghost_at(event->position());
    std::vector<GhostPath> wanted;
    if ((event->modifiers() & Qt::ControlModifier) != 0) {
        wanted = selected_;
    }
    if (row != nullptr) {
        const auto found = std::ranges::find(wanted, row->path);
        if (found == wanted.end()) {
            wanted.push_back(row->path);
        } else {
            wanted.erase(found);
        }
    }
    Q_EMIT selected(wanted);
}

void GhostMatrix::keyPressEvent(QKeyEvent* event) {
    int down = 0, right = 0;
    switch (event->key()) {
        case Qt::Key_Up:
            down = -1;
            break;
        case Qt::Key_Down:
            down = 1;
            break;
        case Qt::Key_Left:
            right = -1;
            break;
        case Qt::Key_Right:
            right = 1;
            break;
        default:
            QWidget::keyPressEvent(event);
            return;
    }
    if (rows_.empty()) {
        return;
    }
    if (selected_.empty() || !rows_.contains(selected_.back())) {
        Q_EMIT selected({rows_.begin()->first});
        return;
    }
    // The next ghost that way; surfaces that do not reflect have none.
    GhostPath path = selected_.back();
    const auto span = static_cast<int>(highest_ - lowest_ + 1);
    for (int k = 0; k < span; ++k) {
        path.reflections[0] += static_cast<std::size_t>(down);
        path.reflections[1] += static_cast<std::size_t>(right);
        if (rows_.contains(path)) {
            Q_EMIT selected({path});
            return;
        }
    }
}

bool GhostMatrix::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        auto* help = static_cast<QHelpEvent*>(event);
        if (const GhostRow* row = ghost_at(help->pos())) {
            QToolTip::showText(
                help->globalPos(),
                tr("%1 · %2 mm² · %3 % on the sensor")
                    .arg(QString::fromStdString(name(row->path, table_->surface_count)),
                         significant(row->flux_mm2), significant(100.0 * row->on_sensor, 3)),
                this);
        } else {
            QToolTip::hideText();
        }
        return true;
    }
    return QWidget::event(event);
}

void GhostMatrix::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange) {
        update();
    }
    QWidget::changeEvent(event);
}

}  // namespace ghostlight
