#include "widgets/models/fit_parameter_model.h"

#include <algorithm>
#include <array>
#include <utility>

#include "widgets/models/column_header.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

constexpr std::array<const char*, FitParameterModel::column_count> titles = {
    QT_TRANSLATE_NOOP("FitParameterModel", "Varies"),
    "",
    QT_TRANSLATE_NOOP("FitParameterModel", "Start"),
    QT_TRANSLATE_NOOP("FitParameterModel", "Lower"),
    QT_TRANSLATE_NOOP("FitParameterModel", "Upper"),
    QT_TRANSLATE_NOOP("FitParameterModel", "Prior ±"),
    QT_TRANSLATE_NOOP("FitParameterModel", "Fitted"),
    QT_TRANSLATE_NOOP("FitParameterModel", "Std. error"),
    "95 %",
    QT_TRANSLATE_NOOP("FitParameterModel", "Known")};
constexpr std::array<const char*, FitParameterModel::column_count> tips = {
    QT_TRANSLATE_NOOP("FitParameterModel", "A number of the lens; only what is marked is varied"),
    QT_TRANSLATE_NOOP("FitParameterModel", "Unit"),
    QT_TRANSLATE_NOOP("FitParameterModel", "The lens's own value, where the fit begins"),
    QT_TRANSLATE_NOOP("FitParameterModel", "The fit stays above this"),
    QT_TRANSLATE_NOOP("FitParameterModel", "The fit stays below this"),
    QT_TRANSLATE_NOOP("FitParameterModel",
                      "Standard deviation of what the shop makes, about the start"),
    QT_TRANSLATE_NOOP("FitParameterModel", "What explains the photographs best"),
    QT_TRANSLATE_NOOP("FitParameterModel", "Standard error, widened for the misfit"),
    QT_TRANSLATE_NOOP("FitParameterModel", "95 % interval; P by the number's profile likelihood"),
    QT_TRANSLATE_NOOP(
        "FitParameterModel",
        "Determined: narrower than half its prior. Weak: narrower, but by less. Prior: the "
        "photographs "
        "say nothing. Not felt: no visible ghost depends on it. At bound: its error means little")};

QColor color_of(FitKnowledge knowledge) {
    const Palette& colors = current_palette();
    switch (knowledge) {
        case FitKnowledge::determined:
            return colors.teal;
        case FitKnowledge::weak:
            return colors.text;
        case FitKnowledge::at_bound:
            return colors.red_orange;
        case FitKnowledge::prior:
        case FitKnowledge::not_felt:
            break;
    }
    return colors.dim;
}

bool is_same(const FitParameter& a, const FitParameter& b) {
    return a.kind == b.kind && a.rows == b.rows && a.layer == b.layer;
}

}  // namespace

int FitParameterModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int FitParameterModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : column_count;
}

const FittedNumber* FitParameterModel::number_of(const FitParameter& parameter) const {
    const auto at = std::ranges::find_if(
        numbers_, [&](const FittedNumber& each) { return is_same(each.parameter, parameter); });
    return at == numbers_.end() ? nullptr : &*at;
}

QVariant FitParameterModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) {
        return {};
    }
    const Row& row = rows_[static_cast<std::size_t>(index.row())];
    const FitParameter& p = row.parameter;
    const FittedNumber* number = row.varies ? number_of(p) : nullptr;
    const bool with_errors = number != nullptr && have_errors_;
    const bool has_error = with_errors && number->knowledge != FitKnowledge::not_felt;
    if (role == Qt::TextAlignmentRole) {
        const bool is_text = index.column() <= unit_of || index.column() == known;
        return QVariant((is_text ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    }
    if (role == Qt::CheckStateRole && index.column() == what) {
        return row.varies ? Qt::Checked : Qt::Unchecked;
    }
    if (role == Qt::ForegroundRole) {
        if (index.column() == known && with_errors) {
            return color_of(number->knowledge);
        }
        if (!row.varies || index.column() == unit_of ||
            (index.column() == interval && !has_error)) {
            return current_palette().dim;
        }
        return {};
    }
    if (role == Qt::EditRole) {
        switch (index.column()) {
            case lower:
                return shortest(p.lower);
            case upper:
                return shortest(p.upper);
            case prior:
                return shortest(p.prior);
            default:
                return {};
        }
    }
    if (role != Qt::DisplayRole) {
        return {};
    }
    switch (index.column()) {
        case what:
            return QString::fromStdString(name(p));
        case unit_of:
            return QString::fromStdString(unit(p));
        case start:
            return significant(p.start, 5);
        case lower:
            return significant(p.lower, 5);
        case upper:
            return significant(p.upper, 5);
        case prior:
            return significant(p.prior, 3);
        case fitted:
            return number != nullptr ? significant(number->value, 5) : QString();
        case error:
            return has_error ? significant(number->standard_error, 2) : QString();
        case interval:
            if (row.is_profiled && !has_error) {
                return tr("profile");
            }
            if (has_error) {
                const auto profile =
                    std::ranges::find(profiles_, static_cast<std::size_t>(number - numbers_.data()),
                                      &FittedProfile::number);
                if (profile != profiles_.end()) {
                    return QStringLiteral("%1 … %2 P")
                        .arg(significant(profile->low, 4), significant(profile->high, 4));
                }
            }
            return has_error ? QStringLiteral("%1 … %2").arg(significant(number->low, 4),
                                                             significant(number->high, 4))
                             : QString();
        case known:
            return with_errors ? QString::fromStdString(name(number->knowledge))
                               : (row.varies ? QString() : QStringLiteral("held"));
        default:
            return {};
    }
}

QVariant FitParameterModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= column_count) {
        return {};
    }
    const auto at = static_cast<std::size_t>(section);
    const bool is_text = section <= unit_of || section == known;
    return column_header("FitParameterModel", titles[at], tips[at],
                         is_text ? Qt::AlignLeft : Qt::AlignRight, role);
}

Qt::ItemFlags FitParameterModel::flags(const QModelIndex& index) const {
    Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
    if (index.column() == what) {
        flags |= Qt::ItemIsUserCheckable;
    }
    if (index.column() == lower || index.column() == upper || index.column() == prior) {
        flags |= Qt::ItemIsEditable;
    }
    return flags;
}

bool FitParameterModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    if (!index.isValid()) {
        return false;
    }
    std::vector<Row> wanted = rows_;
    Row& row = wanted[static_cast<std::size_t>(index.row())];
    if (role == Qt::CheckStateRole && index.column() == what) {
        row.varies = value.toInt() == Qt::Checked;
    } else if (role == Qt::EditRole && flags(index).testFlag(Qt::ItemIsEditable)) {
        const auto number = parse_number(value.toString());
        FitParameter& p = row.parameter;
        double& changed = index.column() == lower   ? p.lower
                          : index.column() == upper ? p.upper
                                                    : p.prior;
        if (number) {
            changed = *number;
        }
        const QString of = QString::fromStdString(name(p));
        if (!number) {
            Q_EMIT refused(tr("%1: “%2” is not a number").arg(of, value.toString()));
            return false;
        }
        if (!(p.lower < p.upper) || p.start < p.lower || p.start > p.upper) {
            Q_EMIT refused(
                tr("%1: bounds %2 … %3 do not hold the start %4")
                    .arg(of, significant(p.lower), significant(p.upper), significant(p.start)));
            return false;
        }
        if (!(p.prior > 0.0)) {
            Q_EMIT refused(tr("%1: the prior needs a width above 0").arg(of));
            return false;
        }
    } else {
        return false;
    }
    Q_EMIT edited(wanted);
    return true;
}

void FitParameterModel::set_rows(std::vector<Row> rows) {
    beginResetModel();
    rows_ = std::move(rows);
    endResetModel();
}

void FitParameterModel::set_numbers(std::vector<FittedNumber> numbers, bool have_errors) {
    numbers_ = std::move(numbers);
    have_errors_ = have_errors;
    if (!rows_.empty()) {
        Q_EMIT dataChanged(index(0, fitted), index(rowCount() - 1, known));
    }
}

}  // namespace ghostlight
