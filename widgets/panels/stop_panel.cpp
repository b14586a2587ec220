#include "widgets/panels/stop_panel.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QStackedWidget>
#include <QStyle>
#include <QToolButton>
#include <QVBoxLayout>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <utility>

#include "core/error.h"
#include "core/flare/mask_raster.h"
#include "core/flare/starburst.h"
#include "core/flare/tone_map.h"
#include "core/io/stop_image_file.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "render/auto_exposure.h"
#include "widgets/actions.h"
#include "widgets/document.h"
#include "widgets/models/cell_text.h"
#include "widgets/number_text.h"
#include "widgets/panel_header.h"
#include "widgets/panels/empty_state.h"
#include "widgets/panels/scrub.h"
#include "widgets/panels/stop_statistics.h"
#include "widgets/prescription_edits.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

QString what_is_here() {
    return StopPanel::tr(
        "The stop's blades, an image over its opening, dust and scratches, and the starburst they "
        "make.");
}
constexpr int least_blades = 3;
constexpr int picture_px = 168;
/// The starburst is shown on this much of the sensor's width, about the axis.
constexpr double shown_share = 1.0 / 6.0;
constexpr double starburst_exposure_share = 0.004;

/// A number within a range, or Error with the range.
double number_within(const QString& text, double least, double most, const QString& expected) {
    const double value = read_number(text, expected);
    if (!(value >= least && value <= most)) {
        throw Error({StopPanel::tr("out of range").toStdString(),
                     {},
                     {},
                     text.toStdString(),
                     expected.toStdString()});
    }
    return value;
}
int count_within(const QString& text, int least, int most, const QString& expected) {
    const double value = number_within(text, least, most, expected);
    if (value != std::floor(value)) {
        throw Error({StopPanel::tr("not a whole number").toStdString(),
                     {},
                     {},
                     text.toStdString(),
                     expected.toStdString()});
    }
    return static_cast<int>(value);
}

QString percent(double share) { return shortest(std::round(share * 1e7) / 1e5); }

QImage opening_picture(const OpticalSystem& system, const StopDirt& dirt) {
    const MaskRaster raster = mask_raster(system.stop_mask, dirt, picture_px);
    QImage picture(picture_px, picture_px, QImage::Format_Grayscale8);
    for (int y = 0; y < picture_px; ++y) {
        uchar* line = picture.scanLine(y);
        for (int x = 0; x < picture_px; ++x) {
            const auto at = static_cast<std::size_t>((picture_px - 1 - y) * picture_px + x);
            line[x] = static_cast<uchar>(std::lround(255.0F * srgb_encoded(raster.open[at])));
        }
    }
    return picture;
}

QImage starburst_picture(const FlareImage& image) {
    const double exposure_ev = auto_exposure_ev(image, starburst_exposure_share);
    const std::vector<float> rgb = upright_picture(image.rgb, image.width_px, image.height_px, 3);
    QImage picture(image.width_px, image.height_px, QImage::Format_RGB32);
    for (int y = 0; y < image.height_px; ++y) {
        auto* line = reinterpret_cast<QRgb*>(picture.scanLine(y));
        for (int x = 0; x < image.width_px; ++x) {
            const auto at = 3 * static_cast<std::size_t>(y * image.width_px + x);
            const auto shown = tone_mapped({rgb[at], rgb[at + 1], rgb[at + 2]}, exposure_ev);
            const auto byte = [](float value) {
                return static_cast<int>(std::lround(255 * value));
            };
            line[x] = qRgb(byte(shown[0]), byte(shown[1]), byte(shown[2]));
        }
    }
    return picture;
}

QLabel* picture_label(const QString& tip) {
    auto* label = new QLabel;
    label->setFixedSize(picture_px, picture_px);
    label->setAlignment(Qt::AlignCenter);
    label->setToolTip(tip);
    label->setStyleSheet("background: black;");
    return label;
}

QLabel* dim_label(const QString& text) {
    auto* label = new QLabel(text);
    label->setForegroundRole(QPalette::PlaceholderText);
    return label;
}

void set_refused(QLineEdit& editor, bool refused) {
    editor.setProperty("refused", refused);
    editor.setStyleSheet(refused ? "QLineEdit { border: 1px solid #ff7a59; }" : "");
}

}  // namespace

StopPanel::StopPanel(Document& document, const Actions& actions, QWidget* parent)
    : QWidget(parent),
      document_(document),
      header_(new PanelHeader(tr("Stop"))),
      empty_(new EmptyState(what_is_here(), tr("Open a lens…"))),
      pages_(new QStackedWidget),
      opening_label_(picture_label(tr("The opening, its right +x and its top +y"))),
      starburst_label_(picture_label(tr("Light on the axis as the opening diffracts it, in the "
                                        "middle sixth of the sensor's width"))),
      reason_label_(new QLabel),
      statistics_label_(dim_label({})) {
    auto* content = new QWidget;
    auto* column = new QVBoxLayout(content);
    column->setContentsMargins(12, 10, 12, 10);
    column->setSpacing(10);
    auto* pictures = new QHBoxLayout;
    pictures->setSpacing(8);
    pictures->addWidget(opening_label_);
    pictures->addWidget(starburst_label_);
    pictures->addStretch(1);
    column->addLayout(pictures);
    reason_label_->setWordWrap(true);
    reason_label_->setObjectName("stop_reason");
    reason_label_->hide();
    column->addWidget(reason_label_);
    statistics_label_->setObjectName("stop_statistics");
    statistics_label_->setWordWrap(true);
    column->addWidget(statistics_label_);
    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(8);
    grid->setVerticalSpacing(4);
    add_rows(*grid);
    column->addLayout(grid);
    column->addStretch(1);
    auto* scroll = new QScrollArea;
    scroll->setWidget(content);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    pages_->addWidget(empty_);
    pages_->addWidget(scroll);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->setSpacing(0);
    outer->addWidget(header_);
    outer->addWidget(pages_, 1);

    job_ = std::make_unique<NewestJob<Request>>(
        [this](const Request& request, const std::stop_token& stop) { work_on(request, stop); });
    delay_.setSingleShot(true);
    delay_.setInterval(0);
    connect(&delay_, &QTimer::timeout, this, &StopPanel::request);
    connect(empty_, &EmptyState::action_triggered, &actions["file.open"], &QAction::trigger);
    connect(&document_, &Document::changed, this, &StopPanel::follow_document);
    follow_document();
}

StopPanel::~StopPanel() = default;

QLineEdit& StopPanel::editor(const QString& name) const {
    return *std::ranges::find(rows_, name, &Row::name)->editor;
}

QToolButton& StopPanel::reset_button(const QString& name) const {
    return *std::ranges::find(rows_, name, &Row::name)->reset;
}

void StopPanel::add_row(QGridLayout& grid, const QString& name, const QString& label,
                        const QString& unit, const QString& tip, Stride stride,
                        std::function<QString(const Stop&)> text,
                        std::function<void(Stop&, const QString&)> read,
                        std::function<void(Stop&)> clear) {
    Row row{name,
            nullptr,
            nullptr,
            stride,
            [text = std::move(text)](const Prescription& lens) { return text(lens.stop); },
            [read = std::move(read)](Prescription& lens, const QString& typed) {
                read(lens.stop, typed);
            },
            [clear = std::move(clear)](Prescription& lens) { clear(lens.stop); }};
    add_lens_row(grid, label, unit, tip, std::move(row));
}

void StopPanel::add_lens_row(QGridLayout& grid, const QString& label, const QString& unit,
                             const QString& tip, Row row) {
    const int at = grid.rowCount();
    const bool can_step = row.stride.by > 0.0;
    const QString whole_tip =
        can_step ? tip + tr("\nDrag its name sideways to change it; arrow keys go by steps.") : tip;
    auto* editor = new QLineEdit;
    editor->setObjectName("stop_" + row.name);
    editor->setAccessibleName(label);
    editor->setToolTip(whole_tip);
    set_line_width(*editor, 96);
    editor->installEventFilter(this);
    auto* title = new QLabel(label);
    title->setToolTip(whole_tip);
    auto* reset = new QToolButton;
    reset->setText("↺");
    reset->setAutoRaise(true);
    reset->setToolTip(tr("Back to what it usually is"));
    reset->setAccessibleName(tr("Reset %1").arg(label));
    grid.addWidget(title, at, 0);
    grid.addWidget(editor, at, 1);
    grid.addWidget(dim_label(unit), at, 2);
    grid.addWidget(reset, at, 3);
    grid.setColumnStretch(2, 1);
    row.editor = editor;
    row.reset = reset;
    rows_.push_back(std::move(row));
    const std::size_t index = rows_.size() - 1;
    const auto finish = [this, index] {
        const Row& each = rows_[index];
        if (each.editor->isModified()) {
            each.editor->setModified(false);
            enter(each, each.editor->text());
        }
    };
    connect(editor, &QLineEdit::editingFinished, this, finish);
    connect(reset, &QToolButton::clicked, this, [this, index, label] {
        change(tr("reset the stop's %1").arg(label.toLower()), {}, rows_[index].clear);
    });
    if (can_step) {
        title->setCursor(Qt::SizeHorCursor);
        auto* scrub = new Scrub(*title, Qt::LeftButton);
        const auto done = std::make_shared<int>(0);
        connect(scrub, &Scrub::begun, this, [done] { *done = 0; });
        connect(scrub, &Scrub::moved, this, [this, index, done](double px) {
            constexpr double step_px = 6.0;
            const int steps = static_cast<int>(px / step_px) - *done;
            if (steps != 0) {
                *done += steps;
                step(rows_[index], steps);
            }
        });
    }
}

void StopPanel::step(const Row& row, int steps) {
    const auto now = parse_number(row.text(document_.lens()));
    if (document_.is_empty() || !now) {
        return;
    }
    double next = *now + steps * row.stride.by;
    if (row.stride.ratio != 1.0 && *now > 0.0) {
        next = *now * std::pow(row.stride.ratio, steps);
        next = parse_number(significant(next, 3)).value_or(next);  // as people write numbers
    }
    if (row.name == "blades" && next > 0.0 && next < least_blades) {
        next = steps > 0 ? least_blades : 0.0;
    }
    try {
        take(row, shortest(std::round(next * 1e4) / 1e4));
    } catch (const Error&) {
        // At the end of its range it stays where it is.
    }
}

bool StopPanel::eventFilter(QObject* watched, QEvent* event) {
    const auto row = std::ranges::find(rows_, watched, &Row::editor);
    if (row == rows_.end() || !(row->stride.by > 0.0)) {
        return QWidget::eventFilter(watched, event);
    }
    if (event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        if (key == Qt::Key_Up || key == Qt::Key_Down) {
            row->editor->setModified(false);
            step(*row, key == Qt::Key_Up ? 1 : -1);
            return true;
        }
    } else if (event->type() == QEvent::Wheel && row->editor->hasFocus()) {
        const int turned = static_cast<QWheelEvent*>(event)->angleDelta().y();
        if (turned != 0) {
            row->editor->setModified(false);
            step(*row, turned > 0 ? 1 : -1);
            return true;
        }
    }
    return QWidget::eventFilter(watched, event);
}

void StopPanel::add_f_number_row(QGridLayout& grid) {
    const auto present = [this](const Prescription&) {
        try {
            const double f = first_order(compile(document_.configured_lens(), d_line_nm)).f_number;
            return shortest(std::round(f * 100.0) / 100.0);
        } catch (const Error&) {
            return QString();  // the banner says why
        }
    };
    const auto read = [this](Prescription& lens, const QString& text) {
        lens = with_f_number(std::move(lens), document_.scene().configuration,
                             number_within(text, 0.01, 1e6, tr("an f-number above 0")));
    };
    const auto clear = [this](Prescription& lens) {
        lens.stop.f_number.reset();
        lens.stop.semi_diameter_mm.reset();
        for (Configuration& each : lens.configurations) {
            if (each.name == document_.scene().configuration) {
                each.f_number.reset();
            }
        }
    };
    constexpr double third_of_a_stop = 1.122462048309373;  // 2^(1/6)
    add_lens_row(grid, tr("f-number"), tr("reset: fully open"),
                 tr("How far the stop is closed, in this configuration."),
                 {"f_number", nullptr, nullptr, {0.1, third_of_a_stop}, present, read, clear});
}

void StopPanel::add_rows(QGridLayout& grid) {
    const Stop usual;
    add_f_number_row(grid);
    add_row(
        grid, "blades", tr("Blades"), tr("0 round, 3–1000"),
        tr("Blades of the stop; 0 is a round one."), {1.0},
        [](const Stop& stop) { return QString::number(stop.blades); },
        [](Stop& stop, const QString& text) {
            const int blades = count_within(text, 0, 1000, tr("0 (round), or 3 to 1000 blades"));
            if (blades == 1 || blades == 2) {
                throw Error({tr("not a usable number of blades").toStdString(),
                             {},
                             {},
                             text.toStdString(),
                             tr("0 (round), or 3 to 1000").toStdString()});
            }
            stop.blades = blades;
        },
        [usual](Stop& stop) { stop.blades = usual.blades; });
    add_row(
        grid, "curvature", tr("Roundness"), tr("0 straight – 1 round"),
        tr("Curvature of the blades: 0 straight edges, 1 the full circle."), {0.05},
        [](const Stop& stop) { return shortest(stop.blade_curvature); },
        [](Stop& stop, const QString& text) {
            stop.blade_curvature = number_within(text, 0.0, 1.0, tr("a roundness from 0 to 1"));
        },
        [usual](Stop& stop) { stop.blade_curvature = usual.blade_curvature; });
    add_row(
        grid, "rotation", tr("Rotation"), "°", tr("Turns blades and image, counter-clockwise."),
        {1.0}, [](const Stop& stop) { return shortest(stop.rotation_deg); },
        [](Stop& stop, const QString& text) {
            stop.rotation_deg = read_number(text, tr("an angle in degrees"));
        },
        [usual](Stop& stop) { stop.rotation_deg = usual.rotation_deg; });
    add_image_row(grid);
    const auto add_dirt = [&](const char* name, const QString& label, const QString& unit,
                              const QString& tip, Stride stride, double StopDirt::*value,
                              double least, double most, const QString& expected, double scale) {
        const double reset_to = StopDirt{}.*value;
        add_row(
            grid, name, label, unit, tip, stride,
            [value, scale](const Stop& stop) {
                return scale == 1.0 ? shortest(stop.dirt.*value) : percent(stop.dirt.*value);
            },
            [=](Stop& stop, const QString& text) {
                stop.dirt.*value = number_within(text, least, most, expected) / scale;
            },
            [=](Stop& stop) { stop.dirt.*value = reset_to; });
    };
    const QString diameter = tr("a diameter in mm, 0.0001 to 10");
    const QString width = tr("a width in mm, 0.0001 to 10");
    constexpr Stride size{0.001, 1.1};  // mm
    constexpr Stride share{0.1, 1.1};   // per cent
    add_dirt("dust", tr("Dust"), tr("% of the stop, 0–50"),
             tr("Share of the stop that opaque specks cover."), share, &StopDirt::dust_coverage,
             0.0, 50.0, tr("per cent, from 0 to 50"), 100.0);
    add_dirt("dust_smallest", tr("Specks from"), "mm", tr("Diameter of the smallest speck."), size,
             &StopDirt::dust_smallest_mm, 1e-4, 10.0, diameter, 1.0);
    add_dirt("dust_largest", tr("Specks to"), "mm", tr("Diameter of the largest speck."), size,
             &StopDirt::dust_largest_mm, 1e-4, 10.0, diameter, 1.0);
    add_row(
        grid, "scratches", tr("Scratches"), "0–10000",
        tr("How many, each a tenth to the whole of the stop's radius long."), {1.0},
        [](const Stop& stop) { return QString::number(stop.dirt.scratches); },
        [](Stop& stop, const QString& text) {
            stop.dirt.scratches = count_within(text, 0, 10'000, tr("how many, 0 to 10000"));
        },
        [](Stop& stop) { stop.dirt.scratches = 0; });
    add_dirt("scratch_thinnest", tr("Widths from"), "mm", tr("Width of the thinnest scratch."),
             size, &StopDirt::scratch_thinnest_mm, 1e-4, 10.0, width, 1.0);
    add_dirt("scratch_widest", tr("Widths to"), "mm", tr("Width of the widest scratch."), size,
             &StopDirt::scratch_widest_mm, 1e-4, 10.0, width, 1.0);
    add_dirt("fingerprint", tr("Fingerprint"), tr("% that its ridges take, 0–100"),
             tr("One print; its ridges take this share of the light."), share,
             &StopDirt::fingerprint, 0.0, 100.0, tr("per cent, from 0 to 100"), 100.0);
    add_row(
        grid, "seed", tr("Seed"), "", tr("Another number scatters the same dirt otherwise."), {1.0},
        [](const Stop& stop) { return QString::number(stop.dirt.seed); },
        [](Stop& stop, const QString& text) {
            stop.dirt.seed =
                count_within(text, 0, 1'000'000'000, tr("a whole number from 0 to 1000000000"));
        },
        [usual](Stop& stop) { stop.dirt.seed = usual.dirt.seed; });
}

void StopPanel::add_image_row(QGridLayout& grid) {
    add_row(
        grid, "image", tr("Image"), "",
        tr("An image over the opening, white where it is open. Nothing: the blades alone."), {},
        [](const Stop& stop) {
            return stop.image ? QFileInfo(QString::fromStdString(stop.image->file)).fileName()
                              : QString();
        },
        [](Stop& stop, const QString& text) {
            if (text.trimmed().isEmpty()) {
                stop.image.reset();
            } else {
                stop.image = read_stop_image(text.trimmed().toStdString());
            }
        },
        [](Stop& stop) { stop.image.reset(); });
    auto* choose = new QToolButton;
    choose->setText(tr("Choose…"));
    choose->setObjectName("stop_choose_image");
    grid.addWidget(choose, grid.rowCount() - 1, 2, Qt::AlignLeft);
    connect(choose, &QToolButton::clicked, this, [this] {
        const QString file = QFileDialog::getOpenFileName(
            this, tr("Image of the stop"), {},
            tr("Images (*.png *.tif *.tiff *.exr *.jpg *.jpeg *.bmp *.webp);;All files (*)"));
        if (!file.isEmpty()) {
            take_image(file);
        }
    });
}

bool StopPanel::take_image(const QString& file) {
    const Row& row = *std::ranges::find(rows_, QString("image"), &Row::name);
    enter(row, file);
    return reason_.isEmpty();
}

void StopPanel::enter(const Row& row, const QString& text) {
    try {
        take(row, text);
    } catch (const Error& error) {
        set_refused(*row.editor, true);
        show_reason(QString::fromUtf8(error.what()));
    }
}

void StopPanel::take(const Row& row, const QString& text) {
    Prescription lens = document_.lens();
    row.read(lens, text);
    validate(lens);
    show_reason({});
    set_refused(*row.editor, false);
    document_.edit_lens(std::move(lens),
                        tr("change the stop's %1").arg(row.editor->accessibleName().toLower()),
                        "stop." + row.name);
    follow_document();  // also where nothing changed: the text as it is written here
}

void StopPanel::change(const QString& what, const QString& field,
                       const std::function<void(Prescription&)>& edit) {
    Prescription lens = document_.lens();
    edit(lens);
    show_reason({});
    document_.edit_lens(std::move(lens), what, field);
    follow_document();
}

void StopPanel::follow_document() {
    pages_->setCurrentIndex(document_.is_empty() ? 0 : 1);
    if (document_.is_empty()) {
        header_->set_state(QString());
        return;
    }
    const Prescription& lens = document_.lens();
    for (const Row& row : rows_) {
        if (row.editor->hasFocus() && row.editor->isModified()) {
            continue;
        }
        row.editor->setText(row.text(lens));
        set_refused(*row.editor, false);
        Prescription cleared = lens;
        row.clear(cleared);
        row.reset->setEnabled(cleared != lens);
    }
    delay_.start();
}

void StopPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    delay_.start();
}

void StopPanel::request() {
    // Behind a tab nobody sees the starburst, which takes longer than most edits.
    const bool is_hidden = !isVisible() && window()->isVisible();
    if (document_.is_empty() || is_hidden) {
        return;
    }
    try {
        Prescription lens = document_.configured_lens();
        const Spectrum spectrum = document_.scene().light().spectrum;
        if (lens == asked_ && spectrum == asked_spectrum_) {
            return;  // the light moves, and nothing here changes
        }
        asked_ = lens;
        asked_spectrum_ = spectrum;
        header_->set_dimmed(true);
        job_->submit({std::move(lens), spectrum, ++serial_});
    } catch (const Error& error) {  // the configuration is not one of the lens's
        asked_ = {};
        ++serial_;
        show_pictures({{}, {}, {}, {}, QString::fromUtf8(error.what())}, serial_);
    }
}

void StopPanel::work_on(const Request& request, const std::stop_token& stop) {
    Shown shown;
    try {
        const OpticalSystem system = compile(request.lens, d_line_nm);
        shown.opening = opening_picture(system, request.lens.stop.dirt);
        const double share = clear_share(system.stop_mask, request.lens.stop.dirt);
        shown.state =
            QStringLiteral("⌀ %1 mm").arg(significant(2.0 * system.stop_mask.semi_diameter_mm, 4));
        if (share < 1.0) {
            shown.state += tr(" · %1 % clear").arg(significant(100.0 * share, 4));
        }
        shown.statistics = stop_statistics(request.lens.stop, system);
        StarburstRequest wanted;
        wanted.light = {0.0, 90.0};
        wanted.spectrum = request.spectrum;
        wanted.width_px = picture_px;
        Prescription near_axis = request.lens;
        near_axis.sensor.width_mm *= shown_share;
        near_axis.sensor.height_mm = near_axis.sensor.width_mm;
        const auto image = render_starburst(near_axis, wanted, stop);
        if (!image) {
            return;  // a newer one is on its way
        }
        shown.starburst = starburst_picture(*image);
    } catch (const std::exception& error) {
        shown.reason = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(
        this, [this, shown, serial = request.serial] { show_pictures(shown, serial); },
        Qt::QueuedConnection);
}

void StopPanel::show_pictures(const Shown& shown, std::uint64_t serial) {
    if (serial != serial_) {
        return;
    }
    shown_serial_ = serial;
    opening_ = shown.opening;
    starburst_ = shown.starburst;
    opening_label_->setPixmap(QPixmap::fromImage(opening_));
    starburst_label_->setPixmap(QPixmap::fromImage(starburst_));
    statistics_label_->setText(shown.statistics);
    header_->set_state(shown.state);
    header_->set_dimmed(false);
    show_reason(shown.reason);
}

QString StopPanel::statistics() const { return statistics_label_->text(); }

void StopPanel::show_reason(const QString& reason) {
    reason_ = reason;
    reason_label_->setText(reason);
    reason_label_->setVisible(!reason.isEmpty());
}

}  // namespace ghostlight
