#include "widgets/panels/stop_panel.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QStackedWidget>
#include <QStyle>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "core/error.h"
#include "core/flare/mask_raster.h"
#include "core/flare/starburst.h"
#include "core/flare/tone_map.h"
#include "core/io/stop_image_file.h"
#include "core/optics/optical_system.h"
#include "core/units.h"
#include "render/auto_exposure.h"
#include "widgets/actions.h"
#include "widgets/document.h"
#include "widgets/models/cell_text.h"
#include "widgets/number_text.h"
#include "widgets/panel_header.h"
#include "widgets/panels/empty_state.h"

namespace ghostlight {

namespace {

constexpr const char* what_is_here =
    "The stop's blades, an image over its opening, dust and scratches, and the starburst they "
    "make.";
constexpr int picture_px = 168;
/// The starburst is shown on this much of the sensor's width, about the axis.
constexpr double shown_share = 1.0 / 6.0;
constexpr double starburst_exposure_share = 0.004;

/// A number within a range, or Error with the range.
double number_within(const QString& text, double least, double most, const char* expected) {
    const double value = read_number(text, expected);
    if (!(value >= least && value <= most)) {
        throw Error({"out of range", {}, {}, text.toStdString(), expected});
    }
    return value;
}
int count_within(const QString& text, int least, int most, const char* expected) {
    const double value = number_within(text, least, most, expected);
    if (value != std::floor(value)) {
        throw Error({"not a whole number", {}, {}, text.toStdString(), expected});
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
      header_(new PanelHeader("Stop")),
      empty_(new EmptyState(what_is_here, "Open a lens…")),
      pages_(new QStackedWidget),
      opening_label_(picture_label("The opening, its right +x and its top +y")),
      starburst_label_(picture_label("Light on the axis as the opening diffracts it, in the "
                                     "middle sixth of the sensor's width")),
      reason_label_(new QLabel) {
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
                        const QString& unit, const QString& tip,
                        std::function<QString(const Stop&)> text,
                        std::function<void(Stop&, const QString&)> read,
                        std::function<void(Stop&)> clear) {
    const int at = grid.rowCount();
    auto* editor = new QLineEdit;
    editor->setObjectName("stop_" + name);
    editor->setAccessibleName(label);
    editor->setToolTip(tip);
    editor->setFixedWidth(96);
    auto* title = new QLabel(label);
    title->setToolTip(tip);
    auto* reset = new QToolButton;
    reset->setText("↺");
    reset->setAutoRaise(true);
    reset->setToolTip("Back to what it usually is");
    reset->setAccessibleName("Reset " + label);
    grid.addWidget(title, at, 0);
    grid.addWidget(editor, at, 1);
    grid.addWidget(dim_label(unit), at, 2);
    grid.addWidget(reset, at, 3);
    grid.setColumnStretch(2, 1);
    rows_.push_back({name, editor, reset, std::move(text), std::move(read), std::move(clear)});
    const std::size_t index = rows_.size() - 1;
    const auto finish = [this, index] {
        const Row& row = rows_[index];
        if (row.editor->isModified()) {
            row.editor->setModified(false);
            enter(row, row.editor->text());
        }
    };
    connect(editor, &QLineEdit::editingFinished, this, finish);
    connect(reset, &QToolButton::clicked, this, [this, index] {
        const Row& row = rows_[index];
        change("reset the stop's " + row.name, {}, row.clear);
    });
}

void StopPanel::add_rows(QGridLayout& grid) {
    const Stop usual;
    add_row(
        grid, "blades", "Blades", "0 round, 3–1000", "Blades of the stop; 0 is a round one.",
        [](const Stop& stop) { return QString::number(stop.blades); },
        [](Stop& stop, const QString& text) {
            const int blades = count_within(text, 0, 1000, "0 (round), or 3 to 1000 blades");
            if (blades == 1 || blades == 2) {
                throw Error({"not a usable number of blades",
                             {},
                             {},
                             text.toStdString(),
                             "0 (round), or 3 to 1000"});
            }
            stop.blades = blades;
        },
        [usual](Stop& stop) { stop.blades = usual.blades; });
    add_row(
        grid, "curvature", "Roundness", "0 straight – 1 round",
        "Curvature of the blades: 0 straight edges, 1 the full circle.",
        [](const Stop& stop) { return shortest(stop.blade_curvature); },
        [](Stop& stop, const QString& text) {
            stop.blade_curvature = number_within(text, 0.0, 1.0, "a roundness from 0 to 1");
        },
        [usual](Stop& stop) { stop.blade_curvature = usual.blade_curvature; });
    add_row(
        grid, "rotation", "Rotation", "°", "Turns blades and image, counter-clockwise.",
        [](const Stop& stop) { return shortest(stop.rotation_deg); },
        [](Stop& stop, const QString& text) {
            stop.rotation_deg = read_number(text, "an angle in degrees");
        },
        [usual](Stop& stop) { stop.rotation_deg = usual.rotation_deg; });
    add_image_row(grid);
    const auto add_dirt = [&](const char* name, const char* label, const char* unit,
                              const char* tip, double StopDirt::*value, double least, double most,
                              const char* expected, double scale) {
        const double reset_to = StopDirt{}.*value;
        add_row(
            grid, name, label, unit, tip,
            [value, scale](const Stop& stop) {
                return scale == 1.0 ? shortest(stop.dirt.*value) : percent(stop.dirt.*value);
            },
            [=](Stop& stop, const QString& text) {
                stop.dirt.*value = number_within(text, least, most, expected) / scale;
            },
            [=](Stop& stop) { stop.dirt.*value = reset_to; });
    };
    add_dirt("dust", "Dust", "% of the stop, 0–50", "Share of the stop that opaque specks cover.",
             &StopDirt::dust_coverage, 0.0, 50.0, "per cent, from 0 to 50", 100.0);
    add_dirt("dust_smallest", "Specks from", "mm", "Diameter of the smallest speck.",
             &StopDirt::dust_smallest_mm, 1e-4, 10.0, "a diameter in mm, 0.0001 to 10", 1.0);
    add_dirt("dust_largest", "Specks to", "mm", "Diameter of the largest speck.",
             &StopDirt::dust_largest_mm, 1e-4, 10.0, "a diameter in mm, 0.0001 to 10", 1.0);
    add_row(
        grid, "scratches", "Scratches", "0–10000",
        "How many, each a tenth to the whole of the stop's radius long.",
        [](const Stop& stop) { return QString::number(stop.dirt.scratches); },
        [](Stop& stop, const QString& text) {
            stop.dirt.scratches = count_within(text, 0, 10'000, "how many, 0 to 10000");
        },
        [](Stop& stop) { stop.dirt.scratches = 0; });
    add_dirt("scratch_thinnest", "Widths from", "mm", "Width of the thinnest scratch.",
             &StopDirt::scratch_thinnest_mm, 1e-4, 10.0, "a width in mm, 0.0001 to 10", 1.0);
    add_dirt("scratch_widest", "Widths to", "mm", "Width of the widest scratch.",
             &StopDirt::scratch_widest_mm, 1e-4, 10.0, "a width in mm, 0.0001 to 10", 1.0);
    add_dirt("fingerprint", "Fingerprint", "% that its ridges take, 0–100",
             "One print; its ridges take this share of the light.", &StopDirt::fingerprint, 0.0,
             100.0, "per cent, from 0 to 100", 100.0);
    add_row(
        grid, "seed", "Seed", "", "Another number scatters the same dirt otherwise.",
        [](const Stop& stop) { return QString::number(stop.dirt.seed); },
        [](Stop& stop, const QString& text) {
            stop.dirt.seed =
                count_within(text, 0, 1'000'000'000, "a whole number from 0 to 1000000000");
        },
        [usual](Stop& stop) { stop.dirt.seed = usual.dirt.seed; });
}

void StopPanel::add_image_row(QGridLayout& grid) {
    add_row(
        grid, "image", "Image", "",
        "An image over the opening, white where it is open. Nothing: the blades alone.",
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
    choose->setText("Choose…");
    choose->setObjectName("stop_choose_image");
    grid.addWidget(choose, grid.rowCount() - 1, 2, Qt::AlignLeft);
    connect(choose, &QToolButton::clicked, this, [this] {
        const QString file = QFileDialog::getOpenFileName(
            this, "Image of the stop", {},
            "Images (*.png *.tif *.tiff *.exr *.jpg *.jpeg *.bmp *.webp);;All files (*)");
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
        Prescription lens = document_.lens();
        row.read(lens.stop, text);
        validate(lens);
        show_reason({});
        set_refused(*row.editor, false);
        document_.edit_lens(std::move(lens), "change the stop's " + row.name, "stop." + row.name);
        follow_document();  // also where nothing changed: the text as it is written here
    } catch (const Error& error) {
        set_refused(*row.editor, true);
        show_reason(QString::fromUtf8(error.what()));
    }
}

void StopPanel::change(const QString& what, const QString& field,
                       const std::function<void(Stop&)>& edit) {
    Prescription lens = document_.lens();
    edit(lens.stop);
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
    const Stop& stop = document_.lens().stop;
    for (const Row& row : rows_) {
        if (row.editor->hasFocus() && row.editor->isModified()) {
            continue;
        }
        row.editor->setText(row.text(stop));
        set_refused(*row.editor, false);
        Stop cleared = stop;
        row.clear(cleared);
        row.reset->setEnabled(cleared != stop);
    }
    delay_.start();
}

void StopPanel::request() {
    if (document_.is_empty()) {
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
        show_pictures({}, {}, {}, QString::fromUtf8(error.what()), serial_);
    }
}

void StopPanel::work_on(const Request& request, const std::stop_token& stop) {
    QImage opening, starburst;
    QString state, reason;
    try {
        const OpticalSystem system = compile(request.lens, d_line_nm);
        opening = opening_picture(system, request.lens.stop.dirt);
        const double share = clear_share(system.stop_mask, request.lens.stop.dirt);
        state =
            QStringLiteral("⌀ %1 mm").arg(significant(2.0 * system.stop_mask.semi_diameter_mm, 4));
        if (share < 1.0) {
            state += QStringLiteral(" · %1 % clear").arg(significant(100.0 * share, 4));
        }
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
        starburst = starburst_picture(*image);
    } catch (const std::exception& error) {
        reason = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(
        this,
        [this, opening, starburst, state, reason, serial = request.serial] {
            show_pictures(opening, starburst, state, reason, serial);
        },
        Qt::QueuedConnection);
}

void StopPanel::show_pictures(const QImage& opening, const QImage& starburst, const QString& state,
                              const QString& reason, std::uint64_t serial) {
    if (serial != serial_) {
        return;
    }
    shown_serial_ = serial;
    opening_ = opening;
    starburst_ = starburst;
    opening_label_->setPixmap(QPixmap::fromImage(opening));
    starburst_label_->setPixmap(QPixmap::fromImage(starburst));
    header_->set_state(state);
    header_->set_dimmed(false);
    show_reason(reason);
}

void StopPanel::show_reason(const QString& reason) {
    reason_ = reason;
    reason_label_->setText(reason);
    reason_label_->setVisible(!reason.isEmpty());
}

}  // namespace ghostlight
