#pragma once

#include <QVariant>

namespace ghostlight {

/// What a column's header says to a role, for headerData(): its text, its tool tip where it has
/// one, and where they stand.
inline QVariant column_header(const char* text, const char* tip, Qt::AlignmentFlag side, int role) {
    switch (role) {
        case Qt::DisplayRole:
            return QString::fromUtf8(text);
        case Qt::ToolTipRole:
            return tip != nullptr ? QVariant(QString::fromUtf8(tip)) : QVariant();
        case Qt::TextAlignmentRole:
            return QVariant::fromValue(Qt::AlignVCenter | side);
        default:
            return {};
    }
}

}  // namespace ghostlight
