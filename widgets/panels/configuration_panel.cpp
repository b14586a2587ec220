#include "widgets/panels/configuration_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QStandardItemModel>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "widgets/configuration_edits.h"
#include "widgets/document.h"
#include "widgets/number_text.h"
#include "widgets/panel_header.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/quiet_button.h"
#include "widgets/panels/table_delegate.h"

namespace ghostlight {

namespace {

constexpr int slider_end = 1000;
enum Column { name_column, efl_column, f_number_column, gaps_column, column_count };
/// The position's name in the lens: "" for the lens as listed.
constexpr int name_role = Qt::UserRole + 1;

QString shown_name(const std::string& name) {
    return name.empty() ? ConfigurationPanel::tr("as listed") : QString::fromStdString(name);
}

QStandardItem* cell(const QString& text, Qt::Alignment alignment) {
    auto* item = new QStandardItem(text);
    item->setEditable(false);
    item->setTextAlignment(alignment | Qt::AlignVCenter);
    return item;
}

QList<QStandardItem*> row_of(const Prescription& lens, const std::string& name) {
    QString efl = QStringLiteral("–"), f_number = QStringLiteral("–");
    try {
        const auto order = first_order(compile(configured(lens, name), d_line_nm));
        efl = significant(order.efl_mm, 5);
        f_number = significant(order.f_number, 3);
    } catch (const Error&) {
        // The banner says why it cannot be traced.
    }
    const auto known = std::ranges::find(lens.configurations, name, &Configuration::name);
    const bool is_listed = known == lens.configurations.end();
    auto* title = cell(shown_name(name), Qt::AlignLeft);
    title->setEditable(!is_listed);
    title->setData(QString::fromStdString(name), name_role);
    QString gaps;
    if (!is_listed) {
        QStringList rows;
        for (const auto& [row, thickness_mm] : known->thickness_mm) {
            rows << QString::number(row + 1);
        }
        gaps = rows.join(", ");
    }
    return {title, cell(efl, Qt::AlignRight), cell(f_number, Qt::AlignRight),
            cell(gaps, Qt::AlignLeft)};
}

}  // namespace

ConfigurationPanel::ConfigurationPanel(Document& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      header_(new PanelHeader(tr("Configurations"))),
      model_(new QStandardItemModel(0, column_count, this)),
      table_(plain_table(model_, new TableDelegate(-1, -1, this))),
      add_(quiet_button(tr("+ Add"), tr("Another position like the one in hand"), false)),
      remove_(quiet_button(tr("− Remove"), tr("Take this position away"), false)),
      first_(new QComboBox),
      second_(new QComboBox),
      slider_(new QSlider(Qt::Horizontal)),
      share_(new QLabel) {
    setObjectName("configuration_panel");
    model_->setHorizontalHeaderLabels({tr("Position"), tr("EFL mm"), "f/", tr("Own thicknesses")});
    model_->horizontalHeaderItem(name_column)->setToolTip(tr("Double-click or F2 renames"));
    model_->horizontalHeaderItem(gaps_column)
        ->setToolTip(tr("Surfaces whose thickness is this position's own. Edit ▸ Own Thickness in\n"
                        "This Configuration adds one: choose the surface in the prescription."));
    model_->horizontalHeaderItem(efl_column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    model_->horizontalHeaderItem(f_number_column)
        ->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    table_->setObjectName("configuration_table");
    table_->setSelectionMode(QAbstractItemView::SingleSelection);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
    table_->horizontalHeader()->setStretchLastSection(true);
    table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    slider_->setRange(0, slider_end);
    slider_->setAccessibleName(tr("Between two positions"));
    slider_->setToolTip(
        tr("From the one position to the other, linear in every thickness and the f-number.\n"
           "What it makes is a position of its own; undo takes it away again."));
    share_->setMinimumWidth(44);
    share_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    for (QComboBox* end : {first_, second_}) {
        end->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        end->setMinimumContentsLength(8);
        end->setAccessibleName(end == first_ ? tr("From") : tr("To"));
    }

    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(header_);
    column->addWidget(table_, 1);
    auto* buttons = new QHBoxLayout;
    buttons->setContentsMargins(8, 4, 12, 4);
    buttons->addWidget(add_);
    buttons->addWidget(remove_);
    buttons->addStretch(1);
    column->addLayout(buttons);
    auto* between = new QHBoxLayout;
    between->setContentsMargins(12, 4, 12, 10);
    between->setSpacing(8);
    between->addWidget(first_);
    between->addWidget(slider_, 1);
    between->addWidget(second_);
    between->addWidget(share_);
    column->addLayout(between);

    connect(add_, &QToolButton::clicked, this,
            [this] { attempt(tr("add a configuration"), with_configuration_added); });
    connect(remove_, &QToolButton::clicked, this, [this] {
        attempt(tr("remove the configuration %1").arg(shown_name(chosen())),
                [this](DocumentState state) {
                    return with_configuration_removed(std::move(state), chosen());
                });
    });
    connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& now) {
                if (is_filling_ || !now.isValid()) {
                    return;
                }
                Scene scene = document_.scene();
                scene.configuration =
                    now.siblingAtColumn(name_column).data(name_role).toString().toStdString();
                document_.edit_scene(scene, tr("change configuration"), "configuration");
            });
    connect(model_, &QStandardItemModel::itemChanged, this, [this](QStandardItem* item) {
        if (is_filling_ || item->column() != name_column) {
            return;
        }
        const std::string from = item->data(name_role).toString().toStdString();
        const std::string to = item->text().trimmed().toStdString();
        if (to == from) {
            return;  // what was refused has given way
        }
        attempt(tr("rename the configuration %1").arg(shown_name(from)), [&](DocumentState state) {
            return with_configuration_renamed(std::move(state), from, to);
        });
        update_.start();  // a refused name gives way to the old one
    });
    connect(slider_, &QSlider::sliderPressed, this, [this] { ++drag_; });
    connect(slider_, &QSlider::valueChanged, this, &ConfigurationPanel::go_between);
    update_.setSingleShot(true);
    update_.setInterval(0);
    connect(&update_, &QTimer::timeout, this, &ConfigurationPanel::show_lens);
    connect(&document_, &Document::changed, this, &ConfigurationPanel::follow_document);
    connect(&document_, &Document::opened, this, [this] {
        const QSignalBlocker quiet(slider_);
        slider_->setValue(0);
        first_->clear();
        second_->clear();
    });
    show_lens();
}

template <class Edit>
void ConfigurationPanel::attempt(const QString& text, const Edit& edit, const QString& field) {
    try {
        document_.edit(edit(document_.state()), text, field);
        Q_EMIT refused({});
    } catch (const Error& error) {
        Q_EMIT refused(error.what());
    }
}

std::string ConfigurationPanel::chosen() const { return document_.scene().configuration; }

void ConfigurationPanel::go_between(int value) {
    const std::string first = first_->currentData().toString().toStdString();
    const std::string second = second_->currentData().toString().toStdString();
    const double share = static_cast<double>(value) / slider_end;
    share_->setText(QStringLiteral("%1 %").arg(share * 100.0, 0, 'f', 1));
    attempt(
        "go " + QString::fromStdString(name_between(first, second)),
        [&](DocumentState state) {
            return with_configuration_between(std::move(state), first, second, share);
        },
        QStringLiteral("between/%1").arg(drag_));
}

void ConfigurationPanel::follow_document() { update_.start(); }

void ConfigurationPanel::show_lens() {
    const Prescription& lens = document_.lens();
    const bool empty = document_.is_empty();
    is_filling_ = true;
    std::vector<std::string> names = {std::string()};
    for (const Configuration& known : lens.configurations) {
        names.push_back(known.name);
    }
    if (empty) {
        names.clear();
    }
    const bool same_rows = model_->rowCount() == static_cast<int>(names.size());
    if (!same_rows) {
        model_->setRowCount(0);
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
        const int at = static_cast<int>(k);
        const QList<QStandardItem*> cells = row_of(lens, names[k]);
        if (!same_rows) {
            model_->appendRow(cells);
        } else {
            for (int column = 0; column < column_count; ++column) {
                model_->setItem(at, column, cells[column]);
            }
        }
        if (names[k] == chosen()) {
            table_->setCurrentIndex(model_->index(at, name_column));
        }
    }
    fit_columns(*table_);

    // Ends of the slider: never what it makes itself.
    for (QComboBox* end : {first_, second_}) {
        const QVariant kept = end->currentData();
        const QSignalBlocker quiet(end);
        end->clear();
        for (const std::string& name : names) {
            if (!name.starts_with("between ") || names.size() <= 2) {
                end->addItem(shown_name(name), QString::fromStdString(name));
            }
        }
        int at = kept.isValid() ? end->findData(kept) : -1;
        if (at < 0) {
            at = end == second_ ? end->count() - 1 : std::min(1, end->count() - 2);
        }
        end->setCurrentIndex(at);
    }
    const bool has_two = first_->count() > 1;
    for (QWidget* part : {static_cast<QWidget*>(first_), static_cast<QWidget*>(second_),
                          static_cast<QWidget*>(slider_)}) {
        part->setEnabled(has_two);
    }
    share_->setText(QStringLiteral("%1 %").arg(100.0 * slider_->value() / slider_end, 0, 'f', 1));
    add_->setEnabled(!empty);
    remove_->setEnabled(!chosen().empty());
    header_->set_state(
        empty ? QString()
        : lens.configurations.empty()
            ? tr("one position, as listed")
            : tr("%n position(s)", nullptr, static_cast<int>(lens.configurations.size())));
    is_filling_ = false;
}

}  // namespace ghostlight
