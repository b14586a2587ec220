#include "widgets/panels/veiling_strip.h"

#include <QHBoxLayout>
#include <QPushButton>

#include <atomic>
#include <exception>
#include <utility>

#include "core/error.h"
#include "widgets/document.h"
#include "widgets/number_text.h"
#include "widgets/tabular_text.h"

namespace ghostlight {

VeilingStrip::VeilingStrip(Document& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      label_(new TabularLabel),
      button_(new QPushButton),
      job_(std::make_unique<NewestJob<Request>>(
          [this](const Request& request, std::stop_token stop) { work_on(request, stop); })) {
    setObjectName("veiling_strip");
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(12, 6, 8, 8);
    row->addWidget(label_, 1);
    row->addWidget(button_);
    button_->setObjectName("veiling_button");
    label_->setToolTip(
        tr("ISO 9358: light in the image of a small black spot over that of the bright surround, "
           "from all ghosts of two reflections at 587.56 nm, averaged over the sensor and at its "
           "middle. Barrel, dust and scatter make a real lens's higher."));
    connect(button_, &QPushButton::clicked, this, &VeilingStrip::toggle);
    connect(&document_, &Document::changed, this, &VeilingStrip::withdraw);
    show_state();
}

VeilingStrip::~VeilingStrip() { job_->cancel(); }

QString VeilingStrip::text() const { return label_->text(); }

void VeilingStrip::toggle() {
    if (busy_) {
        job_->cancel();
        ++serial_;
        busy_ = false;
    } else {
        try {
            asked_ = document_.configured_lens();
            reason_.clear();
            index_.reset();
            busy_ = true;
            percent_ = 0;
            job_->submit({asked_, ++serial_});
        } catch (const Error& error) {
            reason_ = QString::fromUtf8(error.what());
        }
    }
    show_state();
}

void VeilingStrip::withdraw() {
    try {
        if (!document_.is_empty() && document_.configured_lens() == asked_) {
            return;  // only the light moves
        }
    } catch (const Error&) {
        // The configuration is not one of the lens's: nothing is known of it.
    }
    job_->cancel();
    ++serial_;
    busy_ = false;
    index_.reset();
    reason_.clear();
    show_state();
}

void VeilingStrip::work_on(const Request& request, const std::stop_token& stop) {
    const auto say = [this, serial = request.serial](auto&& what) {
        QMetaObject::invokeMethod(
            this,
            [this, serial, what] {
                if (serial == serial_) {
                    what();
                    show_state();
                }
            },
            Qt::QueuedConnection);
    };
    try {
        std::atomic<int> said{-1};
        const auto index = veiling_index(request.lens, {}, stop, [&](double share) {
            const int percent = static_cast<int>(100.0 * share);
            if (said.exchange(percent) != percent) {
                say([this, percent] { percent_ = percent; });
            }
        });
        if (index) {
            say([this, index] {
                busy_ = false;
                index_ = index;
            });
        }
    } catch (const std::exception& error) {
        say([this, reason = QString::fromUtf8(error.what())] {
            busy_ = false;
            reason_ = reason;
        });
    }
}

void VeilingStrip::show_state() {
    setVisible(!document_.is_empty());
    button_->setText(busy_ ? tr("Cancel") : tr("Work out"));
    QString text = tr("Veiling glare index  ");
    if (busy_) {
        text += tr("%1 %").arg(percent_);
    } else if (index_) {
        text += tr("*%1 %* of the sensor, *%2 %* at its middle")
                    .arg(significant(100.0 * index_->index(), 3),
                         significant(100.0 * index_->center_index(), 3));
    } else {
        text += reason_.isEmpty() ? QStringLiteral("–") : reason_;
    }
    label_->set_text(text);
    label_->set_warning(!reason_.isEmpty());
}

}  // namespace ghostlight
