#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QToolButton>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/io/stop_image_file.h"
#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "widgets/document.h"
#include "widgets/models/cell_text.h"
#include "widgets/number_text.h"
#include "widgets/panels/stop_panel.h"
#include "widgets/prescription_edits.h"

// What a stop has: each number with its unit, its range and what it usually is.

namespace ghostlight {

namespace {

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

}  // namespace

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

}  // namespace ghostlight
