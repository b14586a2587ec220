#include "widgets/panels/coating_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QStandardItemModel>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <iterator>

#include "core/error.h"
#include "core/io/coating_library.h"
#include "widgets/coating_edits.h"
#include "widgets/document.h"
#include "widgets/panels/curve_chart.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/quiet_button.h"
#include "widgets/panels/table_delegate.h"
#include "widgets/selection.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

QString what_is_here() {
    return CoatingPanel::tr(
        "The coating of the surface chosen in the prescription: its layers, what it reflects, and "
        "the ghosts that it feeds.");
}
constexpr const char* kind_names[coating_kinds] = {
    QT_TRANSLATE_NOOP("ghostlight::CoatingPanel", "None"),
    QT_TRANSLATE_NOOP("ghostlight::CoatingPanel", "Quarter wave, MgF2"),
    QT_TRANSLATE_NOOP("ghostlight::CoatingPanel", "Quarter wave, ideal"),
    QT_TRANSLATE_NOOP("ghostlight::CoatingPanel", "Layers"),
    QT_TRANSLATE_NOOP("ghostlight::CoatingPanel", "Constant R"),
    QT_TRANSLATE_NOOP("ghostlight::CoatingPanel", "Measured table")};

}  // namespace

CoatingPanel::CoatingPanel(Document& document, Selection& selection, const Actions& actions,
                           QWidget* parent)
    : PagedPanel(tr("Coating"), what_is_here(), actions, parent),
      document_(document),
      selection_(selection),
      kind_(new QComboBox),
      model_(new QStandardItemModel(this)),
      table_(plain_table(model_, new TableDelegate(-1, -1, this))),
      add_(quiet_button(tr("+ Layer"), tr("A layer after the chosen one"), false)),
      remove_(quiet_button(tr("− Layer"), tr("Take the chosen layer away"), false)),
      turn_(quiet_button(tr("⇅ Turn"), tr("The same layers in reverse order"), false)),
      fed_label_(new QLabel),
      side_(new QComboBox),
      wavelength_(new QLineEdit),
      wavelength_chart_(new CurveChart(tr("R over wavelength"), "nm")),
      angle_chart_(new CurveChart(tr("R over angle"), "°")),
      targets_(new QLineEdit) {
    setObjectName("coating_panel");
    build();
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
        kind_->addItem(tr(name));
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
    // The longest name of the library may be cut off, what is beside it may not.
    kind_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    kind_->setMinimumContentsLength(14);
    kind_->setAccessibleName(tr("Kind of coating"));
    model_->setHorizontalHeaderLabels({"#", tr("Material"), "n 550", "nm", "k"});
    for (const int column : {number_column, index_column, thickness_column, k_column}) {
        model_->horizontalHeaderItem(column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    }
    model_->horizontalHeaderItem(number_column)
        ->setToolTip(tr("Layers count from the side that light comes from, or from the air"));
    model_->horizontalHeaderItem(material_column)
        ->setToolTip(tr("MgF2, a catalogue name, or an index at every wavelength"));
    model_->horizontalHeaderItem(thickness_column)
        ->setToolTip(tr("Thickness in nm; arithmetic is taken: =550/4/1.38"));
    model_->horizontalHeaderItem(k_column)->setToolTip(
        tr("Extinction k of n + ik; 0 for a layer that does not absorb"));
    table_->setObjectName("layer_table");
    table_->setSelectionMode(QAbstractItemView::SingleSelection);
    table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    side_->addItems({tr("from the front"), tr("from behind")});
    side_->setToolTip(tr("From where the light comes: the angle is the one in the medium there"));
    side_->setAccessibleName(tr("Side that the light comes from"));
    wavelength_->setText("550");
    set_line_width(*wavelength_, 56);
    wavelength_->setAccessibleName(tr("Wavelength of the curve over the angle in nm"));
    wavelength_->setToolTip(tr("Wavelength of the curve over the angle, nm"));
    targets_->setPlaceholderText("2-5, 8");
    targets_->setAccessibleName(tr("Surfaces to copy the coating to"));
    targets_->setToolTip(tr("Surfaces that get the same coating: 2-5, 8"));
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
    add_row({new QLabel(tr("Light")), side_, new QLabel(tr("at")), wavelength_, new QLabel("nm")});
    auto* charts = new QHBoxLayout;
    charts->setSpacing(0);
    charts->addWidget(angle_chart_, 1);
    charts->addWidget(wavelength_chart_, 1);
    column->addLayout(charts, 1);
    auto* copy = new QPushButton(tr("Copy"));
    auto* everywhere = new QPushButton(tr("To all that face air"));
    everywhere->setToolTip(tr("The same coating on every surface between air and glass"));
    add_row({new QLabel(tr("Copy to")), targets_, copy, everywhere});

    auto* scroll = new QScrollArea;
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setWidgetResizable(true);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAsNeeded);
    scroll->setWidget(content);
    set_content(scroll);

    connect(kind_, &QComboBox::activated, this, &CoatingPanel::choose_kind);
    connect(model_, &QStandardItemModel::itemChanged, this, &CoatingPanel::change_layer);
    connect(add_, &QToolButton::clicked, this, [this] {
        change_stack(tr("add a layer to the coating"), [](LayerStack& stack, std::size_t at) {
            const Layer like =
                stack.layers.empty() ? Layer{magnesium_fluoride(), 100.0} : stack.layers[at];
            stack.layers.insert(stack.layers.begin() + static_cast<std::ptrdiff_t>(
                                                           std::min(at + 1, stack.layers.size())),
                                like);
        });
    });
    connect(remove_, &QToolButton::clicked, this, [this] {
        change_stack(tr("remove a layer of the coating"), [](LayerStack& stack, std::size_t at) {
            if (at < stack.layers.size()) {
                stack.layers.erase(stack.layers.begin() + static_cast<std::ptrdiff_t>(at));
            }
        });
    });
    connect(turn_, &QToolButton::clicked, this, [this] {
        change_stack(tr("turn the coating"),
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

}  // namespace ghostlight
