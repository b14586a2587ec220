#include "widgets/panels/fit_ghost_page.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QItemSelectionModel>
#include <QLabel>
#include <QStyledItemDelegate>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <set>

#include "core/ghosts/ghost_path.h"
#include "core/units.h"
#include "widgets/number_text.h"
#include "widgets/panels/plain_table.h"
#include "widgets/panels/quiet_button.h"
#include "widgets/panels/table_delegate.h"

namespace ghostlight {

namespace {

std::vector<std::string> names_in(const std::string& text) {
    std::vector<std::string> names;
    for (const QString& each : QString::fromStdString(text).split(',', Qt::SkipEmptyParts)) {
        names.push_back(each.trimmed().toStdString());
    }
    return names;
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& each : names) {
        text += (text.empty() ? "" : ",") + each;
    }
    return text;
}

/// With those of `names` in it or not.
std::string with(const std::string& text, const std::vector<std::string>& names, bool in) {
    std::vector<std::string> all = names_in(text);
    for (const std::string& each : names) {
        std::erase(all, each);
        if (in) {
            all.push_back(each);
        }
    }
    return joined(all);
}

}  // namespace

FitGhostPage::FitGhostPage(QWidget* parent)
    : QWidget(parent), model_(new FitGhostModel(this)), sum_(new QLabel) {
    table_ = plain_table(model_, new TableDelegate(-1, -1, this));
    table_->setItemDelegateForColumn(FitGhostModel::ghost, new QStyledItemDelegate(this));
    table_->setObjectName("fit_ghosts");
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setContextMenuPolicy(Qt::NoContextMenu);
    table_->horizontalHeader()->setStretchLastSection(true);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    auto* row = new QHBoxLayout;
    const auto add = [&](const char* name, const QString& text, const QString& tip) {
        auto* button = quiet_button(text, tip, false);
        button->setObjectName(QStringLiteral("fit_") + name);
        row->addWidget(button);
        return button;
    };
    auto* leave = add("ghosts_leave", tr("Leave out"), tr("The chosen ghosts do not count"));
    auto* only = add("ghosts_only", tr("Use only these"), tr("The chosen ghosts alone count"));
    auto* all = add("ghosts_all", tr("Use all"), tr("Every ghost counts"));
    row->addStretch(1);
    sum_->setForegroundRole(QPalette::PlaceholderText);
    sum_->setWordWrap(true);
    column->addLayout(row);
    column->addWidget(table_, 1);
    column->addWidget(sum_);
    const auto show_choice = [this, leave, only] {
        const bool any = table_->selectionModel()->hasSelection();
        leave->setEnabled(any);
        only->setEnabled(any);
    };
    connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, show_choice);
    connect(model_, &QAbstractItemModel::modelReset, this, show_choice);
    show_choice();
    connect(leave, &QToolButton::clicked, this,
            [this] { set_counts(chosen(), false, tr("leave ghosts out of the fit")); });
    connect(only, &QToolButton::clicked, this,
            [this] { edit({}, joined(chosen()), tr("use only some ghosts in the fit")); });
    connect(all, &QToolButton::clicked, this,
            [this] { edit({}, {}, tr("use all ghosts in the fit")); });
    connect(model_, &FitGhostModel::count_asked, this,
            [this](const std::string& name, bool counts) {
                const QString ghost = QString::fromStdString(name);
                set_counts({name}, counts,
                           counts ? tr("use ghost %1 in the fit").arg(ghost)
                                  : tr("leave ghost %1 out of the fit").arg(ghost));
            });
}

std::vector<std::string> FitGhostPage::chosen() const {
    std::vector<std::string> names;
    for (const QModelIndex& each : table_->selectionModel()->selectedRows()) {
        names.push_back(model_->name_at(each.row()));
    }
    return names;
}

void FitGhostPage::edit(const std::string& left_out, const std::string& only, const QString& step) {
    FitSetup setup = setup_;
    setup.left_out = left_out;
    setup.only = only;
    if (!(setup == setup_)) {
        Q_EMIT edited(setup, step);
    }
}

void FitGhostPage::set_counts(const std::vector<std::string>& names, bool counts,
                              const QString& step) {
    if (setup_.only.empty() || !counts) {
        edit(with(setup_.left_out, names, !counts), setup_.only, step);
    } else {
        edit(with(setup_.left_out, names, false), with(setup_.only, names, true), step);
    }
}

void FitGhostPage::set_setup(const FitSetup& setup, const Prescription& lens) {
    setup_ = setup;
    const OpticalSystem system = compile(lens, d_line_nm);
    std::vector<std::string> names;
    for (const GhostPath& path : two_reflection_ghosts(system)) {
        names.push_back(name(path, system.surfaces.size()));
    }
    const int before = model_->rowCount();
    model_->set_ghosts(names, ghosts_left_out(setup.left_out, setup.only, lens));
    if (model_->rowCount() != before) {
        fit_columns(*table_);
    }
    show_sum();
}

void FitGhostPage::set_report(const FitReport* report) {
    model_->set_report(report);
    std::set<std::string> below;
    for (std::size_t k = 0; report != nullptr && k < report->left_out.size(); ++k) {
        below.insert(report->left_out[k].name);
    }
    below_noise_ = below.size();
    below_noise_signal_ = report != nullptr ? report->left_out_signal_to_noise : 0.0;
    fit_columns(*table_);
    constexpr int check_mark_px = 26;
    table_->setColumnWidth(FitGhostModel::ghost,
                           table_->columnWidth(FitGhostModel::ghost) + check_mark_px);
    show_sum();
}

void FitGhostPage::show_sum() {
    QString text = tr("%1 of %2 ghosts count.").arg(model_->counted()).arg(model_->rowCount());
    if (below_noise_ > 0) {
        text += tr(" %1 below the noise were left out: signal to noise %2 at the start, all "
                   "together.")
                    .arg(below_noise_)
                    .arg(significant(below_noise_signal_, 2));
    }
    sum_->setText(text);
}

QString FitGhostPage::sum() const { return sum_->text(); }

}  // namespace ghostlight
