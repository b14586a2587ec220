#include "widgets/panels/empty_state.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace ghostlight {

EmptyState::EmptyState(const QString& what, const QString& action_text, QWidget* parent)
    : QWidget(parent), what_(new QLabel(what)) {
    setBackgroundRole(QPalette::Base);  // as the panel that it stands for
    setAutoFillBackground(true);
    what_->setWordWrap(true);
    what_->setAlignment(Qt::AlignCenter);
    what_->setForegroundRole(QPalette::PlaceholderText);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(24, 24, 24, 24);
    column->setSpacing(12);
    column->addStretch();
    column->addWidget(what_);
    if (!action_text.isEmpty()) {
        auto* button = new QPushButton(action_text);
        column->addWidget(button, 0, Qt::AlignHCenter);
        connect(button, &QPushButton::clicked, this, &EmptyState::action_triggered);
    }
    column->addStretch();
}

void EmptyState::set_what(const QString& what) { what_->setText(what); }

}  // namespace ghostlight
