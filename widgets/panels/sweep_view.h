#pragma once

#include <QImage>
#include <QWidget>

#include <optional>
#include <vector>

#include "core/flare/ghost_sweep.h"

namespace ghostlight {

/// A sweep as a strip of flares over curves of the strongest ghosts, logarithmic, each curve's
/// worst value marked. A click on a flare asks for its value, one on a curve selects its ghost.
class SweepView : public QWidget {
    Q_OBJECT
   public:
    explicit SweepView(QWidget* parent = nullptr);

    /// `wanted` points in all; those that are there so far.
    void show_points(const SweepParameter& parameter, std::vector<SweepPoint> points,
                     std::size_t wanted, std::size_t surface_count);
    void set_quantity(SweepQuantity quantity);
    void set_selected(std::vector<GhostPath> ghosts);
    const std::vector<SweepPoint>& points() const { return points_; }
    const std::vector<GhostCurve>& curves() const { return curves_; }
    std::size_t current_point() const { return current_; }
    /// Where a flare of the strip, and a point of a ghost's curve, is on the widget.
    QRectF flare_place(std::size_t point) const;
    QPointF curve_place(const GhostCurve& curve, std::size_t point) const;

    QSize minimumSizeHint() const override { return {240, 160}; }

   Q_SIGNALS:
    void value_chosen(double value);
    void ghost_chosen(const ghostlight::GhostPath& path);

   protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    /// Left and right go from flare to flare, Return takes its value; up and down choose a curve.
    void keyPressEvent(QKeyEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

   private:
    struct Shown {
        const GhostCurve* curve;
        bool selected;
    };
    std::vector<Shown> shown_curves() const;
    QRectF chart() const;
    void make_flares();
    void choose_curve(int step);

    SweepParameter parameter_;
    std::vector<SweepPoint> points_;
    std::size_t wanted_ = 0;
    std::size_t surface_count_ = 0;
    SweepQuantity quantity_ = SweepQuantity::flux;
    std::vector<GhostCurve> curves_;
    std::vector<GhostPath> selected_;
    std::vector<QImage> flares_;
    std::size_t current_ = 0;           ///< point that the keyboard is at
    double low_ = 0.0, high_ = 1.0;     ///< values of the sweep
    double bottom_ = -6.0, top_ = 0.0;  ///< decades of the chart
};

}  // namespace ghostlight
