#pragma once

#include <QWidget>

#include <functional>
#include <vector>

#include "core/fit/photo_setup.h"
#include "widgets/fit_job.h"

class QGridLayout;
class QLineEdit;

namespace ghostlight {

/// Where a photograph's pixels lie on the sensor, and how noisy they are: numbers that its file
/// does not say. An empty field stands for what its placeholder names.
class FitPhotoForm : public QWidget {
    Q_OBJECT
   public:
    explicit FitPhotoForm(QWidget* parent = nullptr);

    /// `loaded` is null where the photograph is not read (yet).
    void set_photo(const FitPhotoSetup& setup, const LoadedPhoto* loaded, double sensor_width_mm);
    /// "width", "axis", "rotation", "crop", "noise", "saturation", "mask".
    QLineEdit& field(const QString& name) const;

   Q_SIGNALS:
    void edited(const ghostlight::FitPhotoSetup& setup, const QString& step);
    void refused(const QString& reason);

   private:
    struct Field {
        QLineEdit* edit;
        std::function<void(FitPhotoSetup&, const QString&)> take;  ///< throws Error
        std::function<QString(const FitPhotoSetup&)> text;
        QString step;
    };
    void add(QGridLayout& grid, int place, const QString& name, const QString& label,
             const QString& tip, Field field);
    void commit(const Field& field);

    FitPhotoSetup setup_;
    std::vector<Field> fields_;
};

}  // namespace ghostlight
