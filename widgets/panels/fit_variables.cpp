#include "widgets/panels/fit_variables.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QTabWidget>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/io/coating_words.h"
#include "core/io/varied_cells.h"
#include "widgets/number_text.h"
#include "widgets/panels/fit_ghost_page.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/quiet_button.h"
#include "widgets/panels/table_delegate.h"

namespace ghostlight {

namespace {

constexpr int suggested_angles = 4;

template <class Takes>
std::string joined(const std::vector<FitParameterModel::Row>& rows, const Takes& takes) {
    std::string text;
    for (const FitParameterModel::Row& row : rows) {
        if (takes(row)) {
            text += (text.empty() ? "" : ",") + vary_item(row.parameter);
        }
    }
    return text;
}

bool is_varied(const FitParameterModel::Row& row) { return row.varies; }
bool is_held(const FitParameterModel::Row& row) { return !row.varies; }
bool is_profiled(const FitParameterModel::Row& row) { return row.varies && row.is_profiled; }

bool is_same(const FitParameter& a, const FitParameter& b) {
    return a.kind == b.kind && a.layer == b.layer && a.rows == b.rows;
}

std::vector<FitParameterModel::Row> rows_of(const FitSetup& setup, const Prescription& lens) {
    std::vector<FitParameterModel::Row> rows;
    for (const bool varies : {true, false}) {
        const std::string& text = varies ? setup.vary : setup.held;
        if (text.empty()) {
            continue;  // which parse_vary() refuses
        }
        for (const FitParameter& each : parse_vary(text, lens)) {
            rows.push_back({each, varies, false});
        }
    }
    if (!setup.profiled.empty()) {
        for (const FitParameter& each : parse_vary(setup.profiled, lens)) {
            for (FitParameterModel::Row& row : rows) {
                row.is_profiled = row.is_profiled || (row.varies && is_same(row.parameter, each));
            }
        }
    }
    std::ranges::stable_sort(rows, [](const auto& a, const auto& b) {
        return std::pair(a.parameter.kind, a.parameter.rows) <
               std::pair(b.parameter.kind, b.parameter.rows);
    });
    return rows;
}

QToolButton* named(const char* name, const QString& text, const QString& tip) {
    auto* button = quiet_button(text, tip, false);
    button->setObjectName(QStringLiteral("fit_") + name);
    return button;
}

}  // namespace

FitVariables::FitVariables(QWidget* parent)
    : QWidget(parent),
      pages_(new QTabWidget),
      model_(new FitParameterModel(this)),
      table_(plain_table(model_, new TableDelegate(-1, FitParameterModel::stale_role, this))),
      ghosts_(new FitGhostPage) {
    table_->setItemDelegateForColumn(FitParameterModel::what, new QStyledItemDelegate(this));
    table_->setObjectName("fit_table");
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setContextMenuPolicy(Qt::NoContextMenu);
    auto* numbers = new QWidget;
    auto* in_numbers = new QVBoxLayout(numbers);
    in_numbers->setContentsMargins(0, 4, 0, 0);
    in_numbers->setSpacing(6);
    in_numbers->addLayout(make_add());
    in_numbers->addWidget(table_, 1);
    pages_->setDocumentMode(true);
    pages_->addTab(numbers, tr("What varies"));
    pages_->addTab(ghosts_, tr("Ghosts"));
    pages_->setTabToolTip(1, tr("Which ghosts count, and what the fit made of each"));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(8, 6, 8, 6);
    column->setSpacing(6);
    column->addWidget(pages_, 1);
    column->addLayout(make_kinds());
    column->addLayout(make_more());
    connect(ghosts_, &FitGhostPage::edited, this, &FitVariables::edited);
    connect(model_, &FitParameterModel::refused, this, &FitVariables::refused);
    connect(
        model_, &FitParameterModel::edited, this,
        [this](const auto& rows) { set_rows(rows, tr("change what a fit varies")); },
        Qt::QueuedConnection);  // after the table's editor is done with the row
}

QHBoxLayout* FitVariables::make_add() {
    auto* row = new QHBoxLayout;
    auto* coatings = named("all_coatings", tr("All coatings"),
                           tr("Vary the centre wavelength, or the constant reflectance, of every "
                              "coated surface"));
    auto* marked = named("vary_marked", tr("Marked"),
                         tr("Vary what is marked V in the prescription (Ctrl+M there)"));
    spec_ = new QLineEdit;
    spec_->setObjectName("fit_spec");
    spec_->setPlaceholderText(QStringLiteral("center@3  radius@4~0.2%  gap@2=1..3"));
    spec_->setToolTip(
        tr("KIND@ROWS[=LOWER..UPPER][~PRIOR]; KIND: center, thickness, layer.N, layer-index.N, "
           "reflectance, radius, gap, index, semi-diameter, and stop-size, stop-x, stop-y, "
           "stop-rotation without rows; ROWS: 3, 2+5 (one common value), all"));
    auto* add = named("vary_add", tr("Add"), tr("Vary this too"));
    auto* remove = named("vary_remove", tr("Remove"), tr("Take the chosen rows out"));
    row->addWidget(coatings);
    row->addWidget(marked);
    row->addWidget(spec_, 1);
    row->addWidget(add);
    row->addWidget(remove);
    auto* profile = named("profile", tr("Profile"),
                          tr("How χ² rises as the chosen numbers move, all others fitted to each: "
                             "intervals that need not be symmetric; takes longer. Again: not any "
                             "more"));
    row->addWidget(profile);
    connect(profile, &QToolButton::clicked, this, &FitVariables::profile_chosen);
    const auto add_typed = [this] {
        if (!spec_->text().trimmed().isEmpty()) {
            add_spec(spec_->text().trimmed().replace(' ', ','), tr("vary %1").arg(spec_->text()));
        }
    };
    connect(coatings, &QToolButton::clicked, this, &FitVariables::add_all_coatings);
    connect(marked, &QToolButton::clicked, this, &FitVariables::add_marked);
    connect(spec_, &QLineEdit::returnPressed, this, add_typed);
    connect(add, &QToolButton::clicked, this, add_typed);
    connect(remove, &QToolButton::clicked, this, [this] {
        std::vector<FitParameterModel::Row> rows;
        for (int k = 0; k < model_->rowCount(); ++k) {
            if (!table_->selectionModel()->isRowSelected(k)) {
                rows.push_back(model_->rows()[static_cast<std::size_t>(k)]);
            }
        }
        set_rows(rows, tr("vary less"));
    });
    const auto show_choice = [this, remove, profile] {
        remove->setEnabled(table_->selectionModel()->hasSelection());
        profile->setEnabled(table_->selectionModel()->hasSelection());
    };
    connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, show_choice);
    connect(model_, &QAbstractItemModel::modelReset, this, show_choice);
    show_choice();
    return row;
}

QHBoxLayout* FitVariables::make_kinds() {
    auto* row = new QHBoxLayout;
    kinds_ = new QLineEdit;
    kinds_->setObjectName("fit_kinds");
    kinds_->setPlaceholderText(tr("as listed; or none, qw:550, v-coat"));
    kinds_->setToolTip(
        tr("Kinds of coating to choose from on each surface, besides the listed "
           "one: none, qw:NM[:INDEX], names of the coating library, separated by "
           "commas; takes longer"));
    kind_rows_ = new QLineEdit;
    kind_rows_->setObjectName("fit_kind_rows");
    kind_rows_->setPlaceholderText(tr("all varied"));
    kind_rows_->setMaximumWidth(96);
    kind_rows_->setToolTip(
        tr("Surfaces whose kind is chosen, separated by commas; empty: those "
           "whose coating is varied"));
    auto* kinds_label = new QLabel(tr("Kinds of coating"));
    kinds_label->setBuddy(kinds_);
    auto* rows_label = new QLabel(tr("on surfaces"));
    rows_label->setBuddy(kind_rows_);
    row->addWidget(kinds_label);
    row->addWidget(kinds_, 1);
    row->addWidget(rows_label);
    row->addWidget(kind_rows_);
    connect(kinds_, &QLineEdit::editingFinished, this, [this] {
        change(tr("change kinds of coating"), [this](FitSetup& setup) {
            setup.kinds = kinds_->text().simplified().remove(' ').toStdString();
            parse_kinds(setup.kinds);
        });
    });
    connect(kind_rows_, &QLineEdit::editingFinished, this, [this] {
        change(tr("change where kinds are chosen"), [this](FitSetup& setup) {
            setup.kind_rows = kind_rows_->text().simplified().remove(' ').toStdString();
            parse_kind_rows(setup.kind_rows, lens_.surfaces.size());
        });
    });
    return row;
}

QVBoxLayout* FitVariables::make_more() {
    auto* rows = new QVBoxLayout;
    auto* row = new QHBoxLayout;
    auto* on_request = new QHBoxLayout;
    rows->addLayout(row);
    rows->addLayout(on_request);
    spectrum_ = new QLineEdit;
    spectrum_->setObjectName("fit_spectrum");
    spectrum_->setMaximumWidth(110);
    spectrum_->setToolTip(tr("Of the light: D65, A, E, LED, sodium, 3200 K, 550 nm …"));
    loss_ = new QComboBox;
    loss_->setObjectName("fit_loss");
    loss_->setToolTip(tr(
        "How far samples count that the model cannot explain, such as dust or a lamp beside it"));
    for (const auto& [loss, text, tip] :
         {std::tuple{FitLoss::none, tr("Least squares"), tr("Every sample counts by its square")},
          std::tuple{FitLoss::huber, tr("Huber"), tr("Linear beyond the scale")},
          std::tuple{FitLoss::cauchy, tr("Cauchy"), tr("Logarithmic beyond the scale")},
          std::tuple{FitLoss::tukey, tr("Tukey"), tr("Nothing beyond the scale")}}) {
        loss_->addItem(text, static_cast<int>(loss));
        loss_->setItemData(loss_->count() - 1, tip, Qt::ToolTipRole);
    }
    loss_scale_ = new QLineEdit;
    loss_scale_->setObjectName("fit_loss_scale");
    loss_scale_->setMaximumWidth(44);
    loss_scale_->setToolTip(tr("The loss's scale, standard deviations of a sample"));
    merge_ = new QCheckBox(tr("Exposures of one scene"));
    merge_->setObjectName("fit_merge");
    merge_->setToolTip(
        tr("Merge the photographs by their exposure times before the fit, each value weighted by "
           "the inverse of its variance"));
    suggest_ = new QCheckBox(tr("Suggest the next"));
    suggest_->setObjectName("fit_suggest");
    suggest_->setToolTip(
        tr("Which photograph would help most: tries other angles of the light in the model; takes "
           "longer"));
    row->addWidget(new QLabel(tr("Spectrum")));
    row->addWidget(spectrum_);
    row->addWidget(new QLabel(tr("Loss")));
    row->addWidget(loss_);
    row->addWidget(loss_scale_);
    row->addWidget(new QLabel(QStringLiteral("σ")));
    row->addSpacing(8);
    bootstrap_ = new QSpinBox;
    bootstrap_->setObjectName("fit_bootstrap");
    bootstrap_->setRange(0, 1000);
    bootstrap_->setSpecialValueText(tr("none"));
    bootstrap_->setKeyboardTracking(false);
    bootstrap_->setToolTip(
        tr("Fits to so many photographs drawn from the fitted model and its errors; takes longer"));
    row->addStretch(1);
    on_request->addWidget(new QLabel(tr("Bootstrap")));
    on_request->addWidget(bootstrap_);
    on_request->addSpacing(8);
    on_request->addWidget(merge_);
    on_request->addWidget(suggest_);
    on_request->addStretch(1);
    connect(bootstrap_, &QSpinBox::valueChanged, this, [this](int draws) {
        change(tr("change the fit's bootstrap"),
               [draws](FitSetup& setup) { setup.bootstrap = draws; });
    });
    connect(spectrum_, &QLineEdit::editingFinished, this, [this] {
        change(tr("change the fit's spectrum"), [this](FitSetup& setup) {
            setup.spectrum = spectrum_->text().trimmed().toStdString();
            parse_spectrum(setup.spectrum);
        });
    });
    connect(loss_, &QComboBox::activated, this, [this] {
        change(tr("change the fit's loss"), [this](FitSetup& setup) {
            setup.loss = static_cast<FitLoss>(loss_->currentData().toInt());
        });
    });
    connect(loss_scale_, &QLineEdit::editingFinished, this, [this] {
        change(tr("change the loss's scale"), [this](FitSetup& setup) {
            const auto number = parse_number(loss_scale_->text());
            if (!number || !(*number > 0.0)) {
                throw Error({.problem = tr("the loss's scale cannot be taken").toStdString(),
                             .file = {},
                             .where = {},
                             .found = "'" + loss_scale_->text().toStdString() + "'",
                             .expected = tr("standard deviations above 0").toStdString()});
            }
            setup.loss_scale = *number;
        });
    });
    connect(merge_, &QCheckBox::clicked, this, [this](bool on) {
        change(on ? tr("merge exposures") : tr("keep exposures apart"),
               [on](FitSetup& setup) { setup.merge = on; });
    });
    connect(suggest_, &QCheckBox::clicked, this, [this](bool on) {
        change(on ? tr("suggest photographs") : tr("suggest no photographs"),
               [on](FitSetup& setup) { setup.suggestions = on ? suggested_angles : 0; });
    });
    return rows;
}

template <class Change>
void FitVariables::change(const QString& step, const Change& change) {
    FitSetup setup = setup_;
    try {
        change(setup);
    } catch (const Error& error) {
        Q_EMIT refused(QString::fromUtf8(error.what()));
        return;
    }
    if (!(setup == setup_)) {
        Q_EMIT edited(setup, step);
    }
}

void FitVariables::add_all_coatings() {
    std::string wanted;
    for (const char* item : {"center@all", "reflectance@all"}) {
        try {
            parse_vary(item, lens_);
            wanted += (wanted.empty() ? "" : ",") + std::string(item);
        } catch (const Error&) {
            // None of that kind in this lens.
        }
    }
    if (wanted.empty()) {
        Q_EMIT refused(
            tr("no surface of this lens has a quarter-wave layer or a constant "
               "reflectance; vary thickness@all of layer stacks, or coat it first"));
        return;
    }
    add_spec(QString::fromStdString(wanted), tr("vary all coatings"));
}

void FitVariables::add_marked() {
    const std::string wanted = vary_text(lens_);
    if (wanted.empty()) {
        Q_EMIT refused(tr("nothing is marked; choose a cell of the prescription and press Ctrl+M"));
        return;
    }
    add_spec(QString::fromStdString(wanted), tr("vary what is marked"));
}

void FitVariables::profile_chosen() {
    std::vector<FitParameterModel::Row> rows = model_->rows();
    std::vector<FitParameterModel::Row*> chosen;
    for (const QModelIndex& each : table_->selectionModel()->selectedRows()) {
        chosen.push_back(&rows[static_cast<std::size_t>(each.row())]);
    }
    const bool all = std::ranges::all_of(chosen, [](const auto* row) { return is_profiled(*row); });
    for (FitParameterModel::Row* row : chosen) {
        row->is_profiled = !all;
    }
    set_rows(rows, all ? tr("want no profile") : tr("want a profile"));
}

void FitVariables::set_rows(const std::vector<FitParameterModel::Row>& rows, const QString& step) {
    FitSetup setup = setup_;
    setup.vary = joined(rows, is_varied);
    setup.held = joined(rows, is_held);
    setup.profiled = joined(rows, is_profiled);
    Q_EMIT edited(setup, step);
}

void FitVariables::add_spec(const QString& text, const QString& step) {
    try {
        std::vector<FitParameterModel::Row> rows = model_->rows();
        const auto added = parse_vary(text.toStdString(), lens_);
        for (const FitParameter& each : added) {
            // What is there already is marked and keeps its bounds, unless it is asked for alone.
            const auto at = std::ranges::find_if(rows, [&](const FitParameterModel::Row& row) {
                return is_same(row.parameter, each);
            });
            if (at == rows.end()) {
                rows.push_back({each, true, false});
            } else {
                *at = {added.size() == 1 ? each : at->parameter, true, at->is_profiled};
            }
        }
        parse_vary(joined(rows, is_varied), lens_);  // nothing twice
        set_rows(rows, step);
        spec_->clear();
    } catch (const Error& error) {
        Q_EMIT refused(QString::fromUtf8(error.what()));
    }
}

void FitVariables::show_columns() {
    constexpr int check_mark_px = 26;
    fit_columns(*table_);
    table_->setColumnWidth(FitParameterModel::what,
                           table_->columnWidth(FitParameterModel::what) + check_mark_px);
}

void FitVariables::set_setup(const FitSetup& setup, const Prescription& lens) {
    setup_ = setup;
    lens_ = lens;
    spectrum_->setText(QString::fromStdString(setup.spectrum));
    loss_->setCurrentIndex(loss_->findData(static_cast<int>(setup.loss)));
    kinds_->setText(QString::fromStdString(setup.kinds));
    kind_rows_->setText(QString::fromStdString(setup.kind_rows));
    kind_rows_->setEnabled(!setup.kinds.empty());
    loss_scale_->setText(shortest(setup.loss_scale));
    loss_scale_->setEnabled(setup.loss != FitLoss::none);
    merge_->setChecked(setup.merge);
    merge_->setEnabled(setup.photos.size() > 1);
    suggest_->setChecked(setup.suggestions > 0);
    const QSignalBlocker quiet(bootstrap_);
    bootstrap_->setValue(setup.bootstrap);
    model_->set_rows({});  // of another lens, should what follows be refused
    ghosts_->set_setup(setup, lens);
    model_->set_rows(rows_of(setup, lens));
    show_columns();
}

void FitVariables::set_numbers(const std::vector<FittedNumber>& numbers, bool have_errors) {
    model_->set_numbers(numbers, have_errors);
}

void FitVariables::set_report(const FitReport* report) {
    ghosts_->set_report(report);
    model_->set_profiles(report != nullptr ? report->profiles : std::vector<FittedProfile>());
    model_->set_numbers(report != nullptr ? report->numbers : std::vector<FittedNumber>(),
                        report != nullptr);
    show_columns();
}

}  // namespace ghostlight
