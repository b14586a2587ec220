#include "widgets/panels/scene_field.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QStyle>
#include <QWheelEvent>

#include <algorithm>

#include "widgets/panels/scrub.h"
#include "widgets/tabular_text.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

constexpr int min_editor_width = 28;

void set_mark(QFrame& frame, const char* mark, bool on) {
    if (frame.property(mark).toBool() == on) {
        return;
    }
    frame.setProperty(mark, on);
    frame.style()->unpolish(&frame);
    frame.style()->polish(&frame);
}

/// A drag over a name goes by a step every so many pixels.
constexpr double step_px = 6.0;

QHBoxLayout* field_row(QFrame& frame, QLabel* text, const QString& tip) {
    frame.setProperty("field", true);
    frame.setToolTip(tip);
    set_line_height(frame, 28);
    frame.setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    auto* row = new QHBoxLayout(&frame);
    row->setContentsMargins(8, 0, 8, 0);
    row->setSpacing(6);
    text->setForegroundRole(QPalette::PlaceholderText);
    row->addWidget(text);
    return row;
}

}  // namespace

NumberField::NumberField(const QString& label, const QString& unit, const QString& tip,
                         QWidget* parent)
    : QFrame(parent), editor_(new QLineEdit), unit_(unit) {
    auto* name = new QLabel(label);
    name->setCursor(Qt::SizeHorCursor);
    QHBoxLayout* row = field_row(
        *this, name, tip.isEmpty() ? tip : tip + tr("\nDrag its name sideways to change it."));
    auto* scrub = new Scrub(*name, Qt::LeftButton);
    connect(scrub, &Scrub::begun, this, [this] { scrubbed_ = 0; });
    connect(scrub, &Scrub::moved, this, [this](double px) {
        const int steps = static_cast<int>(px / step_px) - scrubbed_;
        if (steps != 0) {
            scrubbed_ += steps;
            Q_EMIT stepped(steps);
        }
    });
    editor_->setFrame(false);
    editor_->setAlignment(Qt::AlignLeft);
    editor_->setTextMargins(0, 0, 0, 0);
    row->addWidget(editor_);
    editor_->setAccessibleName(label);
    editor_->installEventFilter(this);
    connect(editor_, &QLineEdit::textEdited, this, [this] {
        set_refused(false);
        fit_width();
    });
    connect(editor_, &QLineEdit::returnPressed, this, [this] {
        Q_EMIT entered(editor_->text());
        editor_->selectAll();
    });
    set_text("–");
    follow_text_scale(*this, [this] { fit_width(); });
}

void NumberField::set_text(const QString& text) {
    shown_ = text;
    if (!(editor_->hasFocus() && editor_->isModified())) {
        editor_->setText(editor_->hasFocus() ? text : text + unit_);
        set_refused(false);
        fit_width();
    }
}

void NumberField::set_refused(bool refused) { set_mark(*this, "refused", refused); }

void NumberField::fit_width() {
    editor_->setFixedWidth(
        std::max(min_editor_width, fontMetrics().horizontalAdvance(editor_->text()) + 10));
}

bool NumberField::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::FocusIn) {
        set_mark(*this, "focused", true);
        editor_->setText(shown_);
        editor_->selectAll();
    } else if (event->type() == QEvent::FocusOut) {
        set_mark(*this, "focused", false);
        if (editor_->isModified() && editor_->text() != shown_) {
            editor_->setModified(false);
            Q_EMIT entered(editor_->text());
        }
        editor_->setModified(false);
        if (!property("refused").toBool()) {
            editor_->setText(shown_ + unit_);
            fit_width();
        }
    } else if (event->type() == QEvent::ShortcutOverride &&
               static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        event->accept();  // gives up this entry, before it means anything to the window
        return true;
    } else if (event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        if (key == Qt::Key_Up || key == Qt::Key_Down) {
            Q_EMIT stepped(key == Qt::Key_Up ? 1 : -1);
            return true;
        }
        if (key == Qt::Key_Escape) {
            editor_->setModified(false);
            set_text(shown_);
            return true;
        }
        if (key == Qt::Key_Return || key == Qt::Key_Enter) {
            editor_->setModified(false);
        }
    }
    return QFrame::eventFilter(watched, event);
}

void NumberField::wheelEvent(QWheelEvent* event) {
    const int steps = event->angleDelta().y() / 120;
    if (steps != 0) {
        Q_EMIT stepped(steps);
    }
    event->accept();
}

ChoiceField::ChoiceField(const QString& label, const QString& tip, bool editable, QWidget* parent)
    : QFrame(parent), box_(new QComboBox) {
    QHBoxLayout* row = field_row(*this, new QLabel(label), tip);
    box_->setFrame(false);
    box_->setEditable(editable);
    box_->setInsertPolicy(QComboBox::NoInsert);
    box_->setAccessibleName(label);
    row->addWidget(box_);
    auto* arrow = new QLabel("▾");
    arrow->setForegroundRole(QPalette::PlaceholderText);
    arrow->setAttribute(Qt::WA_TransparentForMouseEvents);
    row->addWidget(arrow);
    if (editable) {
        connect(box_->lineEdit(), &QLineEdit::returnPressed, this,
                [this] { Q_EMIT entered(box_->currentText()); });
        connect(box_->lineEdit(), &QLineEdit::textEdited, this, [this] { set_refused(false); });
    }
    connect(box_, &QComboBox::textActivated, this,
            [this](const QString& text) { Q_EMIT entered(text); });
}

void ChoiceField::set_choices(const QStringList& choices) {
    QStringList now;
    for (int k = 0; k < box_->count(); ++k) {
        now << box_->itemText(k);
    }
    if (now != choices) {
        const QSignalBlocker quiet(box_);
        box_->clear();
        box_->addItems(choices);
    }
}

void ChoiceField::set_text(const QString& text) {
    const QSignalBlocker quiet(box_);
    if (box_->isEditable()) {
        box_->setEditText(text);
        box_->lineEdit()->setCursorPosition(0);
    } else {
        box_->setCurrentText(text);
    }
    set_refused(false);
    fit_width();
}

void ChoiceField::set_refused(bool refused) { set_mark(*this, "refused", refused); }

void ChoiceField::fit_width() {
    int widest = 0;
    for (int k = 0; k < box_->count(); ++k) {
        widest = std::max(widest, fontMetrics().horizontalAdvance(box_->itemText(k)));
    }
    constexpr int most_width = 160;
    box_->setFixedWidth(
        std::min(fontMetrics().horizontalAdvance(box_->currentText()) + 12, most_width));
    box_->view()->setMinimumWidth(widest + 32);
}

}  // namespace ghostlight
