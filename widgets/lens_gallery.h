#pragma once

#include <QDialog>

#include <filesystem>
#include <memory>
#include <vector>

#include "core/io/lens_file.h"

class QListWidget;

namespace ghostlight {

class LensThumbnails;

/// The bundled lenses as pictures: layout and flare of each. Return or a double click opens one.
class LensGallery : public QDialog {
    Q_OBJECT
   public:
    /// `cache`: where thumbnails are kept; empty keeps none.
    LensGallery(std::vector<BundledLens> lenses, const QString& cache, QWidget* parent = nullptr);
    ~LensGallery() override;

    QListWidget& list() { return *list_; }
    LensThumbnails& thumbnails() { return *thumbnails_; }

   Q_SIGNALS:
    void chosen(const std::filesystem::path& file);

   private:
    void show_card(int index, const QImage& flare, const QString& instead);
    void draw_layouts(int from);
    void choose();

    std::vector<BundledLens> lenses_;
    std::vector<QImage> layouts_;
    std::vector<QImage> flares_;
    QListWidget* list_;
    std::unique_ptr<LensThumbnails> thumbnails_;
};

}  // namespace ghostlight
