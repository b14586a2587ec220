#include "widgets/models/prescription_model.h"

#include <QBrush>
#include <QFont>

#include <array>
#include <utility>

#include "core/io/varied_cells.h"
#include "core/optics/mend.h"
#include "core/optics/reverse.h"
#include "widgets/models/coating_color.h"
#include "widgets/models/column_header.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"
#include "widgets/prescription_edits.h"
#include "widgets/unknown_glass.h"

namespace ghostlight {

namespace {

struct ColumnText {
    const char* header;
    const char* what;  ///< in the history: "change … of surface 3"
    const char* tip;
};

constexpr std::array<ColumnText, PrescriptionModel::column_count> columns = {{
    {"#", "",
     QT_TRANSLATE_NOOP("PrescriptionModel",
                       "Surfaces count from 1, in the order in which light meets them.")},
    {QT_TRANSLATE_NOOP("PrescriptionModel", "Radius mm"),
     QT_TRANSLATE_NOOP("PrescriptionModel", "radius"),
     QT_TRANSLATE_NOOP("PrescriptionModel",
                       "Positive when the centre of curvature lies towards the sensor.\n"
                       "Empty or 'plane' for a plane; 'c=0.01' gives a curvature in 1/mm.\n"
                       "Numbers may be worked out: =2*13.2, 0.5in, 1/3.")},
    {QT_TRANSLATE_NOOP("PrescriptionModel", "Thickness mm"),
     QT_TRANSLATE_NOOP("PrescriptionModel", "thickness"),
     QT_TRANSLATE_NOOP("PrescriptionModel",
                       "To the next surface; the last one to the sensor.\n"
                       "In a configuration that sets it, its own value.\n"
                       "Numbers may be worked out: =2*13.2, 0.5in, 1/3.")},
    {QT_TRANSLATE_NOOP("PrescriptionModel", "Glass"),
     QT_TRANSLATE_NOOP("PrescriptionModel", "glass"),
     QT_TRANSLATE_NOOP(
         "PrescriptionModel",
         "What follows the surface: a catalogue name, 'nd / Vd' or an index.\nEmpty for air.")},
    {QT_TRANSLATE_NOOP("PrescriptionModel", "nd / Vd"), "",
     QT_TRANSLATE_NOOP("PrescriptionModel",
                       "Index at the d line, 587.56 nm, and Abbe number of the named glass.")},
    {QT_TRANSLATE_NOOP("PrescriptionModel", "Semi-dia. mm"),
     QT_TRANSLATE_NOOP("PrescriptionModel", "semi-diameter"),
     QT_TRANSLATE_NOOP("PrescriptionModel",
                       "Clear radius. Rays beyond it are clipped.\n"
                       "A number fixes it; 'auto' lets the direct beam size it, marked A.")},
    {QT_TRANSLATE_NOOP("PrescriptionModel", "Conic"),
     QT_TRANSLATE_NOOP("PrescriptionModel", "conic constant"),
     QT_TRANSLATE_NOOP("PrescriptionModel", "0 sphere, −1 paraboloid, below −1 hyperboloid.")},
    {QT_TRANSLATE_NOOP("PrescriptionModel", "Asphere"),
     QT_TRANSLATE_NOOP("PrescriptionModel", "aspheric terms"),
     QT_TRANSLATE_NOOP("PrescriptionModel",
                       "Even terms of the sag, A4 r⁴ + A6 r⁶ + …, in mm^(1−power).")},
    {QT_TRANSLATE_NOOP("PrescriptionModel", "Coating"),
     QT_TRANSLATE_NOOP("PrescriptionModel", "coating"),
     QT_TRANSLATE_NOOP("PrescriptionModel",
                       "none, MgF2 λ/4 550, 1.38 λ/4 550, ideal λ/4 550,\n"
                       "or a stack from the light's side: 1.38:96.4 | 2.1:50 (nm).\n"
                       "The chip is the reflected colour under the chosen light.")},
    {QT_TRANSLATE_NOOP("PrescriptionModel", "Comment"),
     QT_TRANSLATE_NOOP("PrescriptionModel", "comment"),
     QT_TRANSLATE_NOOP("PrescriptionModel", "Words of your own; they change nothing.")},
}};

constexpr ColumnText curvature_column = {
    QT_TRANSLATE_NOOP("PrescriptionModel", "Curvature /mm"),
    QT_TRANSLATE_NOOP("PrescriptionModel", "curvature"),
    QT_TRANSLATE_NOOP(
        "PrescriptionModel",
        "1/R. Positive when the centre of curvature lies towards the sensor; 0 for a plane.\n"
        "'r=50' gives a radius in mm. Numbers may be worked out: 1/50, 1/2in.")};

bool is_number(int column) {
    return column != PrescriptionModel::coating && column != PrescriptionModel::comment &&
           column != PrescriptionModel::aspheric && column != PrescriptionModel::medium;
}

std::string field_key(const QModelIndex& index, const std::string& configuration) {
    return std::to_string(index.row()) + '/' + std::to_string(index.column()) + '/' + configuration;
}

bool is_unknown(const Medium& medium) {
    return std::holds_alternative<UnknownGlass>(medium.dispersion);
}

/// In the history.
QString step_name(const QModelIndex& index) {
    return PrescriptionModel::tr("change %1 of surface %2")
        .arg(QCoreApplication::translate("PrescriptionModel",
                                         columns[static_cast<std::size_t>(index.column())].what))
        .arg(index.row() + 1);
}

std::size_t row_of(const QModelIndex& index) { return static_cast<std::size_t>(index.row()); }

}  // namespace

PrescriptionModel::PrescriptionModel(Document& document, QObject* parent)
    : QAbstractTableModel(parent), document_(document) {
    connect(&document_, &Document::changed, this, &PrescriptionModel::follow_document);
    follow_document();
}

int PrescriptionModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(shown_.surfaces.size());
}

int PrescriptionModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : column_count;
}

void PrescriptionModel::follow_document() {
    const Prescription& lens = document_.lens();
    const Scene& scene = document_.scene();
    if (lens == shown_ && scene.configuration == configuration_ &&
        scene.light().spectrum == spectrum_) {
        return;  // the light moves, and nothing here changes
    }
    configuration_ = scene.configuration;
    const bool other_light = scene.light().spectrum != spectrum_;
    spectrum_ = scene.light().spectrum;
    // Every row's number changes below an insertion, so that no row is just where it was, moved.
    const bool other_rows = shown_.surfaces.size() != lens.surfaces.size();
    if (other_rows) {
        beginResetModel();
    }
    const Prescription before = std::exchange(shown_, lens);
    chips_.resize(shown_.surfaces.size());
    for (std::size_t row = 0; row < shown_.surfaces.size(); ++row) {
        const Surface& surface = shown_.surfaces[row];
        // While a radius is drawn, no colour changes.
        const bool is_as_before = !other_rows && !other_light &&
                                  before.surfaces[row].coating == surface.coating &&
                                  before.surfaces[row].medium_after == surface.medium_after &&
                                  medium_before(before, row) == medium_before(shown_, row);
        if (!is_as_before) {
            chips_[row] = coating_color(medium_before(shown_, row), surface.coating,
                                        surface.medium_after, spectrum_);
        }
    }
    if (other_rows) {
        endResetModel();
    } else if (rowCount() > 0) {
        Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, column_count - 1));
    }
}

QString PrescriptionModel::mark(std::size_t row, int column) const {
    const Surface& surface = shown_.surfaces[row];
    const std::string kind = vary_kind(surface, column);
    QString marks;
    if (!kind.empty() && varied(surface).contains(kind)) {
        marks += 'V';
    }
    if (column == semi_diameter && surface.semi_diameter_sized) {
        marks += 'A';
    }
    return marks;
}

QVariant PrescriptionModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || row_of(index) >= shown_.surfaces.size()) {
        return {};
    }
    const std::size_t row = row_of(index);
    const int column = index.column();
    switch (role) {
        case Qt::DisplayRole:
            return cell_text(shown(), row, column);
        case Qt::EditRole:
            return cell_edit_text(shown(), row, column);
        case Qt::ToolTipRole: {
            QString tip = cell_tool_tip(shown(), row, column);
            if (mark(row, column).contains('V')) {
                tip += tr("%1Variable in a fit").arg(tip.isEmpty() ? QString() : QString("\n"));
            }
            return tip;
        }
        case Qt::TextAlignmentRole:
            return QVariant::fromValue(Qt::AlignVCenter |
                                       (is_number(column) ? Qt::AlignRight : Qt::AlignLeft));
        case Qt::DecorationRole:
            // A transparent chip keeps the texts of a column in line.
            return column == coating ? chips_[row].value_or(QColor(Qt::transparent)) : QVariant();
        case Qt::FontRole:
            if (is_stop(row)) {
                QFont font;
                font.setItalic(true);
                return font;
            }
            return {};
        case Qt::BackgroundRole:
            return index.row() == marked_row_ ? QVariant(QBrush(current_palette().line))
                                              : QVariant();
        case offers_role:
            return column == medium ? QVariant(offered_glasses(shown_.surfaces[row].medium_after))
                                    : QVariant();
        case mark_role:
            return mark(row, column);
        case vary_kind_role:
            return QString::fromStdString(vary_kind(shown_.surfaces[row], column));
        case must_be_mended_role:
            return column == medium && is_unknown(shown_.surfaces[row].medium_after);
        case Qt::ForegroundRole: {
            if (column == medium && is_unknown(shown_.surfaces[row].medium_after)) {
                return current_palette().red_orange;
            }
            const bool replaced = column == thickness && row + 1 == shown_.surfaces.size() &&
                                  shown_.sensor.at_paraxial_focus;
            const bool bare =
                column == coating && std::holds_alternative<Uncoated>(shown_.surfaces[row].coating);
            if (is_stop(row) || column == number || column == dispersion || replaced || bare) {
                return current_palette().dim;
            }
            return {};
        }
        default:
            return {};
    }
}

QVariant PrescriptionModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= column_count) {
        return {};
    }
    const ColumnText& column = section == radius && curvatures_
                                   ? curvature_column
                                   : columns[static_cast<std::size_t>(section)];
    return column_header("PrescriptionModel", column.header, column.tip,
                         is_number(section) ? Qt::AlignRight : Qt::AlignLeft, role);
}

Qt::ItemFlags PrescriptionModel::flags(const QModelIndex& index) const {
    const auto flags = QAbstractTableModel::flags(index);
    const bool is_read_only = index.column() == number || index.column() == dispersion;
    return index.isValid() && !is_read_only ? flags | Qt::ItemIsEditable : flags;
}

QString PrescriptionModel::refusal(const QModelIndex& index, const QString& text) const {
    if (!index.isValid() || text == data(index, Qt::EditRole).toString()) {
        return {};
    }
    try {
        with_cell_text(shown(), row_of(index), index.column(), text);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

bool PrescriptionModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    if (role != Qt::EditRole || !index.isValid() || index.column() == number) {
        return false;
    }
    const QString text = value.toString();
    // A medium or layer that has no text of its own is kept as long as its cell is not changed.
    if (text == data(index, Qt::EditRole).toString()) {
        return true;
    }
    try {
        document_.edit_lens(with_cell_text(shown(), row_of(index), index.column(), text),
                            step_name(index),
                            QString::fromStdString(field_key(index, configuration_)));
        return true;
    } catch (const Error& error) {
        Q_EMIT refused(index, error.what());
        return false;
    }
}

void PrescriptionModel::set_marked_row(int row) {
    const int before = std::exchange(marked_row_, row);
    for (const int changed : {before, row}) {
        if (changed >= 0 && changed < rowCount()) {
            Q_EMIT dataChanged(index(changed, 0), index(changed, column_count - 1),
                               {Qt::BackgroundRole});
        }
    }
}

template <class Edit>
bool PrescriptionModel::attempt(const QString& text, const Edit& edit) {
    try {
        document_.edit_lens(edit(document_.lens()), text);
        return true;
    } catch (const Error& error) {
        Q_EMIT refused({}, error.what());
        return false;
    }
}

bool PrescriptionModel::insert_after(int row) {
    return attempt(tr("insert surface %1").arg(row + 2), [&](Prescription lens) {
        return with_row_inserted_after(std::move(lens), static_cast<std::size_t>(row));
    });
}

bool PrescriptionModel::remove(int row) {
    return attempt(tr("delete surface %1").arg(row + 1), [&](Prescription lens) {
        return with_row_removed(std::move(lens), static_cast<std::size_t>(row));
    });
}

bool PrescriptionModel::move(int row, int to) {
    return attempt(tr("move surface %1").arg(row + 1), [&](Prescription lens) {
        return with_row_moved(std::move(lens), static_cast<std::size_t>(row),
                              static_cast<std::size_t>(to));
    });
}

bool PrescriptionModel::make_stop(int row) {
    return attempt(tr("make surface %1 the stop").arg(row + 1), [&](Prescription lens) {
        return with_stop_at(std::move(lens), static_cast<std::size_t>(row));
    });
}

bool PrescriptionModel::reverse() {
    return attempt(tr("reverse the lens"), [](const Prescription& lens) { return reversed(lens); });
}

bool PrescriptionModel::scale(double factor) {
    return attempt(tr("scale the lens by %1").arg(shortest(factor)),
                   [&](const Prescription& lens) { return scaled(lens, factor); });
}

void PrescriptionModel::set_shows_curvatures(bool shown) {
    if (shown == curvatures_) {
        return;
    }
    curvatures_ = shown;
    Q_EMIT headerDataChanged(Qt::Horizontal, radius, radius);
    if (rowCount() > 0) {
        Q_EMIT dataChanged(index(0, radius), index(rowCount() - 1, radius));
    }
}

bool PrescriptionModel::set_texts(const std::vector<CellText>& cells, const QString& name) {
    return attempt(name, [&](const Prescription&) { return with_cell_texts(shown(), cells); });
}

std::vector<CellNumber> PrescriptionModel::numbers(const QModelIndex& index) const {
    return index.isValid() && row_of(index) < shown_.surfaces.size()
               ? cell_numbers(shown(), row_of(index), index.column())
               : std::vector<CellNumber>();
}

bool PrescriptionModel::set_number(const QModelIndex& index, std::size_t which, double value,
                                   int drag) {
    try {
        document_.edit_lens(with_cell_number(shown(), row_of(index), index.column(), which, value),
                            step_name(index),
                            QStringLiteral("drag/%1/%2")
                                .arg(drag)
                                .arg(QString::fromStdString(field_key(index, configuration_))));
        return true;
    } catch (const Error& error) {
        Q_EMIT refused(index, error.what());
        return false;
    }
}

void PrescriptionModel::set_varied(const QModelIndexList& cells, bool varies) {
    attempt(varies ? tr("mark as variable") : tr("mark as fixed"), [&](Prescription lens) {
        for (const QModelIndex& cell : cells) {
            Surface& surface = lens.surfaces.at(row_of(cell));
            const std::string kind = vary_kind(surface, cell.column());
            if (!kind.empty()) {
                ghostlight::set_varied(surface, kind, varies);
            }
        }
        return lens;
    });
}

void PrescriptionModel::set_own_thickness(int row, bool own) {
    attempt((own ? tr("give surface %1 a thickness of its own here")
                 : tr("take the thickness of surface %1 as listed"))
                .arg(row + 1),
            [&](Prescription lens) {
                return with_own_thickness(std::move(lens), configuration_,
                                          static_cast<std::size_t>(row), own);
            });
}

}  // namespace ghostlight
