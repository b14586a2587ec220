// The panels that study a lens at length: fits and accuracy. They come when they are asked for.

#include <QDockWidget>
#include <QPushButton>

#include "widgets/certificate_job.h"
#include "widgets/main_window.h"
#include "widgets/panels/accuracy_panel.h"
#include "widgets/panels/fit_panel.h"

namespace ghostlight {

namespace {

constexpr int height_percent = 42;  ///< of the window, when one is opened at the bottom

}  // namespace

void MainWindow::build_studies() {
    fit_ = new FitPanel(document_, actions_);
    accuracy_ = new AccuracyPanel(document_, actions_);
    fit_dock_ = add_dock(fit_, "fit", tr("Fit"), Qt::BottomDockWidgetArea);
    accuracy_dock_ = add_dock(accuracy_, "accuracy", tr("Accuracy"), Qt::BottomDockWidgetArea);
    for (QDockWidget* dock : {fit_dock_, accuracy_dock_}) {
        dock->hide();
        connect(dock->toggleViewAction(), &QAction::triggered, this, [this, dock](bool shown) {
            if (shown && !dock->isFloating()) {
                dock->raise();
                resizeDocks({dock}, {height() * height_percent / 100}, Qt::Vertical);
            }
        });
    }
}

void MainWindow::connect_studies() {
    connect(jobs_.get(), &Jobs::flare_ready, accuracy_, &AccuracyPanel::take_picture);
    connect(certificate_.get(), &CertificateJob::certified, accuracy_, &AccuracyPanel::take_proof);
}

bool MainWindow::begin_study(const QString& name) {
    QDockWidget* dock = name == "fit" ? fit_dock_ : accuracy_dock_;
    if (name != "fit" && name != "accuracy" && name != "plan") {
        return false;
    }
    dock->show();
    dock->raise();
    resizeDocks({dock}, {height() * height_percent / 100}, Qt::Vertical);
    if (name == "fit") {
        fit_->start_when_read();
    } else if (name == "accuracy") {
        accuracy_->measure_button().click();
    } else {
        accuracy_->show_plan();
    }
    return true;
}

void MainWindow::arrange_studies() {
    for (QDockWidget* dock : {fit_dock_, accuracy_dock_}) {
        dock->setFloating(false);
        addDockWidget(Qt::BottomDockWidgetArea, dock);
        tabifyDockWidget(report_dock_, dock);
        dock->hide();
    }
}

}  // namespace ghostlight
