#include "widgets/models/ghost_table_model.h"

#include <QStringList>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "widgets/ghost_colors.h"
#include "widgets/models/column_header.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

struct ColumnText {
    const char* header;
    const char* copied;  ///< the name that scripts know
    const char* order;
    const char* tip;
};

constexpr std::array<ColumnText, GhostTableModel::column_count> columns = {{
    {QT_TRANSLATE_NOOP("GhostTableModel", "Ghost"), "ghost",
     QT_TRANSLATE_NOOP("GhostTableModel", "name"),
     QT_TRANSLATE_NOOP("GhostTableModel",
                       "First and second reflection: 5-3 turns at surface 5, then at 3.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "Flux mm²"), "flux_mm2",
     QT_TRANSLATE_NOOP("GhostTableModel", "flux"),
     QT_TRANSLATE_NOOP(
         "GhostTableModel",
         "Effective collecting area: the ghost's flux over the light's irradiance E0,\n"
         "polarisation carried along the path.")},
    {"", "", QT_TRANSLATE_NOOP("GhostTableModel", "flux"),
     QT_TRANSLATE_NOOP("GhostTableModel",
                       "Flux on a logarithmic scale, four decades below the strongest ghost.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "Rel."), "relative_flux",
     QT_TRANSLATE_NOOP("GhostTableModel", "relative flux"),
     QT_TRANSLATE_NOOP("GhostTableModel", "Flux over that of the direct image.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "Peak E0"), "peak_per_e0",
     QT_TRANSLATE_NOOP("GhostTableModel", "peak"),
     QT_TRANSLATE_NOOP(
         "GhostTableModel",
         "Largest mean irradiance over a cell of sensor width / 1280, in units of E0.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "x mm"), "centroid_x_mm",
     QT_TRANSLATE_NOOP("GhostTableModel", "x"),
     QT_TRANSLATE_NOOP("GhostTableModel", "Centroid on the sensor plane, horizontal.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "y mm"), "centroid_y_mm",
     QT_TRANSLATE_NOOP("GhostTableModel", "y"),
     QT_TRANSLATE_NOOP("GhostTableModel",
                       "Centroid on the sensor plane, vertical; pictures are upright,\n"
                       "so that their top is −y.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "RMS mm"), "rms_radius_mm",
     QT_TRANSLATE_NOOP("GhostTableModel", "RMS radius"),
     QT_TRANSLATE_NOOP("GhostTableModel", "Root mean square radius about the centroid.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "On sensor %"), "on_sensor",
     QT_TRANSLATE_NOOP("GhostTableModel", "share on the sensor"),
     QT_TRANSLATE_NOOP("GhostTableModel", "Share of the flux inside the sensor's rectangle.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "R1 %"), "reflectance_1",
     QT_TRANSLATE_NOOP("GhostTableModel", "first reflectance"),
     QT_TRANSLATE_NOOP("GhostTableModel", "Mean reflectance at the first reflection.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "R2 %"), "reflectance_2",
     QT_TRANSLATE_NOOP("GhostTableModel", "second reflectance"),
     QT_TRANSLATE_NOOP("GhostTableModel", "Mean reflectance at the second reflection.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "Angle 1 °"), "incidence_1_deg",
     QT_TRANSLATE_NOOP("GhostTableModel", "first angle of incidence"),
     QT_TRANSLATE_NOOP(
         "GhostTableModel",
         "Mean angle of incidence at the first reflection, in the medium the light comes from.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "Angle 2 °"), "incidence_2_deg",
     QT_TRANSLATE_NOOP("GhostTableModel", "second angle of incidence"),
     QT_TRANSLATE_NOOP(
         "GhostTableModel",
         "Mean angle of incidence at the second reflection, in the medium the light comes from.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "Focus mm"), "focus_from_sensor_mm",
     QT_TRANSLATE_NOOP("GhostTableModel", "ghost focus"),
     QT_TRANSLATE_NOOP("GhostTableModel",
                       "Where a collimated beam meets along the ghost's path, to first order;\n"
                       "negative before the sensor.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "Width mm"), "x_extent_mm",
     QT_TRANSLATE_NOOP("GhostTableModel", "width"),
     QT_TRANSLATE_NOOP("GhostTableModel", "Extent on the sensor plane, horizontal.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "Height mm"), "y_extent_mm",
     QT_TRANSLATE_NOOP("GhostTableModel", "height"),
     QT_TRANSLATE_NOOP("GhostTableModel", "Extent on the sensor plane, vertical.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "Flux A mm²"), "flux_a_mm2",
     QT_TRANSLATE_NOOP("GhostTableModel", "flux of A"),
     QT_TRANSLATE_NOOP("GhostTableModel", "The same ghost's flux in the pinned lens A.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "B − A mm²"), "flux_difference_mm2",
     QT_TRANSLATE_NOOP("GhostTableModel", "difference from A"),
     QT_TRANSLATE_NOOP(
         "GhostTableModel",
         "What the ghost gained since A was pinned; negative where it is weaker now.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "A → B"), "flux_ratio",
     QT_TRANSLATE_NOOP("GhostTableModel", "change from A"),
     QT_TRANSLATE_NOOP("GhostTableModel",
                       "Flux now over flux of A: × 0.5 is half as strong as in the pinned lens.")},
    {QT_TRANSLATE_NOOP("GhostTableModel", "Rays"), "rays",
     QT_TRANSLATE_NOOP("GhostTableModel", "rays"),
     QT_TRANSLATE_NOOP("GhostTableModel", "Rays traced for this row's numbers.")},
}};

/// A centroid closer to the axis than this is on it, but for rounding.
constexpr double on_axis_mm = 1e-9;
constexpr double bar_decades = 4.0;

}  // namespace

QString sorted_by(int column) {
    return QCoreApplication::translate("GhostTableModel",
                                       columns[static_cast<std::size_t>(column)].order);
}

QString column_id(int column) {
    return QString::fromUtf8(columns[static_cast<std::size_t>(column)].copied);
}

QString column_title(int column) {
    return column == GhostTableModel::magnitude
               ? GhostTableModel::tr("Bar")
               : QCoreApplication::translate("GhostTableModel",
                                             columns[static_cast<std::size_t>(column)].header);
}

bool is_of_comparison(int column) {
    return column == GhostTableModel::flux_a || column == GhostTableModel::difference ||
           column == GhostTableModel::ratio;
}

int GhostTableModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() || !table_ ? 0 : static_cast<int>(table_->ghosts.size());
}

int GhostTableModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : column_count;
}

double GhostTableModel::number(const GhostRow& row, int column) const {
    switch (column) {
        case ghost:
            // By first, then by second reflection.
            return row.path.reflections.size() < 2
                       ? 0.0
                       : 1e4 * static_cast<double>(row.path.reflections[0]) +
                             static_cast<double>(row.path.reflections[1]);
        case relative:
            return row.relative_flux;
        case peak:
            return row.peak_per_e0;
        case centroid_x:
            return row.centroid_x_mm;
        case centroid_y:
            return row.centroid_y_mm;
        case rms_radius:
            return row.rms_radius_mm;
        case on_sensor:
            return row.on_sensor;
        case reflectance_1:
            return row.turns[0].reflectance;
        case reflectance_2:
            return row.turns[1].reflectance;
        case incidence_1:
            return row.turns[0].incidence_deg;
        case incidence_2:
            return row.turns[1].incidence_deg;
        case focus:
            return row.paraxial.focus_from_sensor_mm;
        case width:
            return row.box.empty() ? 0.0 : row.box.x1_mm - row.box.x0_mm;
        case height:
            return row.box.empty() ? 0.0 : row.box.y1_mm - row.box.y0_mm;
        case flux_a:
        case difference:
        case ratio: {
            const auto found = flux_before_mm2_.find(row.path);
            if (found == flux_before_mm2_.end()) {
                return std::numeric_limits<double>::quiet_NaN();
            }
            return column == flux_a       ? found->second
                   : column == difference ? row.flux_mm2 - found->second
                                          : row.flux_mm2 / found->second;
        }
        case rays:
            return static_cast<double>(row.rays);
        default:
            return row.flux_mm2;
    }
}

QVariant GhostTableModel::text(const GhostRow& row, int column) const {
    const double value = number(row, column);
    switch (column) {
        case ghost:
            return QString::fromStdString(name(row.path, table_->surface_count));
        case magnitude:
            return {};
        case centroid_x:
        case centroid_y:
            return significant(std::abs(value) < on_axis_mm ? 0.0 : value);
        case rays:
            return grouped(row.rays);
        case on_sensor:
            return significant(100.0 * value, 3);
        case reflectance_1:
        case reflectance_2:
            return significant(100.0 * value);
        case flux_a:
        case difference:
            return std::isnan(value) ? QStringLiteral("–") : significant(value, 3);
        case ratio:
            return !std::isfinite(value) ? QStringLiteral("–")
                                         : QStringLiteral("× ") + significant(value, 3);
        default:
            return significant(value);
    }
}

QVariant GhostTableModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || !table_ || index.row() >= rowCount()) {
        return {};
    }
    const GhostRow& ghost_row = row(index.row());
    const int column = index.column();
    const double value = number(ghost_row, column);
    switch (role) {
        case Qt::DisplayRole:
            return text(ghost_row, column);
        case sort_role:  // what does not exist comes last, and in an order
            return std::isnan(value) ? -std::numeric_limits<double>::infinity() : value;
        case bar_role: {
            const double strongest = table_->ghosts.front().flux_mm2;
            if (column != magnitude || !(value > 0.0) || !(strongest > 0.0)) {
                return {};
            }
            return std::clamp(1.0 + std::log10(value / strongest) / bar_decades, 0.0, 1.0);
        }
        case stale_role:
            return stale_ || !ghost_row.converged;
        case Qt::DecorationRole:
            return column == ghost ? QVariant(ghost_color(ghost_row.path)) : QVariant();
        case Qt::TextAlignmentRole:
            return QVariant::fromValue(Qt::AlignVCenter |
                                       (column == ghost ? Qt::AlignLeft : Qt::AlignRight));
        case Qt::ToolTipRole:
            if (column == flux) {
                return QStringLiteral("%1 ± %2 mm²%3")
                    .arg(significant(ghost_row.flux_mm2, 6),
                         significant(ghost_row.flux_error_mm2, 2),
                         ghost_row.converged ? QString() : tr("\nThe tolerance was not reached."));
            }
            return {};
        default:
            return {};
    }
}

QVariant GhostTableModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= column_count) {
        return {};
    }
    const ColumnText& column = columns[static_cast<std::size_t>(section)];
    return column_header("GhostTableModel", column.header, column.tip,
                         section == ghost ? Qt::AlignLeft : Qt::AlignRight, role);
}

void GhostTableModel::set_table(std::shared_ptr<const GhostTable> table) {
    stale_ = false;
    const bool same_rows = table_ && table && table_->ghosts.size() == table->ghosts.size();
    if (same_rows && rowCount() > 0) {
        // The rows stay where they are for views; only their numbers are others.
        table_ = std::move(table);
        Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, column_count - 1));
        return;
    }
    beginResetModel();
    table_ = std::move(table);
    endResetModel();
}

void GhostTableModel::set_before(std::shared_ptr<const GhostTable> before) {
    before_ = std::move(before);
    flux_before_mm2_.clear();
    if (before_) {
        for (const GhostRow& row : before_->ghosts) {
            flux_before_mm2_[row.path] = row.flux_mm2;
        }
    }
    if (rowCount() > 0) {
        Q_EMIT dataChanged(index(0, flux_a), index(rowCount() - 1, ratio));
    }
}

void GhostTableModel::set_stale(bool stale) {
    if (stale == stale_) {
        return;
    }
    stale_ = stale;
    if (rowCount() > 0) {
        Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, column_count - 1), {stale_role});
    }
}

int GhostTableModel::find(const GhostPath& path) const {
    for (int k = 0; k < rowCount(); ++k) {
        if (row(k).path == path) {
            return k;
        }
    }
    return -1;
}

QString GhostTableModel::clipboard_text(const std::vector<int>& rows) const {
    QStringList lines;
    QStringList cells;
    const auto is_copied = [&](int column) {
        return column != magnitude && (before_ || !is_of_comparison(column));
    };
    for (int column = 0; column < column_count; ++column) {
        if (is_copied(column)) {
            cells << columns[static_cast<std::size_t>(column)].copied;
        }
    }
    lines << cells.join('\t');
    for (const int k : rows) {
        cells = {QString::fromStdString(name(row(k).path, table_->surface_count))};
        for (int column = flux; column < column_count; ++column) {
            if (is_copied(column)) {
                cells << shortest(number(row(k), column));
            }
        }
        lines << cells.join('\t');
    }
    return lines.join('\n') + '\n';
}

}  // namespace ghostlight
