#include "widgets/models/note_table_model.h"

#include <QFont>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "core/io/import_report.h"
#include "widgets/models/column_header.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

struct ColumnText {
    const char* header;
    const char* tip;
};

constexpr std::array<ColumnText, NoteTableModel::column_count> columns = {{
    {QT_TRANSLATE_NOOP("NoteTableModel", "Where"),
     QT_TRANSLATE_NOOP(
         "NoteTableModel",
         "The place in the file. Click a row that is about a surface to go to that surface.")},
    {QT_TRANSLATE_NOOP("NoteTableModel", "What became"),
     QT_TRANSLATE_NOOP(
         "NoteTableModel",
         "read, converted to another unit or form, assumed where the file says nothing,\n"
         "left out, or taken as it is and noticed as odd.")},
    {QT_TRANSLATE_NOOP("NoteTableModel", "For flare"),
     QT_TRANSLATE_NOOP("NoteTableModel",
                       "'matters': changes where ghosts land, or how bright they are.\n"
                       "'mend': the lens cannot be traced until this is mended.")},
    {QT_TRANSLATE_NOOP("NoteTableModel", "What"),
     QT_TRANSLATE_NOOP("NoteTableModel", "What was found.")},
    {QT_TRANSLATE_NOOP("NoteTableModel", "Proposal"),
     QT_TRANSLATE_NOOP("NoteTableModel", "What can be done about it.")},
}};

bool matters_to(const Note& note) {
    return note.matters_for_flare || note.severity == Note::Severity::error;
}

/// What has to be mended comes first, then what matters, each in the order of the file.
int urgency(const Note& note) {
    return note.severity == Note::Severity::error ? 2 : matters_to(note) ? 1 : 0;
}

QString text_of(std::string_view text) {
    return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

QString importance(const Note& note) {
    return note.severity == Note::Severity::error ? NoteTableModel::tr("mend")
           : note.matters_for_flare               ? NoteTableModel::tr("matters")
                                                  : QString();
}

}  // namespace

int NoteTableModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(notes_.size());
}

int NoteTableModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : column_count;
}

void NoteTableModel::set_notes(Notes notes, const Prescription& lens) {
    beginResetModel();
    notes_ = std::move(notes);
    std::ranges::stable_sort(notes_, std::greater{}, urgency);
    surfaces_.clear();
    for (const Note& note : notes_) {
        surfaces_.push_back(surface_of(note, notes_, lens));
    }
    endResetModel();
}

int NoteTableModel::count(Note::Severity least) const {
    return static_cast<int>(
        std::ranges::count_if(notes_, [&](const Note& note) { return note.severity >= least; }));
}

int NoteTableModel::count_what_matters() const {
    return static_cast<int>(std::ranges::count_if(notes_, matters_to));
}

QVariant NoteTableModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || index.row() >= rowCount()) {
        return {};
    }
    const auto row = static_cast<std::size_t>(index.row());
    const Note& note = notes_[row];
    const auto words = [&](int column) {
        switch (column) {
            case place:
                return QString::fromStdString(note.where);
            case fate:
                return text_of(fate_name(note.fate));
            case matters:
                return importance(note);
            case text:
                return QString::fromStdString(note.text);
            default:
                return QString::fromStdString(note.proposal);
        }
    };
    switch (role) {
        case Qt::DisplayRole:
            return words(index.column());
        case Qt::ToolTipRole: {
            const QString said = words(index.column());
            return index.column() == text || index.column() == proposal ? said : QString();
        }
        case Qt::TextAlignmentRole:
            return QVariant::fromValue(Qt::AlignVCenter | Qt::AlignLeft);
        case Qt::ForegroundRole:
            if (index.column() == matters ||
                (note.severity == Note::Severity::error && index.column() == text)) {
                return current_palette().red_orange;
            }
            // What needs no attention stands back behind what does.
            return matters_to(note) ? QVariant(current_palette().text)
                                    : QVariant(current_palette().dim);
        case Qt::FontRole:
            if (note.severity == Note::Severity::error && index.column() == matters) {
                QFont font;
                font.setWeight(QFont::DemiBold);
                return font;
            }
            return {};
        case matters_role:
            return matters_to(note);
        case surface_role:
            return surfaces_[row] ? static_cast<int>(*surfaces_[row]) : -1;
        default:
            return {};
    }
}

QVariant NoteTableModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= column_count) {
        return {};
    }
    const ColumnText& column = columns[static_cast<std::size_t>(section)];
    return column_header("NoteTableModel", column.header, column.tip, Qt::AlignLeft, role);
}

void NoteFilter::set_only_what_matters(bool only) {
    only_what_matters_ = only;
    invalidateFilter();
}

bool NoteFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
    return !only_what_matters_ ||
           sourceModel()->index(row, 0, parent).data(NoteTableModel::matters_role).toBool();
}

}  // namespace ghostlight
