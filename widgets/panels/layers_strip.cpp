#include "widgets/panels/layers_strip.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QMenu>
#include <QToolButton>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/flare/light.h"
#include "widgets/document.h"
#include "widgets/number_text.h"
#include "widgets/panels/quiet_button.h"
#include "widgets/panels/scene_field.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

constexpr double gain_step_ev = 0.5;

struct LayerText {
    QString title;
    QString tip;
};
LayerText text_of(LayerKind kind) {
    switch (kind) {
        case LayerKind::ghosts:
            return {LayersStrip::tr("Ghosts"),
                    LayersStrip::tr("Light that was reflected between surfaces.")};
        case LayerKind::starburst:
            return {LayersStrip::tr("Starburst"),
                    LayersStrip::tr("The direct image, spread by diffraction at the stop.")};
        case LayerKind::veil:
            return {LayersStrip::tr("Veil"),
                    LayersStrip::tr("Ghosts folded away and light scattered by the lens; both are "
                                    "set in the Light panel.")};
        case LayerKind::backdrop:
            break;
    }
    return {
        LayersStrip::tr("Backdrop"),
        LayersStrip::tr("A picture behind the flare. Its white is a white surface in the sun.")};
}

}  // namespace

LayersStrip::LayersStrip(Document& document, QWidget* parent)
    : QFrame(parent), document_(document) {
    setObjectName("layers_strip");
    set_line_height(*this, 40);
    // The docks beside the flare keep their widths, however many layers are on.
    setMinimumWidth(1);
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(12, 6, 12, 6);
    row->setSpacing(4);
    for (const LayerKind kind : layer_kinds) {
        add_row(kind);
    }
    more_ = quiet_button("⋯", tr("Gains and switches that have no room here"), false);
    more_->hide();
    row->addWidget(more_);
    row->addStretch(1);
    connect(more_, &QToolButton::clicked, this, &LayersStrip::show_more);
    ask_backdrop = [this] {
        return QFileDialog::getOpenFileName(
            window(), tr("A picture behind the flare"), {},
            tr("Pictures (*.exr *.hdr *.png *.jpg *.jpeg *.tif *.tiff);;All files (*)"));
    };
    connect(&document_, &Document::changed, this, &LayersStrip::follow_document);
    follow_document();
    follow_text_scale(*this, [this] { fit_width(); });
}

void LayersStrip::add_row(LayerKind kind) {
    Row& row = rows_[static_cast<std::size_t>(kind)];
    const LayerText text = text_of(kind);
    row.on = quiet_button(text.title, text.tip, true);
    row.gain = new NumberField("", " EV",
                               tr("Gain of the layer %1, −40 to +40 EV. Wheel or "
                                  "arrows: half a stop.")
                                   .arg(QString(text.title).toLower()));
    row.reset = quiet_button("↺", tr("Back to 0 EV"), false);
    row.alone = quiet_button("◎", tr("Show this layer alone; again for all"), true);
    auto* strip = static_cast<QHBoxLayout*>(layout());
    strip->addWidget(row.on);
    strip->addWidget(row.gain);
    strip->addWidget(row.reset);
    strip->addWidget(row.alone);
    if (kind == LayerKind::ghosts) {
        ringing_ = quiet_button(tr("Ringing"),
                                tr("Diffraction at the ghosts' rims, where its fringes are a pixel "
                                   "wide or more; at rest"),
                                true);
        strip->addWidget(ringing_);
        connect(ringing_, &QToolButton::clicked, this, [this](bool on) {
            Scene scene = document_.scene();
            scene.ringing = on;
            document_.edit_scene(scene, on ? tr("ring the ghosts' rims") : tr("leave rims sharp"));
        });
    }
    strip->addSpacing(8);
    connect(row.on, &QToolButton::clicked, this, [this, kind](bool on) { switch_layer(kind, on); });
    connect(row.alone, &QToolButton::clicked, this, [this, kind](bool on) {
        Scene scene = document_.scene();
        scene.layers.alone = on ? std::optional(kind) : std::nullopt;
        document_.edit_scene(scene, tr("show a layer alone"));
    });
    connect(row.reset, &QToolButton::clicked, this, [this, kind] { set_gain(kind, 0.0); });
    connect(row.gain, &NumberField::stepped, this, [this, kind](int steps) {
        set_gain(kind, document_.scene().layers.of(kind).gain_ev + steps * gain_step_ev);
    });
    connect(row.gain, &NumberField::entered, this,
            [this, kind, field = row.gain](const auto& typed) {
                const auto value = parse_number(typed);
                const bool fits = value && std::abs(*value) <= most_ev;
                field->set_refused(!fits);
                Q_EMIT refused(
                    fits ? QString()
                         : tr("a gain: found '%1', expected stops from −40 to 40").arg(typed));
                if (fits) {
                    set_gain(kind, *value);
                }
            });
}

void LayersStrip::switch_layer(LayerKind kind, bool on) {
    Scene scene = document_.scene();
    if (on && kind == LayerKind::backdrop && scene.backdrop.file.empty()) {
        const QString file = ask_backdrop();
        if (file.isEmpty()) {
            follow_document();
            return;
        }
        scene.backdrop.file = file.toStdString();
    }
    scene.layers.of(kind).on = on;
    document_.edit_scene(scene, on ? tr("show a layer") : tr("hide a layer"));
}

void LayersStrip::set_gain(LayerKind kind, double gain_ev) {
    Scene scene = document_.scene();
    scene.layers.of(kind).gain_ev = std::clamp(gain_ev, -most_ev, most_ev);
    document_.edit_scene(scene, tr("change the gain of a layer"),
                         "gain " + QString::fromUtf8(name(kind).data()));
}

void LayersStrip::follow_document() {
    const LayerSettings& layers = document_.scene().layers;
    ringing_->setEnabled(!document_.is_empty() && layers.shows(LayerKind::ghosts));
    ringing_->setChecked(document_.scene().ringing);
    for (const LayerKind kind : layer_kinds) {
        const Row& row = rows_[static_cast<std::size_t>(kind)];
        const LayerSetting& setting = layers.of(kind);
        row.on->setEnabled(!document_.is_empty());
        row.on->setChecked(setting.on);
        row.alone->setEnabled(!document_.is_empty() && (setting.on || layers.alone == kind));
        row.alone->setChecked(layers.alone == kind);
        row.gain->setEnabled(layers.shows(kind));
        row.gain->set_text(at_least_decimals(std::round(setting.gain_ev * 100.0) / 100.0, 1));
        row.reset->setEnabled(setting.gain_ev != 0.0);
    }
    fit_width();
}

void LayersStrip::fit_width() {
    const LayerSettings& layers = document_.scene().layers;
    enum Room { all, no_alone, no_gains, names, names_of_shown };
    const auto show_for = [&](int room) {
        for (const LayerKind kind : layer_kinds) {
            // What is off takes no room but its name.
            const Row& row = rows_[static_cast<std::size_t>(kind)];
            const LayerSetting& setting = layers.of(kind);
            const bool gained = setting.gain_ev != 0.0;
            row.on->setVisible(room < names_of_shown || setting.on);
            row.alone->setVisible(room < no_alone && (setting.on || layers.alone == kind));
            row.gain->setVisible(room < no_gains && layers.shows(kind));
            row.reset->setVisible(room < no_gains && layers.shows(kind) && gained);
        }
        ringing_->setVisible(room < names);
        more_->setVisible(room > all);
    };
    // Names stay whole; what has no room goes into the menu, the least wanted first.
    for (int room = all; room <= names_of_shown; ++room) {
        show_for(room);
        layout()->invalidate();
        if (layout()->sizeHint().width() <= width()) {
            break;
        }
    }
}

void LayersStrip::show_more() {
    auto* menu = new QMenu(this);
    menu->setObjectName("more_of_layers");
    menu->setAttribute(Qt::WA_DeleteOnClose);
    const LayerSettings& layers = document_.scene().layers;
    for (const LayerKind kind : layer_kinds) {
        const Row& row = rows_[static_cast<std::size_t>(kind)];
        menu->addSection(row.on->text());
        QAction* on = menu->addAction(tr("Shown"));
        on->setCheckable(true);
        on->setChecked(row.on->isChecked());
        on->setEnabled(row.on->isEnabled());
        connect(on, &QAction::triggered, row.on, &QToolButton::click);
        if (layers.shows(kind)) {
            const double gain_ev = layers.of(kind).gain_ev;
            const auto offer = [&](const QString& text, double to_ev) {
                connect(menu->addAction(text), &QAction::triggered, this,
                        [this, kind, to_ev] { set_gain(kind, to_ev); });
            };
            offer(tr("Half a Stop Brighter"), gain_ev + gain_step_ev);
            offer(tr("Half a Stop Darker"), gain_ev - gain_step_ev);
            if (gain_ev != 0.0) {
                offer(row.reset->toolTip(), 0.0);
            }
        }
        QAction* alone = menu->addAction(tr("This Layer Alone"));
        alone->setCheckable(true);
        alone->setChecked(row.alone->isChecked());
        alone->setEnabled(row.alone->isEnabled());
        connect(alone, &QAction::triggered, row.alone, &QToolButton::click);
        if (kind == LayerKind::ghosts) {
            QAction* ringing = menu->addAction(ringing_->text());
            ringing->setCheckable(true);
            ringing->setChecked(ringing_->isChecked());
            ringing->setEnabled(ringing_->isEnabled());
            connect(ringing, &QAction::triggered, ringing_, &QToolButton::click);
        }
    }
    menu->popup(more_->mapToGlobal(QPoint(0, -menu->sizeHint().height())));
}

void LayersStrip::resizeEvent(QResizeEvent* event) {
    QFrame::resizeEvent(event);
    fit_width();
}

}  // namespace ghostlight
