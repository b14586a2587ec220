#include "widgets/panels/stop_panel.h"

#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/error.h"
#include "widgets/actions.h"
#include "widgets/document.h"
#include "widgets/models/cell_text.h"
#include "widgets/number_text.h"
#include "widgets/panel_header.h"
#include "widgets/panels/empty_state.h"
#include "widgets/panels/scrub.h"
#include "widgets/panels/stop_pictures.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

QString what_is_here() {
    return StopPanel::tr(
        "The stop's blades, an image over its opening, dust and scratches, and the starburst they "
        "make.");
}
constexpr int least_blades = 3;

QLabel* picture_label(const QString& tip) {
    auto* label = new QLabel;
    label->setFixedSize(stop_picture_px, stop_picture_px);
    label->setAlignment(Qt::AlignCenter);
    label->setToolTip(tip);
    label->setStyleSheet("background: black;");
    return label;
}

QLabel* dim_label(const QString& text) {
    auto* label = new QLabel(text);
    label->setForegroundRole(QPalette::PlaceholderText);
    return label;
}

void set_refused(QLineEdit& editor, bool refused) {
    editor.setProperty("refused", refused);
    editor.setStyleSheet(refused ? "QLineEdit { border: 1px solid #ff7a59; }" : "");
}

}  // namespace

StopPanel::StopPanel(Document& document, const Actions& actions, QWidget* parent)
    : QWidget(parent),
      document_(document),
      header_(new PanelHeader(tr("Stop"))),
      empty_(new EmptyState(what_is_here(), tr("Open a lens…"))),
      pages_(new QStackedWidget),
      opening_label_(picture_label(tr("The opening, its right +x and its top +y"))),
      starburst_label_(picture_label(tr("Light on the axis as the opening diffracts it, in the "
                                        "middle sixth of the sensor's width"))),
      reason_label_(new QLabel),
      statistics_label_(dim_label({})) {
    auto* content = new QWidget;
    auto* column = new QVBoxLayout(content);
    column->setContentsMargins(12, 10, 12, 10);
    column->setSpacing(10);
    auto* pictures = new QHBoxLayout;
    pictures->setSpacing(8);
    pictures->addWidget(opening_label_);
    pictures->addWidget(starburst_label_);
    pictures->addStretch(1);
    column->addLayout(pictures);
    reason_label_->setWordWrap(true);
    reason_label_->setObjectName("stop_reason");
    reason_label_->hide();
    column->addWidget(reason_label_);
    statistics_label_->setObjectName("stop_statistics");
    statistics_label_->setWordWrap(true);
    column->addWidget(statistics_label_);
    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(8);
    grid->setVerticalSpacing(4);
    add_rows(*grid);
    column->addLayout(grid);
    column->addStretch(1);
    auto* scroll = new QScrollArea;
    scroll->setWidget(content);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    pages_->addWidget(empty_);
    pages_->addWidget(scroll);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->setSpacing(0);
    outer->addWidget(header_);
    outer->addWidget(pages_, 1);

    job_ = std::make_unique<NewestJob<Request>>(
        [this](const Request& request, const std::stop_token& stop) { work_on(request, stop); });
    delay_.setSingleShot(true);
    delay_.setInterval(0);
    connect(&delay_, &QTimer::timeout, this, &StopPanel::request);
    connect(empty_, &EmptyState::action_triggered, &actions["file.open"], &QAction::trigger);
    connect(&document_, &Document::changed, this, &StopPanel::follow_document);
    follow_document();
}

StopPanel::~StopPanel() = default;

QLineEdit& StopPanel::editor(const QString& name) const {
    return *std::ranges::find(rows_, name, &Row::name)->editor;
}

QToolButton& StopPanel::reset_button(const QString& name) const {
    return *std::ranges::find(rows_, name, &Row::name)->reset;
}

void StopPanel::add_row(QGridLayout& grid, const QString& name, const QString& label,
                        const QString& unit, const QString& tip, Stride stride,
                        std::function<QString(const Stop&)> text,
                        std::function<void(Stop&, const QString&)> read,
                        std::function<void(Stop&)> clear) {
    Row row{name,
            nullptr,
            nullptr,
            stride,
            [text = std::move(text)](const Prescription& lens) { return text(lens.stop); },
            [read = std::move(read)](Prescription& lens, const QString& typed) {
                read(lens.stop, typed);
            },
            [clear = std::move(clear)](Prescription& lens) { clear(lens.stop); }};
    add_lens_row(grid, label, unit, tip, std::move(row));
}

void StopPanel::add_lens_row(QGridLayout& grid, const QString& label, const QString& unit,
                             const QString& tip, Row row) {
    const int at = grid.rowCount();
    const bool can_step = row.stride.by > 0.0;
    const QString whole_tip =
        can_step ? tip + tr("\nDrag its name sideways to change it; arrow keys go by steps.") : tip;
    auto* editor = new QLineEdit;
    editor->setObjectName("stop_" + row.name);
    editor->setAccessibleName(label);
    editor->setToolTip(whole_tip);
    set_line_width(*editor, 96);
    editor->installEventFilter(this);
    auto* title = new QLabel(label);
    title->setToolTip(whole_tip);
    auto* reset = new QToolButton;
    reset->setText("↺");
    reset->setAutoRaise(true);
    reset->setToolTip(tr("Back to what it usually is"));
    reset->setAccessibleName(tr("Reset %1").arg(label));
    grid.addWidget(title, at, 0);
    grid.addWidget(editor, at, 1);
    auto* range = dim_label(unit);
    range->setWordWrap(true);  // in a narrow panel two lines rather than a scroll bar
    grid.addWidget(range, at, 2);
    grid.addWidget(reset, at, 3);
    grid.setColumnStretch(2, 1);
    row.editor = editor;
    row.reset = reset;
    rows_.push_back(std::move(row));
    const std::size_t index = rows_.size() - 1;
    const auto finish = [this, index] {
        const Row& each = rows_[index];
        if (each.editor->isModified()) {
            each.editor->setModified(false);
            enter(each, each.editor->text());
        }
    };
    connect(editor, &QLineEdit::editingFinished, this, finish);
    connect(reset, &QToolButton::clicked, this, [this, index, label] {
        change(tr("reset the stop's %1").arg(label.toLower()), {}, rows_[index].clear);
    });
    if (can_step) {
        title->setCursor(Qt::SizeHorCursor);
        auto* scrub = new Scrub(*title, Qt::LeftButton);
        const auto done = std::make_shared<int>(0);
        connect(scrub, &Scrub::begun, this, [done] { *done = 0; });
        connect(scrub, &Scrub::moved, this, [this, index, done](double px) {
            constexpr double step_px = 6.0;
            const int steps = static_cast<int>(px / step_px) - *done;
            if (steps != 0) {
                *done += steps;
                step(rows_[index], steps);
            }
        });
    }
}

void StopPanel::step(const Row& row, int steps) {
    const auto now = parse_number(row.text(document_.lens()));
    if (document_.is_empty() || !now) {
        return;
    }
    double next = *now + steps * row.stride.by;
    if (row.stride.ratio != 1.0 && *now > 0.0) {
        next = *now * std::pow(row.stride.ratio, steps);
        next = parse_number(significant(next, 3)).value_or(next);  // as people write numbers
    }
    if (row.name == "blades" && next > 0.0 && next < least_blades) {
        next = steps > 0 ? least_blades : 0.0;
    }
    try {
        take(row, shortest(std::round(next * 1e4) / 1e4));
    } catch (const Error&) {
        // At the end of its range it stays where it is.
    }
}

bool StopPanel::eventFilter(QObject* watched, QEvent* event) {
    const auto row = std::ranges::find(rows_, watched, &Row::editor);
    if (row == rows_.end() || !(row->stride.by > 0.0)) {
        return QWidget::eventFilter(watched, event);
    }
    if (event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        if (key == Qt::Key_Up || key == Qt::Key_Down) {
            row->editor->setModified(false);
            step(*row, key == Qt::Key_Up ? 1 : -1);
            return true;
        }
    } else if (event->type() == QEvent::Wheel && row->editor->hasFocus()) {
        const int turned = static_cast<QWheelEvent*>(event)->angleDelta().y();
        if (turned != 0) {
            row->editor->setModified(false);
            step(*row, turned > 0 ? 1 : -1);
            return true;
        }
    }
    return QWidget::eventFilter(watched, event);
}

void StopPanel::enter(const Row& row, const QString& text) {
    try {
        take(row, text);
    } catch (const Error& error) {
        set_refused(*row.editor, true);
        show_reason(QString::fromUtf8(error.what()));
    }
}

void StopPanel::take(const Row& row, const QString& text) {
    Prescription lens = document_.lens();
    row.read(lens, text);
    validate(lens);
    show_reason({});
    set_refused(*row.editor, false);
    document_.edit_lens(std::move(lens),
                        tr("change the stop's %1").arg(row.editor->accessibleName().toLower()),
                        "stop." + row.name);
    follow_document();  // also where nothing changed: the text as it is written here
}

void StopPanel::change(const QString& what, const QString& field,
                       const std::function<void(Prescription&)>& edit) {
    Prescription lens = document_.lens();
    edit(lens);
    show_reason({});
    document_.edit_lens(std::move(lens), what, field);
    follow_document();
}

void StopPanel::follow_document() {
    pages_->setCurrentIndex(document_.is_empty() ? 0 : 1);
    if (document_.is_empty()) {
        header_->set_state(QString());
        return;
    }
    const Prescription& lens = document_.lens();
    for (const Row& row : rows_) {
        if (row.editor->hasFocus() && row.editor->isModified()) {
            continue;
        }
        row.editor->setText(row.text(lens));
        set_refused(*row.editor, false);
        Prescription cleared = lens;
        row.clear(cleared);
        row.reset->setEnabled(cleared != lens);
    }
    delay_.start();
}

void StopPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    delay_.start();
}

void StopPanel::request() {
    // Behind a tab nobody sees the starburst, which takes longer than most edits.
    const bool is_hidden = !isVisible() && window()->isVisible();
    if (document_.is_empty() || is_hidden) {
        return;
    }
    try {
        Prescription lens = document_.configured_lens();
        const Spectrum spectrum = document_.scene().light().spectrum;
        if (lens == asked_ && spectrum == asked_spectrum_) {
            return;  // the light moves, and nothing here changes
        }
        asked_ = lens;
        asked_spectrum_ = spectrum;
        header_->set_dimmed(true);
        job_->submit({std::move(lens), spectrum, ++serial_});
    } catch (const Error& error) {  // the configuration is not one of the lens's
        asked_ = {};
        ++serial_;
        show_pictures({{}, {}, {}, {}, QString::fromUtf8(error.what())}, serial_);
    }
}

void StopPanel::work_on(const Request& request, const std::stop_token& stop) {
    const auto made = stop_pictures(request.lens, request.spectrum, stop);
    if (!made) {
        return;  // a newer one is on its way
    }
    QMetaObject::invokeMethod(
        this, [this, made = *made, serial = request.serial] { show_pictures(made, serial); },
        Qt::QueuedConnection);
}

void StopPanel::show_pictures(const StopPictures& shown, std::uint64_t serial) {
    if (serial != serial_) {
        return;
    }
    shown_serial_ = serial;
    opening_ = shown.opening;
    starburst_ = shown.starburst;
    opening_label_->setPixmap(QPixmap::fromImage(opening_));
    starburst_label_->setPixmap(QPixmap::fromImage(starburst_));
    statistics_label_->setText(shown.statistics);
    header_->set_state(shown.state);
    header_->set_dimmed(false);
    show_reason(shown.reason);
}

QString StopPanel::statistics() const { return statistics_label_->text(); }

void StopPanel::show_reason(const QString& reason) {
    reason_ = reason;
    reason_label_->setText(reason);
    reason_label_->setVisible(!reason.isEmpty());
}

}  // namespace ghostlight
