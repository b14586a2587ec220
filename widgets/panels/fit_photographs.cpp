#include "widgets/panels/fit_photographs.h"

#include <QButtonGroup>
#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

#include "core/io/photo_file.h"
#include "widgets/fit_pictures.h"
#include "widgets/number_text.h"
#include "widgets/panels/fit_photo_form.h"
#include "widgets/panels/quiet_button.h"

namespace ghostlight {

namespace {

QString photo_filter() {
    QStringList patterns{"*.exr", "*.tif", "*.tiff", "*.png", "*.jpg", "*.jpeg"};
    for (const std::string_view each : raw_photo_extensions()) {
        patterns << '*' + QString::fromUtf8(each.data(), static_cast<qsizetype>(each.size()));
    }
    return FitPhotographs::tr("Photographs (%1);;All files (*)").arg(patterns.join(' '));
}

QToolButton* named(const char* name, const QString& text, const QString& tip,
                   bool checkable = false) {
    auto* button = quiet_button(text, tip, checkable);
    button->setObjectName(QStringLiteral("fit_") + name);
    return button;
}

/// Buttons of which one is down.
template <class Choice>
struct Chosen {
    const char* name;
    QString text, tip;
    Choice choice;
};

}  // namespace

FitPhotographs::FitPhotographs(QWidget* parent)
    : QWidget(parent), picture_(new FitPictureView), about_(new QLabel), form_(new FitPhotoForm) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(8, 6, 8, 6);
    column->setSpacing(6);
    column->addLayout(make_files());
    column->addLayout(make_modes());
    column->addWidget(picture_, 1);
    column->addLayout(make_tools());
    column->addLayout(make_light());
    column->addWidget(form_);
    form_->hide();
    about_->setForegroundRole(QPalette::PlaceholderText);
    about_->setWordWrap(true);
    column->addWidget(about_);
    connect(details_, &QToolButton::toggled, form_, &QWidget::setVisible);
    connect(form_, &FitPhotoForm::refused, this, &FitPhotographs::refused);
    connect(form_, &FitPhotoForm::edited, this,
            [this](const FitPhotoSetup& photo, const QString& step) {
                change(step, [&](FitPhotoSetup& shown) { shown = photo; });
            });
    connect(picture_, &FitPictureView::clicked, this, [this](const QPointF& share) {
        const LoadedPhoto* loaded = loaded_shown();
        if (loaded != nullptr && !loaded->size_px.isEmpty()) {
            change(tr("place the photograph's light"), [&](FitPhotoSetup& photo) {
                photo.light = QStringLiteral("%1,%2")
                                  .arg(share.x() * loaded->size_px.width(), 0, 'f', 1)
                                  .arg(share.y() * loaded->size_px.height(), 0, 'f', 1)
                                  .toStdString();
            });
        }
    });
    connect(picture_, &FitPictureView::region_drawn, this, [this](const MaskRegion& region) {
        change(tr("mask a region"), [&](FitPhotoSetup& photo) { photo.masked.push_back(region); });
    });
    connect(picture_, &FitPictureView::region_erased, this, [this](std::size_t index) {
        change(tr("take a masked region away"), [&](FitPhotoSetup& photo) {
            photo.masked.erase(photo.masked.begin() + static_cast<std::ptrdiff_t>(index));
        });
    });
    connect(picture_, &FitPictureView::crop_drawn, this, [this](const FileBox& box) {
        change(box.width_px > 0.0 ? tr("crop the photograph") : tr("take the crop away"),
               [&](FitPhotoSetup& photo) {
                   photo.crop = box.width_px > 0.0 ? std::optional(box) : std::nullopt;
               });
    });
}

QHBoxLayout* FitPhotographs::make_files() {
    auto* row = new QHBoxLayout;
    photos_ = new QComboBox;
    photos_->setObjectName("fit_photos");
    photos_->setToolTip(tr("The photograph that is shown; the fit takes all of them"));
    photos_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    photos_->setMinimumContentsLength(12);
    auto* add = named("add", tr("Add…"), tr("Add photographs: EXR, TIFF, PNG, JPEG or camera RAW"));
    remove_ = named("remove", tr("Remove"), tr("Take this photograph out of the fit"));
    row->addWidget(photos_, 1);
    row->addWidget(add);
    row->addWidget(remove_);
    connect(add, &QToolButton::clicked, this, [this] {
        add_files(
            QFileDialog::getOpenFileNames(this, tr("Photographs"), QString(), photo_filter()));
    });
    connect(remove_, &QToolButton::clicked, this, [this] {
        FitSetup setup = setup_;
        const std::size_t at = shown();
        if (at < setup.photos.size()) {
            setup.photos.erase(setup.photos.begin() + static_cast<std::ptrdiff_t>(at));
            Q_EMIT edited(setup, tr("remove a photograph"));
        }
    });
    connect(photos_, &QComboBox::currentIndexChanged, this, &FitPhotographs::show_photograph);
    return row;
}

QHBoxLayout* FitPhotographs::make_modes() {
    using Mode = FitPictureView::Mode;
    const Chosen<Mode> all[] = {
        {"mode_photograph", tr("Photograph"), tr("The file"), Mode::photograph},
        {"mode_model", tr("Model"), tr("What the lens makes, as far as the fit has come"),
         Mode::model},
        {"mode_overlay", tr("Overlay"), tr("Half the photograph, half the model"), Mode::overlay},
        {"mode_difference", tr("Difference"),
         tr("Residuals: red where the model is too bright, blue where it is too dark; full at 5 σ"),
         Mode::difference},
        {"mode_blink", tr("Blink"), tr("Photograph and model in turn"), Mode::blink}};
    auto* row = new QHBoxLayout;
    row->setSpacing(2);
    auto* group = new QButtonGroup(this);
    for (const auto& each : all) {
        auto* button = named(each.name, each.text, each.tip, true);
        button->setChecked(each.choice == Mode::photograph);
        group->addButton(button);
        row->addWidget(button);
        connect(button, &QToolButton::toggled, this, [this, mode = each.choice](bool on) {
            if (on) {
                picture_->set_mode(mode);
            }
        });
    }
    row->addStretch(1);
    return row;
}

QHBoxLayout* FitPhotographs::make_tools() {
    using Tool = FitPictureView::Tool;
    const Chosen<Tool> all[] = {
        {"tool_light", tr("Light"), tr("Click where the light is"), Tool::light},
        {"tool_box", tr("Box"), tr("Drag boxes over what is not to count"), Tool::box},
        {"tool_lasso", tr("Lasso"), tr("Draw around what is not to count"), Tool::lasso},
        {"tool_brush", tr("Brush"), tr("Paint over what is not to count"), Tool::brush},
        {"tool_erase", tr("Erase"), tr("Click a painted region to take it away"), Tool::erase},
        {"tool_crop", tr("Crop"), tr("Drag over what is to count; a click: all"), Tool::crop}};
    tools_ = new QWidget;
    auto* row = new QHBoxLayout(tools_);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(2);
    brush_ = new QSpinBox;
    brush_->setRange(1, 2000);
    brush_->setValue(20);
    brush_->setSuffix(QStringLiteral(" px"));
    brush_->setToolTip(tr("Diameter of the brush, pixels of the file"));
    brush_->hide();
    auto* group = new QButtonGroup(this);
    for (const auto& each : all) {
        auto* button = named(each.name, each.text, each.tip, true);
        button->setChecked(each.choice == Tool::light);
        group->addButton(button);
        row->addWidget(button);
        if (each.choice == Tool::brush) {
            row->addWidget(brush_);
        }
        connect(button, &QToolButton::toggled, this, [this, tool = each.choice](bool on) {
            if (on) {
                picture_->set_tool(tool);
                brush_->setVisible(tool == Tool::brush);
            }
        });
    }
    row->addStretch(1);
    auto* mask = named("mask", tr("Mask"),
                       tr("Show what does not count: amber painted, blue about the light, red "
                          "clipped or hot, dark outside of the crop"),
                       true);
    mask->setChecked(true);
    row->addWidget(mask);
    connect(mask, &QToolButton::toggled, picture_, &FitPictureView::show_mask);
    connect(brush_, &QSpinBox::valueChanged, this, [this](int px) { picture_->set_brush_px(px); });
    auto* all_of_it = new QHBoxLayout;
    all_of_it->addWidget(tools_);
    return all_of_it;
}

QHBoxLayout* FitPhotographs::make_light() {
    auto* row = new QHBoxLayout;
    light_ = new QLineEdit;
    light_->setObjectName("fit_light");
    light_->setToolTip(
        tr("Where the light is: auto, X,Y in pixels from the upper left corner, or "
           "deg:FIELD:AZIMUTH; or click it in the photograph"));
    find_ = named("find", tr("Find"), tr("The middle of the largest bright patch"));
    details_ =
        named("details", tr("Details"),
              tr("Where the photograph lies on the sensor, its noise, where it clips, a mask "
                 "from a file"),
              true);
    row->addWidget(new QLabel(tr("Light")));
    row->addWidget(light_, 1);
    row->addWidget(find_);
    row->addWidget(details_);
    connect(find_, &QToolButton::clicked, this, [this] {
        change(tr("find the photograph's light"),
               [](FitPhotoSetup& photo) { photo.light = "auto"; });
    });
    connect(light_, &QLineEdit::editingFinished, this, [this] {
        if (light_->isModified()) {
            light_->setModified(false);
            change(tr("place the photograph's light"), [this](FitPhotoSetup& photo) {
                photo.light = light_->text().trimmed().toStdString();
            });
        }
    });
    return row;
}

std::size_t FitPhotographs::shown() const {
    return static_cast<std::size_t>(std::max(0, photos_->currentIndex()));
}

const LoadedPhoto* FitPhotographs::loaded_shown() const {
    const std::size_t at = shown();
    return at < setup_.photos.size() && loaded_ && at < loaded_->size() &&
                   (*loaded_)[at].file == setup_.photos[at].file
               ? &(*loaded_)[at]
               : nullptr;
}

template <class Change>
void FitPhotographs::change(const QString& step, const Change& change) {
    FitSetup setup = setup_;
    const std::size_t at = shown();
    if (at < setup.photos.size()) {
        change(setup.photos[at]);
        Q_EMIT edited(setup, step);
    }
}

void FitPhotographs::add_files(const QStringList& files) {
    FitSetup setup = setup_;
    for (const QString& file : files) {
        const std::string name = QFileInfo(file).absoluteFilePath().toStdString();
        if (std::ranges::find(setup.photos, name, &FitPhotoSetup::file) == setup.photos.end()) {
            setup.photos.emplace_back().file = name;
        }
    }
    if (setup == setup_) {
        return;
    }
    const auto added = setup.photos.size() - setup_.photos.size();
    const int last = static_cast<int>(setup.photos.size()) - 1;
    Q_EMIT edited(setup, added == 1 ? tr("add a photograph") : tr("add photographs"));
    photos_->setCurrentIndex(last);
}

void FitPhotographs::set_setup(const FitSetup& setup, double sensor_width_mm) {
    const FitSetup before = std::exchange(setup_, setup);
    sensor_width_mm_ = sensor_width_mm;
    if (!std::ranges::equal(before.photos, setup_.photos, {}, &FitPhotoSetup::file,
                            &FitPhotoSetup::file)) {
        const int at = photos_->currentIndex();
        const QSignalBlocker quiet(photos_);
        photos_->clear();
        for (const FitPhotoSetup& each : setup_.photos) {
            const QString file = QString::fromStdString(each.file);
            photos_->addItem(QFileInfo(file).fileName());
            photos_->setItemData(photos_->count() - 1, file, Qt::ToolTipRole);
        }
        photos_->setCurrentIndex(std::clamp(at, 0, std::max(0, photos_->count() - 1)));
    }
    show_photograph();
}

void FitPhotographs::set_loaded(const LoadedPhotos& loaded) {
    loaded_ = loaded;
    show_photograph();
}

void FitPhotographs::set_fitted(std::vector<FittedPhoto> photos) {
    fitted_ = std::move(photos);
    show_photograph();
}

void FitPhotographs::show_photograph() {
    const std::size_t at = shown();
    const bool is_there = at < setup_.photos.size();
    const LoadedPhoto* loaded = loaded_shown();
    for (QWidget* each : {static_cast<QWidget*>(light_), static_cast<QWidget*>(find_),
                          static_cast<QWidget*>(remove_), static_cast<QWidget*>(photos_), tools_,
                          static_cast<QWidget*>(form_)}) {
        each->setEnabled(is_there);
    }
    if (!light_->hasFocus() || !light_->isModified()) {
        light_->setText(is_there ? QString::fromStdString(setup_.photos[at].light) : QString());
    }
    form_->set_photo(is_there ? setup_.photos[at] : FitPhotoSetup(), loaded, sensor_width_mm_);
    if (loaded == nullptr) {
        picture_->set_text(is_there ? tr("reading…")
                                    : tr("Add a photograph with a bright light in or near the "
                                         "frame."));
        picture_->set_light({});
        picture_->set_photograph({});
        picture_->set_pictures({});
        about_->clear();
        return;
    }
    show_placed(*loaded);
}

void FitPhotographs::show_placed(const LoadedPhoto& photo) {
    const std::size_t at = shown();
    picture_->set_text(photo.preview.isNull() ? photo.reason : QString());
    picture_->set_photograph({.size_px = photo.size_px,
                              .masked = setup_.photos[at].masked,
                              .crop = setup_.photos[at].crop,
                              .to_sensor = photo.to_sensor});
    picture_->set_light(photo.light
                            ? std::optional(QPointF(photo.light->x() / photo.size_px.width(),
                                                    photo.light->y() / photo.size_px.height()))
                            : std::nullopt);
    FitPictureView::Pictures pictures;
    pictures.photograph = photo.preview;
    pictures.mask = photo.mask;
    // Exposures that are merged are one photograph to the fit.
    if (const std::size_t of = setup_.merge ? 0 : at; of < fitted_.size()) {
        const FittedPhoto& fitted = fitted_[of];
        const double ev = fit_exposure_ev(fitted);
        pictures.measured = fit_picture(fitted, fitted.measured, ev);
        pictures.model = fit_picture(fitted, fitted.after, ev);
        pictures.difference = residual_picture(fitted);
    }
    picture_->set_pictures(std::move(pictures));
    QStringList about{photo.about};
    if (photo.reason.isEmpty()) {
        about << tr("light at %1°").arg(significant(photo.field_deg, 3)) << photo.masked;
    }
    about += photo.notes;
    about.removeAll(QString());
    about_->setText(about.join(QStringLiteral(" · ")));
}

QString FitPhotographs::about() const { return about_->text(); }

}  // namespace ghostlight
