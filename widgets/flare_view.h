#pragma once

#include <glm/vec2.hpp>

#include <QImage>
#include <QPointF>
#include <QTimer>

#include <memory>
#include <optional>
#include <vector>

#include "core/flare/flare_image.h"
#include "core/optics/trace.h"
#include "render/flare_renderer.h"
#include "render/picture_frame.h"
#include "widgets/flare_overlay.h"
#include "widgets/gl_view.h"

namespace ghostlight {

/// Draws a flare picture and takes the mouse: left drag moves the light, the wheel changes the
/// exposure, Ctrl+wheel zooms about the cursor, middle drag pans; a click asks for the ghosts
/// there.
class FlareView : public GlView {
    Q_OBJECT
   public:
    explicit FlareView(QWidget* parent = nullptr);
    ~FlareView() override;

    void set_image(std::shared_ptr<const FlareImage> image);
    const FlareImage* image() const { return image_.get(); }
    void set_light(const LightDirection& light, double efl_mm);
    /// Marked less strongly.
    void set_other_lights(std::vector<LightDirection> lights);
    /// The lens cannot be traced as it stands: says so where there is no picture.
    void set_failed();
    void set_exposure_ev(double exposure_ev);
    double exposure_ev() const { return look_.exposure_ev; }
    /// Tone curve, false colours, clipping; the exposure stays.
    void set_tone(ToneCurve tone);
    void set_mark_clipping(bool marks);
    /// Over four decades, the brightest place of the picture at rest on top.
    void set_false_color(bool on);
    const PictureLook& look() const { return look_; }
    /// The pinned lens's picture: shown left of the divider, or in turn with the own one. Null ends
    /// that.
    void set_compared(std::shared_ptr<const FlareImage> image);
    bool compares() const { return compared_ != nullptr; }
    void set_split(bool split);
    double split_share() const { return split_share_; }
    /// While blinking: whether A is the one that is shown.
    void set_showing_a(bool shows);
    bool is_showing_a() const { return shows_a_; }
    /// The ghosts at a place, with their shares; shown while the cursor stays there.
    void set_probe(glm::dvec2 point_mm, std::vector<ReadoutLine> lines);
    const std::vector<ReadoutLine>& probe() const { return probe_; }
    double last_upload_ms() const { return last_upload_ms_; }
    /// Brings the whole sensor into view.
    void reset_zoom();
    /// Where the picture lies on the widget, logical pixels.
    PictureFrame frame() const;

   Q_SIGNALS:
    void light_dragged(ghostlight::LightDirection light);
    void light_drag_finished();
    /// The cursor rests on a point of the sensor, mm.
    void rested(glm::dvec2 point_mm);
    /// A click on a point of the sensor; `adds` with Ctrl.
    void picked(glm::dvec2 point_mm, bool adds);
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
    enum class Drag { none, pressed, light, pan, divider };

    void drag_light_to(QPointF position);
    void zoom_about(QPointF position, double factor);
    bool is_over_divider(QPointF position) const;
    void fit_decades();
    PictureLook look_of(double from_share) const;
    void upload(PictureUpload& to, const FlareImage& image) const;
    void paint_comparison(QPainter& painter) const;

    std::shared_ptr<const FlareImage> image_;
    bool upload_pending_ = false;
    enum class Waiting { lens, picture, mending };
    Waiting waiting_for_ = Waiting::lens;  ///< while there is no picture
    LightDirection light_;
    std::vector<LightDirection> other_lights_;
    double efl_mm_ = 50.0;
    PictureLook look_;
    std::shared_ptr<const FlareImage> compared_;
    bool compared_pending_ = false;
    bool split_ = true, shows_a_ = false;
    double split_share_ = 0.5;  ///< of the view's width
    std::vector<ReadoutLine> probe_;
    glm::dvec2 probe_mm_{0.0, 0.0};
    QTimer rest_;  ///< of the cursor
    double last_upload_ms_ = 0.0;
    PictureZoom zoom_;

    Drag drag_ = Drag::none;
    QPointF pressed_at_, last_position_;
    QPointF grip_px_;  ///< from the cursor to the light's place when the drag began on its marker
    std::optional<QPointF> cursor_;

    std::unique_ptr<FlareRenderer> renderer_;
    std::unique_ptr<PictureUpload> upload_, compared_upload_;
    QImage software_picture_;  ///< what paint_without_gl() last made, for that look and frame
    PictureLook software_look_;
    PictureFrame software_frame_;
};

}  // namespace ghostlight
