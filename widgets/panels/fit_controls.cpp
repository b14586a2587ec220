#include "widgets/panels/fit_controls.h"

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>

#include <cmath>

namespace ghostlight {

FitControls::FitControls(QWidget* parent)
    : QWidget(parent), reason_(new QLabel), progress_(new QProgressBar) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(8, 2, 8, 8);
    column->setSpacing(4);
    reason_->setObjectName("refusal");
    reason_->setWordWrap(true);
    reason_->hide();
    column->addWidget(reason_);
    auto* row = new QHBoxLayout;
    const auto button = [&](const char* name, const QString& text, const QString& tip,
                            void (FitControls::*asked)()) {
        auto* made = new QPushButton(text);
        made->setObjectName(QStringLiteral("fit_") + name);
        made->setToolTip(tip);
        made->setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
        row->addWidget(made);
        connect(made, &QPushButton::clicked, this, asked);
        return made;
    };
    start_ = button("start", tr("Start"), tr("Fit what is marked to the photographs"),
                    &FitControls::start_asked);
    pause_ =
        button("pause", tr("Pause"), tr("Wait after the step in work"), &FitControls::pause_asked);
    cancel_ = button("cancel", tr("Cancel"), tr("Stop, and keep the best so far"),
                     &FitControls::cancel_asked);
    progress_->setRange(0, 1000);
    progress_->setTextVisible(false);
    progress_->setFixedHeight(6);
    QSizePolicy keeps_its_place = progress_->sizePolicy();
    keeps_its_place.setRetainSizeWhenHidden(true);
    progress_->setSizePolicy(keeps_its_place);
    row->addWidget(progress_, 1);
    apply_ = button("apply", tr("Apply"),
                    tr("Put the fitted numbers into the lens, as one step that can be undone"),
                    &FitControls::apply_asked);
    save_ = button("report", tr("Save Report…"), tr("One HTML page with everything"),
                   &FitControls::save_asked);
    column->addLayout(row);
}

void FitControls::set_state(const State& state) {
    start_->setEnabled(state.can_start);
    start_->setToolTip(state.why_not.isEmpty() ? tr("Fit what is marked to the photographs")
                                               : state.why_not);
    pause_->setEnabled(state.runs);
    pause_->setText(state.is_paused ? tr("Resume") : tr("Pause"));
    cancel_->setEnabled(state.runs);
    apply_->setEnabled(state.can_apply);
    save_->setEnabled(state.can_save);
    progress_->setVisible(state.runs);
}

void FitControls::set_share(double share) {
    progress_->setValue(static_cast<int>(std::lround(1000.0 * share)));
}

void FitControls::show_reason(const QString& reason) {
    reason_->setText(reason);
    reason_->setVisible(!reason.isEmpty());
}

QString FitControls::reason() const { return reason_->isHidden() ? QString() : reason_->text(); }

}  // namespace ghostlight
