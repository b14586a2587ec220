#include "widgets/panels/layout_panel.h"

#include <QSlider>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/flare/scene.h"
#include "core/units.h"
#include "widgets/axis_marks.h"
#include "widgets/layout_export.h"
#include "widgets/layout_view.h"
#include "widgets/number_text.h"
#include "widgets/palette.h"
#include "widgets/panel_header.h"

namespace ghostlight {

namespace {

constexpr int direct_rays = 9;
constexpr int ghost_rays = 7;
constexpr int many_ghost_rays = 5;    // each, when several are selected
constexpr int fewest_ghost_rays = 3;  // each, of a crowd
constexpr std::size_t crowd = 6;
constexpr std::size_t most_ghosts = 24;  // more would only hide each other, and cost time
constexpr int field_rays = 5;            // of each of several fields
constexpr int stopped_rays = 15;
constexpr int walk_steps = 1000;
constexpr double zone = 0.7;  // of the field, where aberrations turn

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
    walk_ = new QSlider(Qt::Horizontal);
    walk_->setObjectName("walk");
    walk_->setRange(0, walk_steps);
    walk_->setValue(walk_steps);
    walk_->setToolTip(tr("Walks the light along its way: how far it has come"));
    walk_->setAccessibleName(tr("How far the light has come"));
    walk_->hide();
    column->addWidget(walk_);
    connect(walk_, &QSlider::valueChanged, this,
            [this](int value) { view_->set_walk(static_cast<double>(value) / walk_steps); });
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
    shown_ = {configured, light, wavelength_nm, selected};
    draw();
}

void LayoutPanel::draw() {
    const Prescription& configured = shown_.lens;
    const LightDirection& light = shown_.light;
    const std::vector<GhostPath>& selected = shown_.selected;
    if (configured.surfaces.empty()) {
        return;
    }
    surface_count_ = configured.surfaces.size();
    export_failure_.clear();
    std::optional<OpticalSystem> system;
    failure_.clear();
    try {
        system = compile(configured, shown_.wavelength_nm);
    } catch (const Error& error) {
        failure_ = QString::fromUtf8(error.what());
    }
    const OpticalSystem* compiled = system ? &*system : nullptr;
    LensDrawing drawing = lens_drawing(configured, compiled, light);

    std::vector<RayFan> fans;
    std::vector<AxisMark> marks;
    if (compiled != nullptr) {
        const double lead = drawing.lead_in_mm;
        fans.push_back(ray_fan(*compiled, {}, light.field_deg, direct_rays, lead));
        if (several_fields_) {
            const double edge_deg = half_field_deg(configured);
            int field = 0;
            for (const double share : {0.0, zone, 1.0}) {
                fans.push_back(ray_fan(*compiled, {}, share * edge_deg, field_rays, lead));
                fans.back().field = field++;
            }
        }
        const int rays = selected.size() > crowd ? fewest_ghost_rays
                         : selected.size() > 1   ? many_ghost_rays
                                                 : ghost_rays;
        for (std::size_t i = 0; i < std::min(selected.size(), most_ghosts); ++i) {
            const bool exists = std::ranges::all_of(selected[i].reflections, [&](std::size_t row) {
                return row < turning_count(*compiled);
            });
            if (exists && !selected[i].is_direct()) {
                fans.push_back(ray_fan(*compiled, selected[i], light.field_deg, rays, lead));
                if (shows_stopped_ && fans.back().rays > 0) {
                    add_stopped_rays(*compiled, light.field_deg, stopped_rays, lead, fans.back());
                }
            }
        }
        if (shows_marks_) {
            marks = axis_marks(*compiled, selected);
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
    walk_->setVisible(!selected.empty());
    if (selected.empty()) {
        walk_->setValue(walk_steps);
    }
    view_->show_drawing(std::move(drawing), std::move(fans), std::move(marks));
    if (another) {
        view_->fit();
    }
    show_state();
}

void LayoutPanel::set_several_fields(bool on) {
    several_fields_ = on;
    draw();
}

void LayoutPanel::set_marks(bool on) {
    shows_marks_ = on;
    draw();
}

void LayoutPanel::set_stopped_rays(bool on) {
    shows_stopped_ = on;
    draw();
}

void LayoutPanel::set_measuring(bool on) { view_->set_measuring(on); }

bool LayoutPanel::export_to(const QString& file) {
    export_failure_.clear();
    try {
        export_layout(file, paper_shapes(view_->drawing(), view_->fans(), view_->marks()),
                      view_->drawing().box);
    } catch (const Error& error) {
        export_failure_ = QString::fromUtf8(error.what());
    }
    show_state();
    return export_failure_.isEmpty();
}

void LayoutPanel::clear() {
    shown_ = {};
    walk_->hide();
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
    if (!export_failure_.isEmpty()) {
        header_->set_warning(true);
        header_->set_state(export_failure_);
        return;
    }
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
    if (ghosts > 1) {
        header_->set_state(tr("%1 · %2 rays · faint on their way in, full between the reflections")
                               .arg(who)
                               .arg(rays));
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
