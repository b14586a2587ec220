#include "widgets/models/fit_ghost_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_set>

#include "widgets/models/column_header.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

constexpr std::array<const char*, FitGhostModel::column_count> titles = {
    QT_TRANSLATE_NOOP("FitGhostModel", "Counts"),
    QT_TRANSLATE_NOOP("FitGhostModel", "Signal/noise"),
    QT_TRANSLATE_NOOP("FitGhostModel", "Before, %"),
    QT_TRANSLATE_NOOP("FitGhostModel", "After, %"),
    QT_TRANSLATE_NOOP("FitGhostModel", "Gain"),
    QT_TRANSLATE_NOOP("FitGhostModel", "In the fit")};
constexpr std::array<const char*, FitGhostModel::column_count> tips = {
    QT_TRANSLATE_NOOP("FitGhostModel",
                      "A ghost by its two surfaces; only what is marked counts in the fit"),
    QT_TRANSLATE_NOOP("FitGhostModel",
                      "√Σ (model / σ)² over the samples of the photograph that shows it best"),
    QT_TRANSLATE_NOOP("FitGhostModel",
                      "Its share of the model's light on the samples, before the fit"),
    QT_TRANSLATE_NOOP("FitGhostModel",
                      "Its share of the model's light on the samples, after the fit"),
    QT_TRANSLATE_NOOP(
        "FitGhostModel",
        "Its light in the photograph over the fitted model's, all ghosts unmixed together"),
    QT_TRANSLATE_NOOP(
        "FitGhostModel",
        "Below the noise: left out by the fit, with the most that its signal to noise can be, its "
        "coatings six times as bright as at the start")};

}  // namespace

int FitGhostModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int FitGhostModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : column_count;
}

QString FitGhostModel::fate_of(const Row& row) const {
    if (!row.counts) {
        return tr("left out by you");
    }
    if (!has_report_) {
        return {};
    }
    if (row.fitted) {
        return row.fitted->merged_with.empty()
                   ? tr("fitted")
                   : tr("not told from %1").arg(QString::fromStdString(row.fitted->merged_with));
    }
    return row.at_most ? tr("below the noise: at most %1").arg(significant(*row.at_most, 2))
                       : tr("not on the photographs");
}

QVariant FitGhostModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) {
        return {};
    }
    const Row& row = rows_[static_cast<std::size_t>(index.row())];
    if (role == Qt::TextAlignmentRole) {
        const bool is_text = index.column() == ghost || index.column() == fate;
        return QVariant((is_text ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    }
    if (role == Qt::CheckStateRole && index.column() == ghost) {
        return row.counts ? Qt::Checked : Qt::Unchecked;
    }
    if (role == Qt::ForegroundRole) {
        const bool is_dim = !row.counts || (has_report_ && !row.fitted);
        return is_dim ? QVariant(current_palette().dim) : QVariant();
    }
    if (role != Qt::DisplayRole) {
        return {};
    }
    const auto number = [](double value, int digits) {
        return std::isfinite(value) ? significant(value, digits) : QString();
    };
    switch (index.column()) {
        case ghost:
            return QString::fromStdString(row.name);
        case signal:
            return row.fitted ? number(row.fitted->signal_to_noise, 3) : QString();
        case before:
            return row.fitted ? number(100.0 * row.fitted->share_before, 3) : QString();
        case after:
            return row.fitted ? number(100.0 * row.fitted->share_after, 3) : QString();
        case gain:
            return row.fitted && std::isfinite(row.fitted->gain_after)
                       ? QStringLiteral("%1 ± %2").arg(number(row.fitted->gain_after, 3),
                                                       number(row.fitted->gain_error, 2))
                       : QString();
        case fate:
            return fate_of(row);
        default:
            return {};
    }
}

QVariant FitGhostModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= column_count) {
        return {};
    }
    const auto at = static_cast<std::size_t>(section);
    const bool is_text = section == ghost || section == fate;
    return column_header("FitGhostModel", titles[at], tips[at],
                         is_text ? Qt::AlignLeft : Qt::AlignRight, role);
}

Qt::ItemFlags FitGhostModel::flags(const QModelIndex& index) const {
    Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
    return index.column() == ghost ? flags | Qt::ItemIsUserCheckable : flags;
}

bool FitGhostModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    if (!index.isValid() || role != Qt::CheckStateRole || index.column() != ghost) {
        return false;
    }
    Q_EMIT count_asked(name_at(index.row()), value.toInt() == Qt::Checked);
    return true;
}

void FitGhostModel::set_ghosts(const std::vector<std::string>& names,
                               const std::vector<std::string>& left_out) {
    const std::unordered_set<std::string> gone(left_out.begin(), left_out.end());
    std::vector<std::string> sorted = names, known;
    for (const Row& row : rows_) {
        known.push_back(row.name);
    }
    std::ranges::sort(sorted);
    std::ranges::sort(known);
    if (sorted == known) {
        for (Row& row : rows_) {
            row.counts = !gone.contains(row.name);
        }
        if (!rows_.empty()) {
            Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, column_count - 1));
        }
        return;
    }
    beginResetModel();
    rows_.clear();
    has_report_ = false;
    for (const std::string& name : names) {
        rows_.push_back({.name = name,
                         .counts = !gone.contains(name),
                         .fitted = std::nullopt,
                         .at_most = std::nullopt});
    }
    endResetModel();
}

void FitGhostModel::set_report(const FitReport* report) {
    if (report == nullptr && !has_report_) {
        return;
    }
    std::map<std::string, FittedGhost> fitted;
    std::map<std::string, double> at_most;
    if (report != nullptr) {
        for (const FittedGhost& each : report->ghosts) {
            const auto [at, is_new] = fitted.emplace(each.name, each);
            if (!is_new && each.signal_to_noise > at->second.signal_to_noise) {
                at->second = each;
            }
        }
        for (const LeftOutGhost& each : report->left_out) {
            double& most = at_most[each.name];
            most = std::max(most, each.at_most);
        }
    }
    beginResetModel();
    has_report_ = report != nullptr;
    for (Row& row : rows_) {
        const auto found = fitted.find(row.name);
        row.fitted = found == fitted.end() ? std::nullopt : std::optional(found->second);
        const auto below = at_most.find(row.name);
        row.at_most = below == at_most.end() ? std::nullopt : std::optional(below->second);
    }
    sort_rows();
    endResetModel();
}

void FitGhostModel::sort_rows() {
    const auto strength = [](const Row& row) {
        // Those below the noise come after all others that land on a photograph.
        return row.fitted ? row.fitted->signal_to_noise : row.at_most ? *row.at_most - 1e6 : -1e9;
    };
    std::ranges::stable_sort(rows_, std::ranges::greater{}, strength);
}

std::size_t FitGhostModel::counted() const {
    return static_cast<std::size_t>(std::ranges::count(rows_, true, &Row::counts));
}

}  // namespace ghostlight
