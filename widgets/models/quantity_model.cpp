#include "widgets/models/quantity_model.h"

#include <QCoreApplication>
#include <QStringList>

#include <array>
#include <cmath>
#include <utility>

#include "widgets/models/column_header.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

constexpr std::array<const char*, QuantityModel::column_count> headers = {
    QT_TRANSLATE_NOOP("QuantityModel", "Quantity"), QT_TRANSLATE_NOOP("QuantityModel", "Value"),
    QT_TRANSLATE_NOOP("QuantityModel", "Unit")};

/// As lens_quantities() names them.
[[maybe_unused]] constexpr std::array labels = {
    QT_TRANSLATE_NOOP("LensQuantities", "Focal length"),
    QT_TRANSLATE_NOOP("LensQuantities", "Back focal distance"),
    QT_TRANSLATE_NOOP("LensQuantities", "Front focal distance"),
    QT_TRANSLATE_NOOP("LensQuantities", "F-number"),
    QT_TRANSLATE_NOOP("LensQuantities", "Entrance pupil, place"),
    QT_TRANSLATE_NOOP("LensQuantities", "Entrance pupil, radius"),
    QT_TRANSLATE_NOOP("LensQuantities", "Exit pupil, place"),
    QT_TRANSLATE_NOOP("LensQuantities", "Exit pupil, radius"),
    QT_TRANSLATE_NOOP("LensQuantities", "Sensor distance"),
    QT_TRANSLATE_NOOP("LensQuantities", "Defocus"),
    QT_TRANSLATE_NOOP("LensQuantities", "Ghosts"),
    QT_TRANSLATE_NOOP("LensQuantities", "Front principal point"),
    QT_TRANSLATE_NOOP("LensQuantities", "Rear principal point"),
    QT_TRANSLATE_NOOP("LensQuantities", "Front nodal point"),
    QT_TRANSLATE_NOOP("LensQuantities", "Rear nodal point"),
    QT_TRANSLATE_NOOP("LensQuantities", "Pupil magnification"),
    QT_TRANSLATE_NOOP("LensQuantities", "Working f-number"),
    QT_TRANSLATE_NOOP("LensQuantities", "Numerical aperture"),
    QT_TRANSLATE_NOOP("LensQuantities", "Image height"),
    QT_TRANSLATE_NOOP("LensQuantities", "Half field, to the corner"),
    QT_TRANSLATE_NOOP("LensQuantities", "Half field, to first order"),
    QT_TRANSLATE_NOOP("LensQuantities", "Half field, horizontal"),
    QT_TRANSLATE_NOOP("LensQuantities", "Half field, vertical"),
    QT_TRANSLATE_NOOP("LensQuantities", "Total track"),
    QT_TRANSLATE_NOOP("LensQuantities", "Petzval sum"),
    QT_TRANSLATE_NOOP("LensQuantities", "Higher reflections")};

/// Below this, against lengths of millimetres, a number is 0 but for rounding.
constexpr double rounding = 1e-12;

QString text_of(const Cell& cell) {
    if (const auto* number = std::get_if<double>(&cell)) {
        if (std::isnan(*number)) {
            return QStringLiteral("–");
        }
        if (std::isinf(*number)) {
            return *number < 0.0 ? QStringLiteral("−∞") : QStringLiteral("∞");
        }
        return significant(std::abs(*number) < rounding ? 0.0 : *number, 5);
    }
    if (const auto* count = std::get_if<std::int64_t>(&cell)) {
        return grouped(static_cast<qulonglong>(*count));
    }
    return QStringLiteral("–");
}

}  // namespace

int QuantityModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(quantities_.size());
}

int QuantityModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : column_count;
}

QVariant QuantityModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || index.row() >= rowCount()) {
        return {};
    }
    const LensQuantity& quantity = quantities_[static_cast<std::size_t>(index.row())];
    switch (role) {
        case Qt::DisplayRole:
            return index.column() == name
                       ? QCoreApplication::translate("LensQuantities", quantity.label.c_str())
                   : index.column() == value ? text_of(quantity.value)
                                             : QString::fromStdString(quantity.unit);
        case Qt::ToolTipRole:
            return tr("%1\nIn files: %2")
                .arg(QString::fromStdString(quantity.definition),
                     QString::fromStdString(quantity.name));
        case Qt::TextAlignmentRole:
            return QVariant::fromValue(Qt::AlignVCenter |
                                       (index.column() == value ? Qt::AlignRight : Qt::AlignLeft));
        case stale_role:
            return stale_;
        case Qt::ForegroundRole:
            return index.column() == unit ? QVariant(current_palette().dim) : QVariant();
        default:
            return {};
    }
}

QVariant QuantityModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= column_count) {
        return {};
    }
    return column_header("QuantityModel", headers[static_cast<std::size_t>(section)], nullptr,
                         section == value ? Qt::AlignRight : Qt::AlignLeft, role);
}

void QuantityModel::set_quantities(std::vector<LensQuantity> quantities) {
    stale_ = false;
    const bool same_rows = quantities.size() == quantities_.size();
    if (same_rows && rowCount() > 0) {
        // The rows stay where they are for views; only their numbers are others.
        quantities_ = std::move(quantities);
        Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, column_count - 1));
        return;
    }
    beginResetModel();
    quantities_ = std::move(quantities);
    endResetModel();
}

void QuantityModel::set_stale(bool stale) {
    stale_ = stale;
    if (rowCount() > 0) {
        Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, column_count - 1), {stale_role});
    }
}

QString QuantityModel::clipboard_text(const std::vector<int>& rows) const {
    QStringList lines = {QStringLiteral("quantity\tvalue")};
    for (const int row : rows) {
        const LensQuantity& quantity = quantities_[static_cast<std::size_t>(row)];
        lines << QString::fromStdString(quantity.name + '\t' + exact_text(quantity.value));
    }
    return lines.join('\n') + '\n';
}

}  // namespace ghostlight
