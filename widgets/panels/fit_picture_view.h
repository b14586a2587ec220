#pragma once

#include <QImage>
#include <QTimer>
#include <QWidget>

#include <optional>

namespace ghostlight {

/// A photograph beside, over or in turn with the model's picture.
class FitPictureView : public QWidget {
    Q_OBJECT
   public:
    enum class Mode { photograph, model, overlay, difference, blink };
    struct Pictures {
        QImage photograph;  ///< at the file's own scale
        QImage measured, model, difference;
    };

    explicit FitPictureView(QWidget* parent = nullptr);

    void set_pictures(Pictures pictures);
    const Pictures& pictures() const { return pictures_; }
    void set_mode(Mode mode);
    Mode mode() const { return mode_; }
    /// Where the light's image is, shares of width and height; nothing for none.
    void set_light(std::optional<QPointF> share);
    /// In place of a picture.
    void set_text(const QString& text);
    /// Where the picture is shown.
    QRectF picture_rect() const;
    /// What is shown at this moment; the model's turn when blinking.
    const QImage& shown() const;

    QSize sizeHint() const override { return {420, 280}; }
    QSize minimumSizeHint() const override { return {220, 150}; }

   Q_SIGNALS:
    /// Shares of the picture's width and height.
    void clicked(const QPointF& share);

   protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;

   private:
    Pictures pictures_;
    Mode mode_ = Mode::photograph;
    std::optional<QPointF> light_;
    QString text_;
    QTimer blink_;
    bool shows_model_ = false;
};

}  // namespace ghostlight
