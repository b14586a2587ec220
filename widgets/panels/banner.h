#pragma once

#include <QFrame>

class QLabel;
class QPushButton;

namespace ghostlight {

/// A sentence that must not be missed, over the middle of the window until it no longer holds or
/// is put away. It moves nothing else.
class Banner : public QFrame {
    Q_OBJECT
   public:
    explicit Banner(QWidget* window);

    /// `topic` tells which message a later clear() means.
    void show_text(const QString& topic, const QString& text);
    /// With one action beside it.
    void show_offer(const QString& topic, const QString& text, const QString& action_text);
    void clear(const QString& topic);
    QString text() const;
    /// Where it may be, in the window.
    void set_place(const QRect& place);

   Q_SIGNALS:
    void offer_taken(const QString& topic);
    void offer_declined(const QString& topic);

   private:
    void fit();

    QLabel* label_;
    QPushButton* action_;
    QString topic_;
    QRect place_;
};

}  // namespace ghostlight
