#pragma once

#include <QColor>
#include <QString>
#include <QWidget>

#include <vector>

namespace ghostlight {

/// Curves over one axis, with places marked on it. Values are per cent, from 0 up.
class CurveChart : public QWidget {
    Q_OBJECT
   public:
    struct Curve {
        QString name;
        std::vector<QPointF> points;  ///< x in the axis's unit, y in per cent
        QColor color;
        bool dashed = false;
    };
    /// A place that matters, and how far it spreads.
    struct Mark {
        double at = 0.0;
        double to = 0.0;  ///< end of a band that begins at `at`; the same for a line alone
        QString text;
    };

    /// `unit` follows the numbers of the axis: "nm", "°".
    explicit CurveChart(const QString& title, const QString& unit, QWidget* parent = nullptr);

    void show_curves(std::vector<Curve> curves, std::vector<Mark> marks, const QString& title);
    void show_reason(const QString& reason);
    const std::vector<Curve>& curves() const { return curves_; }
    const std::vector<Mark>& marks() const { return marks_; }

    QSize sizeHint() const override { return {300, 170}; }

   protected:
    void paintEvent(QPaintEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;

   private:
    QRectF plot() const;
    double top_percent() const;

    QString title_;
    QString unit_;
    QString reason_;
    std::vector<Curve> curves_;
    std::vector<Mark> marks_;
    double first_ = 0.0, last_ = 1.0;
    double cursor_ = -1.0;  ///< under the mouse, 0 to 1 along the axis; below 0 for none
};

/// Steps of 1, 2 or 5 times a power of ten, about so many over a span.
double round_step(double span, int about);

}  // namespace ghostlight
