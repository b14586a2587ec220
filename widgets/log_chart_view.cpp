#include "widgets/log_chart_view.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlotLine.h>
#include <vtkPlotPoints.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <QPainter>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "widgets/number_text.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

constexpr double mark_px = 7.0, ring_px = 13.0, line_px = 1.5;
constexpr int least_contrast = 40;  ///< of 255
constexpr int label_px = 12, title_px = 13;

struct Decades {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void take(double value) {
        if (value > 0.0) {
            low = std::min(low, std::log10(value));
            high = std::max(high, std::log10(value));
        }
    }
    bool is_empty() const { return !(low <= high); }
    void widen() {
        const double by = std::max(0.08 * (high - low), 0.1);
        low -= by;
        high += by;
    }
};

vtkSmartPointer<vtkTable> table_of(const std::vector<std::vector<double>>& columns) {
    auto table = vtkSmartPointer<vtkTable>::New();
    int number = 0;
    for (const std::vector<double>& column : columns) {
        vtkNew<vtkDoubleArray> values;
        values->SetName(("c" + std::to_string(number++)).c_str());
        for (const double value : column) {
            values->InsertNextValue(value);
        }
        table->AddColumn(values);
    }
    return table;
}

void write_in(vtkTextProperty* text, const QColor& color, int size_px) {
    text->SetColor(color.redF(), color.greenF(), color.blueF());
    text->SetFontSize(size_px);
    text->SetBold(false);
    text->SetItalic(false);
}

/// Ticks at 1, 2 and 5 of each decade, or at whole decades where there are many.
void set_axis(vtkAxis* axis, const Decades& range, const std::string& title, const Palette& colors,
              int ratio) {
    vtkNew<vtkDoubleArray> places;
    vtkNew<vtkStringArray> words;
    constexpr double many = 3.5;
    const std::vector<double> steps =
        range.high - range.low > many ? std::vector{1.0} : std::vector{1.0, 2.0, 5.0};
    for (int decade = static_cast<int>(std::floor(range.low)); decade <= std::ceil(range.high);
         ++decade) {
        for (const double step : steps) {
            const double value = step * std::pow(10.0, decade);
            if (std::log10(value) >= range.low && std::log10(value) <= range.high) {
                places->InsertNextValue(std::log10(value));
                words->InsertNextValue(shortest(value).toStdString());
            }
        }
    }
    axis->SetBehavior(vtkAxis::FIXED);
    axis->SetRange(range.low, range.high);
    axis->SetCustomTickPositions(places, words);
    axis->SetTitle(title);
    write_in(axis->GetTitleProperties(), colors.dim, title_px * ratio);
    write_in(axis->GetLabelProperties(), colors.dim, label_px * ratio);
    const auto pen_in = [](vtkPen* pen, const QColor& color) {
        pen->SetColor(static_cast<unsigned char>(color.red()),
                      static_cast<unsigned char>(color.green()),
                      static_cast<unsigned char>(color.blue()), 255);
    };
    pen_in(axis->GetPen(), colors.dim);
    pen_in(axis->GetGridPen(), colors.line);
}

void color_in(vtkPlot* plot, const QColor& color, int alpha = 255) {
    plot->SetColor(static_cast<unsigned char>(color.red()),
                   static_cast<unsigned char>(color.green()),
                   static_cast<unsigned char>(color.blue()), static_cast<unsigned char>(alpha));
}

}  // namespace

LogChartView::LogChartView(QWidget* parent) : VtkView(parent) {
    setMinimumSize(260, 160);
    actor_->GetScene()->AddItem(plot_);
    renderer()->AddActor(actor_);
    actor_->GetScene()->SetRenderer(renderer());
    plot_->SetVisible(false);
}

LogChartView::~LogChartView() { close_gl(); }

void LogChartView::set_chart(std::optional<LogChart> chart) {
    shown_ = std::move(chart);
    built_ground_.clear();
    refresh();
}

void LogChartView::set_text(const QString& text) {
    text_ = text;
    refresh();
}

void LogChartView::build() {
    const Palette& colors = current_palette();
    plot_->ClearPlots();
    plot_->SetVisible(shown_.has_value());
    if (!shown_) {
        return;
    }
    Decades x, y;
    for (const LogSeries& series : shown_->series) {
        for (const LogMark& mark : series.marks) {
            if (mark.x > 0.0 && mark.y > 0.0) {
                x.take(mark.x);
                y.take(mark.y);
            }
        }
    }
    if (x.is_empty()) {
        plot_->SetVisible(false);
        return;
    }
    if (shown_->band_y) {
        y.take(*shown_->band_y);
    }
    x.widen();
    y.widen();
    const int ratio = std::max(1, built_ratio_);
    if (shown_->diagonal) {
        const double low = std::max(x.low, y.low), high = std::min(x.high, y.high);
        auto* line = plot_->AddPlot(vtkChart::LINE);
        line->SetInputData(table_of({{low, high}, {low, high}}), 0, 1);
        line->SetLabel("as asked");
        line->SetWidth(static_cast<float>(line_px * ratio));
        color_in(line, colors.dim);
    }
    std::vector<double> ring_x, ring_y;
    for (const LogSeries& series : shown_->series) {
        std::vector<double> all_x, all_y, fine_x, fine_y, hollow_x, hollow_y;
        for (const LogMark& mark : series.marks) {
            if (!(mark.x > 0.0 && mark.y > 0.0)) {
                continue;
            }
            const double u = std::log10(mark.x), v = std::log10(mark.y);
            all_x.push_back(u);
            all_y.push_back(v);
            (mark.hollow ? hollow_x : fine_x).push_back(u);
            (mark.hollow ? hollow_y : fine_y).push_back(v);
            if (mark.ringed) {
                ring_x.push_back(u);
                ring_y.push_back(v);
            }
        }
        QColor color(QString::fromStdString(series.color));
        if (std::abs(color.lightness() - colors.panel.lightness()) < least_contrast) {
            color = colors.text;  // colours are chosen for paper
        }
        if (series.joined && all_x.size() > 1) {
            auto* line = plot_->AddPlot(vtkChart::LINE);
            line->SetInputData(table_of({all_x, all_y}), 0, 1);
            line->SetWidth(static_cast<float>(line_px * ratio));
            line->SetLegendVisibility(false);
            color_in(line, color, 160);
        }
        const auto marks = [&](const std::vector<double>& u, const std::vector<double>& v,
                               int style, bool named) {
            if (u.empty()) {
                return;
            }
            auto* points = vtkPlotPoints::SafeDownCast(plot_->AddPlot(vtkChart::POINTS));
            points->SetInputData(table_of({u, v}), 0, 1);
            points->SetMarkerStyle(style);
            points->SetMarkerSize(static_cast<float>(mark_px * ratio));
            points->SetLabel(series.name);
            points->SetLegendVisibility(named);
            color_in(points, color);
        };
        marks(fine_x, fine_y, vtkPlotPoints::CIRCLE, true);
        marks(hollow_x, hollow_y, vtkPlotPoints::CROSS, fine_x.empty());
    }
    if (!ring_x.empty()) {
        auto* ring = vtkPlotPoints::SafeDownCast(plot_->AddPlot(vtkChart::POINTS));
        ring->SetInputData(table_of({ring_x, ring_y}), 0, 1);
        ring->SetMarkerStyle(vtkPlotPoints::CIRCLE);
        ring->SetMarkerSize(static_cast<float>(ring_px * ratio));
        ring->SetLabel(shown_->ring_name);
        color_in(ring, colors.amber, 110);
    }
    set_axis(plot_->GetAxis(vtkAxis::BOTTOM), x, shown_->x_title, colors, ratio);
    set_axis(plot_->GetAxis(vtkAxis::LEFT), y, shown_->y_title, colors, ratio);
    plot_->SetTitle("");
    plot_->SetShowLegend(true);
    vtkChartLegend* legend = plot_->GetLegend();
    legend->SetInline(false);
    legend->SetHorizontalAlignment(vtkChartLegend::RIGHT);
    legend->SetVerticalAlignment(vtkChartLegend::TOP);
    write_in(legend->GetLabelProperties(), colors.text, label_px * ratio);
    legend->GetBrush()->SetOpacityF(0.0);
    legend->GetPen()->SetLineType(vtkPen::NO_PEN);
    plot_->GetBackgroundBrush()->SetOpacityF(0.0);
}

void LogChartView::prepare_rendering(int width_px, int) {
    const Palette& colors = current_palette();
    const int ratio =
        std::max(1, static_cast<int>(std::lround(width_px / std::max(1.0, 1.0 * width()))));
    if (built_ground_ != colors.panel.name() || built_ratio_ != ratio) {
        built_ground_ = colors.panel.name();
        built_ratio_ = ratio;
        build();
    }
    renderer()->SetBackground(colors.panel.redF(), colors.panel.greenF(), colors.panel.blueF());
}

void LogChartView::paint_overlay(QPainter& painter) {
    const Palette& colors = current_palette();
    if (!shown_) {
        painter.setPen(colors.dim);
        painter.drawText(rect().adjusted(16, 16, -16, -16), Qt::AlignCenter | Qt::TextWordWrap,
                         text_);
        return;
    }
    if (!shown_->band_y || !(*shown_->band_y > 0.0) || !plot_->GetVisible()) {
        return;
    }
    // VTK's axes are in device pixels from the lower left corner.
    vtkAxis* across = plot_->GetAxis(vtkAxis::BOTTOM);
    vtkAxis* up = plot_->GetAxis(vtkAxis::LEFT);
    const double ratio = std::max(1, built_ratio_);
    const double low = up->GetMinimum(), high = up->GetMaximum();
    const double share = std::clamp((std::log10(*shown_->band_y) - low) / (high - low), 0.0, 1.0);
    const double bottom = up->GetPoint1()[1], top = up->GetPoint2()[1];
    const QRectF band(QPointF(across->GetPoint1()[0] / ratio,
                              height() - (bottom + share * (top - bottom)) / ratio),
                      QPointF(across->GetPoint2()[0] / ratio, height() - bottom / ratio));
    QColor faint = colors.dim;
    faint.setAlphaF(0.16F);
    painter.fillRect(band, faint);
    painter.setPen(colors.dim);
    painter.drawText(band.adjusted(8, 3, -8, -3), Qt::AlignRight | Qt::AlignTop,
                     QString::fromStdString(shown_->band_name));
}

}  // namespace ghostlight
