#pragma once

#include <QColor>
#include <QString>
#include <QWidget>

#include <vector>

namespace ghostlight {

/// The strip on top of a panel: what it is about on the left, its state on the right.
class PanelHeader : public QWidget {
    Q_OBJECT
   public:
    /// A stretch of the state's text; without a colour it takes the header's own.
    struct Part {
        QString text;
        QColor color;
    };

    explicit PanelHeader(const QString& title, QWidget* parent = nullptr);

    void set_state(const QString& state);
    void set_state(std::vector<Part> parts);
    /// The state as plain text.
    QString state() const;
    /// A warning is written in the warning colour.
    void set_warning(bool warning);
    /// Dims the state: it belongs to something older than what is now asked for.
    void set_dimmed(bool dimmed);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

   protected:
    void paintEvent(QPaintEvent* event) override;

   private:
    QString title_;
    std::vector<Part> parts_;
    bool warning_ = false;
    bool dimmed_ = false;
};

}  // namespace ghostlight
