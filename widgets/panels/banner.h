#pragma once

#include <QFrame>

#include <vector>

class QLabel;
class QPushButton;
class QToolButton;

namespace ghostlight {

/// A sentence that must not be missed, over the middle of the window until it no longer holds or
/// is put away. It moves nothing else.
class Banner : public QFrame {
    Q_OBJECT
   public:
    explicit Banner(QWidget* window);

    /// `topic` tells which message a later clear() means.
    void show_text(const QString& topic, const QString& text);
    /// With one action beside it, and another for putting it away if that has a name of its own.
    /// Unlike a text, an offer that another message covers comes back after that one.
    void show_offer(const QString& topic, const QString& text, const QString& action_text,
                    const QString& decline_text = {});
    void clear(const QString& topic);
    QString text() const;
    /// Where it may be, in the window.
    void set_place(const QRect& place);

   Q_SIGNALS:
    void offer_taken(const QString& topic);
    void offer_declined(const QString& topic);

   private:
    struct Message {
        QString topic, text, action_text, decline_text;
    };
    void fit();
    void show_newest();
    void decline();

    QLabel* label_;
    QPushButton* action_;
    QPushButton* decline_;
    QToolButton* close_;
    std::vector<Message> messages_;  ///< the last one is shown
    QRect place_;
};

}  // namespace ghostlight
