#include "widgets/panels/banner.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

#include <algorithm>
#include <utility>

#include "widgets/palette.h"

namespace ghostlight {

Banner::Banner(QWidget* window)
    : QFrame(window),
      label_(new QLabel),
      action_(new QPushButton),
      decline_(new QPushButton),
      close_(new QToolButton) {
    setObjectName("banner");
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(12, 8, 8, 8);
    row->setSpacing(12);
    label_->setWordWrap(true);
    label_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    row->addWidget(label_, 1);
    row->addWidget(action_);
    row->addWidget(decline_);
    close_->setText("×");
    close_->setAutoRaise(true);
    close_->setToolTip(tr("Put this message away"));
    close_->setAccessibleName(close_->toolTip());
    row->addWidget(close_, 0, Qt::AlignTop);
    connect(close_, &QToolButton::clicked, this, &Banner::decline);
    connect(decline_, &QPushButton::clicked, this, &Banner::decline);
    connect(action_, &QPushButton::clicked, this, [this] {
        const QString topic = messages_.back().topic;
        clear(topic);
        Q_EMIT offer_taken(topic);
    });
    hide();
}

void Banner::show_text(const QString& topic, const QString& text) { show_offer(topic, text, {}); }

void Banner::show_offer(const QString& topic, const QString& text, const QString& action_text,
                        const QString& decline_text) {
    std::erase_if(messages_, [&](const Message& message) {
        return message.topic == topic || message.action_text.isEmpty();
    });
    messages_.push_back({topic, text, action_text, decline_text});
    show_newest();
}

void Banner::show_newest() {
    if (messages_.empty()) {
        label_->clear();
        hide();
        return;
    }
    const Message& newest = messages_.back();
    QPalette colors = label_->palette();
    colors.setColor(QPalette::WindowText, newest.action_text.isEmpty()
                                              ? current_palette().red_orange
                                              : current_palette().text);
    label_->setPalette(colors);
    label_->setText(newest.text);
    action_->setText(newest.action_text);
    action_->setVisible(!newest.action_text.isEmpty());
    decline_->setText(newest.decline_text);
    decline_->setVisible(!newest.decline_text.isEmpty());
    close_->setVisible(newest.decline_text.isEmpty());
    show();
    raise();
    fit();
}

void Banner::decline() {
    const QString topic = messages_.back().topic;
    Q_EMIT offer_declined(topic);
    clear(topic);
}

void Banner::clear(const QString& topic) {
    const auto gone =
        std::erase_if(messages_, [&](const Message& message) { return message.topic == topic; });
    if (gone > 0) {
        show_newest();
    }
}

QString Banner::text() const { return isHidden() ? QString() : label_->text(); }

void Banner::set_place(const QRect& place) {
    place_ = place;
    raise();  // panels that were arranged since lie over it
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
