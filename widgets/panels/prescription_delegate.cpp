#include "widgets/panels/prescription_delegate.h"

#include <QAbstractItemView>
#include <QCompleter>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPainter>
#include <QStandardItemModel>
#include <QStyle>
#include <QTimer>

#include <map>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/io/coating_library.h"
#include "core/io/glass_library.h"
#include "widgets/models/prescription_model.h"
#include "widgets/palette.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

/// Which cell an editor belongs to.
constexpr const char* cell_property = "cell";
/// What a list of words shows beside each.
constexpr int beside_role = Qt::UserRole;
constexpr int beside_gap = 24;
constexpr int mark_width = 12;

/// Every glass at hand, by name, each once, with its nd, Vd and catalogue in words.
std::map<QString, QString> all_glasses() {
    std::map<QString, QString> names;
    try {
        const auto library = glass_library();
        for (const GlassFile& catalog : library->catalogs) {
            for (const CataloguedGlass& glass : catalog.glasses) {
                const auto nd = known_nd(glass);
                const auto vd = known_vd(glass);
                names.emplace(QString::fromStdString(glass.medium.name),
                              QStringLiteral("%1 / %2   %3")
                                  .arg(nd ? QString::number(*nd, 'f', 4) : QStringLiteral("–"),
                                       vd ? QString::number(*vd, 'f', 1) : QStringLiteral("–"),
                                       QString::fromStdString(glass.catalog)));
            }
        }
    } catch (const Error&) {
        // No catalogue: nothing to suggest.
    }
    return names;
}

/// A word, and what is said beside it.
using Suggestion = std::pair<QString, QString>;

std::vector<Suggestion> suggestions(const QModelIndex& index) {
    if (index.column() == PrescriptionModel::coating) {
        std::vector<Suggestion> names;
        for (const char* plain : {"none", "MgF2 λ/4 550", "ideal λ/4 550", "1.38 λ/4 550"}) {
            names.emplace_back(plain, QString());
        }
        try {
            for (const LibraryCoating& coating : coating_library()) {
                names.emplace_back(QString::fromStdString(coating.name),
                                   QString::fromStdString(coating.title));
            }
        } catch (const Error&) {
            // No library: the plain ones are there all the same.
        }
        return names;
    }
    if (index.column() != PrescriptionModel::medium) {
        return {};
    }
    std::vector<Suggestion> names;
    std::map<QString, QString> glasses = all_glasses();
    for (const QString& offer : index.data(PrescriptionModel::offers_role).toStringList()) {
        names.emplace_back(offer, glasses[offer]);
        glasses.erase(offer);
    }
    names.insert(names.end(), glasses.begin(), glasses.end());
    return names;
}

/// Words to complete from; what is said beside each is seen and not typed.
QAbstractItemModel* word_list(const std::vector<Suggestion>& words, QObject* parent) {
    auto* list = new QStandardItemModel(static_cast<int>(words.size()), 1, parent);
    for (int row = 0; row < list->rowCount(); ++row) {
        const auto& [word, beside] = words[static_cast<std::size_t>(row)];
        list->setData(list->index(row, 0), word, Qt::EditRole);
        list->setData(list->index(row, 0), beside, beside_role);
    }
    return list;
}

/// A word on the left, and dim on the right what is said beside it.
class WordDelegate : public QStyledItemDelegate {
   public:
    using QStyledItemDelegate::QStyledItemDelegate;
    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override {
        QStyledItemDelegate::paint(painter, option, index);
        const QRect inside = option.rect.adjusted(0, 0, -8, 0);
        painter->setPen(current_palette().dim);
        painter->drawText(inside, Qt::AlignRight | Qt::AlignVCenter,
                          index.data(beside_role).toString());
    }
    QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        QSize size = QStyledItemDelegate::sizeHint(option, index);
        const QString beside = index.data(beside_role).toString();
        size.rwidth() += beside_gap + option.fontMetrics.horizontalAdvance(beside);
        return size;
    }
};

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

void PrescriptionDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option,
                                 const QModelIndex& index) const {
    TableDelegate::paint(painter, option, index);
    const QString marks = index.data(PrescriptionModel::mark_role).toString();
    if (marks.isEmpty()) {
        return;
    }
    painter->save();
    QFont small = small_font();
    small.setWeight(QFont::DemiBold);
    painter->setFont(small);
    int x = index.data(Qt::TextAlignmentRole).toInt() & Qt::AlignRight
                ? option.rect.left() + 3
                : option.rect.right() - mark_width * static_cast<int>(marks.size());
    for (const QChar& letter : marks) {
        painter->setPen(letter == 'V' ? current_palette().teal : current_palette().dim);
        painter->drawText(QRect(x, option.rect.top(), mark_width, option.rect.height()),
                          Qt::AlignCenter, letter);
        x += mark_width;
    }
    painter->restore();
}

QSize PrescriptionDelegate::sizeHint(const QStyleOptionViewItem& option,
                                     const QModelIndex& index) const {
    QSize size = TableDelegate::sizeHint(option, index);
    const auto marks = index.data(PrescriptionModel::mark_role).toString().size();
    size.rwidth() += mark_width * static_cast<int>(marks);
    return size;
}

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
    const std::vector<Suggestion> words = suggestions(index);
    if (!words.empty()) {
        auto* completer = new QCompleter(word_list(words, editor), editor);
        completer->setCaseSensitivity(Qt::CaseInsensitive);
        completer->setFilterMode(Qt::MatchContains);
        completer->setMaxVisibleItems(10);
        editor->setCompleter(completer);
        completer->popup()->setItemDelegate(new WordDelegate(completer));
        completer->popup()->setMinimumWidth(320);
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
