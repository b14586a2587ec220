#include "widgets/text_scale.h"

#include <QApplication>
#include <QEvent>
#include <QWidget>

#include <algorithm>
#include <utility>

#include "widgets/theme.h"

namespace ghostlight {

namespace {

/// Goes with its widget.
class TextScaleFollower : public QObject {
   public:
    TextScaleFollower(QWidget& widget, std::function<void()> fit)
        : QObject(&widget), fit_(std::move(fit)) {
        widget.installEventFilter(this);
        fit_();
    }

   protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        if (event->type() == QEvent::ApplicationFontChange || event->type() == QEvent::FontChange) {
            fit_();
        }
        return QObject::eventFilter(watched, event);
    }

   private:
    std::function<void()> fit_;
};

}  // namespace

double text_scale() {
    const int px = QApplication::font().pixelSize();
    return px > 0 ? static_cast<double>(px) / usual_text_px : 1.0;
}

int with_text(int usual_px) { return std::max(usual_px, qRound(usual_px * text_scale())); }

QFont small_font() {
    constexpr double share = 0.85;
    QFont font = QApplication::font();
    font.setPixelSize(std::max(1, qRound(share * usual_text_px * text_scale())));
    return font;
}

void follow_text_scale(QWidget& widget, std::function<void()> fit) {
    new TextScaleFollower(widget, std::move(fit));
}

void set_line_height(QWidget& widget, int usual_px) {
    follow_text_scale(widget, [&widget, usual_px] { widget.setFixedHeight(with_text(usual_px)); });
}

void set_line_width(QWidget& widget, int usual_px) {
    follow_text_scale(widget, [&widget, usual_px] { widget.setFixedWidth(with_text(usual_px)); });
}

}  // namespace ghostlight
