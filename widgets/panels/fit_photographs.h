#pragma once

#include <QWidget>

#include <vector>

#include "core/fit/fit_setup.h"
#include "widgets/fit_job.h"
#include "widgets/panels/fit_picture_view.h"

class QComboBox;
class QHBoxLayout;
class QLabel;
class QLineEdit;
class QSpinBox;
class QToolButton;

namespace ghostlight {

class FitPhotoForm;

/// The photographs of a fit, one at a time beside the model: its light, what of it counts, and
/// where its pixels lie.
class FitPhotographs : public QWidget {
    Q_OBJECT
   public:
    explicit FitPhotographs(QWidget* parent = nullptr);

    void set_setup(const FitSetup& setup, double sensor_width_mm);
    void set_loaded(const LoadedPhotos& loaded);
    /// As far as a fit has come; empty: none.
    void set_fitted(std::vector<FittedPhoto> photos);
    void add_files(const QStringList& files);

    FitPictureView& picture() { return *picture_; }
    FitPhotoForm& form() { return *form_; }
    QLineEdit& light() { return *light_; }
    QSpinBox& brush_px() { return *brush_; }
    QString about() const;

   Q_SIGNALS:
    void edited(const ghostlight::FitSetup& setup, const QString& step);
    void refused(const QString& reason);

   private:
    QHBoxLayout* make_files();
    QHBoxLayout* make_modes();
    QHBoxLayout* make_tools();
    QHBoxLayout* make_light();
    std::size_t shown() const;
    const LoadedPhoto* loaded_shown() const;
    /// Changes the photograph that is shown, as one step.
    template <class Change>
    void change(const QString& step, const Change& change);
    void show_photograph();
    void show_placed(const LoadedPhoto& photo);

    FitSetup setup_;
    double sensor_width_mm_ = 36.0;
    LoadedPhotos loaded_;
    std::vector<FittedPhoto> fitted_;
    FitPictureView* picture_;
    QComboBox* photos_ = nullptr;
    QLineEdit* light_ = nullptr;
    QSpinBox* brush_ = nullptr;
    QLabel* about_;
    FitPhotoForm* form_;
    QToolButton *remove_ = nullptr, *find_ = nullptr, *details_ = nullptr;
    QWidget* tools_ = nullptr;
};

}  // namespace ghostlight
