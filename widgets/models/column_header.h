#pragma once

#include <QCoreApplication>
#include <QVariant>

namespace ghostlight {

/// What a column's header says to a role, for headerData(): its text, its tool tip where it has
/// one, both as `context` translates them, and where they stand.
inline QVariant column_header(const char* context, const char* text, const char* tip,
                              Qt::AlignmentFlag side, int role) {
    const auto translated = [context](const char* words) {
        return *words == '\0' ? QString() : QCoreApplication::translate(context, words);
    };
    switch (role) {
        case Qt::DisplayRole:
            return translated(text);
        case Qt::ToolTipRole:
            return tip != nullptr ? QVariant(translated(tip)) : QVariant();
        case Qt::TextAlignmentRole:
            return QVariant::fromValue(Qt::AlignVCenter | side);
        default:
            return {};
    }
}

}  // namespace ghostlight
