#include <QDockWidget>

#include "widgets/main_window.h"
#include "widgets/models/ghost_table_model.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/coating_panel.h"
#include "widgets/panels/configuration_panel.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/glass_panel.h"
#include "widgets/panels/prescription_panel.h"

namespace ghostlight {

void MainWindow::build_editing() {
    coating_ = new CoatingPanel(document_, selection_, actions_);
    configurations_ = new ConfigurationPanel(document_);
    glasses_ = new GlassPanel(document_);
    coating_dock_ = add_dock(coating_, "coating", tr("Coating"), Qt::LeftDockWidgetArea);
    configuration_dock_ =
        add_dock(configurations_, "configurations", tr("Configurations"), Qt::LeftDockWidgetArea);
    glass_dock_ = add_dock(glasses_, "glasses", tr("Glasses"), Qt::LeftDockWidgetArea);
}

void MainWindow::arrange_editing() {
    for (QDockWidget* dock : {coating_dock_, configuration_dock_, glass_dock_}) {
        dock->setFloating(false);
        addDockWidget(Qt::LeftDockWidgetArea, dock);
        dock->show();
    }
    tabifyDockWidget(coating_dock_, configuration_dock_);
    tabifyDockWidget(configuration_dock_, glass_dock_);
    coating_dock_->raise();
    resizeDocks({prescription_dock_, coating_dock_}, {height() * 60 / 100, height() * 40 / 100},
                Qt::Vertical);
}

void MainWindow::connect_editing() {
    connect(prescription_, &PrescriptionPanel::row_chosen, coating_, &CoatingPanel::set_row);
    connect(prescription_, &PrescriptionPanel::row_chosen, glasses_, &GlassPanel::set_row);
    connect(jobs_.get(), &Jobs::table_ready, coating_, &CoatingPanel::set_table);
    const auto say = [this](const QString& reason) {
        reason.isEmpty() ? banner_->clear("editing") : banner_->show_text("editing", reason);
    };
    connect(coating_, &CoatingPanel::refused, this, say);
    connect(configurations_, &ConfigurationPanel::refused, this, say);
    connect(glasses_, &GlassPanel::refused, this, say);
}

}  // namespace ghostlight
