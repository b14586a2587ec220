#pragma once

#include <QFrame>

#include <functional>

class QComboBox;
class QLineEdit;

namespace ghostlight {

/// A labelled value in the scene bar: "Field 10.0°", with an editor that looks like text.
class NumberField : public QFrame {
    Q_OBJECT
   public:
    /// `unit` is written after the number.
    NumberField(const QString& label, const QString& unit, const QString& tip,
                QWidget* parent = nullptr);

    /// Shown unless the field is being typed into.
    void set_text(const QString& text);
    QLineEdit& editor() { return *editor_; }
    /// Marks the text as one that cannot be taken.
    void set_refused(bool refused);

   Q_SIGNALS:
    void entered(const QString& text);
    /// Wheel or arrow keys: so many steps up.
    void stepped(int steps);

   protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;

   private:
    void fit_width();

    QLineEdit* editor_;
    QString unit_;
    QString shown_;
    int scrubbed_ = 0;  ///< steps since a drag over the name began
};

/// The same with a choice.
class ChoiceField : public QFrame {
    Q_OBJECT
   public:
    ChoiceField(const QString& label, const QString& tip, bool editable, QWidget* parent = nullptr);

    void set_choices(const QStringList& choices);
    void set_text(const QString& text);
    void set_refused(bool refused);
    QComboBox& box() { return *box_; }

   Q_SIGNALS:
    void entered(const QString& text);

   private:
    void fit_width();

    QComboBox* box_;
};

}  // namespace ghostlight
