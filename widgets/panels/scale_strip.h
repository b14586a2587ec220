#pragma once

#include <QWidget>

class QLineEdit;
class QPushButton;

namespace ghostlight {

class Document;

/// Asks by how much the lens is scaled, by a factor or to a focal length, each following the
/// other. It stays below the table until it is answered, and nothing waits for it.
class ScaleStrip : public QWidget {
    Q_OBJECT
   public:
    explicit ScaleStrip(Document& document, QWidget* parent = nullptr);

    void ask();
    QLineEdit& factor() { return *factor_; }
    QLineEdit& efl() { return *efl_; }

   Q_SIGNALS:
    void chosen(double factor);
    void refused(const QString& reason);

   protected:
    bool event(QEvent* event) override;

   private:
    void take();

    Document& document_;
    QLineEdit* factor_;
    QLineEdit* efl_;
    double efl_mm_ = 0.0;  ///< of the lens as it is; 0 where it has none
    double wanted_ = 1.0;  ///< what the fields say; 0 for what cannot be read
};

}  // namespace ghostlight
