#include "widgets/panels/accuracy_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDate>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QSysInfo>
#include <QTabWidget>
#include <QTableWidget>
#include <QVBoxLayout>

#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/instruction_set.h"
#include "core/io/lens_file.h"
#include "core/parallel.h"
#include "widgets/document.h"
#include "widgets/log_chart_view.h"
#include "widgets/number_text.h"
#include "widgets/panel_header.h"
#include "widgets/panels/plan_page.h"
#include "widgets/panels/table_delegate.h"

namespace ghostlight {

namespace {

QString what_is_here() {
    return AccuracyPanel::tr(
        "Error against time of every way to draw this lens's flare, measured against a reference, "
        "and "
        "what the picture leaves out.");
}
QString before_measuring() {
    return AccuracyPanel::tr(
        "Measures every method against a reference for the lens and light at hand.");
}
/// As `ghostlight-cli accuracy --quick` has them.
constexpr int usual_width_px = 320, usual_repeats = 5;
constexpr double usual_reference_percent = 2.0, usual_budget_s = 10.0;
constexpr std::size_t compared_ghosts = 2;

enum Column { method, setting, median, p95, error, energy, smape, resolved, front, column_count };

QString percent(double share, int digits = 3) {
    return std::isfinite(share) ? significant(100.0 * share, digits) : QStringLiteral("–");
}

QString setting_text(const AccuracyPoint& point) {
    if (point.knob.empty() || std::isnan(point.setting)) {
        return {};
    }
    return point.knob == "tolerance" || point.knob == "share"
               ? percent(point.setting) + QStringLiteral(" %")
               : QStringLiteral("%1 %2").arg(QString::fromStdString(point.knob),
                                             shortest(point.setting));
}

void say_within(QTabWidget& tabs, QWidget* page, const QString& tip) {
    tabs.setTabToolTip(tabs.indexOf(page), tip);
}

}  // namespace

AccuracyPanel::AccuracyPanel(Document& document, const Actions& actions, MakeGlEngine make_gl,
                             QWidget* parent)
    : PagedPanel(tr("Accuracy"), what_is_here(), actions, parent),
      document_(document),
      tabs_(new QTabWidget),
      error_chart_(new LogChartView),
      promise_chart_(new LogChartView),
      table_(new QTableWidget(0, column_count)),
      plan_(new PlanPage),
      job_(std::make_unique<AccuracyJob>(std::move(make_gl))) {
    setObjectName("accuracy_panel");
    error_chart_->set_text(before_measuring());
    promise_chart_->set_text(before_measuring());
    table_->setObjectName("accuracy_table");
    table_->setHorizontalHeaderLabels({tr("Method"), tr("Setting"), tr("Median, ms"), tr("p95, ms"),
                                       tr("Error, %"), tr("Energy, %"), tr("SMAPE, %"),
                                       tr("Resolved"), tr("Front")});
    table_->horizontalHeaderItem(error)->setToolTip(
        tr("Relative L1 of the ghosts' irradiance on the sensor"));
    table_->horizontalHeaderItem(resolved)->setToolTip(
        tr("No: less than three times the reference's own error"));
    table_->horizontalHeaderItem(front)->setToolTip(
        tr("Nothing measured is both faster and closer"));
    table_->setItemDelegate(new TableDelegate(-1, -1, this));
    for (const int number : {median, p95, error, energy, smape}) {
        table_->horizontalHeaderItem(number)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    }
    table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setShowGrid(false);
    table_->setFrameShape(QFrame::NoFrame);
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(table_row_height);
    tabs_->setDocumentMode(true);
    tabs_->addTab(error_chart_, tr("Error against time"));
    tabs_->addTab(promise_chart_, tr("Promised against achieved"));
    tabs_->addTab(table_, tr("Table"));
    tabs_->addTab(plan_, tr("Not computed"));
    say_within(*tabs_, plan_, tr("What the picture on screen leaves out, and what that can cost"));

    auto* content = new QWidget;
    auto* column = new QVBoxLayout(content);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(make_controls());
    column->addWidget(tabs_, 1);
    set_content(content);

    connect(&document_, &Document::changed, this, &AccuracyPanel::follow_document);
    connect(&document_, &Document::opened, this, [this] {
        cancel();
        job_->cancel_plan();
        run_.reset();
        picture_.reset();
        show_rows();
        show_reason({});
    });
    connect(tabs_, &QTabWidget::currentChanged, this, [this] { report_plan(false); });
    connect(&plan_->measure(), &QPushButton::clicked, this, [this] { report_plan(true); });
    connect(job_.get(), &AccuracyJob::progressed, this, [this](double share, const QString& what) {
        progress_->setValue(static_cast<int>(1000.0 * share));
        header().set_state(tr("measuring %1").arg(what));
    });
    connect(job_.get(), &AccuracyJob::measured, this,
            [this](const auto& result) { show_result(*result); });
    connect(job_.get(), &AccuracyJob::failed, this, [this](const QString& reason) {
        show_reason(reason);
        header().set_state(tr("failed"));
        show_buttons();
    });
    connect(job_.get(), &AccuracyJob::planned, plan_, &PlanPage::show_report);
    connect(job_.get(), &AccuracyJob::error_progressed, plan_, &PlanPage::show_progress);
    connect(job_.get(), &AccuracyJob::error_measured, plan_, &PlanPage::show_error);
    connect(job_.get(), &AccuracyJob::plan_failed, plan_, &PlanPage::show_nothing);
    show_buttons();
}

AccuracyPanel::~AccuracyPanel() { job_.reset(); }

QWidget* AccuracyPanel::make_controls() {
    auto* part = new QWidget;
    auto* column = new QVBoxLayout(part);
    column->setContentsMargins(8, 8, 8, 6);
    column->setSpacing(6);
    auto* row = new QHBoxLayout;
    const auto add = [&](const QString& label, QWidget* field, const QString& tip) {
        row->addWidget(new QLabel(label));
        row->addWidget(field);
        field->setToolTip(tip);
        row->addSpacing(8);
    };
    width_ = new QSpinBox;
    width_->setRange(16, 4096);
    width_->setValue(usual_width_px);
    width_->setSuffix(QStringLiteral(" px"));
    reference_ = new QDoubleSpinBox;
    reference_->setRange(0.01, 50.0);
    reference_->setDecimals(2);
    reference_->setValue(usual_reference_percent);
    reference_->setSuffix(QStringLiteral(" %"));
    budget_ = new QDoubleSpinBox;
    budget_->setRange(0.1, 100'000.0);
    budget_->setDecimals(1);
    budget_->setValue(usual_budget_s);
    budget_->setSuffix(QStringLiteral(" s"));
    spectrum_ = new QComboBox;
    spectrum_->addItems({tr("one wavelength"), tr("the light's spectrum")});
    with_gl_ = new QCheckBox(tr("OpenGL too"));
    with_gl_->setChecked(true);
    add(tr("Width"), width_, tr("Of the pictures"));
    add(tr("Reference"), reference_,
        tr("What the reference may err by; the finer, the longer it takes"));
    add(tr("Budget"), budget_,
        tr("For the timed frames, the reference not among them; settings that would go beyond it "
           "are left out"));
    row->addWidget(spectrum_);
    row->addWidget(with_gl_);
    with_gl_->setToolTip(tr("Measure OpenGL's pictures beside the CPU's"));
    row->addSpacing(8);
    measure_ = new QPushButton(tr("Measure"));
    measure_->setObjectName("accuracy_measure");
    cancel_ = new QPushButton(tr("Cancel"));
    save_ = new QPushButton(tr("Save…"));
    save_->setToolTip(tr("Tables (CSV), charts (SVG) and one HTML page into a folder"));
    progress_ = new QProgressBar;
    progress_->setRange(0, 1000);
    progress_->setTextVisible(false);
    progress_->setFixedHeight(6);
    progress_->setMinimumWidth(60);
    row->addWidget(measure_);
    row->addWidget(cancel_);
    row->addWidget(progress_, 1);
    row->addStretch(0);
    row->addWidget(save_);
    column->addLayout(row);
    reason_label_ = new QLabel;
    reason_label_->setObjectName("refusal");
    reason_label_->setWordWrap(true);
    reason_label_->hide();
    column->addWidget(reason_label_);
    connect(measure_, &QPushButton::clicked, this, &AccuracyPanel::measure);
    connect(cancel_, &QPushButton::clicked, this, &AccuracyPanel::cancel);
    connect(save_, &QPushButton::clicked, this, [this] {
        const QString folder = QFileDialog::getExistingDirectory(this, tr("Folder for the report"));
        if (!folder.isEmpty()) {
            save(folder);
        }
    });
    return part;
}

QString AccuracyPanel::reason() const {
    return reason_label_->isHidden() ? QString() : reason_label_->text();
}

void AccuracyPanel::show_reason(const QString& reason) {
    reason_label_->setText(reason);
    reason_label_->setVisible(!reason.isEmpty());
}

void AccuracyPanel::show_buttons() {
    const bool measures = job_->is_measuring();
    measure_->setEnabled(!measures);
    cancel_->setEnabled(measures);
    save_->setEnabled(!measures && run_);
    progress_->setVisible(measures);
}

void AccuracyPanel::measure() {
    try {
        const Prescription lens = document_.configured_lens();
        const Light& light = document_.scene().light();
        AccuracyRequest request;
        request.light = light.direction;
        if (spectrum_->currentIndex() == 1) {
            request.spectrum = light.spectrum;
        }
        request.width_px = width_->value();
        request.reference_tolerance = reference_->value() / 100.0;
        request.budget_s = budget_->value();
        request.most_repeats = usual_repeats;
        request.ghosts = compared_ghosts;
        const std::string& configuration = document_.scene().configuration;
        const std::string name = document_.title().toStdString();
        const std::filesystem::path& file = document_.file();
        asked_ = {};
        asked_.spectrum = ghostlight::name(request.spectrum);
        asked_.command = "ghostlight-cli accuracy " + file.string() +
                         (configuration.empty() ? "" : " --config " + configuration) + " --field " +
                         shortest(request.light.field_deg).toStdString() + " --azimuth " +
                         shortest(request.light.azimuth_deg).toStdString() + " --width " +
                         std::to_string(request.width_px) + " --reference " +
                         shortest(request.reference_tolerance).toStdString() + " --budget " +
                         shortest(request.budget_s).toStdString() +
                         " (measured in the window, OpenGL beside the CPU)";
        asked_.machine = QSysInfo::prettyProductName().toStdString() + ", " +
                         std::to_string(default_thread_count()) + " threads, " +
                         std::string(instruction_set_name()) + ", compiler " + __VERSION__;
        asked_.date = QDate::currentDate().toString(Qt::ISODate).toStdString();
        asked_.cases.push_back(
            {.heading = configuration.empty() ? name : name + ", " + configuration,
             .short_name = file.empty() ? name : file.stem().string(),
             .configuration = configuration,
             .file = file.string(),
             .surfaces = lens.surfaces.size(),
             .field_deg = request.light.field_deg,
             .closed_stops = 0.0,
             .report = {}});
        show_reason({});
        progress_->setValue(0);
        header().set_state(tr("measuring"));
        job_->measure(lens, request, with_gl_->isChecked());
    } catch (const Error& failure) {
        show_reason(QString::fromUtf8(failure.what()));
    }
    show_buttons();
}

void AccuracyPanel::cancel() {
    if (job_->is_measuring()) {
        job_->cancel();
        header().set_state(tr("stopped"));
        show_buttons();
    }
}

void AccuracyPanel::show_result(const AccuracyResult& result) {
    run_ = asked_;
    run_->cases.front().report = result.report;
    if (!result.renderer.empty()) {
        run_->machine += ", OpenGL by " + result.renderer;
    }
    show_reason(result.without_gl.isEmpty() ? QString()
                                            : tr("OpenGL took no part: %1").arg(result.without_gl));
    show_rows();
    show_buttons();
}

void AccuracyPanel::show_rows() {
    if (!run_) {
        table_->setRowCount(0);
        error_chart_->set_chart({});
        promise_chart_->set_chart({});
        header().set_state(QString());
        return;
    }
    const AccuracyCase& one = run_->cases.front();
    error_chart_->set_chart(error_time_chart(one));
    promise_chart_->set_chart(ghostlight::promise_chart(*run_));
    table_->setRowCount(static_cast<int>(one.report.points.size()));
    int row = 0;
    for (const AccuracyPoint& point : one.report.points) {
        const QString cells[column_count] = {
            QString::fromStdString(point.method),
            setting_text(point),
            point.is_shortcut ? QStringLiteral("–") : significant(point.median_ms, 3),
            point.is_shortcut ? QStringLiteral("–") : significant(point.p95_ms, 3),
            percent(point.errors.relative_l1),
            percent(point.errors.energy, 2),
            percent(point.errors.smape, 3),
            point.resolved ? tr("yes") : tr("no"),
            point.on_front ? QStringLiteral("●") : QString()};
        for (int k = 0; k < column_count; ++k) {
            auto* item = new QTableWidgetItem(cells[k]);
            const bool is_number = k >= median && k <= smape;
            item->setTextAlignment((is_number ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
            table_->setItem(row, k, item);
        }
        ++row;
    }
    table_->resizeColumnsToContents();
    const Promises promises = promises_of(*run_);
    header().set_state(
        tr("reference to %1 % in %2 s · the plan kept its tolerance in %3 of %4, %5 not resolved")
            .arg(percent(one.report.reference_error, 2),
                 significant(one.report.reference_ms / 1000.0, 2))
            .arg(promises.kept)
            .arg(promises.kept + promises.broken)
            .arg(promises.unresolved));
}

bool AccuracyPanel::save(const QString& folder) {
    if (!run_) {
        return false;
    }
    try {
        const std::filesystem::path into = folder.toStdString();
        write_file_safely(into / "accuracy.csv", table_csv(accuracy_rows(*run_)));
        write_file_safely(into / "ghosts.csv", table_csv(ghost_accuracy_rows(*run_)));
        for (const AccuracyCase& one : run_->cases) {
            write_file_safely(into / chart_file(one), log_chart_svg(error_time_chart(one)));
        }
        write_file_safely(into / "accuracy_promised.svg",
                          log_chart_svg(ghostlight::promise_chart(*run_)));
        write_file_safely(into / "accuracy.html", accuracy_html(*run_));
        return true;
    } catch (const Error& failure) {
        show_reason(QString::fromUtf8(failure.what()));
        return false;
    }
}

void AccuracyPanel::follow_document() {
    show_content(!document_.is_empty());
    proof_ = nullptr;
    if (reported_ != 0) {
        reported_ = 0;
        job_->cancel_plan();
        plan_->show_nothing(tr("The picture is being drawn."));
    }
    if (run_ && !job_->is_measuring()) {
        header().set_state(tr("of another state of the lens or light; measure again"));
    }
}

void AccuracyPanel::take_picture(const FlarePicture& picture) {
    picture_ = picture;
    report_plan(false);
}

void AccuracyPanel::take_proof(std::shared_ptr<const PlanProof> proof) {
    if (proof->certified < proof->ghosts.size()) {
        return;  // a bound that is still being worked on says nothing yet
    }
    proof_ = std::move(proof);
    reported_ = 0;  // with the proof's bounds
    report_plan(false);
}

void AccuracyPanel::report_plan(bool measure_error) {
    if (!plan_->isVisible() || !picture_ || document_.is_empty()) {
        return;
    }
    if (!picture_->is_final || picture_->revision != document_.revision()) {
        plan_->show_nothing(tr("The picture is being drawn."));
        return;
    }
    if (!has_plain_ghosts(document_.scene()) || picture_->image->plan.ghosts.empty()) {
        plan_->show_nothing(
            tr("Only the ghosts of one point light, unchanged by hand, have a plan "
               "that says all about them."));
        return;
    }
    if (!measure_error && (reported_ == document_.revision() || job_->is_reporting())) {
        return;
    }
    try {
        AccuracyJob::PlanTask task;
        task.lens = document_.configured_lens();
        task.request.light = document_.scene().light().direction;
        task.request.spectrum = document_.scene().light().spectrum;
        task.request.tolerance = picture_->image->plan.tolerance;
        task.request.width_px = picture_->image->width_px;
        task.image = picture_->image;
        task.proof = proof_;
        task.measure_error = measure_error;
        reported_ = document_.revision();
        if (measure_error) {
            plan_->show_progress(0.0);
        }
        job_->report_plan(std::move(task));
    } catch (const Error& failure) {
        plan_->show_nothing(QString::fromUtf8(failure.what()));
    }
}

void AccuracyPanel::show_plan() { tabs_->setCurrentWidget(plan_); }

void AccuracyPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    report_plan(false);
}

}  // namespace ghostlight
