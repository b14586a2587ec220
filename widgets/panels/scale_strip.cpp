#include "widgets/panels/scale_strip.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include <cmath>

#include "core/error.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "widgets/document.h"
#include "widgets/models/cell_text.h"
#include "widgets/number_text.h"
#include "widgets/text_scale.h"

namespace ghostlight {

ScaleStrip::ScaleStrip(Document& document, QWidget* parent)
    : QWidget(parent), document_(document), factor_(new QLineEdit), efl_(new QLineEdit) {
    setObjectName("scale_strip");
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(12, 4, 12, 4);
    row->setSpacing(8);
    auto* scale = new QPushButton(tr("Scale"));
    auto* cancel = new QPushButton(tr("Cancel"));
    factor_->setAccessibleName(tr("Scale by"));
    factor_->setToolTip(tr("Every length times this factor; arithmetic is taken: =50/43.2"));
    efl_->setAccessibleName(tr("Scale to a focal length in mm"));
    efl_->setToolTip(tr("The focal length that the lens is to have, in mm"));
    for (QLineEdit* editor : {factor_, efl_}) {
        set_line_width(*editor, 84);
        editor->setAlignment(Qt::AlignRight);
        connect(editor, &QLineEdit::returnPressed, this, &ScaleStrip::take);
    }
    row->addWidget(new QLabel(tr("Scale by")));
    row->addWidget(factor_);
    row->addWidget(new QLabel(tr("to EFL")));
    row->addWidget(efl_);
    row->addWidget(new QLabel("mm"));
    row->addStretch(1);
    row->addWidget(scale);
    row->addWidget(cancel);
    hide();
    const auto reads = [](const QString& text, CellUnit unit) {
        try {
            return read_positive(text, tr("a factor"), unit);
        } catch (const Error&) {
            return 0.0;  // said when it is taken
        }
    };
    connect(factor_, &QLineEdit::textEdited, this, [this, reads](const QString& text) {
        wanted_ = reads(text, CellUnit::none);
        efl_->setText(wanted_ > 0.0 && efl_mm_ != 0.0 ? significant(efl_mm_ * wanted_, 6)
                                                      : QString());
    });
    connect(efl_, &QLineEdit::textEdited, this, [this, reads](const QString& text) {
        wanted_ = efl_mm_ != 0.0 ? reads(text, CellUnit::mm) / std::abs(efl_mm_) : 0.0;
        factor_->setText(wanted_ > 0.0 ? significant(wanted_, 6) : QString());
    });
    connect(scale, &QPushButton::clicked, this, &ScaleStrip::take);
    connect(cancel, &QPushButton::clicked, this, &QWidget::hide);
}

void ScaleStrip::ask() {
    efl_mm_ = 0.0;
    try {
        efl_mm_ = first_order(compile(document_.configured_lens(), d_line_nm)).efl_mm;
    } catch (const Error&) {
        // It can be scaled all the same.
    }
    efl_mm_ = std::isfinite(efl_mm_) ? efl_mm_ : 0.0;
    efl_->setEnabled(efl_mm_ != 0.0);
    wanted_ = 1.0;
    factor_->setText("1");
    efl_->setText(efl_mm_ != 0.0 ? significant(efl_mm_, 6) : QString());
    show();
    factor_->setFocus();
    factor_->selectAll();
}

void ScaleStrip::take() {
    try {
        if (wanted_ <= 0.0) {
            wanted_ = read_positive(factor_->text(), tr("a factor above 0"));
        }
        hide();
        Q_EMIT chosen(wanted_);
    } catch (const Error& error) {
        Q_EMIT refused(error.what());
    }
}

bool ScaleStrip::event(QEvent* event) {
    const bool is_key =
        event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride;
    if (is_key && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        event->accept();  // gives up this question, before it means anything to the window
        if (event->type() == QEvent::KeyPress) {
            hide();
        }
        return true;
    }
    return QWidget::event(event);
}

}  // namespace ghostlight
