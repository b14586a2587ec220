#include "widgets/panels/quiet_button.h"

#include <QToolButton>

#include "widgets/text_scale.h"
namespace ghostlight {

QToolButton* quiet_button(const QString& text, const QString& tip, bool checkable) {
    auto* button = new QToolButton;
    button->setProperty("quiet", true);
    button->setText(text);
    button->setToolTip(tip);
    button->setAccessibleName(text);
    button->setCheckable(checkable);
    button->setFocusPolicy(Qt::TabFocus);
    set_line_height(*button, 28);
    return button;
}

}  // namespace ghostlight
