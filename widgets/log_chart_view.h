#pragma once

#include <vtkNew.h>

#include <optional>

#include "core/io/log_chart_svg.h"
#include "widgets/vtk_view.h"

class vtkAxis;
class vtkChartXY;
class vtkContextActor;

namespace ghostlight {

/// A chart with logarithmic axes, drawn by VTK; the same as log_chart_svg() writes.
class LogChartView : public VtkView {
    Q_OBJECT
   public:
    explicit LogChartView(QWidget* parent = nullptr);
    ~LogChartView() override;

    void set_chart(std::optional<LogChart> chart);
    const std::optional<LogChart>& chart() const { return shown_; }
    /// In place of a chart.
    void set_text(const QString& text);

   protected:
    void prepare_rendering(int width_px, int height_px) override;
    void paint_overlay(QPainter& painter) override;

   private:
    void build();
    std::optional<LogChart> shown_;
    QString text_;
    QString built_ground_;  ///< the theme's colour that the chart was built in
    int built_ratio_ = 0;
    vtkNew<vtkContextActor> actor_;
    vtkNew<vtkChartXY> plot_;
};

}  // namespace ghostlight
