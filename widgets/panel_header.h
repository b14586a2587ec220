#pragma once

#include <QString>
#include <QWidget>

class QLabel;

namespace ghostlight {

/// The strip on top of a panel: what it is about on the left, its state on the right.
class PanelHeader : public QWidget {
    Q_OBJECT
   public:
    explicit PanelHeader(const QString& title, QWidget* parent = nullptr);

    void set_state(const QString& state);
    QString state() const { return state_; }
    /// A warning is written in the warning colour.
    void set_warning(bool warning);
    void set_dimmed(bool dimmed);

   protected:
    void resizeEvent(QResizeEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void changeEvent(QEvent* event) override;

   private:
    void refresh();

    QLabel* title_label_ = nullptr;
    QLabel* state_label_ = nullptr;
    QString state_;
    bool warning_ = false;
    bool dimmed_ = false;
};

}  // namespace ghostlight
