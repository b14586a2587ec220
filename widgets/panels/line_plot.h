#pragma once

#include <QColor>
#include <QPolygonF>
#include <QString>
#include <QWidget>

#include <vector>

namespace ghostlight {

/// Curves over two axes with their units, painted plainly.
class LinePlot : public QWidget {
    Q_OBJECT
   public:
    struct Curve {
        QString name;
        QColor color;
        QPolygonF points;
        QPolygonF band = {};  ///< closed; filled faintly
        bool dashed = false;
    };
    explicit LinePlot(QWidget* parent = nullptr);

    void set_axes(const QString& x_title, const QString& y_title, bool log_y);
    void set_title(const QString& title) { title_ = title; }
    void set_curves(std::vector<Curve> curves);
    const std::vector<Curve>& curves() const { return curves_; }

    QSize sizeHint() const override { return {320, 200}; }
    QSize minimumSizeHint() const override { return {200, 130}; }

   protected:
    void paintEvent(QPaintEvent* event) override;

   private:
    QString title_, x_title_, y_title_;
    bool log_y_ = false;
    std::vector<Curve> curves_;
};

}  // namespace ghostlight
