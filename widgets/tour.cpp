#include "widgets/tour.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

#include "widgets/palette.h"

namespace ghostlight {

namespace {

constexpr int card_width_px = 340;
constexpr int gap_px = 12;
constexpr double frame_px = 2.0;

/// A frame that lets everything through.
class Outline : public QWidget {
   public:
    explicit Outline(QWidget* parent) : QWidget(parent) {
        setAttribute(Qt::WA_TransparentForMouseEvents);
        hide();
    }

   protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(QPen(current_palette().teal, frame_px));
        painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 4, 4);
    }
};

}  // namespace

Tour::Tour(std::vector<TourStep> steps, QWidget* window)
    : QFrame(window),
      steps_(std::move(steps)),
      outline_(new Outline(window)),
      title_(new QLabel),
      text_(new QLabel),
      count_(new QLabel),
      back_(new QPushButton(tr("Back"))),
      next_(new QPushButton) {
    setObjectName("tour");
    setFocusPolicy(Qt::StrongFocus);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(16, 12, 16, 12);
    column->setSpacing(8);
    QFont bold = font();
    bold.setWeight(QFont::DemiBold);
    title_->setFont(bold);
    text_->setWordWrap(true);
    count_->setForegroundRole(QPalette::PlaceholderText);
    auto* row = new QHBoxLayout;
    row->addWidget(count_);
    row->addStretch();
    auto* skip = new QPushButton(tr("Skip"));
    row->addWidget(skip);
    row->addWidget(back_);
    row->addWidget(next_);
    column->addWidget(title_);
    column->addWidget(text_);
    column->addLayout(row);
    connect(skip, &QPushButton::clicked, this, &Tour::end);
    connect(back_, &QPushButton::clicked, this, [this] { go_to(step_ - 1); });
    connect(next_, &QPushButton::clicked, this, [this] { go_to(step_ + 1); });
    window->installEventFilter(this);
    hide();
}

Tour::~Tour() = default;

void Tour::begin() { go_to(0); }

void Tour::end() {
    hide();
    outline_->hide();
    Q_EMIT ended();
}

void Tour::go_to(int step) {
    if (step < 0) {
        return;
    }
    if (step >= static_cast<int>(steps_.size())) {
        end();
        return;
    }
    step_ = step;
    const TourStep& now = steps_[static_cast<std::size_t>(step)];
    Q_EMIT step_begins(now.target);
    title_->setText(now.title);
    text_->setText(now.text);
    count_->setText(tr("%1 of %2").arg(step + 1).arg(steps_.size()));
    back_->setEnabled(step > 0);
    next_->setText(step + 1 == static_cast<int>(steps_.size()) ? tr("Done") : tr("Next"));
    next_->setDefault(true);
    show();
    place();
    next_->setFocus();
    QTimer::singleShot(0, this, &Tour::place);  // once a panel that was brought up has its place
}

void Tour::place() {
    const QWidget* target = steps_[static_cast<std::size_t>(step_)].target;
    if (isHidden() || target == nullptr) {
        return;
    }
    QWidget& window = *parentWidget();
    const int height_px = std::max(layout()->totalHeightForWidth(card_width_px), 0);
    QRect card(0, 0, card_width_px, height_px);
    if (!target->isVisible() || target->window() != &window) {
        outline_->hide();  // it floats elsewhere, or was closed
        card.moveCenter(window.rect().center());
        setGeometry(card);
        raise();
        return;
    }
    const QRect at(target->mapTo(&window, QPoint(0, 0)), target->size());
    outline_->setGeometry(at);
    outline_->show();
    outline_->raise();
    // Beside the target where there is room, else inside it.
    if (at.right() + gap_px + card.width() < window.width()) {
        card.moveTopLeft({at.right() + gap_px, at.top() + gap_px});
    } else if (at.left() - gap_px - card.width() >= 0) {
        card.moveTopLeft({at.left() - gap_px - card.width(), at.top() + gap_px});
    } else {
        card.moveBottomRight(at.bottomRight() - QPoint(gap_px, gap_px));
    }
    card.moveLeft(std::clamp(card.left(), 0, std::max(0, window.width() - card.width())));
    card.moveTop(std::clamp(card.top(), 0, std::max(0, window.height() - card.height())));
    setGeometry(card);
    raise();
}

bool Tour::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize || event->type() == QEvent::LayoutRequest) {
        place();
    }
    return QFrame::eventFilter(watched, event);
}

void Tour::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
        case Qt::Key_Escape:
            end();
            break;
        case Qt::Key_Right:
            go_to(step_ + 1);
            break;
        case Qt::Key_Left:
            go_to(step_ - 1);
            break;
        default:
            QFrame::keyPressEvent(event);
    }
}

}  // namespace ghostlight
