#pragma once

#include <QString>
#include <QWidget>

#include <vector>

namespace ghostlight {

/// Correlations of fitted numbers as a square of colours: amber alike, teal opposite.
class CorrelationView : public QWidget {
    Q_OBJECT
   public:
    explicit CorrelationView(QWidget* parent = nullptr);
    /// `values`: names × names.
    void set_correlations(std::vector<QString> names, std::vector<double> values);
    /// What the mouse at a place is told; empty beside the square.
    QString text_at(const QPoint& at) const;

    QSize minimumSizeHint() const override { return {200, 160}; }

   protected:
    void paintEvent(QPaintEvent* event) override;
    bool event(QEvent* event) override;

   private:
    QRectF square() const;
    std::vector<QString> names_;
    std::vector<double> values_;
};

}  // namespace ghostlight
