#pragma once

#include <QTimer>
#include <QWidget>

#include <string>

#include "core/optics/prescription.h"

class QStackedWidget;
class QTableView;

namespace ghostlight {

class Actions;
class Document;
class EmptyState;
class PanelHeader;
class QuantityModel;

/// First-order data of the lens in its configuration, at the d line. Worked out in this thread: it
/// takes about a millisecond.
class FirstOrderPanel : public QWidget {
    Q_OBJECT
   public:
    FirstOrderPanel(Document& document, const Actions& actions, QWidget* parent = nullptr);

    QuantityModel& model() { return *model_; }
    QTableView& table() { return *table_; }
    QString state() const;
    /// Why there are no numbers; empty while there are.
    QString reason() const { return reason_; }
    void copy_rows() const;

   private:
    void follow_document();
    void work_out();

    Document& document_;
    QuantityModel* model_;
    PanelHeader* header_;
    QTableView* table_;
    EmptyState* empty_;
    EmptyState* cannot_;
    QStackedWidget* pages_;
    QTimer delay_;  ///< many changes, one calculation
    Prescription shown_;
    QString reason_;
};

}  // namespace ghostlight
