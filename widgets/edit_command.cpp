#include "widgets/edit_command.h"

#include <utility>

namespace ghostlight {

EditCommand::EditCommand(Document& document, DocumentState before, DocumentState after,
                         const QString& text, const QString& field)
    : QUndoCommand(text),
      document_(document),
      before_(std::move(before)),
      after_(std::move(after)),
      field_(field) {}

void EditCommand::undo() { document_.apply(before_); }

void EditCommand::redo() { document_.apply(after_); }

int EditCommand::id() const { return field_.isEmpty() ? -1 : 1; }

bool EditCommand::mergeWith(const QUndoCommand* later) {
    // Only commands of this class are ever on the document's history.
    const auto* next = static_cast<const EditCommand*>(later);
    if (next->field_ != field_) {
        return false;
    }
    after_ = next->after_;
    setObsolete(after_ == before_);
    return true;
}

}  // namespace ghostlight
