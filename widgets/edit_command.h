#pragma once

#include <QUndoCommand>

#include "widgets/document.h"

namespace ghostlight {

/// A step of the history: the document before and after. Steps on the same field merge, and one
/// that comes back to where it began vanishes.
class EditCommand : public QUndoCommand {
   public:
    EditCommand(Document& document, DocumentState before, DocumentState after, const QString& text,
                const QString& field);

    void undo() override;
    void redo() override;
    int id() const override;
    bool mergeWith(const QUndoCommand* later) override;

   private:
    Document& document_;
    DocumentState before_;
    DocumentState after_;
    QString field_;
};

}  // namespace ghostlight
