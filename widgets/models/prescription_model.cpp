#include "widgets/models/prescription_model.h"

#include <QBrush>
#include <QFont>

#include <array>
#include <utility>

#include "core/io/lens_file.h"
#include "core/units.h"
#include "widgets/models/cell_text.h"
#include "widgets/models/coating_color.h"
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
    {"#", "", "Surfaces count from 1, in the order in which light meets them."},
    {"Radius mm", "radius",
     "Positive when the centre of curvature lies towards the sensor.\n"
     "Empty or 'plane' for a plane; 'c=0.01' gives a curvature in 1/mm."},
    {"Thickness mm", "thickness",
     "To the next surface; the last one to the sensor.\n"
     "In a configuration that sets it, its own value."},
    {"nd / Vd", "glass",
     "What follows the surface: a catalogue name, 'nd / Vd' or an index.\nEmpty for air."},
    {"Semi-dia. mm", "semi-diameter", "Clear radius. Rays beyond it are clipped."},
    {"Conic", "conic constant", "0 sphere, −1 paraboloid, below −1 hyperboloid."},
    {"Asphere", "aspheric terms", "Even terms of the sag, A4 r⁴ + A6 r⁶ + …, in mm^(1−power)."},
    {"Coating", "coating",
     "none, MgF2 λ/4 550, 1.38 λ/4 550, ideal λ/4 550,\n"
     "or a stack from the light's side: 1.38:96.4 | 2.1:50 (nm).\n"
     "The chip is the reflected colour under the chosen light."},
    {"Comment", "comment", ""},
}};

bool is_number(int column) {
    return column != PrescriptionModel::coating && column != PrescriptionModel::comment &&
           column != PrescriptionModel::aspheric;
}

QString true_minus(QString text) { return text.replace('-', QChar(0x2212)); }

QString shown_curve(const BaseCurve& curve) {
    if (const auto* radius = std::get_if<Radius>(&curve)) {
        return at_least_decimals(radius->mm, 3);
    }
    const double curvature = curvature_per_mm(curve);
    return curvature == 0.0 ? QStringLiteral("plane") : significant(1.0 / curvature, 7);
}

std::string field_key(const QModelIndex& index, const std::string& configuration) {
    return std::to_string(index.row()) + '/' + std::to_string(index.column()) + '/' + configuration;
}

/// What was typed; of a size that was worked out, as many digits as mean something.
QString shown_size(double mm) {
    constexpr int most_digits = 7;
    const QString typed = at_least_decimals(mm, 2);
    return typed.size() > most_digits + 2 ? significant(mm, most_digits) : typed;
}

bool is_unknown(const Medium& medium) {
    return std::holds_alternative<UnknownGlass>(medium.dispersion);
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
    spectrum_ = scene.light().spectrum;
    // Every row's number changes below an insertion, so that no row is just where it was, moved.
    const bool other_rows = shown_.surfaces.size() != lens.surfaces.size();
    if (other_rows) {
        beginResetModel();
    }
    shown_ = lens;
    chips_.clear();
    for (std::size_t row = 0; row < shown_.surfaces.size(); ++row) {
        const Surface& surface = shown_.surfaces[row];
        chips_.push_back(coating_color(medium_before(shown_, row), surface.coating,
                                       surface.medium_after, spectrum_));
    }
    if (other_rows) {
        endResetModel();
    } else if (rowCount() > 0) {
        Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, column_count - 1));
    }
}

QString PrescriptionModel::display_text(std::size_t row, int column) const {
    const Surface& surface = shown_.surfaces[row];
    switch (column) {
        case number:
            return QString::number(row + 1);
        case radius:
            return is_stop(row) && std::holds_alternative<Plane>(surface.curve)
                       ? QStringLiteral("stop")
                       : shown_curve(surface.curve);
        case thickness:
            return at_least_decimals(thickness_mm(shown_, configuration_, row), 3);
        case medium: {
            const QString text = text_of_medium(surface.medium_after);
            if (surface.medium_after.name.empty()) {
                return true_minus(text);
            }
            // With a mark, too, for whoever does not see the colour.
            return is_unknown(surface.medium_after) ? text + QStringLiteral(" ?") : text;
        }
        case semi_diameter:
            return shown_size(surface.semi_diameter_mm);
        case conic:
            return surface.conic == 0.0 ? QString() : at_least_decimals(surface.conic, 3);
        case aspheric:
            return true_minus(text_of_aspheric(surface.aspheric));
        case coating: {
            if (!std::holds_alternative<Uncoated>(surface.coating)) {
                return QString::fromStdString(describe(surface.coating));
            }
            const bool glass_before = !is_air(medium_before(shown_, row));
            const bool glass_after = !is_air(surface.medium_after);
            return glass_before && glass_after   ? QStringLiteral("cemented")
                   : glass_before || glass_after ? QStringLiteral("none")
                                                 : QString();
        }
        default:
            return QString::fromStdString(surface.comment);
    }
}

QString PrescriptionModel::edit_text(std::size_t row, int column) const {
    const Surface& surface = shown_.surfaces[row];
    switch (column) {
        case radius:
            return text_of_curve(surface.curve);
        case thickness:
            return shortest(thickness_mm(shown_, configuration_, row));
        case medium:
            return text_of_medium(surface.medium_after);
        case semi_diameter:
            return shortest(surface.semi_diameter_mm);
        case conic:
            return shortest(surface.conic);
        case aspheric:
            return text_of_aspheric(surface.aspheric);
        case coating:
            return text_of_coating(surface.coating);
        default:
            return display_text(row, column);
    }
}

QString PrescriptionModel::tool_tip(std::size_t row, int column) const {
    const Surface& surface = shown_.surfaces[row];
    if (column == medium && is_unknown(surface.medium_after)) {
        const QStringList names = offered_glasses(surface.medium_after);
        return why_unknown(shown_, row) +
               (names.isEmpty() ? QString()
                                : QStringLiteral("\nNearest names: %1").arg(names.join(", "))) +
               QStringLiteral("\nType a catalogue name, or nd / Vd.");
    }
    if (column == medium && !is_air(surface.medium_after)) {
        try {
            return QStringLiteral("nd %1, Vd %2")
                .arg(significant(refractive_index(surface.medium_after, d_line_nm), 6),
                     significant(abbe_number(surface.medium_after)));
        } catch (const Error& error) {
            return error.what();
        }
    }
    if (column == thickness && overrides_thickness(shown_, configuration_, row)) {
        return QStringLiteral("Set by the configuration %1; as listed %2 mm")
            .arg(QString::fromStdString(configuration_), shortest(surface.thickness_mm));
    }
    if (column == thickness && row + 1 == shown_.surfaces.size()) {
        return shown_.sensor.at_paraxial_focus
                   ? QStringLiteral("The sensor is at the paraxial focus instead.")
                   : QStringLiteral("To the sensor");
    }
    if (column == coating || column == aspheric || column == comment) {
        return edit_text(row, column);
    }
    return {};
}

QVariant PrescriptionModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || row_of(index) >= shown_.surfaces.size()) {
        return {};
    }
    const std::size_t row = row_of(index);
    const int column = index.column();
    switch (role) {
        case Qt::DisplayRole:
            return display_text(row, column);
        case Qt::EditRole:
            return edit_text(row, column);
        case Qt::ToolTipRole:
            return tool_tip(row, column);
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
            if (is_stop(row) || column == number || replaced || bare) {
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
    const ColumnText& column = columns[static_cast<std::size_t>(section)];
    switch (role) {
        case Qt::DisplayRole:
            return QString::fromUtf8(column.header);
        case Qt::ToolTipRole:
            return QString::fromUtf8(column.tip);
        case Qt::TextAlignmentRole:
            return QVariant::fromValue(Qt::AlignVCenter |
                                       (is_number(section) ? Qt::AlignRight : Qt::AlignLeft));
        default:
            return {};
    }
}

Qt::ItemFlags PrescriptionModel::flags(const QModelIndex& index) const {
    const auto flags = QAbstractTableModel::flags(index);
    return index.isValid() && index.column() != number ? flags | Qt::ItemIsEditable : flags;
}

Prescription PrescriptionModel::edited(const QModelIndex& index, const QString& text) const {
    Prescription lens = document_.lens();
    const std::size_t row = row_of(index);
    Surface& surface = lens.surfaces.at(row);
    switch (index.column()) {
        case radius:
            surface.curve = read_curve(text);
            break;
        case thickness:
            lens = with_thickness(std::move(lens), configuration_, row,
                                  read_number(text, "a thickness in mm"));
            break;
        case medium:
            surface.medium_after = read_medium(text, bundled_glasses());
            break;
        case semi_diameter:
            surface.semi_diameter_mm = read_positive(text, "a semi-diameter in mm, above 0");
            surface.semi_diameter_sized = false;
            break;
        case conic:
            surface.conic = text.trimmed().isEmpty() ? 0.0 : read_number(text, "a conic constant");
            break;
        case aspheric:
            surface.aspheric = read_aspheric(text);
            break;
        case coating:
            surface.coating = read_coating(text, bundled_glasses());
            break;
        case comment:
            surface.comment = text.trimmed().toStdString();
            break;
        default:
            break;
    }
    bool was_sound = true;
    try {
        validate(document_.lens());
    } catch (const Error&) {
        was_sound = false;  // it came like this; an edit that repairs one of two faults is welcome
    }
    if (was_sound) {
        validate(lens);
    }
    return lens;
}

QString PrescriptionModel::refusal(const QModelIndex& index, const QString& text) const {
    if (!index.isValid() || text == data(index, Qt::EditRole).toString()) {
        return {};
    }
    try {
        edited(index, text);
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
        document_.edit_lens(edited(index, text),
                            QStringLiteral("change %1 of surface %2")
                                .arg(columns[static_cast<std::size_t>(index.column())].what)
                                .arg(index.row() + 1),
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
    return attempt(QStringLiteral("insert surface %1").arg(row + 2), [&](Prescription lens) {
        return with_row_inserted_after(std::move(lens), static_cast<std::size_t>(row));
    });
}

bool PrescriptionModel::remove(int row) {
    return attempt(QStringLiteral("delete surface %1").arg(row + 1), [&](Prescription lens) {
        return with_row_removed(std::move(lens), static_cast<std::size_t>(row));
    });
}

bool PrescriptionModel::move(int row, int to) {
    return attempt(QStringLiteral("move surface %1").arg(row + 1), [&](Prescription lens) {
        return with_row_moved(std::move(lens), static_cast<std::size_t>(row),
                              static_cast<std::size_t>(to));
    });
}

bool PrescriptionModel::make_stop(int row) {
    return attempt(QStringLiteral("make surface %1 the stop").arg(row + 1), [&](Prescription lens) {
        return with_stop_at(std::move(lens), static_cast<std::size_t>(row));
    });
}

}  // namespace ghostlight
