#include "widgets/panels/plan_page.h"

#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

#include "widgets/number_text.h"
#include "widgets/panels/table_delegate.h"

namespace ghostlight {

namespace {

enum Column { what, ghosts, bound, how_known, why, column_count };

QString percent(double share) { return significant(100.0 * share, 2) + QStringLiteral(" %"); }

QString bound_text(const PlanReport& plan, const Omission& each) {
    if (!each.bound_mm2) {
        return QStringLiteral("–");
    }
    if (*each.bound_mm2 == 0.0) {
        return PlanPage::tr("nothing");
    }
    return plan.flux_mm2 > 0.0 ? (each.proven ? QStringLiteral("≤ ") : QStringLiteral("≈ ")) +
                                     percent(*each.bound_mm2 / plan.flux_mm2)
                               : QString();
}

}  // namespace

PlanPage::PlanPage(QWidget* parent)
    : QWidget(parent),
      table_(new QTableWidget(0, column_count)),
      sum_(new QLabel),
      measure_(new QPushButton(tr("Measure the true error"))) {
    table_->setObjectName("plan_table");
    table_->setHorizontalHeaderLabels(
        {tr("Not computed"), tr("Ghosts"), tr("Changes"), tr("Known"), tr("Why")});
    table_->horizontalHeaderItem(bound)->setToolTip(
        tr("What it can change of the picture: L1 over the light on the sensor. ≤ at most, by a "
           "proof; ≈ by the plan's own estimate, good to a factor of two"));
    table_->setItemDelegate(new TableDelegate(-1, -1, this));
    for (const int number : {ghosts, bound}) {
        table_->horizontalHeaderItem(number)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    }
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setShowGrid(false);
    table_->setFrameShape(QFrame::NoFrame);
    table_->setWordWrap(false);
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(table_row_height);
    table_->horizontalHeader()->setStretchLastSection(true);
    table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    measure_->setObjectName("plan_measure");
    measure_->setToolTip(
        tr("Draws the reference to a tenth of the picture's tolerance; takes from seconds to "
           "minutes"));
    sum_->setWordWrap(true);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(table_, 1);
    auto* row = new QHBoxLayout;
    row->setContentsMargins(8, 6, 8, 8);
    row->addWidget(sum_, 1);
    row->addWidget(measure_);
    column->addLayout(row);
    show_nothing({});
}

void PlanPage::show_nothing(const QString& why) {
    report_ = nullptr;
    error_.reset();
    table_->setRowCount(0);
    measure_->setEnabled(false);
    sum_->setText(why);
}

void PlanPage::show_report(std::shared_ptr<const PlanReport> report) {
    report_ = std::move(report);
    table_->setRowCount(static_cast<int>(report_->omissions.size()));
    int row = 0;
    for (const Omission& each : report_->omissions) {
        const QString cells[column_count] = {QString::fromStdString(each.what),
                                             each.ghosts > 0 ? grouped(each.ghosts) : QString(),
                                             bound_text(*report_, each),
                                             !each.bound_mm2 ? QStringLiteral("–")
                                             : each.proven   ? tr("proven")
                                                             : tr("estimated"),
                                             QString::fromStdString(each.why)};
        for (int k = 0; k < column_count; ++k) {
            auto* item = new QTableWidgetItem(cells[k]);
            item->setToolTip(cells[k]);
            const bool is_number = k == ghosts || k == bound;
            item->setTextAlignment((is_number ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
            table_->setItem(row, k, item);
        }
        ++row;
    }
    for (int k = 0; k < why; ++k) {
        table_->resizeColumnToContents(k);
    }
    measure_->setEnabled(true);
    show_sum();
}

void PlanPage::show_progress(double share) {
    measure_->setEnabled(false);
    sum_->setText(tr("Measuring against the reference, %1 %").arg(qRound(100.0 * share)));
}

void PlanPage::show_error(const MeasuredPlan& error) {
    error_ = error;
    measure_->setEnabled(true);
    show_sum();
}

void PlanPage::show_sum() {
    const auto share = [&](double mm2) {
        return percent(report_->flux_mm2 > 0.0 ? mm2 / report_->flux_mm2 : 0.0);
    };
    const double proven_mm2 = report_->proven_mm2;
    const double estimated_mm2 = report_->bound_mm2 - proven_mm2;
    QString text;
    if (!(estimated_mm2 > 0.0)) {
        text = tr("All of these: at most %1.").arg(share(proven_mm2));
    } else if (proven_mm2 > 0.0) {
        text = tr("All of these: at most %1 proven, and about %2 estimated (good to a factor of "
                  "two).")
                   .arg(share(proven_mm2), share(estimated_mm2));
    } else {
        text = tr("All of these: about %1, estimated (good to a factor of two).")
                   .arg(share(estimated_mm2));
    }
    if (std::ranges::any_of(report_->omissions,
                            [](const Omission& each) { return !each.bound_mm2; })) {
        text += tr(" Rows with – are not in it.");
    }
    if (error_) {
        text += tr(" The true error is %1, by a reference whose two samplings differ by %2.")
                    .arg(percent(error_->error), percent(error_->reference_error));
    }
    sum_->setText(text);
}

QString PlanPage::sum() const { return sum_->text(); }

}  // namespace ghostlight
