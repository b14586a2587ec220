#pragma once

#include <glm/vec2.hpp>

#include <QImage>
#include <QPointF>

#include <memory>
#include <optional>

#include "core/flare/flare_image.h"
#include "core/optics/trace.h"
#include "render/picture_frame.h"
#include "widgets/gl_view.h"

namespace ghostlight {

class FlareRenderer;
class PictureUpload;

/// Draws a flare picture and takes the mouse: left drag moves the light, the wheel changes the
/// exposure, Ctrl+wheel zooms about the cursor, middle drag pans.
class FlareView : public GlView {
    Q_OBJECT
   public:
    explicit FlareView(QWidget* parent = nullptr);
    ~FlareView() override;

    void set_image(std::shared_ptr<const FlareImage> image);
    const FlareImage* image() const { return image_.get(); }
    void set_light(const LightDirection& light, double efl_mm);
    /// The lens cannot be traced as it stands: says so where there is no picture.
    void set_failed();
    void set_exposure_ev(double exposure_ev);
    double exposure_ev() const { return exposure_ev_; }
    double last_upload_ms() const { return last_upload_ms_; }
    /// Brings the whole sensor into view.
    void reset_zoom();
    /// Where the picture lies on the widget, logical pixels.
    PictureFrame frame() const;

   Q_SIGNALS:
    void light_dragged(ghostlight::LightDirection light);
    void light_drag_finished();
    void exposure_requested(double exposure_ev);
    void auto_exposure_requested();

   protected:
    void init_gl() override;
    void paint_gl(unsigned framebuffer, int width_px, int height_px) override;
    void release_gl() override;
    void paint_overlay(QPainter& painter) override;
    void paint_without_gl(QPainter& painter) override;

    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void changeEvent(QEvent* event) override;

   private:
    enum class Drag { none, pressed, light, pan };

    void drag_light_to(QPointF position);
    void zoom_about(QPointF position, double factor);

    std::shared_ptr<const FlareImage> image_;
    bool upload_pending_ = false;
    enum class Waiting { lens, picture, mending };
    Waiting waiting_for_ = Waiting::lens;  ///< while there is no picture
    LightDirection light_;
    double efl_mm_ = 50.0;
    double exposure_ev_ = 0.0;
    double last_upload_ms_ = 0.0;
    PictureZoom zoom_;

    Drag drag_ = Drag::none;
    QPointF pressed_at_, last_position_;
    QPointF grip_px_;  ///< from the cursor to the light's place when the drag began on its marker
    std::optional<QPointF> cursor_;

    std::unique_ptr<FlareRenderer> renderer_;
    std::unique_ptr<PictureUpload> upload_;
    QImage software_picture_;  ///< what paint_without_gl() last made, for that exposure and frame
    double software_exposure_ev_ = 0.0;
    PictureFrame software_frame_;
};

}  // namespace ghostlight
