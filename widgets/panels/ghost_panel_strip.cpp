// What is above the ghosts: table, matrix or surfaces, the filter's words, and which columns there
// are.

#include <QBoxLayout>
#include <QFrame>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QStyle>
#include <QTableView>
#include <QToolButton>

#include "core/error.h"
#include "widgets/actions.h"
#include "widgets/models/ghost_filter.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/quiet_button.h"
#include "widgets/settings.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

constexpr const char* look_of_button = "look";

/// Hidden until somebody chooses: what is left is what most questions are about.
QStringList usually_hidden() {
    return {"incidence_1_deg", "incidence_2_deg", "x_extent_mm", "y_extent_mm"};
}

}  // namespace

void GhostPanel::build_strip() {
    strip_ = new QFrame;
    strip_->setObjectName("layers_strip");  // looks like the flare's
    strip_->setMinimumWidth(1);
    strip_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    auto* parts = new QBoxLayout(QBoxLayout::LeftToRight, strip_);
    parts->setContentsMargins(6, 6, 6, 6);
    parts->setSpacing(6);
    auto* row = new QHBoxLayout;
    row->setSpacing(2);
    const struct {
        const char* id;
        QString text;
        Look look;
    } looks[] = {{"ghosts.as_table", tr("Table"), Look::table},
                 {"ghosts.as_matrix", tr("Matrix"), Look::matrix},
                 {"ghosts.as_surfaces", tr("Surfaces"), Look::surfaces}};
    for (const auto& each : looks) {
        QAction& action = actions_[each.id];
        QToolButton* button = quiet_button(each.text, action.statusTip(), true);
        button->setProperty(look_of_button, static_cast<int>(each.look));
        row->addWidget(button);
        connect(button, &QToolButton::clicked, this, [this, look = each.look] { set_look(look); });
        connect(&action, &QAction::triggered, this, [this, look = each.look] { set_look(look); });
        connect(&action, &QAction::toggled, button, &QToolButton::setChecked);
    }
    words_ = new QLineEdit;
    words_->setObjectName("ghost_filter");
    words_->setFrame(false);
    words_->setPlaceholderText(tr("Filter, e.g. touches 7"));
    words_->setClearButtonEnabled(true);
    words_->setToolTip(tr(
        "Which ghosts are listed, in words:\n"
        "touches surface 7\nfocus within 5 mm of the sensor\nabove 1e-6   (flux, mm²)\n"
        "below 1 % of the strongest\non sensor above 50 %\nRMS below 2 mm\n5-3\n"
        "joined by 'and' or a comma, 'or', and 'not'. Also: relative, peak, x, y, R1, R2, angle 1, "
        "angle 2, width, height, area"));
    words_->setAccessibleName(tr("Filter of ghosts"));
    words_frame_ = new QFrame;
    words_frame_->setProperty("field", true);
    auto* inside = new QHBoxLayout(words_frame_);
    inside->setContentsMargins(8, 0, 4, 0);
    inside->addWidget(words_);
    row->addStretch(1);
    auto* filter_row = new QHBoxLayout;
    filter_row->setSpacing(2);
    filter_row->addWidget(words_frame_, 1);
    columns_ = quiet_button(tr("Columns"), tr("Choose the table's columns"), false);
    filter_row->addWidget(columns_);
    parts->addLayout(row);
    parts->addLayout(filter_row, 1);
    follow_text_scale(*strip_, [this] { fit_strip(); });
    connect(columns_, &QToolButton::clicked, this, &GhostPanel::choose_columns);
    problem_ = new QLabel;
    problem_->setObjectName("refusal");
    problem_->setWordWrap(true);
    problem_->hide();
    connect(words_, &QLineEdit::textChanged, this, &GhostPanel::read_filter);
}

void GhostPanel::fit_strip() {
    constexpr int least_words_px = 110;  // "touches 7"
    constexpr int one_line_px = 40, two_lines_px = 74;
    auto* parts = static_cast<QBoxLayout*>(strip_->layout());
    const int looks_px = parts->itemAt(0)->sizeHint().width();
    const int columns_px = columns_->sizeHint().width();
    const QMargins margins = parts->contentsMargins();
    const int whole_px = looks_px + parts->spacing() + with_text(least_words_px) + columns_px +
                         margins.left() + margins.right();
    const bool is_narrow = width() < whole_px;
    parts->setDirection(is_narrow ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
    strip_->setFixedHeight(with_text(is_narrow ? two_lines_px : one_line_px));
}

void GhostPanel::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    fit_strip();
}

void GhostPanel::set_look(Look look) {
    look_ = look;
    const std::pair<const char*, Look> looks[] = {{"ghosts.as_table", Look::table},
                                                  {"ghosts.as_matrix", Look::matrix},
                                                  {"ghosts.as_surfaces", Look::surfaces}};
    for (const auto& [id, each] : looks) {
        actions_[id].setChecked(false);  // so that the button follows, whatever was clicked
        actions_[id].setChecked(each == look);
    }
    for (QToolButton* button : strip_->findChildren<QToolButton*>()) {
        if (button->isCheckable()) {
            button->setChecked(button->property(look_of_button).toInt() == static_cast<int>(look));
        }
    }
    show_state();
}

QString GhostPanel::filter_problem() const {
    return problem_->isHidden() ? QString() : problem_->text();
}

void GhostPanel::read_filter() {
    const auto& table = model_->table();
    QString problem;
    selecting_ = true;  // what is no longer listed stays selected
    try {
        filter_->set_query(parse_ghost_query(words_->text().toStdString(),
                                             table ? table->surface_count : any_surface_count));
    } catch (const Error& error) {
        problem = tr("%1: expected %2")
                      .arg(QString::fromStdString(error.parts().found),
                           QString::fromStdString(error.parts().expected));
    }
    selecting_ = false;
    problem_->setText(problem);
    problem_->setVisible(!problem.isEmpty());
    words_frame_->setProperty("refused", !problem.isEmpty());
    words_frame_->style()->unpolish(words_frame_);
    words_frame_->style()->polish(words_frame_);
    select_in_table();
    show_state();
}

void GhostPanel::show_columns() {
    const QStringList hidden = settings::hidden_ghost_columns().value_or(usually_hidden());
    for (int column = GhostTableModel::flux; column < GhostTableModel::column_count; ++column) {
        const bool is_bar = column == GhostTableModel::magnitude;
        const QString id = is_bar ? QStringLiteral("bar") : column_id(column);
        table_->setColumnHidden(
            column, is_of_comparison(column) ? !model_->compares() : hidden.contains(id));
    }
}

void GhostPanel::choose_columns() {
    QMenu menu;
    for (int column = GhostTableModel::flux; column < GhostTableModel::column_count; ++column) {
        if (is_of_comparison(column)) {
            continue;
        }
        QAction* action = menu.addAction(column_title(column));
        action->setCheckable(true);
        action->setChecked(!table_->isColumnHidden(column));
        action->setData(column);
    }
    menu.addSeparator();
    QAction* usual = menu.addAction(tr("The Usual Ones"));
    QAction* taken = menu.exec(QCursor::pos());
    if (taken == nullptr) {
        return;
    }
    QStringList hidden;
    if (taken == usual) {
        hidden = usually_hidden();
    } else {
        for (const QAction* action : menu.actions()) {
            const int column = action->data().toInt();
            if (action->isCheckable() && !action->isChecked()) {
                hidden << (column == GhostTableModel::magnitude ? QStringLiteral("bar")
                                                                : column_id(column));
            }
        }
    }
    settings::set_hidden_ghost_columns(hidden);
    show_columns();
}

}  // namespace ghostlight
