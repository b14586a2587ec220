#include "widgets/panels/sweep_panel.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <exception>

#include "core/error.h"
#include "core/io/lens_file.h"
#include "core/io/sweep_table.h"
#include "widgets/number_text.h"
#include "widgets/panel_header.h"
#include "widgets/panels/quiet_button.h"
#include "widgets/panels/sweep_view.h"
#include "widgets/selection.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

constexpr int picture_width_px = 240;
constexpr double coarsest_tolerance = 0.05;
constexpr int most_points = 200;

/// A label and a control in one frame, as in the scene bar.
QFrame* framed_field(const QString& label, QWidget* control) {
    auto* frame = new QFrame;
    frame->setProperty("field", true);
    set_line_height(*frame, 28);
    auto* row = new QHBoxLayout(frame);
    row->setContentsMargins(8, 0, 8, 0);
    row->setSpacing(6);
    if (!label.isEmpty()) {
        row->addWidget(new QLabel(label));
    }
    row->addWidget(control);
    return frame;
}

QLineEdit* number_edit(const char* name, int width) {
    auto* edit = new QLineEdit;
    edit->setObjectName(name);
    edit->setFrame(false);
    set_line_width(*edit, width);
    return edit;
}

}  // namespace

SweepPanel::SweepPanel(Document& document, Selection& selection, QWidget* parent)
    : QWidget(parent),
      document_(document),
      selection_(selection),
      header_(new PanelHeader(tr("Sweep"))),
      parameter_(new QComboBox),
      from_(number_edit("sweep_from", 56)),
      to_(number_edit("sweep_to", 56)),
      count_(number_edit("sweep_count", 28)),
      quantity_(new QComboBox),
      run_(quiet_button(tr("Sweep"), tr("Run the number through its range; again to stop"), false)),
      export_(quiet_button(tr("Export CSV…"),
                           tr("Every ghost at every value, with where it is worst"), false)),
      problem_(new QLabel),
      view_(new SweepView) {
    parameter_->setObjectName("sweep_parameter");
    parameter_->setEditable(true);
    parameter_->setFrame(false);
    parameter_->setMinimumWidth(110);
    parameter_->addItems({"field", "azimuth", "f-number", "position", "radius 1", "curvature 1",
                          "thickness 1", "semi-diameter 1", "coating 1"});
    parameter_->setToolTip(tr(
        "What runs: field, azimuth, f-number, position (of the zoom, from 1), or radius N,\n"
        "curvature N, thickness N, semi-diameter N, coating N (a factor on its layers) of surface "
        "N"));
    quantity_->setFrame(false);
    quantity_->addItems({tr("flux"), tr("flux on sensor"), tr("peak")});
    count_->setText("9");
    problem_->setObjectName("refusal");
    problem_->setWordWrap(true);
    problem_->hide();
    auto* strip = new QFrame;
    strip->setObjectName("layers_strip");
    set_line_height(*strip, 40);
    auto* row = new QHBoxLayout(strip);
    row->setContentsMargins(12, 6, 12, 6);
    row->setSpacing(6);
    row->addWidget(framed_field({}, parameter_));
    row->addWidget(framed_field(tr("from"), from_));
    row->addWidget(framed_field(tr("to"), to_));
    row->addWidget(framed_field(tr("points"), count_));
    row->addWidget(run_);
    row->addWidget(framed_field(tr("curves"), quantity_));
    row->addWidget(export_);
    row->addStretch(1);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(header_);
    column->addWidget(strip);
    column->addWidget(problem_);
    column->addWidget(view_, 1);

    connect(parameter_, &QComboBox::currentTextChanged, this, &SweepPanel::suggest_range);
    connect(quantity_, &QComboBox::currentIndexChanged, this,
            [this](int index) { view_->set_quantity(static_cast<SweepQuantity>(index)); });
    connect(run_, &QToolButton::clicked, this, [this] { running_ ? stop() : start(); });
    for (QLineEdit* edit : {from_, to_, count_}) {
        connect(edit, &QLineEdit::returnPressed, this, &SweepPanel::start);
    }
    connect(export_, &QToolButton::clicked, this, &SweepPanel::export_csv);
    connect(view_, &SweepView::value_chosen, this, &SweepPanel::go_to);
    connect(view_, &SweepView::ghost_chosen, this,
            [this](const GhostPath& path) { selection_.set_ghosts({path}); });
    connect(&selection_, &Selection::ghosts_changed, this,
            [this] { view_->set_selected(selection_.ghosts()); });
    connect(&document_, &Document::opened, this, [this] {
        stop();
        points_.clear();
        view_->show_points(swept_, {}, 0, 0);
    });
    connect(&document_, &Document::changed, this, [this](bool) {
        if (document_.revision() == document_.first_revision()) {
            suggest_range();
        }
        show_state();
    });
    job_ = std::make_unique<NewestJob<Wanted>>(
        [this](const Wanted& wanted, std::stop_token stop) { work(wanted, stop); });
    suggest_range();
    show_state();
}

SweepPanel::~SweepPanel() { job_.reset(); }

QString SweepPanel::problem() const { return problem_->isHidden() ? QString() : problem_->text(); }

void SweepPanel::suggest_range() {
    if (document_.is_empty()) {
        return;
    }
    try {
        const Prescription& lens = document_.lens();
        const Scene& scene = document_.scene();
        const SweepParameter parameter =
            parse_sweep_parameter(parameter_->currentText().toStdString(), lens);
        const double now =
            present_value(lens, scene.configuration, scene.light().direction, parameter);
        double from = now - 0.2 * std::abs(now), to = now + 0.2 * std::abs(now);
        switch (parameter.kind) {
            case SweepParameter::Kind::field:
                from = 0.0;
                to = std::floor(half_field_deg(document_.configured_lens()));
                break;
            case SweepParameter::Kind::azimuth:
                from = 0.0;
                to = 90.0;
                break;
            case SweepParameter::Kind::f_number:
                from = now;
                to = std::max(16.0, now);
                break;
            case SweepParameter::Kind::position:
                from = 1.0;
                to = static_cast<double>(lens.configurations.size());
                break;
            default:
                break;
        }
        const auto text = [](double value) { return QString::number(value, 'g', 4); };
        from_->setText(text(from));
        to_->setText(text(to));
        show_problem({});
    } catch (const Error&) {
        // Half typed: said when it is run.
    }
}

void SweepPanel::show_problem(const QString& problem) {
    problem_->setText(problem);
    problem_->setVisible(!problem.isEmpty());
}

void SweepPanel::start() {
    if (document_.is_empty()) {
        return;
    }
    const auto from = parse_number(from_->text()), to = parse_number(to_->text());
    bool is_whole = false;
    const int count = count_->text().toInt(&is_whole);
    if (!from || !to) {
        show_problem(
            from ? tr("'%1' is no number: expected where the range ends").arg(to_->text())
                 : tr("'%1' is no number: expected where the range begins").arg(from_->text()));
        return;
    }
    if (!is_whole || count < 2 || count > most_points) {
        show_problem(tr("'%1' points: expected 2 to %2").arg(count_->text()).arg(most_points));
        return;
    }
    try {
        const Scene& scene = document_.scene();
        Wanted wanted;
        wanted.lens = document_.lens();
        SweepRequest& request = wanted.request;
        request.parameter =
            parse_sweep_parameter(parameter_->currentText().toStdString(), wanted.lens);
        for (int k = 0; k < count; ++k) {
            request.values.push_back(std::lerp(*from, *to, static_cast<double>(k) / (count - 1)));
        }
        request.configuration = scene.configuration;
        request.table.light = scene.light().direction;
        request.table.spectrum = scene.light().spectrum;
        request.table.tolerance = std::max(scene.tolerance, coarsest_tolerance);
        request.picture_width_px = picture_width_px;
        wanted.serial = ++serial_;
        swept_ = request.parameter;
        wanted_ = request.values.size();
        surface_count_ = wanted.lens.surfaces.size();
        revision_ = document_.revision();
        points_.clear();
        running_ = true;
        show_problem({});
        view_->show_points(swept_, {}, wanted_, surface_count_);
        job_->submit(std::move(wanted));
    } catch (const Error& error) {
        show_problem(QString::fromUtf8(error.what()));
    }
    show_state();
}

void SweepPanel::stop() {
    job_->cancel();
    ++serial_;
    running_ = false;
    show_state();
}

void SweepPanel::work(const Wanted& wanted, const std::stop_token& stop) {
    try {
        sweep(wanted.lens, wanted.request, stop, [&](const SweepPoint& point) {
            QMetaObject::invokeMethod(
                this, [this, point, serial = wanted.serial] { take(point, serial); },
                Qt::QueuedConnection);
        });
    } catch (const std::exception& error) {
        QMetaObject::invokeMethod(
            this,
            [this, reason = QString::fromUtf8(error.what()), serial = wanted.serial] {
                if (serial == serial_) {
                    show_problem(reason);
                }
            },
            Qt::QueuedConnection);
    }
    QMetaObject::invokeMethod(
        this, [this, serial = wanted.serial] { finish(serial); }, Qt::QueuedConnection);
}

void SweepPanel::take(SweepPoint point, std::uint64_t serial) {
    if (serial != serial_) {
        return;
    }
    if (!point.failure.empty()) {
        show_problem(QStringLiteral("%1 = %2: %3")
                         .arg(QString::fromStdString(name(swept_)),
                              QString::number(point.value, 'g', 4),
                              QString::fromStdString(point.failure)));
    }
    points_.push_back(std::move(point));
    view_->show_points(swept_, points_, wanted_, surface_count_);
    show_state();
}

void SweepPanel::finish(std::uint64_t serial) {
    if (serial == serial_) {
        running_ = false;
        show_state();
    }
}

void SweepPanel::show_state() {
    run_->setText(running_ ? tr("Stop", "the sweep") : tr("Sweep"));
    run_->setEnabled(!document_.is_empty());
    export_->setEnabled(!points_.empty());
    QString state;
    if (running_) {
        state = tr("%1 of %2").arg(points_.size()).arg(wanted_);
    } else if (!points_.empty()) {
        state =
            tr("%1 · %2 points%3")
                .arg(QString::fromStdString(name(swept_)))
                .arg(points_.size())
                .arg(revision_ == document_.revision() ? QString() : tr(" · of an earlier state"));
    }
    header_->set_state(state);
}

void SweepPanel::go_to(double value) {
    Scene scene = document_.scene();
    if (swept_.kind == SweepParameter::Kind::field) {
        scene.light().direction.field_deg = value;
    } else if (swept_.kind == SweepParameter::Kind::azimuth) {
        scene.light().direction.azimuth_deg = value;
    } else if (swept_.kind == SweepParameter::Kind::f_number) {
        Prescription lens = document_.lens();
        lens.stop.f_number = value;
        document_.edit_lens(lens, tr("set the f-number"));
        return;
    }
    document_.edit_scene(scene, tr("go to a place of the sweep"));
}

QString SweepPanel::csv() const {
    return QString::fromStdString(table_csv(sweep_table(swept_, points_)));
}

void SweepPanel::export_csv() {
    const QString file = QFileDialog::getSaveFileName(window(), tr("Export the Sweep"), "sweep.csv",
                                                      tr("Tables (*.csv)"));
    if (file.isEmpty()) {
        return;
    }
    try {
        write_file_safely(file.toStdString(), csv().toStdString());
        show_problem({});
    } catch (const Error& error) {
        show_problem(QString::fromUtf8(error.what()));
    }
}

}  // namespace ghostlight
