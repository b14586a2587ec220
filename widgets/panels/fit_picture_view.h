#pragma once

#include <QImage>
#include <QTimer>
#include <QTransform>
#include <QWidget>

#include <optional>
#include <vector>

#include "core/fit/photo_mask.h"

namespace ghostlight {

/// A photograph beside, over or in turn with the model's picture. The light is placed, and regions
/// that do not count are painted, by the mouse.
class FitPictureView : public QWidget {
    Q_OBJECT
   public:
    enum class Mode { photograph, model, overlay, difference, blink };
    enum class Tool { light, box, lasso, brush, erase, crop };
    struct Pictures {
        QImage photograph;  ///< at the file's own scale
        QImage mask;        ///< over it, transparent where it counts
        QImage measured, model, difference;
    };
    /// What is known of a photograph beside its picture, in pixels of the file.
    struct Photograph {
        QSize size_px;
        std::vector<MaskRegion> masked;
        std::optional<FileBox> crop;
        /// From shares of its width and height to shares of the sensor's, upright.
        QTransform to_sensor;
    };

    explicit FitPictureView(QWidget* parent = nullptr);

    void set_pictures(Pictures pictures);
    const Pictures& pictures() const { return pictures_; }
    void set_photograph(Photograph photograph);
    void set_mode(Mode mode);
    Mode mode() const { return mode_; }
    void set_tool(Tool tool);
    Tool tool() const { return tool_; }
    void set_brush_px(double diameter_px) { brush_px_ = diameter_px; }
    void show_mask(bool shown);
    /// Where the light's image is, shares of the photograph's width and height; nothing for none.
    void set_light(std::optional<QPointF> share);
    /// In place of a picture.
    void set_text(const QString& text);
    /// Where the picture is shown.
    QRectF picture_rect() const;
    /// What is shown at this moment; the model's turn when blinking.
    const QImage& shown() const;
    /// Of a point of the photograph, pixels of its file.
    QPointF on_screen(const FilePoint& point) const;

    QSize sizeHint() const override { return {420, 280}; }
    QSize minimumSizeHint() const override { return {220, 150}; }

   Q_SIGNALS:
    /// Where the light is, shares of the photograph's width and height.
    void clicked(const QPointF& share);
    void region_drawn(const ghostlight::MaskRegion& region);
    void region_erased(std::size_t index);
    void crop_drawn(const ghostlight::FileBox& box);

   protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

   private:
    bool is_on_sensor() const;  ///< on the fit's scale, as the sensor has it
    QTransform file_to_screen() const;
    std::optional<FilePoint> file_at(const QPointF& screen) const;
    std::optional<std::size_t> region_at(const QPointF& screen) const;
    void paint_regions(QPainter& painter) const;
    void paint_light(QPainter& painter) const;
    void forget_drawing();

    Pictures pictures_;
    Photograph photograph_;
    Mode mode_ = Mode::photograph;
    Tool tool_ = Tool::light;
    double brush_px_ = 20.0;
    bool mask_is_shown_ = true;
    std::optional<QPointF> light_;
    QString text_;
    QTimer blink_;
    bool shows_model_ = false;
    std::vector<FilePoint> drawn_;  ///< while the button is down
    std::optional<std::size_t> under_mouse_;
};

}  // namespace ghostlight
