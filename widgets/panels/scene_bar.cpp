#include "widgets/panels/scene_bar.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QSignalBlocker>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/io/spectrum_csv.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "widgets/document.h"
#include "widgets/models/cell_text.h"
#include "widgets/number_text.h"
#include "widgets/panels/scene_field.h"
#include "widgets/prescription_edits.h"
#include "widgets/tabular_text.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

QString as_listed() { return SceneBar::tr("as listed"); }
constexpr double field_step_deg = 0.5;
constexpr double azimuth_step_deg = 5.0;
constexpr double most_field_deg = 89.9;

/// One decimal at least, and not the sixteenth after a drag.
QString angle_text(double angle_deg) {
    return at_least_decimals(std::round(angle_deg * 100.0) / 100.0, 1);
}

double wrapped_azimuth(double azimuth_deg) {
    const double wrapped = std::remainder(azimuth_deg, 360.0);
    return wrapped == -180.0 ? 180.0 : wrapped;
}

}  // namespace

SceneBar::SceneBar(Document& document, QWidget* parent)
    : QToolBar(tr("Scene"), parent),
      document_(document),
      title_(new TabularLabel),
      configuration_(new ChoiceField(tr("Configuration"), tr("Zoom or focus position"), false)),
      f_number_(
          new NumberField("f/", "", tr("F-number, set by the stop. Wheel or arrows: a third."))),
      field_(new NumberField(tr("Field"), "°",
                             tr("Angle of the light from the axis. Wheel or arrows."))),
      azimuth_(new NumberField(tr("Azimuth"), "°",
                               tr("Direction of the light about the axis; 90° is the plane of the "
                                  "layout's drawing."))),
      spectrum_(
          new ChoiceField(tr("Spectrum"),
                          tr("Of the light: D65, A, E, LED-B3, sodium, a black body (5500 K), "
                             "one wavelength (587.5618 nm) or a table (lamp.csv)"),
                          true)),
      tolerance_(new NumberField(tr("Table within"), " %",
                                 tr("Each flux of the ghost table is refined until its own error "
                                    "estimate is below this share of it."))),
      flare_tolerance_(new NumberField(
          tr("Flare within"), " %",
          tr("The flare at rest is drawn with the least work that keeps its error below this share "
             "of its light (relative L1 over the sensor)."))) {
    setObjectName("scene_bar");
    setMovable(false);
    setFloatable(false);
    toggleViewAction()->setVisible(false);
    auto* content = new QWidget;
    set_line_height(*content, 40);  // also without fields
    auto* row = new QHBoxLayout(content);
    row->setContentsMargins(12, 6, 12, 6);
    row->setSpacing(8);
    QFont bold = title_->font();
    bold.setWeight(QFont::DemiBold);
    title_->setFont(bold);
    row->addWidget(title_);
    row->addSpacing(8);
    for (QWidget* field : {static_cast<QWidget*>(configuration_), static_cast<QWidget*>(f_number_),
                           static_cast<QWidget*>(field_), static_cast<QWidget*>(azimuth_),
                           static_cast<QWidget*>(spectrum_), static_cast<QWidget*>(tolerance_),
                           static_cast<QWidget*>(flare_tolerance_)}) {
        row->addWidget(field);
    }
    row->addStretch(1);
    addWidget(content);

    spectrum_->set_choices(
        {"D65", "A", "E", "LED-B3", "sodium", "5500 K", "3200 K", "587.5618 nm", "550 nm"});
    connect_fields();
    connect(&document_, &Document::changed, this, &SceneBar::follow_document);
    connect(&document_, &Document::file_changed, this, &SceneBar::show_title);
    follow_document();
}

template <class Field, class Edit>
void SceneBar::attempt(Field& field, const Edit& edit) {
    try {
        edit();
        field.set_refused(false);
        Q_EMIT refused({});
    } catch (const Error& error) {
        field.set_refused(true);
        Q_EMIT refused(error.what());
    }
}

void SceneBar::set_field_deg(double field_deg) {
    Scene scene = document_.scene();
    scene.light().direction.field_deg = std::clamp(field_deg, -most_field_deg, most_field_deg);
    document_.edit_scene(scene, tr("change field angle"), "light");
}

void SceneBar::set_azimuth_deg(double azimuth_deg) {
    Scene scene = document_.scene();
    scene.light().direction.azimuth_deg = wrapped_azimuth(azimuth_deg);
    document_.edit_scene(scene, tr("change azimuth"), "light");
}

void SceneBar::set_f_number(double f_number) {
    document_.edit_lens(with_f_number(document_.lens(), document_.scene().configuration, f_number),
                        tr("change f-number"), "f-number");
}

void SceneBar::connect_fields() {
    connect(field_, &NumberField::entered, this, [this](const QString& text) {
        attempt(*field_, [&] {
            const double field_deg = read_number(text, tr("a field angle in degrees"));
            if (std::abs(field_deg) >= 90.0) {
                throw Error({tr("the light must come from the front").toStdString(),
                             {},
                             {},
                             text.toStdString(),
                             tr("a field angle below 90 degrees").toStdString()});
            }
            set_field_deg(field_deg);
        });
    });
    connect(field_, &NumberField::stepped, this, [this](int steps) {
        set_field_deg(document_.scene().light().direction.field_deg + steps * field_step_deg);
    });
    connect(azimuth_, &NumberField::entered, this, [this](const QString& text) {
        attempt(*azimuth_, [&] { set_azimuth_deg(read_number(text, tr("an angle in degrees"))); });
    });
    connect(azimuth_, &NumberField::stepped, this, [this](int steps) {
        set_azimuth_deg(document_.scene().light().direction.azimuth_deg + steps * azimuth_step_deg);
    });
    connect(f_number_, &NumberField::entered, this, [this](const QString& text) {
        attempt(*f_number_, [&] { set_f_number(read_positive(text, tr("an f-number above 0"))); });
    });
    connect(f_number_, &NumberField::stepped, this, [this](int steps) {
        // A third of a stop, and no longer number than people write.
        const double next = shown_f_number_ * std::pow(2.0, steps / 6.0);
        if (std::isfinite(next) && next > 0.0) {
            set_f_number(std::round(next * 100.0) / 100.0);
        }
    });
    connect_tolerance(*tolerance_, &Scene::tolerance, tr("change table tolerance"), "tolerance");
    connect_tolerance(*flare_tolerance_, &Scene::flare_tolerance, tr("change flare tolerance"),
                      "flare tolerance");
    connect(spectrum_, &ChoiceField::entered, this, [this](const QString& text) {
        attempt(*spectrum_, [&] {
            Scene scene = document_.scene();
            const std::string wanted = text.trimmed().toStdString();
            // A table is known by its name alone once it has been read.
            if (wanted != name(scene.light().spectrum)) {
                scene.light().spectrum = spectrum_by_name(wanted);
            }
            document_.edit_scene(scene, tr("change spectrum"), "spectrum");
        });
    });
    connect(configuration_, &ChoiceField::entered, this, [this](const QString& text) {
        Scene scene = document_.scene();
        scene.configuration = text == as_listed() ? std::string() : text.toStdString();
        document_.edit_scene(scene, tr("change configuration"), "configuration");
    });
}

void SceneBar::connect_tolerance(NumberField& field, double Scene::*share, const QString& what,
                                 const QString& key) {
    connect(&field, &NumberField::entered, this,
            [this, &field, share, what, key](const QString& text) {
                attempt(field, [&] {
                    const double percent = read_positive(text, tr("per cent, from 0.001 to 50"));
                    if (percent < 1e-3 || percent > 50.0) {
                        throw Error({tr("out of range").toStdString(),
                                     {},
                                     {},
                                     text.toStdString(),
                                     tr("per cent, from 0.001 to 50").toStdString()});
                    }
                    Scene scene = document_.scene();
                    scene.*share = percent / 100.0;
                    document_.edit_scene(scene, what, key);
                });
            });
}

void SceneBar::follow_document() {
    show_title();
    const bool empty = document_.is_empty();
    for (QWidget* field :
         {static_cast<QWidget*>(f_number_), static_cast<QWidget*>(field_),
          static_cast<QWidget*>(azimuth_), static_cast<QWidget*>(spectrum_),
          static_cast<QWidget*>(tolerance_), static_cast<QWidget*>(flare_tolerance_)}) {
        field->setVisible(!empty);
    }
    const auto& configurations = document_.lens().configurations;
    configuration_->setVisible(!configurations.empty());
    if (empty) {
        return;
    }
    const Scene& scene = document_.scene();
    QStringList names = {as_listed()};
    for (const Configuration& configuration : configurations) {
        names << QString::fromStdString(configuration.name);
    }
    configuration_->set_choices(names);
    configuration_->set_text(
        scene.configuration.empty() ? as_listed() : QString::fromStdString(scene.configuration));
    field_->set_text(angle_text(scene.light().direction.field_deg));
    azimuth_->set_text(angle_text(scene.light().direction.azimuth_deg));
    spectrum_->set_text(QString::fromStdString(name(scene.light().spectrum)));
    const auto percent = [](double share) { return shortest(std::round(share * 1e7) / 1e5); };
    tolerance_->set_text(percent(scene.tolerance));
    flare_tolerance_->set_text(percent(scene.flare_tolerance));
    try {
        shown_f_number_ = first_order(compile(document_.configured_lens(), d_line_nm)).f_number;
        f_number_->set_text(at_least_decimals(std::round(shown_f_number_ * 100.0) / 100.0, 1));
    } catch (const Error&) {
        f_number_->set_text("–");  // the banner says why
    }
}

void SceneBar::show_title() {
    const QString title = document_.is_empty() ? tr("No lens") : document_.title();
    title_->set_text('*' + QString(title).remove('*') + '*');
    title_->setToolTip(title + (document_.lens().source.empty()
                                    ? QString()
                                    : "\n" + QString::fromStdString(document_.lens().source)));
}

}  // namespace ghostlight
