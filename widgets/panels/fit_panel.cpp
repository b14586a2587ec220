#include "widgets/panels/fit_panel.h"

#include <QAbstractButton>
#include <QFileDialog>
#include <QFileInfo>
#include <QLineEdit>
#include <QPushButton>
#include <QSplitter>
#include <QTableView>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/io/fit_page.h"
#include "core/io/fit_setup_json.h"
#include "core/io/lens_file.h"
#include "widgets/document.h"
#include "widgets/fit_apply.h"
#include "widgets/number_text.h"
#include "widgets/panel_header.h"
#include "widgets/panels/fit_controls.h"
#include "widgets/panels/fit_photographs.h"
#include "widgets/panels/fit_results.h"
#include "widgets/panels/fit_variables.h"
#include "widgets/panels/line_plot.h"

namespace ghostlight {

namespace {

QString what_is_here() {
    return FitPanel::tr(
        "Finds the coatings and elements that explain photographs of the lens's flare, and says "
        "how well each is known.");
}

/// Of a list as parse_vary() reads it, what it reads for a lens.
std::string readable_vary(const std::string& words, const Prescription& lens) {
    QStringList kept;
    for (const QString& word : QString::fromStdString(words).split(',', Qt::SkipEmptyParts)) {
        try {
            parse_vary(word.toStdString(), lens);
            kept << word;
        } catch (const Error&) {
            // Not on this lens.
        }
    }
    return kept.join(',').toStdString();
}

}  // namespace

FitPanel::FitPanel(Document& document, const Actions& actions, QWidget* parent)
    : PagedPanel(tr("Fit"), what_is_here(), actions, parent),
      document_(document),
      photographs_(new FitPhotographs),
      variables_(new FitVariables),
      results_(new FitResults),
      controls_(new FitControls),
      job_(std::make_unique<FitJob>()) {
    setObjectName("fit_panel");
    auto* parts = new QSplitter(Qt::Horizontal);
    parts->setChildrenCollapsible(false);
    parts->addWidget(photographs_);
    parts->addWidget(variables_);
    parts->addWidget(results_);
    parts->setStretchFactor(0, 3);
    parts->setStretchFactor(1, 4);
    parts->setStretchFactor(2, 3);
    parts->setSizes({390, 520, 390});
    auto* content = new QWidget;
    auto* column = new QVBoxLayout(content);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(parts, 1);
    column->addWidget(controls_);
    set_content(content);
    delay_.setSingleShot(true);
    delay_.setInterval(0);
    connect(&delay_, &QTimer::timeout, this, &FitPanel::load);
    connect(&document_, &Document::changed, this, &FitPanel::follow_document);
    connect(&document_, &Document::fit_changed, this, &FitPanel::follow_document);
    connect(&document_, &Document::opened, this, [this] {
        cancel();
        drop_result();
        show_reason({});
    });
    connect_parts();
    connect_job();
    show_state();
}

FitPanel::~FitPanel() { job_.reset(); }

void FitPanel::connect_parts() {
    connect(photographs_, &FitPhotographs::edited, this, &FitPanel::edit_setup);
    connect(photographs_, &FitPhotographs::refused, this, &FitPanel::show_reason);
    connect(variables_, &FitVariables::edited, this, &FitPanel::edit_setup);
    connect(variables_, &FitVariables::refused, this, &FitPanel::show_reason);
    connect(controls_, &FitControls::start_asked, this, &FitPanel::start);
    connect(controls_, &FitControls::cancel_asked, this, &FitPanel::cancel);
    connect(controls_, &FitControls::apply_asked, this, &FitPanel::apply);
    connect(controls_, &FitControls::pause_asked, this, [this] {
        is_paused_ = false;
        job_->set_paused(!job_->is_paused());
        show_state();
    });
    connect(controls_, &FitControls::save_asked, this, [this] {
        const QString file =
            QFileDialog::getSaveFileName(this, tr("Save Report"), "fit.html", tr("HTML (*.html)"));
        if (!file.isEmpty()) {
            save_report(file);
        }
    });
}

void FitPanel::connect_job() {
    connect(job_.get(), &FitJob::photos_loaded, this, &FitPanel::take_photos);
    connect(job_.get(), &FitJob::glanced, this,
            [this](const auto& glance) { take_glance(*glance); });
    connect(job_.get(), &FitJob::finished, this,
            [this](const auto& report) { take_report(*report); });
    connect(job_.get(), &FitJob::failed, this, [this](const QString& reason) {
        show_reason(reason);
        has_failed_ = true;
        show_state();
    });
    connect(job_.get(), &FitJob::stage_began, this, [this](const QString& what) {
        stage_ = what;
        show_state();
    });
    connect(job_.get(), &FitJob::paused, this, [this] {
        is_paused_ = job_->is_paused();
        show_state();
    });
    connect(job_.get(), &FitJob::ended, this, &FitPanel::show_state);
    connect(job_.get(), &FitJob::progressed, this, [this](double share) {
        share_ = std::max(share_, share);
        controls_->set_share(share_);
    });
}

FitParameterModel& FitPanel::model() { return variables_->model(); }
QTableView& FitPanel::table() { return variables_->table(); }
FitPictureView& FitPanel::picture() { return photographs_->picture(); }
QLineEdit& FitPanel::light() { return photographs_->light(); }
QLineEdit& FitPanel::spec() { return variables_->spec(); }

QAbstractButton& FitPanel::button(const QString& name) const {
    auto* found = findChild<QAbstractButton*>("fit_" + name);
    Q_ASSERT_X(found != nullptr, "FitPanel::button", qPrintable(name));
    return *found;
}

QString FitPanel::reason() const { return controls_->reason(); }

void FitPanel::edit_setup(const FitSetup& setup, const QString& step) {
    show_reason({});
    document_.edit_fit(fit_setup_to_json(setup), step);
}

void FitPanel::add_photographs(const QStringList& files) { photographs_->add_files(files); }

void FitPanel::follow_document() {
    show_content(!document_.is_empty());
    if (document_.is_empty()) {
        return;
    }
    setup_ = fit_setup_from_json(document_.fit());
    try {
        const Prescription lens = document_.configured_lens();
        photographs_->set_setup(setup_, lens.sensor.width_mm);
        variables_->set_setup(setup_, lens);
        if (std::exchange(setup_is_wrong_, false)) {
            show_reason({});
        }
        if (lens != fitted_lens_ && !job_->is_running()) {
            drop_result();
        }
        if (report_) {
            variables_->set_numbers(report_->numbers, true);
        }
    } catch (const Error& error) {
        setup_is_wrong_ = true;
        show_reason(QString::fromUtf8(error.what()));
    }
    delay_.start();
    show_state();
}

void FitPanel::load() {
    if (setup_.photos.empty()) {
        take_photos(nullptr);
        return;
    }
    try {
        job_->load(document_.configured_lens(), setup_);
    } catch (const Error& error) {
        show_reason(QString::fromUtf8(error.what()));
    }
}

void FitPanel::take_photos(const LoadedPhotos& photos) {
    loaded_ = photos;
    photographs_->set_loaded(photos);
    for (std::size_t k = 0; photos && k < photos->size(); ++k) {
        const LoadedPhoto& each = (*photos)[k];
        if (!each.reason.isEmpty()) {
            show_reason(QFileInfo(QString::fromStdString(each.file)).fileName() + ": " +
                        each.reason);
        }
    }
    show_state();
    if (std::exchange(wants_start_, false) && controls_->start().isEnabled()) {
        start();
    }
}

void FitPanel::start_when_read() {
    if (is_settled()) {
        controls_->start().click();
    } else {
        wants_start_ = true;
    }
}

void FitPanel::show_reason(const QString& reason) { controls_->show_reason(reason); }

void FitPanel::show_state() {
    const bool runs = job_->is_running();
    const bool photos_are_fine =
        loaded_ && !loaded_->empty() && loaded_->size() == setup_.photos.size() &&
        std::ranges::all_of(*loaded_, [](const LoadedPhoto& p) { return p.reason.isEmpty(); });
    QString missing;
    if (setup_.photos.empty()) {
        missing = tr("no photograph");
    } else if (setup_is_wrong_) {
        missing = tr("what varies does not suit this lens");
    } else if (setup_.vary.empty()) {
        missing = tr("nothing varies");
    } else if (job_->is_loading() && !photos_are_fine) {
        missing = tr("reading the photographs");
    } else if (!photos_are_fine) {
        missing = tr("a photograph cannot be used");
    }
    controls_->set_state({.can_start = !runs && missing.isEmpty(),
                          .runs = runs,
                          .is_paused = job_->is_paused(),
                          .can_apply = !runs && (report_ || kept_),
                          .can_save = !runs && report_.has_value(),
                          .why_not = runs ? QString() : missing});
    QString state;
    if (runs) {
        state = is_paused_          ? tr("paused")
                : job_->is_paused() ? tr("pausing after this step")
                : stage_.isEmpty()  ? tr("fitting")
                                    : tr("fitting: %1").arg(stage_);
        if (is_paused_ && !stage_.isEmpty()) {
            state += tr(", %1").arg(stage_);
        }
    } else if (was_stopped_) {
        const QString what =
            kept_ ? tr("best so far kept, errors unknown") : tr("nothing was found yet");
        state = (job_->is_stopping() ? tr("stopping; %1") : tr("stopped; %1")).arg(what);
    } else if (report_) {
        state = report_->usable ? tr("done in %1 s").arg(significant(report_->seconds, 3))
                                : tr("the lens does not explain the photographs");
    } else {
        state = has_failed_ ? tr("failed") : !missing.isEmpty() ? missing : tr("ready");
    }
    header().set_state(state);
}

void FitPanel::drop_result() {
    report_.reset();
    kept_.reset();
    was_stopped_ = false;
    has_failed_ = false;
    fitted_lens_ = {};
    photographs_->set_fitted({});
    variables_->set_report(nullptr);
    results_->clear();
}

void FitPanel::start() {
    try {
        const Prescription lens = document_.configured_lens();
        drop_result();
        show_reason({});
        share_ = 0.0;
        is_paused_ = false;
        stage_ = job_->is_stopping() ? tr("waiting for the last one to stop") : QString();
        controls_->set_share(0.0);
        fitted_lens_ = lens;
        fitted_setup_ = setup_;
        results_->setCurrentWidget(&results_->costs());
        job_->start(lens, setup_);
    } catch (const Error& error) {
        show_reason(QString::fromUtf8(error.what()));
    }
    show_state();
}

void FitPanel::cancel() {
    if (!job_->is_running()) {
        return;
    }
    job_->cancel();
    was_stopped_ = true;
    kept_ = job_->best();
    if (kept_) {
        photographs_->set_fitted(kept_->photos);
        variables_->set_numbers(kept_->numbers, false);
    }
    show_state();
}

void FitPanel::take_glance(const FitGlance& glance) {
    results_->show_costs(glance.costs);
    photographs_->set_fitted(glance.look.photos);
    variables_->set_numbers(glance.look.numbers, false);
}

void FitPanel::take_report(const FitReport& report) {
    report_ = report;
    photographs_->set_fitted(report.photos);
    variables_->set_report(&report);
    results_->show_report(report);
    show_state();
}

void FitPanel::apply() {
    const auto& numbers = report_ ? report_->numbers : kept_->numbers;
    const Prescription& found = report_ ? report_->lens.lens : kept_->lens.lens;
    try {
        if (document_.configured_lens() != fitted_lens_) {
            show_reason(tr("the lens was edited since the fit began; fit again"));
            return;
        }
        const Prescription fitted =
            with_fitted(document_.lens(), document_.scene().configuration, numbers, found);
        // What stands in the table begins from the fitted lens now; the result is still its own.
        fitted_lens_ = configured(fitted, document_.scene().configuration);
        // A surface whose kind of coating was chosen may no longer have what was varied there.
        FitSetup setup = setup_;
        for (std::string* words : {&setup.vary, &setup.held, &setup.profiled}) {
            *words = readable_vary(*words, fitted_lens_);
        }
        document_.history().beginMacro(tr("apply the fit"));
        document_.edit_lens(fitted, tr("apply the fit"));
        if (!(setup == setup_)) {
            document_.edit_fit(fit_setup_to_json(setup), tr("vary what is there"));
        }
        document_.history().endMacro();
    } catch (const Error& error) {
        show_reason(QString::fromUtf8(error.what()));
    }
    show_state();
}

bool FitPanel::save_report(const QString& file) {
    if (!report_) {
        return false;
    }
    try {
        const std::string& configuration = document_.scene().configuration;
        write_file_safely(
            file.toStdString(),
            fit_page(*report_,
                     document_.lens().name + (configuration.empty() ? "" : ", " + configuration),
                     fit_command(fitted_setup_, document_.file().string())));
        return true;
    } catch (const Error& error) {
        show_reason(QString::fromUtf8(error.what()));
        return false;
    }
}

}  // namespace ghostlight
