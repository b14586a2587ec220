#include "widgets/panels/banner.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

#include <algorithm>
#include <utility>

#include "widgets/palette.h"

namespace ghostlight {

Banner::Banner(QWidget* window) : QFrame(window), label_(new QLabel), action_(new QPushButton) {
    setObjectName("banner");
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(12, 8, 8, 8);
    row->setSpacing(12);
    label_->setWordWrap(true);
    label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    row->addWidget(label_, 1);
    row->addWidget(action_);
    auto* close = new QToolButton;
    close->setText("×");
    close->setAutoRaise(true);
    close->setToolTip("Put this message away");
    row->addWidget(close, 0, Qt::AlignTop);
    connect(close, &QToolButton::clicked, this, [this] {
        Q_EMIT offer_declined(topic_);
        clear(topic_);
    });
    connect(action_, &QPushButton::clicked, this, [this] {
        const QString topic = topic_;
        clear(topic);
        Q_EMIT offer_taken(topic);
    });
    hide();
}

void Banner::show_text(const QString& topic, const QString& text) { show_offer(topic, text, {}); }

void Banner::show_offer(const QString& topic, const QString& text, const QString& action_text) {
    topic_ = topic;
    QPalette colors = label_->palette();
    colors.setColor(QPalette::WindowText,
                    action_text.isEmpty() ? current_palette().red_orange : current_palette().text);
    label_->setPalette(colors);
    label_->setText(text);
    action_->setText(action_text);
    action_->setVisible(!action_text.isEmpty());
    show();
    raise();
    fit();
}

void Banner::clear(const QString& topic) {
    if (topic == topic_) {
        label_->clear();
        hide();
    }
}

QString Banner::text() const { return isHidden() ? QString() : label_->text(); }

void Banner::set_place(const QRect& place) {
    place_ = place;
    fit();
}

void Banner::fit() {
    constexpr int most_width = 720;
    const int width = std::min(place_.width(), most_width);
    const int height =
        layout()->hasHeightForWidth() ? layout()->totalHeightForWidth(width) : sizeHint().height();
    setGeometry(place_.left() + (place_.width() - width) / 2, place_.top(), width, height);
}

}  // namespace ghostlight
