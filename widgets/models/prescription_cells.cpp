#include "widgets/models/prescription_cells.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/io/imported_lens.h"
#include "core/io/lens_file.h"
#include "core/units.h"
#include "widgets/models/cell_text.h"
#include "widgets/number_text.h"
#include "widgets/prescription_edits.h"
#include "widgets/unknown_glass.h"

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct PrescriptionCells {
    Q_DECLARE_TR_FUNCTIONS(PrescriptionCells)
};

using Column = PrescriptionColumns;

bool is_unknown(const Medium& medium) {
    return std::holds_alternative<UnknownGlass>(medium.dispersion);
}

QString true_minus(QString text) { return text.replace('-', QChar(0x2212)); }

QString shown_curve(const BaseCurve& curve, bool curvatures) {
    constexpr int digits = 7;
    const double c = curvature_per_mm(curve);
    if (curvatures) {
        const auto* given = std::get_if<Curvature>(&curve);
        return given != nullptr ? at_least_decimals(given->per_mm, 1) : significant(c, digits);
    }
    if (const auto* radius = std::get_if<Radius>(&curve)) {
        return at_least_decimals(radius->mm, 3);
    }
    return c == 0.0 ? QStringLiteral("plane") : significant(1.0 / c, digits);
}

/// What was typed; of a size that was worked out, as many digits as mean something.
QString shown_size(double mm) {
    constexpr int most_digits = 7;
    const QString typed = at_least_decimals(mm, 2);
    return typed.size() > most_digits + 2 ? significant(mm, most_digits) : typed;
}

QString glass_numbers(const Medium& medium) {
    return QStringLiteral("%1 / %2").arg(
        QString::number(refractive_index(medium, d_line_nm), 'f', 4),
        std::isfinite(abbe_number(medium)) ? QString::number(abbe_number(medium), 'f', 1) : "∞");
}

/// A curve as typed into the column of radii or of curvatures.
BaseCurve read_shown_curve(const QString& text, bool curvatures) {
    const QString plain = text.trimmed().toLower();
    if (plain.startsWith("r=")) {
        return read_curve(plain.mid(2));
    }
    const bool is_word = !plain.isEmpty() && plain[0].isLetter();
    if (!curvatures || plain.isEmpty() || (is_word && !plain.startsWith("sqrt"))) {
        return read_curve(text);
    }
    const double per_mm =
        read_number(text, PrescriptionCells::tr("a curvature in 1/mm"), CellUnit::per_mm);
    return per_mm == 0.0 ? BaseCurve(Plane{}) : BaseCurve(Curvature{per_mm});
}

bool is_automatic(const QString& text) {
    const QString plain = text.trimmed();
    return plain.compare("auto", Qt::CaseInsensitive) == 0 ||
           plain.compare("a", Qt::CaseInsensitive) == 0;
}

/// Writes the text, and judges nothing but itself.
void put_text(Prescription& lens, const ShownLens& shown, std::size_t row, int column,
              const QString& text) {
    Surface& surface = lens.surfaces.at(row);
    switch (column) {
        case Column::radius:
            surface.curve = read_shown_curve(text, shown.curvatures);
            break;
        case Column::thickness:
            lens = with_thickness(
                std::move(lens), shown.configuration, row,
                read_number(text, PrescriptionCells::tr("a thickness in mm"), CellUnit::mm));
            break;
        case Column::medium:
            surface.medium_after = read_medium(text, bundled_glasses());
            break;
        case Column::semi_diameter:
            surface.semi_diameter_sized = is_automatic(text);
            if (!surface.semi_diameter_sized) {
                surface.semi_diameter_mm = read_positive(
                    text, PrescriptionCells::tr("a semi-diameter in mm, above 0, or 'auto'"),
                    CellUnit::mm);
            } else if (row == lens.stop.surface) {
                throw Error(PrescriptionCells::tr(
                                "the stop's own radius is what sizes the beam: give it a number")
                                .toStdString());
            }
            break;
        case Column::conic:
            surface.conic = text.trimmed().isEmpty()
                                ? 0.0
                                : read_number(text, PrescriptionCells::tr("a conic constant"));
            break;
        case Column::aspheric:
            surface.aspheric = read_aspheric(text);
            break;
        case Column::coating:
            surface.coating = read_coating(text, bundled_glasses());
            break;
        case Column::comment:
            surface.comment = text.trimmed().toStdString();
            break;
        default:
            throw Error(PrescriptionCells::tr("this cell cannot be edited").toStdString());
    }
}

/// What the lens becomes once an edit is in: sized anew where it sizes itself, and judged.
Prescription settled(Prescription lens, const Prescription& before) {
    bool was_sound = true;
    try {
        validate(before);
    } catch (const Error&) {
        was_sound = false;  // it came like this; an edit that repairs one of two faults is welcome
    }
    if (was_sound) {
        validate(lens);
    }
    const bool sizes_itself = std::ranges::any_of(lens.surfaces, &Surface::semi_diameter_sized);
    if (!sizes_itself) {
        return lens;
    }
    try {
        Prescription sized = sized_again(lens);
        validate(sized);
        return sized;
    } catch (const Error&) {
        return lens;  // no beam gets through: the sizes before are as good as any
    }
}

}  // namespace

QString cell_text(const ShownLens& shown, std::size_t row, int column) {
    const Surface& surface = shown.lens.surfaces[row];
    switch (column) {
        case Column::number:
            return QString::number(row + 1);
        case Column::radius:
            return row == shown.lens.stop.surface && std::holds_alternative<Plane>(surface.curve)
                       ? PrescriptionCells::tr("stop")
                       : shown_curve(surface.curve, shown.curvatures);
        case Column::thickness:
            return at_least_decimals(thickness_mm(shown.lens, shown.configuration, row), 3);
        case Column::medium: {
            const QString text = text_of_medium(surface.medium_after);
            if (surface.medium_after.name.empty()) {
                return true_minus(text);
            }
            // With a mark, too, for whoever does not see the colour.
            return is_unknown(surface.medium_after) ? text + QStringLiteral(" ?") : text;
        }
        case Column::dispersion:
            if (surface.medium_after.name.empty() || is_unknown(surface.medium_after)) {
                return {};  // it says so itself
            }
            try {
                return glass_numbers(surface.medium_after);
            } catch (const Error&) {
                return QStringLiteral("–");  // no index at d; the tool tip says why
            }
        case Column::semi_diameter:
            return shown_size(surface.semi_diameter_mm);
        case Column::conic:
            return surface.conic == 0.0 ? QString() : at_least_decimals(surface.conic, 3);
        case Column::aspheric:
            return true_minus(text_of_aspheric(surface.aspheric));
        case Column::coating: {
            if (!std::holds_alternative<Uncoated>(surface.coating)) {
                return QString::fromStdString(describe(surface.coating));
            }
            const bool glass_before = !is_air(medium_before(shown.lens, row));
            const bool glass_after = !is_air(surface.medium_after);
            return glass_before && glass_after   ? PrescriptionCells::tr("cemented")
                   : glass_before || glass_after ? QStringLiteral("none")
                                                 : QString();
        }
        default:
            return QString::fromStdString(surface.comment);
    }
}

QString cell_edit_text(const ShownLens& shown, std::size_t row, int column) {
    const Surface& surface = shown.lens.surfaces[row];
    switch (column) {
        case Column::radius:
            return shown.curvatures ? shortest(curvature_per_mm(surface.curve))
                                    : text_of_curve(surface.curve);
        case Column::thickness:
            return shortest(thickness_mm(shown.lens, shown.configuration, row));
        case Column::medium:
            return text_of_medium(surface.medium_after);
        case Column::semi_diameter:
            return shortest(surface.semi_diameter_mm);
        case Column::conic:
            return shortest(surface.conic);
        case Column::aspheric:
            return text_of_aspheric(surface.aspheric);
        case Column::coating:
            return text_of_coating(surface.coating);
        default:
            return cell_text(shown, row, column);
    }
}

QString cell_tool_tip(const ShownLens& shown, std::size_t row, int column) {
    const Surface& surface = shown.lens.surfaces[row];
    const bool of_glass = column == Column::medium || column == Column::dispersion;
    if (of_glass && is_unknown(surface.medium_after)) {
        const QStringList names = offered_glasses(surface.medium_after);
        return why_unknown(shown.lens, row) +
               (names.isEmpty()
                    ? QString()
                    : PrescriptionCells::tr("\nNearest names: %1").arg(names.join(", "))) +
               PrescriptionCells::tr("\nType a catalogue name, or nd / Vd.");
    }
    if (of_glass && !is_air(surface.medium_after)) {
        try {
            return QStringLiteral("nd %1, Vd %2")
                .arg(significant(refractive_index(surface.medium_after, d_line_nm), 6),
                     significant(abbe_number(surface.medium_after)));
        } catch (const Error& error) {
            return error.what();
        }
    }
    if (column == Column::radius && !std::holds_alternative<Plane>(surface.curve)) {
        const double c = curvature_per_mm(surface.curve);
        return c == 0.0 ? QString()
               : shown.curvatures
                   ? PrescriptionCells::tr("Radius %1 mm").arg(significant(1.0 / c, 7))
                   : PrescriptionCells::tr("Curvature %1 /mm").arg(significant(c, 7));
    }
    if (column == Column::semi_diameter && row != shown.lens.stop.surface) {
        return surface.semi_diameter_sized
                   ? PrescriptionCells::tr(
                         "Automatic: lets the direct beam through, and follows edits.\n"
                         "Type a number to fix it.")
                   : PrescriptionCells::tr("Fixed. Type 'auto' to let the direct beam size it.");
    }
    if (column == Column::thickness && overrides_thickness(shown.lens, shown.configuration, row)) {
        return PrescriptionCells::tr("Set by the configuration %1; as listed %2 mm")
            .arg(QString::fromStdString(shown.configuration), shortest(surface.thickness_mm));
    }
    if (column == Column::thickness && row + 1 == shown.lens.surfaces.size()) {
        return shown.lens.sensor.at_paraxial_focus
                   ? PrescriptionCells::tr("The sensor is at the paraxial focus instead.")
                   : PrescriptionCells::tr("To the sensor");
    }
    if (column == Column::coating || column == Column::aspheric || column == Column::comment) {
        return cell_edit_text(shown, row, column);
    }
    return {};
}

Prescription with_cell_text(const ShownLens& shown, std::size_t row, int column,
                            const QString& text) {
    Prescription lens = shown.lens;
    put_text(lens, shown, row, column, text);
    return settled(std::move(lens), shown.lens);
}

Prescription with_cell_texts(const ShownLens& shown, const std::vector<CellText>& cells) {
    Prescription lens = shown.lens;
    for (const CellText& cell : cells) {
        if (cell.text == cell_edit_text(shown, cell.row, cell.column)) {
            continue;  // a medium or layer may have no text of its own
        }
        try {
            put_text(lens, shown, cell.row, cell.column, cell.text);
        } catch (const Error& error) {
            Error::Parts parts = error.parts();
            parts.where = "surface " + std::to_string(cell.row + 1);
            throw Error(std::move(parts));
        }
    }
    return settled(std::move(lens), shown.lens);
}

std::vector<CellNumber> cell_numbers(const ShownLens& shown, std::size_t row, int column) {
    constexpr double share = 0.3;  // of a length, to either side
    const Surface& surface = shown.lens.surfaces[row];
    switch (column) {
        case Column::radius: {
            const double c = curvature_per_mm(surface.curve);
            if (shown.curvatures || c == 0.0) {
                return {{PrescriptionCells::tr("Curvature"), "/mm", c,
                         std::max(share * std::abs(c), 0.005)}};
            }
            return {{PrescriptionCells::tr("Radius"), "mm", 1.0 / c, share / std::abs(c)}};
        }
        case Column::thickness: {
            const double mm = thickness_mm(shown.lens, shown.configuration, row);
            return {{PrescriptionCells::tr("Thickness"), "mm", mm,
                     std::max(share * std::abs(mm), 1.0)}};
        }
        case Column::medium: {
            const Medium& medium = surface.medium_after;
            if (const auto* model = std::get_if<ModelGlass>(&medium.dispersion)) {
                return {{"nd", "", model->nd, 0.1}, {"Vd", "", model->vd, 10.0}};
            }
            const auto* constant = std::get_if<ConstantIndex>(&medium.dispersion);
            if (constant != nullptr && medium.name.empty() && !is_air(medium)) {
                return {{PrescriptionCells::tr("Index"), "", constant->n, 0.1}};
            }
            return {};
        }
        case Column::semi_diameter:
            return {{PrescriptionCells::tr("Semi-diameter"), "mm", surface.semi_diameter_mm,
                     share * surface.semi_diameter_mm}};
        case Column::conic:
            return {{PrescriptionCells::tr("Conic"), "", surface.conic, 1.0}};
        case Column::aspheric: {
            std::vector<CellNumber> terms;
            // Two more than there are, so that a new one can be drawn up from 0.
            const std::size_t count = std::min<std::size_t>(surface.aspheric.size() + 2, 9);
            for (std::size_t k = 0; k < count; ++k) {
                const double power = 4.0 + 2.0 * static_cast<double>(k);
                const double value = k < surface.aspheric.size() ? surface.aspheric[k] : 0.0;
                // A new term's slider ends where the rim has moved by a fiftieth of a millimetre.
                const double rim = 0.02 / std::pow(surface.semi_diameter_mm, power);
                terms.push_back({QStringLiteral("A%1").arg(2 * k + 4),
                                 QStringLiteral("mm^−%1").arg(2 * k + 3), value,
                                 std::max(std::abs(value), rim)});
            }
            return terms;
        }
        case Column::coating:
            if (const auto* quarter = std::get_if<QuarterWave>(&surface.coating)) {
                return {{"λ0", "nm", quarter->center_nm, 200.0},
                        {PrescriptionCells::tr("Thickness factor"), "", quarter->thickness_factor,
                         0.5}};
            }
            if (const auto* fixed = std::get_if<ConstantReflectance>(&surface.coating)) {
                return {{"R", "", fixed->reflectance, 0.05}};
            }
            if (const auto* stack = std::get_if<LayerStack>(&surface.coating)) {
                std::vector<CellNumber> layers;
                for (std::size_t k = 0; k < stack->layers.size(); ++k) {
                    const double nm = stack->layers[k].thickness_nm;
                    layers.push_back({PrescriptionCells::tr("Layer %1").arg(k + 1), "nm", nm,
                                      std::max(0.5 * nm, 20.0)});
                }
                return layers;
            }
            return {};
        default:
            return {};
    }
}

Prescription with_cell_number(const ShownLens& shown, std::size_t row, int column,
                              std::size_t which, double value) {
    Prescription lens = shown.lens;
    Surface& surface = lens.surfaces.at(row);
    const auto numbers = cell_numbers(shown, row, column);
    if (which >= numbers.size()) {
        throw Error(PrescriptionCells::tr("there is no number in this cell").toStdString());
    }
    switch (column) {
        case Column::radius:
            if (numbers[0].unit == "/mm") {
                surface.curve = Curvature{value};
            } else if (value == 0.0 || (value < 0.0) != (numbers[0].value < 0.0)) {
                throw Error(PrescriptionCells::tr("a radius cannot be 0").toStdString());
            } else {
                surface.curve = Radius{value};
            }
            break;
        case Column::medium:
            if (auto* model = std::get_if<ModelGlass>(&surface.medium_after.dispersion)) {
                (which == 0 ? model->nd : model->vd) = value;
            } else {
                surface.medium_after.dispersion = ConstantIndex{value};
            }
            surface.medium_after.name.clear();  // it is no longer the glass of that name
            if (numbers[which].name != "Vd" && value < 1.0) {
                throw Error(PrescriptionCells::tr("an index is at least 1").toStdString());
            }
            break;
        case Column::aspheric:
            if (surface.aspheric.size() <= which) {
                surface.aspheric.resize(which + 1, 0.0);
            }
            surface.aspheric[which] = value;
            while (!surface.aspheric.empty() && surface.aspheric.back() == 0.0) {
                surface.aspheric.pop_back();
            }
            break;
        case Column::coating:
            if (auto* quarter = std::get_if<QuarterWave>(&surface.coating)) {
                (which == 0 ? quarter->center_nm : quarter->thickness_factor) = value;
            } else if (auto* fixed = std::get_if<ConstantReflectance>(&surface.coating)) {
                const bool lossless = fixed->transmittance == 1.0 - fixed->reflectance;
                fixed->reflectance = value;
                if (lossless) fixed->transmittance = 1.0 - value;
            } else if (auto* stack = std::get_if<LayerStack>(&surface.coating)) {
                stack->layers.at(which).thickness_nm = value;
                stack->name.clear();  // no longer the library's
            }
            // Throws for what no film can be.
            film_at(surface.coating, medium_before(lens, row), surface.medium_after, d_line_nm);
            break;
        default:
            put_text(lens, shown, row, column, shortest(value));
            break;
    }
    return settled(std::move(lens), shown.lens);
}

std::string vary_kind(const Surface& surface, int column) {
    switch (column) {
        case Column::radius:
            return curvature_per_mm(surface.curve) == 0.0 ? "" : "radius";
        case Column::thickness:
            return "gap";
        case Column::medium:
            return is_air(surface.medium_after) ? "" : "index";
        case Column::semi_diameter:
            return "semi-diameter";
        case Column::coating:
            return std::holds_alternative<QuarterWave>(surface.coating)           ? "center"
                   : std::holds_alternative<LayerStack>(surface.coating)          ? "thickness"
                   : std::holds_alternative<ConstantReflectance>(surface.coating) ? "reflectance"
                                                                                  : "";
        default:
            return {};
    }
}

}  // namespace ghostlight
