#include "widgets/panels/prescription_delegate.h"

#include <QAbstractItemView>
#include <QCompleter>
#include <QKeyEvent>
#include <QLineEdit>
#include <QStyle>
#include <QTimer>

#include <set>

#include "core/error.h"
#include "core/io/glass_library.h"
#include "widgets/models/prescription_model.h"

namespace ghostlight {

namespace {

/// Which cell an editor belongs to.
constexpr const char* cell_property = "cell";

/// Every glass at hand, by name, each once.
QStringList all_glasses() {
    std::set<QString> names;
    try {
        const auto library = glass_library();
        for (const GlassFile& catalog : library->catalogs) {
            for (const CataloguedGlass& glass : catalog.glasses) {
                names.insert(QString::fromStdString(glass.medium.name));
            }
        }
    } catch (const Error&) {
        // No catalogue: nothing to suggest.
    }
    return {names.begin(), names.end()};
}

QStringList suggestions(const QModelIndex& index) {
    if (index.column() == PrescriptionModel::coating) {
        return {"none", "MgF2 λ/4 550", "ideal λ/4 550", "1.38 λ/4 550"};
    }
    if (index.column() != PrescriptionModel::medium) {
        return {};
    }
    QStringList names = index.data(PrescriptionModel::offers_role).toStringList();
    const QStringList offers = names;
    for (const QString& name : all_glasses()) {
        if (!offers.contains(name)) {
            names << name;
        }
    }
    return names;
}

/// What may be meant comes first, unasked, under a cell that must be mended.
void offer_at_once(QLineEdit* editor) {
    QTimer::singleShot(0, editor, [editor] {
        if (editor->completer() != nullptr && !editor->isModified() && editor->isVisible()) {
            editor->selectAll();
            editor->completer()->setCompletionPrefix(QString());
            editor->completer()->complete();
        }
    });
}

void mark(QLineEdit& editor, bool refused) {
    if (editor.property("refused").toBool() != refused) {
        editor.setProperty("refused", refused);
        editor.style()->unpolish(&editor);
        editor.style()->polish(&editor);
    }
}

}  // namespace

PrescriptionDelegate::PrescriptionDelegate(QObject* parent) : TableDelegate(-1, -1, parent) {}

QWidget* PrescriptionDelegate::createEditor(QWidget* parent, const QStyleOptionViewItem&,
                                            const QModelIndex& index) const {
    auto* editor = new QLineEdit(parent);
    editor->setFrame(false);
    editor->setAlignment(static_cast<Qt::Alignment>(index.data(Qt::TextAlignmentRole).toInt()));
    editor->setProperty(cell_property, QPersistentModelIndex(index));
    if (index.column() == PrescriptionModel::coating ||
        index.column() == PrescriptionModel::aspheric) {
        editor->setMinimumWidth(200);  // what is typed here may be longer than the column is wide
    }
    const QStringList words = suggestions(index);
    if (!words.isEmpty()) {
        auto* completer = new QCompleter(words, editor);
        completer->setCaseSensitivity(Qt::CaseInsensitive);
        completer->setFilterMode(Qt::MatchContains);
        completer->setMaxVisibleItems(10);
        editor->setCompleter(completer);
        completer->popup()->setMinimumWidth(160);
        if (index.data(PrescriptionModel::must_be_mended_role).toBool()) {
            offer_at_once(editor);
        }
    }
    connect(editor, &QLineEdit::textEdited, this, [this, editor] {
        mark(*editor, false);
        Q_EMIT refusal_changed({});
    });
    connect(editor, &QObject::destroyed, this, [this] { Q_EMIT refusal_changed({}); });
    return editor;
}

void PrescriptionDelegate::setEditorData(QWidget* editor, const QModelIndex& index) const {
    auto* line = qobject_cast<QLineEdit*>(editor);
    // What is being typed is not lost when the lens changes beneath it.
    if (line != nullptr && !line->isModified()) {
        line->setText(index.data(Qt::EditRole).toString());
    }
}

bool PrescriptionDelegate::accepts(QLineEdit& editor) const {
    const QPersistentModelIndex index =
        editor.property(cell_property).value<QPersistentModelIndex>();
    const auto* model = qobject_cast<const PrescriptionModel*>(index.model());
    const QString reason = model == nullptr ? QString() : model->refusal(index, editor.text());
    mark(editor, !reason.isEmpty());
    Q_EMIT refusal_changed(reason);
    return reason.isEmpty();
}

bool PrescriptionDelegate::eventFilter(QObject* watched, QEvent* event) {
    auto* editor = qobject_cast<QLineEdit*>(watched);
    if (editor == nullptr) {
        return TableDelegate::eventFilter(watched, event);
    }
    if (event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        const bool leaves = key == Qt::Key_Return || key == Qt::Key_Enter || key == Qt::Key_Tab ||
                            key == Qt::Key_Backtab;
        if (leaves && !accepts(*editor)) {
            return true;
        }
    }
    const bool to_popup = event->type() == QEvent::FocusOut &&
                          static_cast<QFocusEvent*>(event)->reason() == Qt::PopupFocusReason;
    if (event->type() == QEvent::FocusOut && !to_popup && editor->isVisible() &&
        !accepts(*editor)) {
        return true;  // stays open until it is put right or given up
    }
    return TableDelegate::eventFilter(watched, event);
}

}  // namespace ghostlight
