#include "widgets/models/surface_sums_model.h"

#include <algorithm>
#include <array>

#include "widgets/ghost_colors.h"
#include "widgets/models/column_header.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

struct ColumnText {
    const char* header;
    const char* tip;
};
constexpr std::array<ColumnText, SurfaceSumsModel::column_count> columns = {{
    {QT_TRANSLATE_NOOP("SurfaceSumsModel", "Surface"),
     QT_TRANSLATE_NOOP("SurfaceSumsModel",
                       "By number, with its ghosts below; double-click to go to its coating.")},
    {QT_TRANSLATE_NOOP("SurfaceSumsModel", "Media"),
     QT_TRANSLATE_NOOP(
         "SurfaceSumsModel",
         "In front of the surface and behind it; of a ghost those at its other one.")},
    {QT_TRANSLATE_NOOP("SurfaceSumsModel", "Flux mm²"),
     QT_TRANSLATE_NOOP("SurfaceSumsModel",
                       "Of all ghosts that turn there, however often. Each counts at both of its "
                       "surfaces,\nso that the column adds up to more than all ghosts.")},
    {"", QT_TRANSLATE_NOOP("SurfaceSumsModel", "The same as a share of the largest.")},
    {QT_TRANSLATE_NOOP("SurfaceSumsModel", "Of all %"),
     QT_TRANSLATE_NOOP("SurfaceSumsModel",
                       "Share of the light of all ghosts that would be gone if this surface did "
                       "not reflect.")},
    {QT_TRANSLATE_NOOP("SurfaceSumsModel", "On sensor mm²"),
     QT_TRANSLATE_NOOP("SurfaceSumsModel", "The part of the flux that lands on the sensor.")},
    {QT_TRANSLATE_NOOP("SurfaceSumsModel", "Ghosts"),
     QT_TRANSLATE_NOOP("SurfaceSumsModel", "How many turn there.")},
}};

/// Top rows have no group above them: 0; a group's ghosts have its row + 1.
quintptr id_of_group(int row) { return static_cast<quintptr>(row) + 1; }

bool turns_at(const GhostRow& ghost, std::size_t surface) {
    return std::ranges::find(ghost.path.reflections, surface) != ghost.path.reflections.end();
}

}  // namespace

QModelIndex SurfaceSumsModel::index(int row, int column, const QModelIndex& parent) const {
    return hasIndex(row, column, parent)
               ? createIndex(row, column, parent.isValid() ? id_of_group(parent.row()) : 0)
               : QModelIndex();
}

QModelIndex SurfaceSumsModel::parent(const QModelIndex& index) const {
    return !index.isValid() || index.internalId() == 0
               ? QModelIndex()
               : createIndex(static_cast<int>(index.internalId() - 1), 0, quintptr{0});
}

int SurfaceSumsModel::rowCount(const QModelIndex& parent) const {
    if (!parent.isValid()) {
        return static_cast<int>(groups_.size());
    }
    const bool is_group = parent.internalId() == 0 && parent.column() == 0;
    return is_group
               ? static_cast<int>(groups_[static_cast<std::size_t>(parent.row())].ghosts.size())
               : 0;
}

int SurfaceSumsModel::columnCount(const QModelIndex&) const { return column_count; }

QModelIndex SurfaceSumsModel::group_of(std::size_t row) const {
    const auto found =
        std::ranges::find(groups_, row, [](const Group& group) { return group.sum.surface; });
    return found == groups_.end() ? QModelIndex()
                                  : index(static_cast<int>(found - groups_.begin()), 0);
}

const GhostRow* SurfaceSumsModel::ghost(const QModelIndex& index) const {
    if (!index.isValid() || index.internalId() == 0) {
        return nullptr;
    }
    const Group& group = groups_[index.internalId() - 1];
    return &table_->ghosts[group.ghosts[static_cast<std::size_t>(index.row())]];
}

QString SurfaceSumsModel::surface_text(std::size_t row) const {
    return row == table_->surface_count ? tr("sensor") : QString::number(row + 1);
}

QString SurfaceSumsModel::media_text(std::size_t row) const {
    const auto& names = table_->media;
    return row + 1 >= names.size() ? QString()
                                   : QString::fromStdString(names[row]) + QStringLiteral(" | ") +
                                         QString::fromStdString(names[row + 1]);
}

QVariant SurfaceSumsModel::group_data(const Group& group, int column, int role) const {
    const GhostSum& sum = group.sum.sum;
    const double largest_mm2 = groups_.front().sum.sum.flux_mm2;
    if (role == bar_role) {
        return column == bar && largest_mm2 > 0.0
                   ? QVariant(std::clamp(sum.flux_mm2 / largest_mm2, 0.0, 1.0))
                   : QVariant();
    }
    if (role != Qt::DisplayRole) {
        return {};
    }
    switch (column) {
        case surface:
            return surface_text(group.sum.surface);
        case media:
            return media_text(group.sum.surface);
        case flux:
            return significant(sum.flux_mm2);
        case share:
            return significant(all_.flux_mm2 > 0.0 ? 100.0 * sum.flux_mm2 / all_.flux_mm2 : 0.0, 3);
        case on_sensor:
            return significant(sum.on_sensor_mm2);
        case ghosts:
            return grouped(sum.ghosts);
        default:
            return {};
    }
}

QVariant SurfaceSumsModel::ghost_data(const Group& group, const GhostRow& ghost, int column,
                                      int role) const {
    const double largest_mm2 = groups_.front().sum.sum.flux_mm2;
    if (role == bar_role) {
        return column == bar && largest_mm2 > 0.0
                   ? QVariant(std::clamp(ghost.flux_mm2 / largest_mm2, 0.0, 1.0))
                   : QVariant();
    }
    if (role == Qt::DecorationRole) {
        return column == surface ? QVariant(ghost_color(ghost.path)) : QVariant();
    }
    if (role == Qt::ForegroundRole) {
        return column == media ? QVariant(current_palette().dim) : QVariant();
    }
    if (role != Qt::DisplayRole) {
        return {};
    }
    switch (column) {
        case surface:
            return QString::fromStdString(name(ghost.path, table_->surface_count));
        case media: {
            const auto& turns = ghost.path.reflections;
            const auto other = std::ranges::find_if(
                turns, [&](std::size_t row) { return row != group.sum.surface; });
            return other == turns.end() ? QString() : media_text(*other);
        }
        case flux:
            return significant(ghost.flux_mm2);
        case share:
            return significant(all_.flux_mm2 > 0.0 ? 100.0 * ghost.flux_mm2 / all_.flux_mm2 : 0.0,
                               3);
        case on_sensor:
            return significant(ghost.flux_mm2 * ghost.on_sensor);
        default:
            return {};
    }
}

QVariant SurfaceSumsModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || !table_) {
        return {};
    }
    if (role == stale_role) {
        const GhostRow* row = ghost(index);
        return row != nullptr && !row->converged;
    }
    if (role == Qt::TextAlignmentRole) {
        return QVariant::fromValue(Qt::AlignVCenter |
                                   (index.column() == surface || index.column() == media
                                        ? Qt::AlignLeft
                                        : Qt::AlignRight));
    }
    if (const GhostRow* row = ghost(index)) {
        return ghost_data(groups_[index.internalId() - 1], *row, index.column(), role);
    }
    return group_data(groups_[static_cast<std::size_t>(index.row())], index.column(), role);
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
    groups_.clear();
    all_ = {};
    if (table_) {
        all_ = sum_of(*table_);
        for (SurfaceSum& sum : sums_by_surface(*table_)) {
            groups_.push_back({sum, {}});
        }
        // The table has the strongest first, and so has every group.
        for (Group& group : groups_) {
            for (std::size_t k = 0; k < table_->ghosts.size(); ++k) {
                if (turns_at(table_->ghosts[k], group.sum.surface)) {
                    group.ghosts.push_back(k);
                }
            }
        }
    }
    endResetModel();
}

}  // namespace ghostlight
