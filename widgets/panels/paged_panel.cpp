#include "widgets/panels/paged_panel.h"

#include <QAction>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "widgets/actions.h"
#include "widgets/panel_header.h"
#include "widgets/panels/empty_state.h"

namespace ghostlight {

PagedPanel::PagedPanel(const QString& title, const QString& what_is_here, const Actions& actions,
                       QWidget* parent)
    : QWidget(parent), header_(new PanelHeader(title)), pages_(new QStackedWidget) {
    auto* empty = new EmptyState(what_is_here, tr("Open a lens…"));
    connect(empty, &EmptyState::action_triggered, &actions["file.open"], &QAction::trigger);
    pages_->addWidget(empty);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(header_);
    column->addWidget(pages_, 1);
}

void PagedPanel::set_content(QWidget* content) { pages_->addWidget(content); }

void PagedPanel::show_content(bool is_there) { pages_->setCurrentIndex(is_there ? 1 : 0); }

QString PagedPanel::state() const { return header_->state(); }

}  // namespace ghostlight
