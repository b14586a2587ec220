#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QStandardItemModel>
#include <QTableView>
#include <QToolButton>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/optics/coating_curves.h"
#include "core/units.h"
#include "widgets/coating_edits.h"
#include "widgets/document.h"
#include "widgets/models/cell_text.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"
#include "widgets/panel_header.h"
#include "widgets/panels/coating_panel.h"
#include "widgets/panels/curve_chart.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/table_delegate.h"

// What the coating panel shows of the surface in hand.

namespace ghostlight {

namespace {

constexpr double design_nm = 550.0;
constexpr double first_nm = 380.0, last_nm = 780.0;
constexpr double steepest_deg = 70.0;
constexpr int points = 121;

QString index_text(const Medium& medium) {
    try {
        return QString::number(refractive_index(medium, design_nm), 'f', 4);
    } catch (const Error&) {
        return QStringLiteral("–");
    }
}

QList<QStandardItem*> cells(const QStringList& texts, const std::vector<bool>& editable) {
    constexpr int text_column = 1;
    QList<QStandardItem*> row;
    for (int column = 0; column < texts.size(); ++column) {
        auto* item = new QStandardItem(texts[column]);
        item->setEditable(editable[static_cast<std::size_t>(column)]);
        item->setTextAlignment(Qt::AlignVCenter |
                               (column == text_column ? Qt::AlignLeft : Qt::AlignRight));
        if (!item->isEditable()) {
            item->setForeground(current_palette().dim);
        }
        row << item;
    }
    return row;
}

std::vector<CurveChart::Curve> curves_of(const std::vector<CurvePoint>& points_of_curve) {
    const Palette& colors = current_palette();
    std::vector<CurveChart::Curve> curves = {{"s", {}, colors.teal, true},
                                             {"p", {}, colors.red_orange, true},
                                             {"mean", {}, colors.text, false}};
    for (const CurvePoint& at : points_of_curve) {
        curves[0].points.emplace_back(at.x, 100.0 * at.r_s);
        curves[1].points.emplace_back(at.x, 100.0 * at.r_p);
        curves[2].points.emplace_back(at.x, 100.0 * at.mean());
    }
    return curves;
}

}  // namespace

void CoatingPanel::show_coating() {
    show_content(!document_.is_empty());
    if (!document_.is_empty() && row_ < 0) {
        row_ = 0;
    }
    if (!has_surface()) {
        header().set_state(QString());
        return;
    }
    const auto row = static_cast<std::size_t>(row_);
    const Medium& before = medium_before(document_.lens(), row);
    const Medium& after = document_.lens().surfaces[row].medium_after;
    header().set_state(tr("surface %1 · %2 to %3")
                           .arg(QString::number(row + 1), QString::fromStdString(describe(before)),
                                QString::fromStdString(describe(after))));
    int at = static_cast<int>(kind_of(coating()));
    if (const auto* stack = std::get_if<LayerStack>(&coating())) {
        const int named =
            stack->name.empty() ? -1 : kind_->findText(QString::fromStdString(stack->name));
        at = named >= 0 ? named : at;
    }
    kind_->setCurrentIndex(at);
    show_layers();
    show_ghosts();
    show_curves();
}

void CoatingPanel::show_layers() {
    is_filling_ = true;
    const int kept = table_->currentIndex().row();
    const int kept_column = table_->currentIndex().column();
    QList<QList<QStandardItem*>> rows;
    QString thickness_header = "nm";
    if (const auto* stack = std::get_if<LayerStack>(&coating())) {
        int number = 0;
        for (const Layer& layer : stack->layers) {
            const QString name = layer.medium.name.empty()
                                     ? index_text(layer.medium)
                                     : QString::fromStdString(layer.medium.name);
            rows << cells(
                {QString::number(++number), name, index_text(layer.medium),
                 shortest(layer.thickness_nm),
                 layer.extinction_table.empty() ? shortest(layer.extinction) : tr("table")},
                {false, true, false, true, true});
        }
    } else if (const auto* quarter = std::get_if<QuarterWave>(&coating())) {
        const auto* medium = std::get_if<Medium>(&quarter->layer);
        thickness_header = tr("centre nm");
        rows << cells({"1",
                       medium == nullptr       ? "ideal"
                       : !medium->name.empty() ? QString::fromStdString(medium->name)
                                               : index_text(*medium),
                       medium == nullptr ? "√(n n′)" : index_text(*medium),
                       shortest(quarter->center_nm), "0"},
                      {false, true, false, true, false});
    } else if (const auto* fixed = std::get_if<ConstantReflectance>(&coating())) {
        thickness_header = "R %";
        rows << cells(
            {"1", tr("at every wavelength"), "", shortest(fixed->reflectance * 100.0), ""},
            {false, false, false, true, false});
    }
    model_->setRowCount(0);
    for (const auto& row : rows) {
        model_->appendRow(row);
    }
    model_->horizontalHeaderItem(thickness_column)->setText(thickness_header);
    const bool from_air =
        std::holds_alternative<LayerStack>(coating()) && std::get<LayerStack>(coating()).from_air;
    model_->horizontalHeaderItem(number_column)->setText(from_air ? tr("# air") : "#");
    fit_columns(*table_);
    table_->setVisible(!rows.isEmpty());
    constexpr int most_shown = 6;
    table_->setFixedHeight(table_->horizontalHeader()->sizeHint().height() + 4 +
                           std::min(model_->rowCount(), most_shown) * table_row_height);
    if (kept >= 0 && kept < model_->rowCount()) {
        table_->setCurrentIndex(model_->index(kept, kept_column));
    }
    const bool is_stack = std::holds_alternative<LayerStack>(coating());
    remove_->setEnabled(is_stack);
    turn_->setEnabled(is_stack);
    is_filling_ = false;
}

QString CoatingPanel::ghosts_text() const { return fed_label_->text(); }

void CoatingPanel::show_ghosts() {
    fed_ = ghosts_ ? ghosts_of_surface(*ghosts_, static_cast<std::size_t>(row_))
                   : std::vector<SurfaceGhost>();
    if (fed_.empty()) {
        fed_label_->setText(ghosts_ ? tr("No ghost turns here.")
                                    : tr("The ghosts are not traced yet."));
        return;
    }
    QStringList named;
    for (std::size_t k = 0; k < std::min<std::size_t>(fed_.size(), 2); ++k) {
        const SurfaceGhost& ghost = fed_[k];
        named << tr("<a href=\"%1\">%2</a> %3 mm², met at %4° (up to %5°) %6")
                     .arg(QString::number(k),
                          QString::fromStdString(name(ghost.path, ghosts_->surface_count)),
                          significant(ghost.flux_mm2, 3),
                          QString::number(ghost.turn.incidence_deg, 'f', 1),
                          QString::number(ghost.turn.largest_incidence_deg, 'f', 1),
                          ghost.from_front ? tr("from the front") : tr("from behind"));
    }
    fed_label_->setText(tr("Feeds most: ") + named.join(tr("<br>then ")));
    if (!side_is_chosen_) {
        side_->setCurrentIndex(fed_.front().from_front ? 0 : 1);
    }
}

void CoatingPanel::show_curves() {
    if (!has_surface()) {
        return;
    }
    const auto row = static_cast<std::size_t>(row_);
    const bool from_front = side_->currentIndex() == 0;
    const CoatedSurface surface{coating(), medium_before(document_.lens(), row),
                                document_.lens().surfaces[row].medium_after, from_front};
    const double nm =
        std::clamp(parse_number(wavelength_->text()).value_or(design_nm), 200.0, 4000.0);
    std::vector<CurveChart::Mark> marks;
    double met_deg = 0.0;
    for (std::size_t k = 0; k < std::min<std::size_t>(fed_.size(), 2); ++k) {
        if (fed_[k].from_front != from_front) {
            continue;  // its angles are on the other side
        }
        if (marks.empty()) {
            met_deg = fed_[k].turn.incidence_deg;
        }
        marks.push_back({fed_[k].turn.incidence_deg, fed_[k].turn.largest_incidence_deg,
                         QString::fromStdString(name(fed_[k].path, ghosts_->surface_count))});
    }
    double last_deg = steepest_deg;
    try {
        // Total reflection would leave nothing to see of the coating.
        const double n_before = refractive_index(surface.before, nm);
        const double n_after = refractive_index(surface.after, nm);
        const double sine = from_front ? n_after / n_before : n_before / n_after;
        if (sine < 1.0) {
            last_deg = std::min(last_deg, std::floor(deg_from_rad(std::asin(sine))));
        }
    } catch (const Error&) {
        // Said below.
    }
    for (const CurveChart::Mark& mark : marks) {
        last_deg = std::clamp(mark.to + 2.0, last_deg, 90.0);
    }
    try {
        angle_chart_->show_curves(curves_of(over_angle(surface, nm, last_deg, points)), marks,
                                  tr("R % over angle, %1 nm").arg(shortest(nm)));
        wavelength_chart_->show_curves(
            curves_of(over_wavelength(surface, met_deg, first_nm, last_nm, points)), {},
            tr("R % over wavelength, %1°").arg(QString::number(met_deg, 'f', 1)));
    } catch (const Error& error) {
        angle_chart_->show_reason(error.what());
        wavelength_chart_->show_reason(error.what());
    }
}

}  // namespace ghostlight
