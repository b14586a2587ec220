#include "widgets/command_palette.h"

#include <QAction>
#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QMenuBar>
#include <QPainter>
#include <QSet>
#include <QStyledItemDelegate>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

#include "widgets/fuzzy_match.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

constexpr int width_px = 620, height_px = 420;
constexpr int row_padding_px = 6, side_px = 12;
constexpr int keys_role = Qt::UserRole, command_role = Qt::UserRole + 1;

/// "&Undo" as it is read: "Undo".
QString plain(QString text) {
    text.replace("&&", QChar(1));
    text.remove('&');
    return text.replace(QChar(1), '&').trimmed();
}

void add_menu(QMenu& menu, const QString& above, Include include, QList<Command>& commands,
              QSet<const QAction*>& seen) {
    Q_EMIT menu.aboutToShow();  // some are filled only then
    for (QAction* action : menu.actions()) {
        const QString text = above + plain(action->text());
        if (QMenu* below = action->menu()) {
            add_menu(*below, text + QStringLiteral(" ▸ "), include, commands, seen);
        } else if (!action->isSeparator() && !seen.contains(action)) {
            seen.insert(action);
            if (action->isEnabled() || include == Include::disabled) {
                commands << Command{action, text,
                                    action->shortcut().toString(QKeySequence::NativeText),
                                    action->toolTip()};
            }
        }
    }
}

/// The command on the left, its key on the right.
class RowPainter : public QStyledItemDelegate {
   public:
    using QStyledItemDelegate::QStyledItemDelegate;
    QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex&) const override {
        return {width_px, option.fontMetrics.height() + 2 * row_padding_px};
    }
    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override {
        const Palette& colors = current_palette();
        const bool is_chosen = (option.state & QStyle::State_Selected) != 0;
        painter->fillRect(option.rect,
                          is_chosen ? option.palette.color(QPalette::Highlight) : colors.panel);
        const QRect inside = option.rect.adjusted(side_px, 0, -side_px, 0);
        const QString keys = index.data(keys_role).toString();
        painter->setPen(colors.dim);
        painter->drawText(inside, Qt::AlignRight | Qt::AlignVCenter, keys);
        const int room = inside.width() - option.fontMetrics.horizontalAdvance(keys) - side_px;
        painter->setPen(colors.text);
        const QString mark = index.data(Qt::CheckStateRole).toInt() == Qt::Checked
                                 ? QStringLiteral("✓ ")
                                 : QString();
        painter->drawText(
            inside, Qt::AlignLeft | Qt::AlignVCenter,
            option.fontMetrics.elidedText(mark + index.data().toString(), Qt::ElideRight, room));
    }
};

}  // namespace

QString Command::plain_tip() const {
    const QString end = QStringLiteral(" (%1)").arg(keys);
    return !keys.isEmpty() && tip.endsWith(end) ? tip.chopped(end.size()) : tip;
}

QList<Command> all_commands(QMenuBar& bar, const QList<QAction*>& others, Include include) {
    QList<Command> commands;
    QSet<const QAction*> seen;
    for (QAction* top : bar.actions()) {
        if (QMenu* menu = top->menu()) {
            add_menu(*menu, plain(top->text()) + QStringLiteral(" ▸ "), include, commands, seen);
        }
    }
    for (QAction* action : others) {
        const bool is_wanted = action->isEnabled() || include == Include::disabled;
        if (is_wanted && !action->isSeparator() && !action->text().isEmpty() &&
            action->menu() == nullptr && !seen.contains(action)) {
            seen.insert(action);
            commands << Command{action, plain(action->text()),
                                action->shortcut().toString(QKeySequence::NativeText),
                                action->toolTip()};
        }
    }
    return commands;
}

CommandPalette::CommandPalette(QList<Command> commands, QWidget* parent)
    : QDialog(parent, Qt::Popup),
      commands_(std::move(commands)),
      line_(new QLineEdit),
      list_(new QListWidget) {
    setObjectName("command_palette");
    setWindowTitle(tr("Find a command"));
    setAttribute(Qt::WA_DeleteOnClose);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(1, 1, 1, 1);
    column->setSpacing(0);
    line_->setPlaceholderText(tr("Type some letters of a command, its menu or what it does"));
    line_->setAccessibleName(windowTitle());
    line_->setFrame(false);
    line_->setTextMargins(side_px - 4, 8, side_px - 4, 8);
    line_->installEventFilter(this);
    list_->setItemDelegate(new RowPainter(list_));
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setFocusPolicy(Qt::NoFocus);
    list_->setUniformItemSizes(true);
    column->addWidget(line_);
    column->addWidget(list_, 1);
    setFocusProxy(line_);
    resize(width_px, height_px);
    if (parent != nullptr) {
        const QWidget& window = *parent->window();
        move(window.mapToGlobal(QPoint((window.width() - width_px) / 2, window.height() / 8)));
    }
    connect(line_, &QLineEdit::textChanged, this, &CommandPalette::show_matches);
    connect(list_, &QListWidget::itemClicked, this, &CommandPalette::run_chosen);
    show_matches({});
}

void CommandPalette::show_matches(const QString& typed) {
    std::vector<std::pair<int, qsizetype>> found;
    for (qsizetype k = 0; k < commands_.size(); ++k) {
        const Command& command = commands_[k];
        // What it does counts too, but its name first.
        constexpr int name_counts = 1000;
        if (const auto score = fuzzy_score(typed, command.text)) {
            found.emplace_back(*score + name_counts, k);
        } else if (command.tip.contains(typed, Qt::CaseInsensitive)) {
            found.emplace_back(0, k);
        }
    }
    std::ranges::stable_sort(found, std::greater(), &std::pair<int, qsizetype>::first);
    list_->clear();
    for (const auto& [score, k] : found) {
        const Command& command = commands_[k];
        auto* item = new QListWidgetItem(command.text, list_);
        item->setData(keys_role, command.keys);
        item->setData(command_role, static_cast<int>(k));
        item->setToolTip(command.tip);
        if (command.action != nullptr && command.action->isCheckable()) {
            item->setData(Qt::CheckStateRole,
                          command.action->isChecked() ? Qt::Checked : Qt::Unchecked);
        }
    }
    list_->setCurrentRow(0);
}

void CommandPalette::run_chosen() {
    const QListWidgetItem* item = list_->currentItem();
    if (item == nullptr) {
        return;
    }
    const QPointer<QAction> action = commands_[item->data(command_role).toInt()].action;
    accept();
    // Once the window has the keyboard again.
    QTimer::singleShot(0, qApp, [action] {
        if (action != nullptr) {
            action->trigger();
        }
    });
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
    if (watched == line_ && event->type() == QEvent::KeyPress) {
        auto* key = static_cast<QKeyEvent*>(event);
        switch (key->key()) {
            case Qt::Key_Up:
            case Qt::Key_Down:
            case Qt::Key_PageUp:
            case Qt::Key_PageDown:
                QApplication::sendEvent(list_, event);
                return true;
            case Qt::Key_Return:
            case Qt::Key_Enter:
                run_chosen();
                return true;
            default:
                break;
        }
    }
    return QDialog::eventFilter(watched, event);
}

}  // namespace ghostlight
