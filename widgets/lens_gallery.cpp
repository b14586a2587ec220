#include "widgets/lens_gallery.h"

#include <QListWidget>
#include <QPainter>
#include <QTimer>
#include <QVBoxLayout>

#include <utility>

#include "core/error.h"
#include "widgets/lens_thumbnails.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

constexpr int width_px = 880, height_px = 720;
constexpr QSize card_px(thumbnail_width_px, 2 * thumbnail_height_px + 1);

}  // namespace

LensGallery::LensGallery(std::vector<BundledLens> lenses, const QString& cache, QWidget* parent)
    : QDialog(parent),
      lenses_(std::move(lenses)),
      layouts_(lenses_.size()),
      flares_(lenses_.size()),
      list_(new QListWidget) {
    setObjectName("gallery");
    setWindowTitle(tr("Bundled lenses"));
    setAttribute(Qt::WA_DeleteOnClose);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    list_->setViewMode(QListView::IconMode);
    list_->setMovement(QListView::Static);
    list_->setResizeMode(QListView::Adjust);
    list_->setIconSize(card_px);
    list_->setSpacing(10);
    list_->setWordWrap(true);
    list_->setUniformItemSizes(true);
    list_->setFrameShape(QFrame::NoFrame);
    list_->setAccessibleName(windowTitle());
    column->addWidget(list_);
    resize(width_px, height_px);
    std::vector<std::filesystem::path> files;
    for (const BundledLens& lens : lenses_) {
        auto* item = new QListWidgetItem(QString::fromStdString(lens.name), list_);
        item->setTextAlignment(Qt::AlignHCenter | Qt::AlignTop);
        item->setSizeHint(card_px + QSize(8, 3 * fontMetrics().height()));
        item->setToolTip(QString::fromStdString(lens.file.filename().string()));
        files.push_back(lens.file);
        show_card(list_->count() - 1, {}, {});
    }
    list_->setCurrentRow(0);
    connect(list_, &QListWidget::itemActivated, this, &LensGallery::choose);
    thumbnails_ = std::make_unique<LensThumbnails>(std::move(files), cache, devicePixelRatioF());
    connect(thumbnails_.get(), &LensThumbnails::flare_made, this,
            [this](int index, const QImage& flare) { show_card(index, flare, {}); });
    connect(thumbnails_.get(), &LensThumbnails::failed, this,
            [this](int index, const QString& reason) { show_card(index, {}, reason); });
    QTimer::singleShot(0, this, [this] { draw_layouts(0); });
}

LensGallery::~LensGallery() = default;

void LensGallery::draw_layouts(int from) {
    if (from >= list_->count()) {
        return;
    }
    const auto k = static_cast<std::size_t>(from);
    QString reason;
    try {
        layouts_[k] = layout_thumbnail(read_lens(lenses_[k].file).lens, devicePixelRatioF());
    } catch (const Error& error) {
        reason = QString::fromUtf8(error.what());
    }
    show_card(from, flares_[k], reason);
    // One at a time: the window stays quick meanwhile.
    QTimer::singleShot(0, this, [this, from] { draw_layouts(from + 1); });
}

void LensGallery::show_card(int index, const QImage& flare, const QString& instead) {
    const Palette& colors = current_palette();
    const auto k = static_cast<std::size_t>(index);
    if (!flare.isNull()) {
        flares_[k] = flare;
    }
    const double ratio = devicePixelRatioF();
    QPixmap card(card_px * ratio);
    card.setDevicePixelRatio(ratio);
    card.fill(colors.line);
    QPainter painter(&card);
    const QRect above(0, 0, thumbnail_width_px, thumbnail_height_px);
    const QRect below(0, thumbnail_height_px + 1, thumbnail_width_px, thumbnail_height_px);
    painter.fillRect(above, colors.panel);
    painter.fillRect(below, dark_palette().ground);
    if (!layouts_[k].isNull()) {
        painter.drawImage(above, layouts_[k]);
    }
    if (!flares_[k].isNull()) {
        // The whole width, and of the height the middle.
        const QSizeF size = flares_[k].deviceIndependentSize();
        const double shown = std::min(size.height(), static_cast<double>(thumbnail_height_px));
        const QRectF part(0, (size.height() - shown) / 2 * ratio, size.width() * ratio,
                          shown * ratio);
        painter.drawImage(QRectF(below), flares_[k], part);
    } else {
        painter.setPen(dark_palette().dim);
        painter.drawText(below.adjusted(8, 8, -8, -8), Qt::AlignCenter | Qt::TextWordWrap,
                         instead.isEmpty() ? tr("drawing…") : instead);
    }
    painter.end();
    QIcon icon(card);
    icon.addPixmap(card, QIcon::Selected);
    list_->item(index)->setIcon(icon);
}

void LensGallery::choose() {
    const int row = list_->currentRow();
    if (row >= 0) {
        const std::filesystem::path file = lenses_[static_cast<std::size_t>(row)].file;
        accept();
        Q_EMIT chosen(file);
    }
}

}  // namespace ghostlight
