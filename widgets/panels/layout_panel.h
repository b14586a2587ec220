#pragma once

#include <QImage>
#include <QStringList>
#include <QWidget>

#include <vector>

#include "core/ghosts/ghost_path.h"
#include "core/optics/prescription.h"
#include "core/optics/trace.h"

class QSlider;

namespace ghostlight {

class LayoutView;
class PanelHeader;

/// The lens in its meridional section, with the direct rays and those of the selected ghosts.
/// Because the lens is rotationally symmetric, the drawing's plane is always the light's own
/// meridional plane, whatever its azimuth.
class LayoutPanel : public QWidget {
    Q_OBJECT
   public:
    explicit LayoutPanel(QWidget* parent = nullptr);
    ~LayoutPanel() override;

    /// Shows a lens in one of its positions (no configurations left in it). Keeps the view unless
    /// the lens is the first one or has another name. A lens that cannot be compiled is drawn
    /// without rays, and the header says why.
    void show_lens(const Prescription& configured, const LightDirection& light,
                   double wavelength_nm, const std::vector<GhostPath>& selected);
    /// Shows the empty state.
    void clear();
    /// Brings the whole lens, from the incoming rays to the sensor, into view.
    void fit();
    /// Direct rays on axis, at 0.7 of the field and at its edge besides those of the light.
    void set_several_fields(bool on);
    /// Pupils, foci, principal points, and the foci of the ghosts that are shown.
    void set_marks(bool on);
    /// Rays of ghosts that do not arrive.
    void set_stopped_rays(bool on);
    void set_measuring(bool on);
    /// Writes the drawing; a failure is said in the header. False then.
    bool export_to(const QString& file);
    LayoutView* view() const { return view_; }
    /// What the view shows, in device pixels; null if it cannot be drawn.
    QImage grab_view();

   Q_SIGNALS:
    /// Row from 1 under the cursor, 0 when there is none.
    void surface_hovered(int row);

   private:
    void show_state();
    void draw();

    PanelHeader* header_ = nullptr;
    LayoutView* view_ = nullptr;
    QSlider* walk_ = nullptr;
    struct Shown {
        Prescription lens;  ///< configured
        LightDirection light;
        double wavelength_nm = 587.5618;
        std::vector<GhostPath> selected;
    };
    Shown shown_;
    bool several_fields_ = false, shows_marks_ = false, shows_stopped_ = false;
    QString export_failure_;
    QString lens_name_;
    QStringList surface_texts_;  ///< what the header says of each surface
    QString direct_text_;
    QString failure_;                ///< why there are no rays
    std::size_t surface_count_ = 0;  ///< of the lens shown; the next one is its sensor
    int hovered_row_ = 0;
};

}  // namespace ghostlight
