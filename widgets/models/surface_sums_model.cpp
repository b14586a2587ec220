#include "widgets/models/surface_sums_model.h"

#include <algorithm>
#include <array>

#include "widgets/models/column_header.h"
#include "widgets/number_text.h"

namespace ghostlight {

namespace {

struct ColumnText {
    const char* header;
    const char* tip;
};
constexpr std::array<ColumnText, SurfaceSumsModel::column_count> columns = {{
    {QT_TRANSLATE_NOOP("SurfaceSumsModel", "Surface"),
     QT_TRANSLATE_NOOP("SurfaceSumsModel", "By number; double-click to go to its coating.")},
    {QT_TRANSLATE_NOOP("SurfaceSumsModel", "Media"),
     QT_TRANSLATE_NOOP("SurfaceSumsModel", "In front of the surface and behind it.")},
    {QT_TRANSLATE_NOOP("SurfaceSumsModel", "Flux mm²"),
     QT_TRANSLATE_NOOP(
         "SurfaceSumsModel",
         "Of all ghosts that turn there, however often. Each counts at both of its surfaces,\n"
         "so that the column adds up to more than all ghosts.")},
    {"", QT_TRANSLATE_NOOP("SurfaceSumsModel", "The same as a share of the largest.")},
    {QT_TRANSLATE_NOOP("SurfaceSumsModel", "Of all %"),
     QT_TRANSLATE_NOOP(
         "SurfaceSumsModel",
         "Share of the light of all ghosts that would be gone if this surface did not reflect.")},
    {QT_TRANSLATE_NOOP("SurfaceSumsModel", "On sensor mm²"),
     QT_TRANSLATE_NOOP("SurfaceSumsModel", "The part of the flux that lands on the sensor.")},
    {QT_TRANSLATE_NOOP("SurfaceSumsModel", "Ghosts"),
     QT_TRANSLATE_NOOP("SurfaceSumsModel", "How many turn there.")},
}};

}  // namespace

int SurfaceSumsModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(sums_.size());
}

int SurfaceSumsModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : column_count;
}

QVariant SurfaceSumsModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || index.row() >= rowCount()) {
        return {};
    }
    const SurfaceSum& row = sum(index.row());
    const double of_all = all_.flux_mm2 > 0.0 ? row.sum.flux_mm2 / all_.flux_mm2 : 0.0;
    const double largest = sums_.front().sum.flux_mm2;
    switch (role) {
        case Qt::DisplayRole:
            switch (index.column()) {
                case surface:
                    return row.surface == table_->surface_count ? tr("sensor")
                                                                : QString::number(row.surface + 1);
                case media: {
                    const auto& names = table_->media;
                    if (row.surface + 1 >= names.size()) {
                        return QString();
                    }
                    return QString::fromStdString(names[row.surface]) + QStringLiteral(" | ") +
                           QString::fromStdString(names[row.surface + 1]);
                }
                case flux:
                    return significant(row.sum.flux_mm2);
                case share:
                    return significant(100.0 * of_all, 3);
                case on_sensor:
                    return significant(row.sum.on_sensor_mm2);
                case ghosts:
                    return grouped(row.sum.ghosts);
                default:
                    return {};
            }
        case bar_role:
            return index.column() == bar && largest > 0.0
                       ? QVariant(std::clamp(row.sum.flux_mm2 / largest, 0.0, 1.0))
                       : QVariant();
        case stale_role:
            return false;
        case Qt::TextAlignmentRole:
            return QVariant::fromValue(Qt::AlignVCenter |
                                       (index.column() == surface || index.column() == media
                                            ? Qt::AlignLeft
                                            : Qt::AlignRight));
        default:
            return {};
    }
}

QVariant SurfaceSumsModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= column_count) {
        return {};
    }
    const ColumnText& column = columns[static_cast<std::size_t>(section)];
    return column_header("SurfaceSumsModel", column.header, column.tip,
                         section == surface || section == media ? Qt::AlignLeft : Qt::AlignRight,
                         role);
}

void SurfaceSumsModel::set_table(std::shared_ptr<const GhostTable> table) {
    beginResetModel();
    table_ = std::move(table);
    sums_ = table_ ? sums_by_surface(*table_) : std::vector<SurfaceSum>();
    all_ = table_ ? sum_of(*table_) : GhostSum();
    endResetModel();
}

}  // namespace ghostlight
