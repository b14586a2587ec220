#pragma once

#include <QImage>
#include <QWidget>

#include <memory>

#include "core/flare/flare_image.h"
#include "core/optics/trace.h"

namespace ghostlight {

class FlareView;
class PanelHeader;

/// The flare as an upright camera picture: drag the light, turn the wheel for exposure.
class FlarePanel : public QWidget {
    Q_OBJECT
   public:
    explicit FlarePanel(QWidget* parent = nullptr);
    ~FlarePanel() override;

    /// Shows a picture; null shows the empty state. The first picture after begin_lens() sets
    /// the exposure.
    void show_image(std::shared_ptr<const FlareImage> image);
    /// Another lens: its first picture sets the exposure, and the whole sensor comes into view.
    void begin_lens();
    /// Where the light is, and the focal length by which a drag is turned into an angle.
    void set_light(const LightDirection& light, double efl_mm);
    /// The scene's other lights, marked too.
    void set_other_lights(std::vector<LightDirection> lights);
    /// The lens cannot be traced: the last picture is dimmed, or the empty view says so.
    void set_failed();

    /// Exposure in stops; 0 shows an irradiance of E0 as white.
    void set_exposure_ev(double exposure_ev);
    double exposure_ev() const;
    /// Exposes by the picture itself: see auto_exposure_ev().
    void auto_expose();
    /// Dims the header's state while the picture is older than the lens it belongs to.
    void set_dimmed(bool stale);
    /// Time that the last picture took from memory to the graphics card, ms.
    double last_upload_ms() const;
    FlareView* view() const { return view_; }
    /// Puts a strip of controls below the view.
    void set_strip(QWidget* strip);
    /// What the view shows, in device pixels; null if it cannot be drawn.
    QImage grab_view();

   Q_SIGNALS:
    void light_dragged(ghostlight::LightDirection light);
    void light_drag_finished();
    void exposure_changed(double exposure_ev);

   private:
    void show_state();

    PanelHeader* header_ = nullptr;
    FlareView* view_ = nullptr;
    bool expose_next_ = true;
};

}  // namespace ghostlight
