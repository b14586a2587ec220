#include "widgets/panels/flare_panel.h"

#include <QVBoxLayout>

#include <cmath>
#include <utility>

#include "render/auto_exposure.h"
#include "widgets/flare_view.h"
#include "widgets/panel_header.h"

namespace ghostlight {

namespace {

QString exposure_text(double exposure_ev) {
    const double shown = std::round(exposure_ev * 10.0) / 10.0;
    const QString size = QString::number(std::abs(shown), 'f', 1);
    return (shown < 0.0 ? QChar(0x2212) : QChar('+')) + size;
}

}  // namespace

FlarePanel::FlarePanel(QWidget* parent)
    : QWidget(parent), header_(new PanelHeader(tr("Flare"), this)), view_(new FlareView(this)) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(header_);
    column->addWidget(view_, 1);
    connect(view_, &FlareView::light_dragged, this, &FlarePanel::light_dragged);
    connect(view_, &FlareView::light_drag_finished, this, &FlarePanel::light_drag_finished);
    connect(view_, &FlareView::exposure_requested, this, &FlarePanel::set_exposure_ev);
    connect(view_, &FlareView::auto_exposure_requested, this, &FlarePanel::auto_expose);
    show_state();
}

FlarePanel::~FlarePanel() = default;

void FlarePanel::show_image(std::shared_ptr<const FlareImage> image) {
    view_->set_image(std::move(image));
    if (view_->image() != nullptr && expose_next_) {
        expose_next_ = false;
        auto_expose();
    }
    show_state();
}

void FlarePanel::begin_lens() {
    expose_next_ = true;
    view_->reset_zoom();
}

void FlarePanel::set_failed() {
    set_dimmed(true);
    view_->set_failed();
}

void FlarePanel::set_light(const LightDirection& light, double efl_mm) {
    view_->set_light(light, efl_mm);
}

void FlarePanel::set_other_lights(std::vector<LightDirection> lights) {
    view_->set_other_lights(std::move(lights));
}

void FlarePanel::set_exposure_ev(double exposure_ev) {
    if (exposure_ev == view_->exposure_ev()) {
        return;
    }
    view_->set_exposure_ev(exposure_ev);
    show_state();
    Q_EMIT exposure_changed(exposure_ev);
}

double FlarePanel::exposure_ev() const { return view_->exposure_ev(); }

void FlarePanel::auto_expose() {
    if (view_->image() != nullptr) {
        set_exposure_ev(auto_exposure_ev(*view_->image()));
    }
}

void FlarePanel::set_dimmed(bool stale) { header_->set_dimmed(stale); }

double FlarePanel::last_upload_ms() const { return view_->last_upload_ms(); }

void FlarePanel::set_strip(QWidget* strip) { layout()->addWidget(strip); }

QImage FlarePanel::grab_view() { return view_->grab_view(); }

void FlarePanel::show_state() {
    header_->set_state(view_->image() == nullptr ? QString()
                                                 : tr("exposure %1 EV · sRGB · drag the light")
                                                       .arg(exposure_text(view_->exposure_ev())));
}

}  // namespace ghostlight
