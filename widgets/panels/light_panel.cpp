#include "widgets/panels/light_panel.h"

#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/io/spectrum_csv.h"
#include "widgets/document.h"
#include "widgets/number_text.h"
#include "widgets/panel_header.h"
#include "widgets/panels/quiet_button.h"
#include "widgets/panels/scene_field.h"
#include "widgets/selection.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

constexpr double most_field_deg = 89.9;

QString shown(double value) { return at_least_decimals(std::round(value * 1e4) / 1e4, 1); }

/// "1  D65 · sun · 10.0°, 90.0° · −3 EV"
QString text_of(std::size_t number, const Light& light) {
    QStringList parts = {
        QString::fromStdString(name(light.spectrum)), QString::fromStdString(name(light.size)),
        shown(light.direction.field_deg) + "°, " + shown(light.direction.azimuth_deg) + "°"};
    if (light.intensity_ev != 0.0) {
        parts << shown(light.intensity_ev) + " EV";
    }
    QString text = QString::number(number + 1) + "   ";
    if (!light.name.empty()) {
        text += QString::fromStdString(light.name) + "   ";
    }
    return text + parts.join(" · ");
}

}  // namespace

LightPanel::LightPanel(Document& document, Selection& selection, QWidget* parent)
    : QWidget(parent),
      document_(document),
      selection_(selection),
      list_(new QListWidget),
      add_(quiet_button(tr("+ Add"), tr("Another light like this one, 5° further up"), false)),
      remove_(quiet_button(tr("− Remove"), tr("Take this light away"), false)) {
    setObjectName("light_panel");
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(new PanelHeader(tr("Light")));
    auto* content = new QWidget;
    auto* rows = new QVBoxLayout(content);
    rows->setContentsMargins(0, 0, 0, 12);
    rows->setSpacing(0);
    build_lights(*rows);
    build_veil(*rows);
    build_artistic(*rows);
    rows->addStretch(1);
    auto* scroll = new QScrollArea;
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setWidgetResizable(true);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setWidget(content);
    column->addWidget(scroll, 1);
    connect(&document_, &Document::changed, this, &LightPanel::follow_document);
    connect(&selection_, &Selection::ghosts_changed, this, &LightPanel::follow_document);
    follow_document();
}

QFormLayout* LightPanel::add_section(QVBoxLayout& column, const QString& title) {
    auto* label = new QLabel(title);
    QFont bold = label->font();
    bold.setWeight(QFont::DemiBold);
    label->setFont(bold);
    label->setContentsMargins(12, 14, 12, 6);
    column.addWidget(label);
    auto* form = new QFormLayout;
    form->setContentsMargins(12, 0, 12, 0);
    form->setHorizontalSpacing(12);
    form->setVerticalSpacing(6);
    form->setFieldGrowthPolicy(QFormLayout::FieldsStayAtSizeHint);
    form->setLabelAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    column.addLayout(form);
    return form;
}

namespace {

/// A field and its reset, side by side.
QWidget* with_reset(QWidget* field, QWidget* reset) {
    auto* both = new QWidget;
    auto* row = new QHBoxLayout(both);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(4);
    row->addWidget(field);
    row->addWidget(reset);
    row->addStretch(1);
    return both;
}

QLabel* dim_label(const QString& text) {
    auto* label = new QLabel(text);
    label->setForegroundRole(QPalette::PlaceholderText);
    follow_text_scale(*label, [label] { label->setMinimumHeight(with_text(28)); });
    return label;
}

}  // namespace

void LightPanel::add_number(QFormLayout& form, Number number) {
    const QString range =
        tr("From %1 to %2%3. Wheel or arrows: %4.")
            .arg(shown(number.low), shown(number.high), number.unit, shown(number.step));
    number.field = new NumberField("", number.unit, number.tip + "\n" + range);
    number.field->editor().setAccessibleName(number.label);
    number.reset =
        quiet_button("↺", tr("Back to %1%2").arg(shown(number.normal), number.unit), false);
    form.addRow(dim_label(number.label), with_reset(number.field, number.reset));
    const std::size_t at = numbers_.size();
    numbers_.push_back(number);
    connect(number.field, &NumberField::stepped, this, [this, at](int steps) {
        const Number& of = numbers_[at];
        const double next = of.get(document_.scene()) + steps * of.step;
        enter(at, std::clamp(next, of.low, of.high));
    });
    connect(number.field, &NumberField::entered, this, [this, at](const QString& text) {
        const Number& of = numbers_[at];
        const auto value = parse_number(text);
        const bool fits = value && *value >= of.low && *value <= of.high;
        of.field->set_refused(!fits);
        Q_EMIT refused(fits ? QString()
                            : tr("%1: found '%2', expected %3 to %4%5")
                                  .arg(of.label, text, shown(of.low), shown(of.high), of.unit));
        if (fits) {
            enter(at, *value);
        }
    });
    connect(number.reset, &QToolButton::clicked, this,
            [this, at] { enter(at, numbers_[at].normal); });
}

void LightPanel::enter(std::size_t number, double value) {
    const Number& of = numbers_[number];
    Scene scene = document_.scene();
    of.set(scene, value);
    document_.edit_scene(scene, tr("change %1").arg(of.label.toLower()), "light panel " + of.id);
}

void LightPanel::add_choice(QFormLayout& form, const QString& label, const QString& tip,
                            bool editable, const QStringList& choices, Choice choice) {
    choice.field = new ChoiceField("", tip, editable);
    choice.field->box().setAccessibleName(label);
    choice.field->set_choices(choices);
    choice.reset = quiet_button("↺", tr("Back to %1").arg(choice.normal), false);
    form.addRow(dim_label(label), with_reset(choice.field, choice.reset));
    const std::size_t at = choices_.size();
    choices_.push_back(choice);
    const auto take = [this, at, label](const QString& text) {
        const Choice& of = choices_[at];
        try {
            Scene scene = document_.scene();
            of.set(scene, text.trimmed());
            of.field->set_refused(false);
            Q_EMIT refused({});
            document_.edit_scene(scene, tr("change %1").arg(label.toLower()),
                                 "light panel " + of.id);
        } catch (const Error& error) {
            of.field->set_refused(true);
            Q_EMIT refused(error.what());
        }
    };
    connect(choice.field, &ChoiceField::entered, this, take);
    connect(choice.reset, &QToolButton::clicked, this,
            [this, at, take] { take(choices_[at].normal); });
}

void LightPanel::build_lights(QVBoxLayout& column) {
    list_->setObjectName("light_list");
    list_->setAccessibleName(tr("Lights"));
    list_->setToolTip(
        tr("Lights of the scene. The chosen one is what the ghost table, the rays and "
           "the scene bar are about."));
    set_line_height(*list_, 92);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setTextElideMode(Qt::ElideRight);
    column.addWidget(list_);
    auto* buttons = new QHBoxLayout;
    buttons->setContentsMargins(8, 4, 8, 0);
    buttons->addWidget(add_);
    buttons->addWidget(remove_);
    buttons->addStretch(1);
    column.addLayout(buttons);
    connect(add_, &QToolButton::clicked, this, &LightPanel::add_light);
    connect(remove_, &QToolButton::clicked, this, &LightPanel::remove_light);
    connect(list_, &QListWidget::currentRowChanged, this, [this](int row) {
        if (follows_ || row < 0) {
            return;
        }
        Scene scene = document_.scene();
        scene.active_light = static_cast<std::size_t>(row);
        document_.edit_scene(scene, tr("choose another light"), "active light");
    });
    connect(list_, &QListWidget::itemChanged, this, [this](const QListWidgetItem* item) {
        const int row = list_->row(item);
        if (follows_ || row < 0) {
            return;
        }
        Scene scene = document_.scene();
        scene.lights[static_cast<std::size_t>(row)].on = item->checkState() == Qt::Checked;
        document_.edit_scene(scene, tr("switch a light"));
    });

    QFormLayout* form = add_section(column, tr("Chosen light"));
    add_number(*form, {"field", tr("Field"), "°", tr("Angle from the axis."), -most_field_deg,
                       most_field_deg, 0.5, 10.0,
                       [](const Scene& s) { return s.light().direction.field_deg; },
                       [](Scene& s, double v) { s.light().direction.field_deg = v; }});
    add_number(*form, {"azimuth", tr("Azimuth"), "°",
                       tr("Direction about the axis; 90° is upright."), -180.0, 180.0, 5.0, 90.0,
                       [](const Scene& s) { return s.light().direction.azimuth_deg; },
                       [](Scene& s, double v) { s.light().direction.azimuth_deg = v; }});
    add_choice(
        *form, tr("Spectrum"),
        tr("D65, A, E, LED-B3, sodium, a black body (5500 K), one wavelength (587.5618 nm), or "
           "a table (the name of a .csv file with wavelength and power)"),
        true, {"D65", "A", "E", "LED-B3", "sodium", "5500 K", "3200 K", "587.5618 nm"},
        {"spectrum",
         [](const Scene& s) { return QString::fromStdString(name(s.light().spectrum)); },
         [](Scene& s, const QString& text) {
             // A table is known by its name alone once it has been read.
             if (text.toStdString() != name(s.light().spectrum)) {
                 s.light().spectrum = spectrum_by_name(text.toStdString());
             }
         },
         "D65"});
    add_choice(
        *form, tr("Size"),
        tr("point, sun (a disc of 0.533°), disc DEG, or picture FILE DEG (its width), up to 20°"),
        true, {"point", "sun", "disc 2", "disc 5"},
        {"size", [](const Scene& s) { return QString::fromStdString(name(s.light().size)); },
         [](Scene& s, const QString& text) {
             s.light().size = parse_light_size(text.toStdString());
         },
         "point"});
    add_number(*form, {"intensity", tr("Intensity"), " EV",
                       tr("Stops over the irradiance E0 that pictures are relative to."), -most_ev,
                       most_ev, 0.5, 0.0, [](const Scene& s) { return s.light().intensity_ev; },
                       [](Scene& s, double v) { s.light().intensity_ev = v; }});
}

void LightPanel::build_veil(QVBoxLayout& column) {
    QFormLayout* form = add_section(column, tr("Veil"));
    add_number(*form,
               {"folded", tr("Folded ghosts"), " %",
                tr("Ghosts of the least irradiance go into the veil, up to this share of the "
                   "ghosts' light, while the layer Veil is on."),
                0.0, 100.0 * most_folded_share, 1.0, 0.0,
                [](const Scene& s) { return 100.0 * s.veil.folded_share; },
                [](Scene& s, double v) { s.veil.folded_share = 0.01 * v; }});
    add_choice(*form, tr("Kernel"), tr("What stands for a folded ghost"), false,
               {"ellipse", "gaussian"},
               {"kernel",
                [](const Scene& s) {
                    return s.veil.kernel == VeilKernel::ellipse ? "ellipse" : "gaussian";
                },
                [](Scene& s, const QString& text) {
                    s.veil.kernel = text == "gaussian" ? VeilKernel::gaussian : VeilKernel::ellipse;
                },
                "ellipse"});
    add_number(*form,
               {"scatter", tr("Scattered light"), " %",
                tr("Share of the direct light that the lens scatters about its image. Dust and "
                   "age decide it, not the prescription."),
                0.0, 100.0, 0.5, 0.0, [](const Scene& s) { return 100.0 * s.veil.spread.share; },
                [](Scene& s, double v) { s.veil.spread.share = 0.01 * v; }});
    add_number(*form,
               {"exponent", tr("Falls as r^−"), "", tr("Power of the distance far from the image."),
                least_glare_exponent, most_glare_exponent, 0.1, GlareSpread{}.exponent,
                [](const Scene& s) { return s.veil.spread.exponent; },
                [](Scene& s, double v) { s.veil.spread.exponent = v; }});
    add_number(*form,
               {"core", tr("Core"), "°", tr("Where the power law begins."), 1e-3, largest_light_deg,
                0.05, GlareSpread{}.core_deg, [](const Scene& s) { return s.veil.spread.core_deg; },
                [](Scene& s, double v) { s.veil.spread.core_deg = v; }});
}

void LightPanel::build_artistic(QVBoxLayout& column) {
    QFormLayout* form = add_section(column, tr("Artistic"));
    add_number(*form, {"exaggeration", tr("All ghosts"), " EV",
                       tr("Stops on top of what is physical."), -most_ev, most_ev, 0.5, 0.0,
                       [](const Scene& s) { return s.artistic.exaggeration_ev; },
                       [](Scene& s, double v) { s.artistic.exaggeration_ev = v; }});
    add_number(
        *form,
        {"jitter", tr("Jitter"), " mm", tr("Every ghost moved by a normal deviate of this size."),
         0.0, most_offset_mm, 0.1, 0.0, [](const Scene& s) { return s.artistic.jitter_mm; },
         [](Scene& s, double v) { s.artistic.jitter_mm = v; }});
    add_number(*form,
               {"seed", tr("Seed"), "", tr("Another seed, another jitter."), 0.0, 4294967295.0, 1.0,
                1.0, [](const Scene& s) { return static_cast<double>(s.artistic.seed); },
                [](Scene& s, double v) {
                    s.artistic.seed = static_cast<std::uint32_t>(std::llround(v));
                }});
    ghost_rows_ = new QWidget;
    auto* own = new QVBoxLayout(ghost_rows_);
    own->setContentsMargins(0, 0, 0, 0);
    QFormLayout* ghost = add_section(*own, tr("Chosen ghosts"));
    ghost_on_ = quiet_button(tr("drawn"), tr("Draw the ghosts that are chosen in the table"), true);
    ghost->addRow(dim_label(tr("Picture")), with_reset(ghost_on_, new QWidget));
    connect(ghost_on_, &QToolButton::clicked, this, [this](bool on) {
        Scene scene = document_.scene();
        change_style(scene, [on](GhostStyle& of) { of.on = on; });
        document_.edit_scene(scene, tr("switch ghosts"));
    });
    const auto add = [&](const char* id, const QString& label, const char* unit, double low,
                         double high, double step, double normal,
                         std::function<double&(GhostStyle&)> part) {
        add_number(*ghost, {id, label, unit, tr("Of the ghosts that are chosen in the table."), low,
                            high, step, normal,
                            [this, part, normal](const Scene& s) {
                                const GhostStyle* found = style(s);
                                GhostStyle copy = found ? *found : GhostStyle{};
                                return found ? part(copy) : normal;
                            },
                            [this, part](Scene& s, double v) {
                                change_style(s, [&](GhostStyle& of) { part(of) = v; });
                            }});
    };
    add("ghost_gain", tr("Gain"), " EV", -most_ev, most_ev, 0.5, 0.0,
        [](GhostStyle& of) -> double& { return of.gain_ev; });
    add("ghost_red", tr("Tint, red"), " ×", 0.0, most_tint, 0.1, 1.0,
        [](GhostStyle& of) -> double& { return of.tint[0]; });
    add("ghost_green", tr("Tint, green"), " ×", 0.0, most_tint, 0.1, 1.0,
        [](GhostStyle& of) -> double& { return of.tint[1]; });
    add("ghost_blue", tr("Tint, blue"), " ×", 0.0, most_tint, 0.1, 1.0,
        [](GhostStyle& of) -> double& { return of.tint[2]; });
    add("ghost_x", tr("Offset, x"), " mm", -most_offset_mm, most_offset_mm, 0.1, 0.0,
        [](GhostStyle& of) -> double& { return of.offset_x_mm; });
    add("ghost_y", tr("Offset, y"), " mm", -most_offset_mm, most_offset_mm, 0.1, 0.0,
        [](GhostStyle& of) -> double& { return of.offset_y_mm; });
    column.addWidget(ghost_rows_);
    auto* buttons = new QHBoxLayout;
    buttons->setContentsMargins(8, 8, 8, 0);
    neutral_ = quiet_button(tr("↺ All neutral"), tr("Take back every artistic change"), false);
    buttons->addWidget(neutral_);
    buttons->addStretch(1);
    column.addLayout(buttons);
    connect(neutral_, &QToolButton::clicked, this, [this] {
        Scene scene = document_.scene();
        scene.artistic = {};
        document_.edit_scene(scene, tr("take back artistic changes"));
    });
}

NumberField& LightPanel::number(const QString& id) const {
    return *std::ranges::find(numbers_, id, &Number::id)->field;
}

ChoiceField& LightPanel::choice(const QString& id) const {
    return *std::ranges::find(choices_, id, &Choice::id)->field;
}

QToolButton& LightPanel::reset(const QString& id) const {
    const auto number = std::ranges::find(numbers_, id, &Number::id);
    return number != numbers_.end() ? *number->reset
                                    : *std::ranges::find(choices_, id, &Choice::id)->reset;
}

const GhostStyle* LightPanel::style(const Scene& scene) const {
    if (selection_.ghosts().empty()) {
        return nullptr;
    }
    const auto& styles = scene.artistic.ghosts;
    const auto found = std::ranges::find(styles, selection_.ghosts().front(), &GhostStyle::path);
    return found == styles.end() ? nullptr : &*found;
}

void LightPanel::change_style(Scene& scene, const std::function<void(GhostStyle&)>& change) const {
    auto& styles = scene.artistic.ghosts;
    for (const GhostPath& path : selection_.ghosts()) {
        auto found = std::ranges::find(styles, path, &GhostStyle::path);
        if (found == styles.end()) {
            found = styles.insert(styles.end(), GhostStyle{.path = path});
        }
        change(*found);
    }
    std::erase_if(styles, [](const GhostStyle& of) { return of == GhostStyle{.path = of.path}; });
}

void LightPanel::add_light() {
    Scene scene = document_.scene();
    Light light = scene.light();
    light.name.clear();
    constexpr double apart_deg = 5.0;
    light.direction.field_deg =
        std::clamp(light.direction.field_deg - apart_deg, -most_field_deg, most_field_deg);
    scene.lights.push_back(light);
    scene.active_light = scene.lights.size() - 1;
    document_.edit_scene(scene, tr("add a light"));
}

void LightPanel::remove_light() {
    Scene scene = document_.scene();
    scene.lights.erase(scene.lights.begin() + static_cast<std::ptrdiff_t>(scene.active_light));
    scene.active_light = std::min(scene.active_light, scene.lights.size() - 1);
    document_.edit_scene(scene, tr("remove a light"));
}

void LightPanel::follow_document() {
    const Scene& scene = document_.scene();
    follows_ = true;
    while (list_->count() > static_cast<int>(scene.lights.size())) {
        delete list_->takeItem(list_->count() - 1);
    }
    for (std::size_t k = 0; k < scene.lights.size(); ++k) {
        const int row = static_cast<int>(k);
        if (row >= list_->count()) {
            list_->addItem(new QListWidgetItem);
        }
        QListWidgetItem& item = *list_->item(row);
        item.setText(text_of(k, scene.lights[k]));
        item.setToolTip(item.text());
        item.setCheckState(scene.lights[k].on ? Qt::Checked : Qt::Unchecked);
    }
    list_->setCurrentRow(static_cast<int>(scene.active_light));
    follows_ = false;
    setEnabled(!document_.is_empty());
    add_->setEnabled(scene.lights.size() < most_lights);
    remove_->setEnabled(scene.lights.size() > 1);
    for (const Number& number : numbers_) {
        const double value = number.get(scene);
        number.field->set_text(number.id == "seed" ? QString::number(std::llround(value))
                                                   : shown(value));
        number.reset->setEnabled(value != number.normal);
    }
    for (const Choice& choice : choices_) {
        const QString text = choice.get(scene);
        choice.field->set_text(text);
        choice.reset->setEnabled(text != choice.normal);
    }
    const bool any = !selection_.ghosts().empty();
    ghost_rows_->setEnabled(any);
    const GhostStyle* of = style(scene);
    ghost_on_->setChecked(of == nullptr || of->on);
    ghost_rows_->setToolTip(any ? QString() : tr("Choose ghosts in the table first"));
    neutral_->setEnabled(!(scene.artistic == Artistic{}));
}

}  // namespace ghostlight
