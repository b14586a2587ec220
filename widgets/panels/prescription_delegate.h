#pragma once

#include <QPersistentModelIndex>

#include "widgets/panels/table_delegate.h"

class QLineEdit;

namespace ghostlight {

/// Editors of the prescription's cells. A text that the model would refuse keeps its editor open,
/// marked, with the reason beside it; Escape gives up.
class PrescriptionDelegate : public TableDelegate {
    Q_OBJECT
   public:
    explicit PrescriptionDelegate(QObject* parent);

    /// Also what is marked: V for what a fit may vary, A for an automatic semi-diameter.
    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override;
    QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
    QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option,
                          const QModelIndex& index) const override;
    void setEditorData(QWidget* editor, const QModelIndex& index) const override;

   Q_SIGNALS:
    /// The reason why the text in an open editor cannot be taken; empty when it can again.
    void refusal_changed(const QString& reason) const;

   protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

   private:
    bool accepts(QLineEdit& editor) const;
};

}  // namespace ghostlight
