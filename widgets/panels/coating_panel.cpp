#include "widgets/panels/coating_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <QStandardItemModel>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "core/io/coating_library.h"
#include "core/optics/coating_curves.h"
#include "core/units.h"
#include "widgets/actions.h"
#include "widgets/coating_edits.h"
#include "widgets/document.h"
#include "widgets/models/cell_text.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"
#include "widgets/panel_header.h"
#include "widgets/panels/curve_chart.h"
#include "widgets/panels/empty_state.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/quiet_button.h"
#include "widgets/panels/table_delegate.h"
#include "widgets/selection.h"

namespace ghostlight {

namespace {

constexpr const char* what_is_here =
    "The coating of the surface chosen in the prescription: its layers, what it reflects, and the "
    "ghosts that it feeds.";
constexpr double design_nm = 550.0;
constexpr double first_nm = 380.0, last_nm = 780.0;
constexpr double steepest_deg = 70.0;
constexpr int points = 121;

enum Column { number_column, material_column, index_column, thickness_column, k_column };

constexpr const char* kind_names[coating_kinds] = {
    "None", "Quarter wave, MgF2", "Quarter wave, ideal", "Layers", "Constant R", "Measured table"};

QString index_text(const Medium& medium) {
    try {
        return QString::number(refractive_index(medium, design_nm), 'f', 4);
    } catch (const Error&) {
        return QStringLiteral("–");
    }
}

QList<QStandardItem*> cells(const QStringList& texts, const std::vector<bool>& editable) {
    QList<QStandardItem*> row;
    for (int column = 0; column < texts.size(); ++column) {
        auto* item = new QStandardItem(texts[column]);
        item->setEditable(editable[static_cast<std::size_t>(column)]);
        item->setTextAlignment(Qt::AlignVCenter |
                               (column == material_column ? Qt::AlignLeft : Qt::AlignRight));
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

CoatingPanel::CoatingPanel(Document& document, Selection& selection, const Actions& actions,
                           QWidget* parent)
    : QWidget(parent),
      document_(document),
      selection_(selection),
      header_(new PanelHeader("Coating")),
      empty_(new EmptyState(what_is_here, "Open a lens…")),
      pages_(new QStackedWidget),
      kind_(new QComboBox),
      model_(new QStandardItemModel(this)),
      table_(plain_table(model_, new TableDelegate(-1, -1, this))),
      add_(quiet_button("+ Layer", "A layer after the chosen one", false)),
      remove_(quiet_button("− Layer", "Take the chosen layer away", false)),
      turn_(quiet_button("⇅ Turn", "The same layers in reverse order", false)),
      fed_label_(new QLabel),
      side_(new QComboBox),
      wavelength_(new QLineEdit),
      wavelength_chart_(new CurveChart("R over wavelength", "nm")),
      angle_chart_(new CurveChart("R over angle", "°")),
      targets_(new QLineEdit) {
    setObjectName("coating_panel");
    build();
    connect(empty_, &EmptyState::action_triggered, &actions["file.open"], &QAction::trigger);
    update_.setSingleShot(true);
    update_.setInterval(0);
    connect(&update_, &QTimer::timeout, this, &CoatingPanel::show_coating);
    connect(&document_, &Document::changed, this, &CoatingPanel::follow);
    connect(&document_, &Document::opened, this, [this] {
        row_ = -1;
        ghosts_.reset();
        side_is_chosen_ = false;
    });
    show_coating();
}

void CoatingPanel::build() {
    for (const char* name : kind_names) {
        kind_->addItem(name);
    }
    kind_->insertSeparator(coating_kinds);
    try {
        for (const LibraryCoating& coating : coating_library()) {
            kind_->addItem(QString::fromStdString(coating.name));
            kind_->setItemData(kind_->count() - 1, QString::fromStdString(coating.title),
                               Qt::ToolTipRole);
        }
    } catch (const Error& error) {
        kind_->setToolTip(error.what());  // the plain kinds are there all the same
    }
    kind_->setAccessibleName("Kind of coating");
    model_->setHorizontalHeaderLabels({"#", "Material", "n 550", "nm", "k"});
    for (const int column : {number_column, index_column, thickness_column, k_column}) {
        model_->horizontalHeaderItem(column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    }
    model_->horizontalHeaderItem(number_column)
        ->setToolTip("Layers count from the side that light comes from, or from the air");
    model_->horizontalHeaderItem(material_column)
        ->setToolTip("MgF2, a catalogue name, or an index at every wavelength");
    model_->horizontalHeaderItem(thickness_column)
        ->setToolTip("Thickness in nm; arithmetic is taken: =550/4/1.38");
    model_->horizontalHeaderItem(k_column)->setToolTip(
        "Extinction k of n + ik; 0 for a layer that does not absorb");
    table_->setObjectName("layer_table");
    table_->setSelectionMode(QAbstractItemView::SingleSelection);
    table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    side_->addItems({"from the front", "from behind"});
    side_->setToolTip("From where the light comes: the angle is the one in the medium there");
    side_->setAccessibleName("Side that the light comes from");
    wavelength_->setText("550");
    wavelength_->setFixedWidth(56);
    wavelength_->setAccessibleName("Wavelength of the curve over the angle in nm");
    wavelength_->setToolTip("Wavelength of the curve over the angle, nm");
    targets_->setPlaceholderText("2-5, 8");
    targets_->setAccessibleName("Surfaces to copy the coating to");
    targets_->setToolTip("Surfaces that get the same coating: 2-5, 8");
    fed_label_->setWordWrap(true);
    fed_label_->setTextFormat(Qt::RichText);
    fed_label_->setTextInteractionFlags(Qt::LinksAccessibleByMouse | Qt::LinksAccessibleByKeyboard);

    auto* content = new QWidget;
    auto* column = new QVBoxLayout(content);
    column->setContentsMargins(0, 8, 0, 8);
    column->setSpacing(6);
    const auto add_row = [column](std::initializer_list<QWidget*> widgets) {
        auto* row = new QHBoxLayout;
        row->setContentsMargins(12, 0, 12, 0);
        row->setSpacing(6);
        for (QWidget* each : widgets) {
            row->addWidget(each);
        }
        row->addStretch(1);
        column->addLayout(row);
    };
    add_row({kind_, add_, remove_, turn_});
    column->addWidget(table_);
    auto* fed_row = new QHBoxLayout;
    fed_row->setContentsMargins(12, 0, 12, 0);
    fed_row->addWidget(fed_label_, 1);
    column->addLayout(fed_row);
    add_row({new QLabel("Light"), side_, new QLabel("at"), wavelength_, new QLabel("nm")});
    auto* charts = new QHBoxLayout;
    charts->setSpacing(0);
    charts->addWidget(angle_chart_, 1);
    charts->addWidget(wavelength_chart_, 1);
    column->addLayout(charts, 1);
    auto* copy = new QPushButton("Copy");
    auto* everywhere = new QPushButton("To all that face air");
    everywhere->setToolTip("The same coating on every surface between air and glass");
    add_row({new QLabel("Copy to"), targets_, copy, everywhere});

    auto* scroll = new QScrollArea;
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setWidgetResizable(true);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setWidget(content);
    pages_->addWidget(empty_);
    pages_->addWidget(scroll);
    auto* whole = new QVBoxLayout(this);
    whole->setContentsMargins(0, 0, 0, 0);
    whole->setSpacing(0);
    whole->addWidget(header_);
    whole->addWidget(pages_, 1);

    connect(kind_, &QComboBox::activated, this, &CoatingPanel::choose_kind);
    connect(model_, &QStandardItemModel::itemChanged, this, &CoatingPanel::change_layer);
    connect(add_, &QToolButton::clicked, this, [this] {
        change_stack("add a layer to the coating", [](LayerStack& stack, std::size_t at) {
            const Layer like =
                stack.layers.empty() ? Layer{magnesium_fluoride(), 100.0} : stack.layers[at];
            stack.layers.insert(stack.layers.begin() + static_cast<std::ptrdiff_t>(
                                                           std::min(at + 1, stack.layers.size())),
                                like);
        });
    });
    connect(remove_, &QToolButton::clicked, this, [this] {
        change_stack("remove a layer of the coating", [](LayerStack& stack, std::size_t at) {
            if (at < stack.layers.size()) {
                stack.layers.erase(stack.layers.begin() + static_cast<std::ptrdiff_t>(at));
            }
        });
    });
    connect(turn_, &QToolButton::clicked, this, [this] {
        change_stack("turn the coating",
                     [](LayerStack& stack, std::size_t) { std::ranges::reverse(stack.layers); });
    });
    connect(side_, &QComboBox::activated, this, [this] {
        side_is_chosen_ = true;
        show_curves();
    });
    connect(wavelength_, &QLineEdit::editingFinished, this, &CoatingPanel::show_curves);
    connect(copy, &QPushButton::clicked, this, &CoatingPanel::copy_to_targets);
    connect(targets_, &QLineEdit::returnPressed, this, &CoatingPanel::copy_to_targets);
    connect(everywhere, &QPushButton::clicked, this, [this] {
        std::vector<std::size_t> rows;
        const Prescription& lens = document_.lens();
        for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
            if (is_air(medium_before(lens, row)) != is_air(lens.surfaces[row].medium_after)) {
                rows.push_back(row);
            }
        }
        copy_to(rows);
    });
    connect(fed_label_, &QLabel::linkActivated, this, [this](const QString& link) {
        const auto at = static_cast<std::size_t>(link.toInt());
        if (at < fed_.size()) {
            selection_.set_ghosts({fed_[at].path});
        }
    });
}

bool CoatingPanel::has_surface() const {
    return row_ >= 0 && static_cast<std::size_t>(row_) < document_.lens().surfaces.size();
}

const Coating& CoatingPanel::coating() const {
    return document_.lens().surfaces[static_cast<std::size_t>(row_)].coating;
}

void CoatingPanel::set_row(int row) {
    if (row >= 0 && row != row_) {
        row_ = row;
        side_is_chosen_ = false;
        update_.start();
    }
}

void CoatingPanel::set_table(std::shared_ptr<const GhostTable> table) {
    ghosts_ = std::move(table);
    update_.start();
}

void CoatingPanel::follow() { update_.start(); }

template <class Edit>
bool CoatingPanel::attempt(const QString& text, const Edit& edit, const QString& field) {
    if (!has_surface()) {
        return false;
    }
    try {
        Prescription lens = document_.lens();
        edit(lens);
        for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
            const Surface& surface = lens.surfaces[row];
            if (surface.coating != document_.lens().surfaces[row].coating) {
                // Throws for what no film can be.
                film_at(surface.coating, medium_before(lens, row), surface.medium_after, d_line_nm);
            }
        }
        document_.edit_lens(std::move(lens), text, field);
        Q_EMIT refused({});
        return true;
    } catch (const Error& error) {
        Q_EMIT refused(error.what());
        update_.start();  // what was refused gives way to what is
        return false;
    }
}

void CoatingPanel::choose_kind(int at) {
    if (!has_surface()) {
        return;
    }
    const auto row = static_cast<std::size_t>(row_);
    const Medium& before = medium_before(document_.lens(), row);
    const Medium& after = document_.lens().surfaces[row].medium_after;
    attempt(QStringLiteral("change coating of surface %1").arg(row_ + 1), [&](Prescription& lens) {
        Coating& chosen = lens.surfaces[row].coating;
        if (at < coating_kinds) {
            chosen = as_kind(chosen, static_cast<CoatingKind>(at), before, after);
        } else if (const Coating* known = find_coating(kind_->itemText(at).toStdString())) {
            chosen = *known;
        }
    });
    update_.start();
}

void CoatingPanel::change_stack(const QString& what, void (*change)(LayerStack&, std::size_t)) {
    const int at = std::max(0, table_->currentIndex().row());
    attempt(what, [&](Prescription& lens) {
        const auto row = static_cast<std::size_t>(row_);
        LayerStack stack =
            as_stack(coating(), medium_before(lens, row), lens.surfaces[row].medium_after);
        change(stack, static_cast<std::size_t>(at));
        stack.name.clear();  // no longer the library's
        lens.surfaces[row].coating = stack.layers.empty() ? Coating(Uncoated{}) : Coating(stack);
    });
}

void CoatingPanel::change_layer(QStandardItem* item) {
    if (is_filling_) {
        return;
    }
    const auto at = static_cast<std::size_t>(item->row());
    const int column = item->column();
    const QString text = item->text();
    attempt(
        QStringLiteral("change coating of surface %1").arg(row_ + 1),
        [&](Prescription& lens) {
            Coating& changed = lens.surfaces[static_cast<std::size_t>(row_)].coating;
            if (auto* stack = std::get_if<LayerStack>(&changed)) {
                Layer& layer = stack->layers.at(at);
                if (column == material_column) {
                    layer.medium = read_layer_medium(text);
                } else if (column == thickness_column) {
                    layer.thickness_nm = read_number(text, "a thickness in nm", CellUnit::nm);
                } else {
                    layer.extinction = read_number(text, "an extinction, 0 or more");
                    layer.extinction_table = {};
                }
                stack->name.clear();
            } else if (auto* quarter = std::get_if<QuarterWave>(&changed)) {
                if (column == material_column) {
                    quarter->layer =
                        text.trimmed().compare("ideal", Qt::CaseInsensitive) == 0
                            ? std::variant<IdealIndex, Medium>(IdealIndex{})
                            : std::variant<IdealIndex, Medium>(read_layer_medium(text));
                } else {
                    quarter->center_nm =
                        read_positive(text, "a centre wavelength in nm", CellUnit::nm);
                }
            } else if (auto* fixed = std::get_if<ConstantReflectance>(&changed)) {
                const double share = read_number(text, "per cent, from 0 to 100") / 100.0;
                *fixed = ConstantReflectance{share, 1.0 - share};
            }
        },
        QStringLiteral("layer/%1/%2/%3").arg(row_).arg(item->row()).arg(column));
}

void CoatingPanel::copy_to(const std::vector<std::size_t>& rows) {
    if (!has_surface()) {
        return;
    }
    attempt(QStringLiteral("copy the coating of surface %1 to %2 surfaces")
                .arg(row_ + 1)
                .arg(rows.size()),
            [&](Prescription& lens) {
                const Coating copied = coating();
                for (const std::size_t row : rows) {
                    lens.surfaces[row].coating = copied;
                }
            });
}

void CoatingPanel::copy_to_targets() {
    try {
        copy_to(read_surfaces(targets_->text(), document_.lens().surfaces.size()));
    } catch (const Error& error) {
        Q_EMIT refused(error.what());
    }
}

void CoatingPanel::show_coating() {
    pages_->setCurrentIndex(document_.is_empty() ? 0 : 1);
    if (!document_.is_empty() && row_ < 0) {
        row_ = 0;
    }
    if (!has_surface()) {
        header_->set_state(QString());
        return;
    }
    const auto row = static_cast<std::size_t>(row_);
    const Medium& before = medium_before(document_.lens(), row);
    const Medium& after = document_.lens().surfaces[row].medium_after;
    header_->set_state(QStringLiteral("surface %1 · %2 to %3")
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
            rows << cells({QString::number(++number), name, index_text(layer.medium),
                           shortest(layer.thickness_nm),
                           layer.extinction_table.empty() ? shortest(layer.extinction) : "table"},
                          {false, true, false, true, true});
        }
    } else if (const auto* quarter = std::get_if<QuarterWave>(&coating())) {
        const auto* medium = std::get_if<Medium>(&quarter->layer);
        thickness_header = "centre nm";
        rows << cells({"1",
                       medium == nullptr       ? "ideal"
                       : !medium->name.empty() ? QString::fromStdString(medium->name)
                                               : index_text(*medium),
                       medium == nullptr ? "√(n n′)" : index_text(*medium),
                       shortest(quarter->center_nm), "0"},
                      {false, true, false, true, false});
    } else if (const auto* fixed = std::get_if<ConstantReflectance>(&coating())) {
        thickness_header = "R %";
        rows << cells({"1", "at every wavelength", "", shortest(fixed->reflectance * 100.0), ""},
                      {false, false, false, true, false});
    }
    model_->setRowCount(0);
    for (const auto& row : rows) {
        model_->appendRow(row);
    }
    model_->horizontalHeaderItem(thickness_column)->setText(thickness_header);
    const bool from_air =
        std::holds_alternative<LayerStack>(coating()) && std::get<LayerStack>(coating()).from_air;
    model_->horizontalHeaderItem(number_column)->setText(from_air ? "# air" : "#");
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
        fed_label_->setText(ghosts_ ? "No ghost turns here." : "The ghosts are not traced yet.");
        return;
    }
    QStringList named;
    for (std::size_t k = 0; k < std::min<std::size_t>(fed_.size(), 2); ++k) {
        const SurfaceGhost& ghost = fed_[k];
        named << QStringLiteral("<a href=\"%1\">%2</a> %3 mm², met at %4° (up to %5°) %6")
                     .arg(QString::number(k),
                          QString::fromStdString(name(ghost.path, ghosts_->surface_count)),
                          significant(ghost.flux_mm2, 3),
                          QString::number(ghost.turn.incidence_deg, 'f', 1),
                          QString::number(ghost.turn.largest_incidence_deg, 'f', 1),
                          ghost.from_front ? "from the front" : "from behind");
    }
    fed_label_->setText("Feeds most: " + named.join("<br>then "));
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
                                  QStringLiteral("R % over angle, %1 nm").arg(shortest(nm)));
        wavelength_chart_->show_curves(
            curves_of(over_wavelength(surface, met_deg, first_nm, last_nm, points)), {},
            QStringLiteral("R % over wavelength, %1°").arg(QString::number(met_deg, 'f', 1)));
    } catch (const Error& error) {
        angle_chart_->show_reason(error.what());
        wavelength_chart_->show_reason(error.what());
    }
}

}  // namespace ghostlight
