#include "widgets/panels/fit_photo_form.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QToolButton>

#include <cmath>

#include "core/error.h"
#include "widgets/number_text.h"
#include "widgets/panels/quiet_button.h"

namespace ghostlight {

namespace {

double number_of(const QString& what, const QString& text, const QString& expected,
                 bool (*accepts)(double)) {
    const auto number = parse_number(text);
    if (!number || !accepts(*number)) {
        throw Error({.problem = FitPhotoForm::tr("%1 cannot be taken").arg(what).toStdString(),
                     .file = {},
                     .where = {},
                     .found = "'" + text.toStdString() + "'",
                     .expected = expected.toStdString()});
    }
    return *number;
}

QString text_or_nothing(const auto& value) {
    return value ? QString::fromStdString(text_of(*value)) : QString();
}

}  // namespace

FitPhotoForm::FitPhotoForm(QWidget* parent) : QWidget(parent) {
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(6);
    grid->setVerticalSpacing(4);
    grid->setColumnStretch(1, 1);
    grid->setColumnStretch(3, 1);
    add(*grid, 0, "width", tr("Width, mm"),
        tr("Of the whole picture on the sensor, mm; give it where the file is a part of the "
           "sensor, "
           "or the camera's sensor is not the lens's"),
        {.edit = nullptr,
         .take =
             [](FitPhotoSetup& setup, const QString& text) {
                 setup.width_mm.reset();
                 if (!text.isEmpty()) {
                     setup.width_mm = number_of(tr("the width"), text, tr("mm above 0"),
                                                [](double mm) { return mm > 0.0 && mm < 1e6; });
                 }
             },
         .text =
             [](const FitPhotoSetup& setup) {
                 return setup.width_mm ? shortest(*setup.width_mm) : QString();
             },
         .step = tr("change the photograph's width")});
    add(*grid, 1, "axis", tr("Axis, px"),
        tr("X,Y of the lens's axis in the file, pixels from the upper left corner: the principal "
           "point"),
        {.edit = nullptr,
         .take =
             [](FitPhotoSetup& setup, const QString& text) {
                 setup.axis.reset();
                 if (!text.isEmpty()) {
                     setup.axis = parse_file_point(text.toStdString());
                 }
             },
         .text = [](const FitPhotoSetup& setup) { return text_or_nothing(setup.axis); },
         .step = tr("move the photograph's axis")});
    add(*grid, 2, "rotation", tr("Rotation, °"),
        tr("Of the camera about the axis, degrees; what is left of it is fitted"),
        {.edit = nullptr,
         .take =
             [](FitPhotoSetup& setup, const QString& text) {
                 setup.rotation_deg =
                     text.isEmpty()
                         ? 0.0
                         : number_of(tr("the rotation"), text, tr("degrees from -180 to 180"),
                                     [](double deg) { return std::abs(deg) <= 180.0; });
             },
         .text =
             [](const FitPhotoSetup& setup) {
                 return setup.rotation_deg != 0.0 ? shortest(setup.rotation_deg) : QString();
             },
         .step = tr("turn the photograph")});
    add(*grid, 3, "crop", tr("Crop, px"),
        tr("X,Y,WIDTH,HEIGHT of the part that counts, pixels from the upper left corner; or drag "
           "it in the picture with Crop"),
        {.edit = nullptr,
         .take =
             [](FitPhotoSetup& setup, const QString& text) {
                 setup.crop.reset();
                 if (!text.isEmpty()) {
                     setup.crop = parse_file_box(text.toStdString());
                 }
             },
         .text = [](const FitPhotoSetup& setup) { return text_or_nothing(setup.crop); },
         .step = tr("crop the photograph")});
    add(*grid, 4, "noise", tr("Noise"),
        tr("SHOT,READ: the variance of a value is SHOT × value + READ, 1 being full scale"),
        {.edit = nullptr,
         .take =
             [](FitPhotoSetup& setup, const QString& text) {
                 setup.noise.reset();
                 if (!text.isEmpty()) {
                     setup.noise = parse_noise(text.toStdString());
                 }
             },
         .text = [](const FitPhotoSetup& setup) { return text_or_nothing(setup.noise); },
         .step = tr("change the photograph's noise")});
    add(*grid, 5, "saturation", tr("Clips at"),
        tr("Values from here on are clipped and do not count; 1 is full scale"),
        {.edit = nullptr,
         .take =
             [](FitPhotoSetup& setup, const QString& text) {
                 setup.saturation.reset();
                 if (!text.isEmpty()) {
                     setup.saturation = number_of(tr("the saturation"), text, tr("a value above 0"),
                                                  [](double value) { return value > 0.0; });
                 }
             },
         .text =
             [](const FitPhotoSetup& setup) {
                 return setup.saturation ? shortest(*setup.saturation) : QString();
             },
         .step = tr("change where the photograph clips")});
    add(*grid, 6, "mask", tr("Mask file"),
        tr("A picture of the photograph's shape, bright where not to look"),
        {.edit = nullptr,
         .take =
             [](FitPhotoSetup& setup, const QString& text) {
                 setup.mask_file = text.isEmpty()
                                       ? std::string()
                                       : QFileInfo(text).absoluteFilePath().toStdString();
             },
         .text = [](const FitPhotoSetup& setup) { return QString::fromStdString(setup.mask_file); },
         .step = tr("change the photograph's mask")});
    auto* choose = quiet_button(tr("Choose…"), tr("Choose the mask's file"), false);
    grid->addWidget(choose, 3, 2, 1, 2, Qt::AlignLeft);
    connect(choose, &QToolButton::clicked, this, [this] {
        const QString file = QFileDialog::getOpenFileName(this, tr("Mask"));
        if (!file.isEmpty()) {
            field("mask").setText(file);
            commit(fields_.back());
        }
    });
    field("mask").setPlaceholderText(tr("none"));
    field("crop").setPlaceholderText(tr("all"));
    field("axis").setPlaceholderText(tr("the middle"));
    field("rotation").setPlaceholderText(tr("0"));
}

void FitPhotoForm::add(QGridLayout& grid, int place, const QString& name, const QString& label,
                       const QString& tip, Field field) {
    field.edit = new QLineEdit;
    field.edit->setObjectName("fit_photo_" + name);
    field.edit->setToolTip(tip);
    auto* text = new QLabel(label);
    text->setBuddy(field.edit);
    text->setToolTip(tip);
    const int row = place / 2, column = 2 * (place % 2);
    grid.addWidget(text, row, column);
    grid.addWidget(field.edit, row, column + 1);
    const std::size_t index = fields_.size();
    connect(field.edit, &QLineEdit::editingFinished, this, [this, index] {
        if (fields_[index].edit->isModified()) {
            commit(fields_[index]);
        }
    });
    fields_.push_back(std::move(field));
}

QLineEdit& FitPhotoForm::field(const QString& name) const {
    auto* found = findChild<QLineEdit*>("fit_photo_" + name);
    Q_ASSERT_X(found != nullptr, "FitPhotoForm::field", qPrintable(name));
    return *found;
}

void FitPhotoForm::commit(const Field& field) {
    field.edit->setModified(false);
    FitPhotoSetup setup = setup_;
    try {
        field.take(setup, field.edit->text().trimmed());
    } catch (const Error& error) {
        Q_EMIT refused(QString::fromUtf8(error.what()));
        return;
    }
    if (!(setup == setup_)) {
        Q_EMIT edited(setup, field.step);
    }
}

void FitPhotoForm::set_photo(const FitPhotoSetup& setup, const LoadedPhoto* loaded,
                             double sensor_width_mm) {
    setup_ = setup;
    for (const Field& each : fields_) {
        if (!each.edit->hasFocus() || !each.edit->isModified()) {
            each.edit->setText(each.text(setup));
        }
    }
    field("width").setPlaceholderText(tr("%1, the sensor's").arg(significant(sensor_width_mm)));
    const bool is_read = loaded != nullptr && loaded->reason.isEmpty();
    field("noise").setPlaceholderText(
        is_read ? tr("%1,%2 %3")
                      .arg(significant(loaded->noise.shot, 3), significant(loaded->noise.read, 3),
                           loaded->noise.estimated ? tr("estimated") : tr("by the file"))
                : tr("by the file, or estimated"));
    field("saturation")
        .setPlaceholderText(!is_read                            ? tr("as the file has it")
                            : std::isfinite(loaded->saturation) ? significant(loaded->saturation)
                                                                : tr("nothing is clipped"));
}

}  // namespace ghostlight
