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
    {"Surface", "By number; double-click to go to its coating."},
    {"Media", "In front of the surface and behind it."},
    {"Flux mm²",
     "Of all ghosts that turn there, however often. Each counts at both of its surfaces,\n"
     "so that the column adds up to more than all ghosts."},
    {"", "The same as a share of the largest."},
    {"Of all %",
     "Share of the light of all ghosts that would be gone if this surface did not reflect."},
    {"On sensor mm²", "The part of the flux that lands on the sensor."},
    {"Ghosts", "How many turn there."},
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
                    return row.surface == table_->surface_count ? QStringLiteral("sensor")
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
    return column_header(column.header, column.tip,
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
