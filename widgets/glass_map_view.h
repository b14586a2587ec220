#pragma once

#include <vtkNew.h>

#include <optional>
#include <vector>

#include "core/io/glass_search.h"
#include "widgets/vtk_view.h"

class vtkActor;
class vtkPolyData;

namespace ghostlight {

/// Glasses by Abbe number, falling to the right, and index. What is found stands out, the surface's
/// own glass is ringed. Wheel zooms, dragging pans, a double click shows all, a click chooses.
class GlassMapView : public VtkView {
    Q_OBJECT
   public:
    explicit GlassMapView(QWidget* parent = nullptr);
    ~GlassMapView() override;

    /// `glasses` has to outlive the view or the next call.
    void show_glasses(const std::vector<MappedGlass>* glasses, std::vector<std::size_t> found);
    /// nd and Vd of the surface in hand.
    void set_ring(std::optional<ModelGlass> glass);
    void set_chosen(std::optional<std::size_t> glass);
    void fit();
    /// Where a glass is in the widget.
    QPointF place(const MappedGlass& glass) const;

   Q_SIGNALS:
    void glass_chosen(std::size_t glass);

   protected:
    void prepare_rendering(int width_px, int height_px) override;
    void paint_overlay(QPainter& painter) override;
    void paint_without_gl(QPainter& painter) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void leaveEvent(QEvent* event) override;

   private:
    struct Range {
        double low = 0.0, high = 1.0;
    };
    QRectF plot() const;
    QPointF place(double nd, double vd) const;
    std::optional<std::size_t> glass_at(QPointF position) const;
    QColor color_of(std::size_t glass) const;
    void stretch(double factor, QPointF about);

    const std::vector<MappedGlass>* glasses_ = nullptr;
    std::vector<std::size_t> found_;
    std::vector<bool> is_found_;
    std::optional<ModelGlass> ring_;
    std::optional<std::size_t> chosen_;
    std::optional<std::size_t> hovered_;
    Range vd_{15.0, 100.0};
    Range nd_{1.40, 2.05};
    QPointF pressed_at_, last_;
    bool panned_ = false;
    vtkNew<vtkPolyData> points_;
    vtkNew<vtkActor> actor_;
};

}  // namespace ghostlight
