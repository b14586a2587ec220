#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "widgets/axis_marks.h"
#include "widgets/layout_actors.h"
#include "widgets/layout_scene.h"
#include "widgets/plane_view.h"
#include "widgets/ray_fan.h"
#include "widgets/vtk_view.h"

namespace ghostlight {

/// Draws a lens and its rays. Drag moves, the wheel zooms about the cursor, double click or F
/// brings everything into view.
class LayoutView : public VtkView {
    Q_OBJECT
   public:
    explicit LayoutView(QWidget* parent = nullptr);
    ~LayoutView() override;

    void show_drawing(LensDrawing drawing, std::vector<RayFan> fans,
                      std::vector<AxisMark> marks = {});
    /// Shows this text instead of a lens.
    void show_nothing(const QString& text);
    void fit();

    const LensDrawing& drawing() const { return drawing_; }
    const std::vector<RayFan>& fans() const { return fans_; }
    const std::vector<AxisMark>& marks() const { return marks_; }
    const PlaneView& plane() const { return plane_; }
    /// The share of each ray's way that is shown, 0 to 1.
    void set_walk(double share);
    double walk() const { return walk_; }
    /// Dragging measures a distance instead of moving the drawing.
    void set_measuring(bool measures);
    /// The last measured distance, mm; 0 when there is none.
    double measured_mm() const;
    /// The ray's meeting with a surface within reach of a position; null when there is none.
    const RayMeeting* meeting_at(QPointF position) const;
    /// Row from 1 of the surface within reach of a position, 0 when there is none.
    int row_at(QPointF position) const;

   Q_SIGNALS:
    void surface_hovered(int row);

   protected:
    void prepare_rendering(int width_px, int height_px) override;
    void paint_overlay(QPainter& painter) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void changeEvent(QEvent* event) override;

   private:
    void hover(int row);
    void rebuild();

    LensDrawing drawing_;
    std::vector<RayFan> fans_;
    std::vector<AxisMark> marks_;
    double walk_ = 1.0;
    bool measures_ = false;
    std::optional<std::pair<DrawingPoint, DrawingPoint>> measured_;
    std::optional<RayMeeting> hovered_meeting_;
    QString nothing_;
    PlaneView plane_;
    bool fitted_ = true;  ///< follows the widget's size until the user moves the view
    int hovered_row_ = 0;
    QPointF last_position_;
    std::unique_ptr<LayoutActors> actors_;
};

}  // namespace ghostlight
