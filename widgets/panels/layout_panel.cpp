#include "widgets/panels/layout_panel.h"

#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/units.h"
#include "widgets/layout_view.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"
#include "widgets/panel_header.h"

namespace ghostlight {

namespace {

constexpr int direct_rays = 9;
constexpr int ghost_rays = 7;
constexpr int many_ghost_rays = 5;      // each, when several are selected
constexpr std::size_t most_ghosts = 8;  // more would only hide each other, and cost time

QString length_text(double mm) { return QString::number(mm, 'f', 2).replace('-', QChar(0x2212)); }

QString surface_text(const Prescription& lens, const OpticalSystem* system, std::size_t row) {
    const QString number = QString::number(row + 1);
    if (row == lens.stop.surface) {
        const QString text = LayoutPanel::tr("surface %1 · stop").arg(number);
        return system == nullptr ? text
                                 : LayoutPanel::tr("%1 · radius %2 mm")
                                       .arg(text, length_text(system->stop_mask.semi_diameter_mm));
    }
    const Surface& surface = lens.surfaces[row];
    const double curvature = curvature_per_mm(surface.curve);
    QString text =
        curvature == 0.0
            ? LayoutPanel::tr("surface %1 · plane").arg(number)
            : LayoutPanel::tr("surface %1 · R %2 mm").arg(number, length_text(1.0 / curvature));
    if (surface.conic != 0.0 || !surface.aspheric.empty()) {
        text += LayoutPanel::tr(" · asphere");
    }
    if (is_air(surface.medium_after)) {
        return text + LayoutPanel::tr(" · air after");
    }
    if (system != nullptr) {
        text += QStringLiteral(" · n ") + QString::number(system->surfaces[row].n_after, 'f', 4);
    }
    if (!surface.medium_after.name.empty()) {
        text += QStringLiteral(" · ") + QString::fromStdString(surface.medium_after.name);
    }
    return text;
}

}  // namespace

LayoutPanel::LayoutPanel(QWidget* parent)
    : QWidget(parent), header_(new PanelHeader(tr("Layout"), this)), view_(new LayoutView(this)) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(header_);
    column->addWidget(view_, 1);
    connect(view_, &LayoutView::surface_hovered, this, [this](int row) {
        hovered_row_ = row;
        show_state();
        Q_EMIT surface_hovered(row);
    });
    clear();
}

LayoutPanel::~LayoutPanel() = default;

void LayoutPanel::show_lens(const Prescription& configured, const LightDirection& light,
                            double wavelength_nm, const std::vector<GhostPath>& selected) {
    if (configured.surfaces.empty()) {
        clear();
        return;
    }
    surface_count_ = configured.surfaces.size();
    std::optional<OpticalSystem> system;
    failure_.clear();
    try {
        system = compile(configured, wavelength_nm);
    } catch (const Error& error) {
        failure_ = QString::fromUtf8(error.what());
    }
    const OpticalSystem* compiled = system ? &*system : nullptr;
    LensDrawing drawing = lens_drawing(configured, compiled, light);

    std::vector<RayFan> fans;
    if (compiled != nullptr) {
        const double lead = drawing.lead_in_mm;
        fans.push_back(ray_fan(*compiled, {}, light.field_deg, direct_rays, lead));
        const int rays = selected.size() > 1 ? many_ghost_rays : ghost_rays;
        for (std::size_t i = 0; i < std::min(selected.size(), most_ghosts); ++i) {
            const bool exists = std::ranges::all_of(selected[i].reflections, [&](std::size_t row) {
                return row < turning_count(*compiled);
            });
            if (exists && !selected[i].is_direct()) {
                fans.push_back(ray_fan(*compiled, selected[i], light.field_deg, rays, lead));
            }
        }
    }
    direct_text_ = tr("direct light at %1°").arg(QString::number(light.field_deg, 'f', 1));
    surface_texts_.clear();
    for (std::size_t row = 0; row < configured.surfaces.size(); ++row) {
        surface_texts_ << surface_text(configured, compiled, row);
    }

    const QString lens_name = QString::fromStdString(configured.name);
    const bool another = lens_name != lens_name_ || view_->drawing().surfaces.empty();
    lens_name_ = lens_name;
    view_->show_drawing(std::move(drawing), std::move(fans));
    if (another) {
        view_->fit();
    }
    show_state();
}

void LayoutPanel::clear() {
    lens_name_.clear();
    surface_texts_.clear();
    failure_.clear();
    direct_text_.clear();
    view_->show_nothing(
        tr("The lens is drawn here in section.\nOpen a lens file, or drop one on the window."));
    show_state();
}

void LayoutPanel::fit() { view_->fit(); }

QImage LayoutPanel::grab_view() { return view_->grab_view(); }

void LayoutPanel::show_state() {
    const Palette& colors = current_palette();
    header_->set_warning(false);
    if (hovered_row_ > 0 && hovered_row_ <= surface_texts_.size()) {
        header_->set_state({{surface_texts_[hovered_row_ - 1], colors.text}});
        return;
    }
    if (!failure_.isEmpty()) {
        header_->set_warning(true);
        header_->set_state(tr("no rays: %1").arg(failure_));
        return;
    }
    int ghosts = 0, rays = 0;
    QString first;
    for (const RayFan& fan : view_->fans()) {
        if (!fan.path.is_direct()) {
            first = ghosts++ == 0 ? QString::fromStdString(name(fan.path, surface_count_)) : first;
            rays += fan.rays;
        }
    }
    if (ghosts == 0) {
        const int direct = view_->fans().empty() ? 0 : view_->fans().front().rays;
        header_->set_state(direct_text_.isEmpty() ? QString()
                           : direct > 0 ? tr("%1 · %2 rays").arg(direct_text_).arg(direct)
                                        : tr("%1 · no ray passes").arg(direct_text_));
        return;
    }
    const QString who = ghosts == 1 ? tr("ghost %1").arg(first) : tr("%1 ghosts").arg(ghosts);
    if (rays == 0) {
        header_->set_state(tr("%1 · no ray of this plane reaches the sensor").arg(who));
        return;
    }
    header_->set_state({{tr("%1 · %2 rays · legs: ").arg(who).arg(rays), {}},
                        {tr("in"), colors.amber},
                        {QStringLiteral(", "), {}},
                        {tr("between"), colors.red_orange},
                        {QStringLiteral(", "), {}},
                        {tr("out"), colors.teal}});
}

}  // namespace ghostlight
