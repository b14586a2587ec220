#include "widgets/panels/number_handle.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QSlider>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "widgets/models/cell_text.h"
#include "widgets/models/prescription_model.h"
#include "widgets/number_text.h"
#include "widgets/panels/scrub.h"
#include "widgets/text_scale.h"

namespace ghostlight {

namespace {

constexpr int slider_end = 1000;
/// As far as a drag over a name or a cell has to go for what the slider's end gives.
constexpr double reach_px = 300.0;

/// Without digits that nobody drew: to a thousandth of the reach, at a power of ten.
double rounded(double value, double reach) {
    const double places = std::ceil(3.0 - std::log10(reach));
    const double scale = std::pow(10.0, places);
    return std::isfinite(scale) ? std::round(value * scale) / scale : value;
}

CellUnit unit_of(const CellNumber& number) {
    return number.unit == "mm"    ? CellUnit::mm
           : number.unit == "nm"  ? CellUnit::nm
           : number.unit == "/mm" ? CellUnit::per_mm
                                  : CellUnit::none;
}

}  // namespace

NumberHandle::NumberHandle(PrescriptionModel& model, QWidget* parent)
    : QWidget(parent),
      model_(model),
      name_(new QLabel),
      choice_(new QComboBox),
      slider_(new QSlider(Qt::Horizontal)),
      editor_(new QLineEdit),
      unit_(new QLabel) {
    setObjectName("number_handle");
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(12, 4, 12, 4);
    row->setSpacing(8);
    name_->setCursor(Qt::SizeHorCursor);
    name_->setToolTip(tr("Drag sideways to change the number; with Shift finely"));
    slider_->setRange(-slider_end, slider_end);
    slider_->setToolTip(
        tr("Drag to change the number of the cell in hand: the flare follows. It springs back to\n"
           "the middle, and the drag is one step of the history. Arrow keys go by a hundredth."));
    slider_->setAccessibleName(tr("Number of the cell in hand"));
    slider_->setSingleStep(slider_end / 100);
    slider_->setPageStep(slider_end / 10);
    set_line_width(*editor_, 104);
    editor_->setAlignment(Qt::AlignRight);
    editor_->setAccessibleName(tr("Value of the cell in hand"));
    choice_->setAccessibleName(tr("Which number of the cell"));
    unit_->setForegroundRole(QPalette::PlaceholderText);
    unit_->setMinimumWidth(44);
    row->addWidget(name_);
    row->addWidget(choice_);
    row->addWidget(slider_, 1);
    row->addWidget(editor_);
    row->addWidget(unit_);

    connect(slider_, &QSlider::sliderPressed, this, [this] { begin(cell_); });
    connect(slider_, &QSlider::valueChanged, this, [this](int value) {
        const bool by_key = !slider_->isSliderDown();
        if (by_key) {
            const int drag = drag_;
            begin(cell_);
            drag_ = drag;  // key after key is one step
        }
        draw(static_cast<double>(value) / slider_end);
        if (by_key) {
            const QSignalBlocker quiet(slider_);
            slider_->setValue(0);
        }
    });
    connect(slider_, &QSlider::sliderReleased, this, [this] {
        const QSignalBlocker quiet(slider_);
        slider_->setValue(0);
        ++drag_;
    });
    auto* scrub = new Scrub(*name_, Qt::LeftButton);
    connect(scrub, &Scrub::begun, this, [this] { begin(cell_); });
    connect(scrub, &Scrub::moved, this, [this](double px) { draw(px / reach_px); });
    connect(choice_, &QComboBox::activated, this, [this] { show_value(); });
    connect(editor_, &QLineEdit::editingFinished, this, &NumberHandle::take_entry);
    connect(&model_, &QAbstractItemModel::dataChanged, this, &NumberHandle::refresh);
    connect(&model_, &QAbstractItemModel::modelReset, this, &NumberHandle::refresh);
    refresh();
}

void NumberHandle::set_cell(const QModelIndex& cell) {
    if (cell != QModelIndex(cell_)) {
        ++drag_;
    }
    cell_ = cell;
    refresh();
}

std::size_t NumberHandle::which() const {
    return static_cast<std::size_t>(std::max(0, choice_->currentIndex()));
}

void NumberHandle::refresh() {
    numbers_ = model_.numbers(cell_);
    const bool has = !numbers_.empty();
    QStringList names;
    for (const CellNumber& number : numbers_) {
        names << number.name;
    }
    QStringList now;
    for (int k = 0; k < choice_->count(); ++k) {
        now << choice_->itemText(k);
    }
    if (names != now) {
        const int kept = choice_->currentIndex();
        const QSignalBlocker quiet(choice_);
        choice_->clear();
        choice_->addItems(names);
        choice_->setCurrentIndex(
            std::clamp(kept, 0, std::max(0, static_cast<int>(names.size()) - 1)));
    }
    choice_->setVisible(names.size() > 1);
    for (QWidget* part : {static_cast<QWidget*>(slider_), static_cast<QWidget*>(editor_)}) {
        part->setEnabled(has);
    }
    show_value();
}

void NumberHandle::show_value() {
    if (numbers_.empty()) {
        name_->setText(cell_.isValid() ? tr("No number in this cell") : tr("No cell in hand"));
        editor_->clear();
        unit_->clear();
        return;
    }
    const CellNumber& number = numbers_[std::min(which(), numbers_.size() - 1)];
    const QString surface = QString::number(cell_.row() + 1);
    name_->setText(numbers_.size() > 1 ? tr("Surface %1").arg(surface)
                                       : tr("%1 of surface %2").arg(number.name, surface));
    if (!(editor_->hasFocus() && editor_->isModified())) {
        editor_->setText(shortest(number.value));
    }
    unit_->setText(number.unit);
}

void NumberHandle::begin(const QModelIndex& cell) {
    ++drag_;
    drawn_cell_ = cell;
    drawn_which_ = cell == QModelIndex(cell_) ? which() : 0;
    const auto numbers = model_.numbers(cell);
    if (drawn_which_ < numbers.size()) {
        drawn_from_ = numbers[drawn_which_];
    } else {
        drawn_cell_ = QModelIndex();
    }
}

void NumberHandle::draw(double share) {
    if (!drawn_cell_.isValid()) {
        return;
    }
    const double value = drawn_from_.value + share * drawn_from_.reach;
    model_.set_number(drawn_cell_, drawn_which_,
                      share == 0.0 ? drawn_from_.value : rounded(value, drawn_from_.reach), drag_);
}

void NumberHandle::take_entry() {
    if (!editor_->isModified() || numbers_.empty()) {
        return;
    }
    editor_->setModified(false);
    const std::size_t at = std::min(which(), numbers_.size() - 1);
    try {
        const double value = read_number(editor_->text(), tr("a number"), unit_of(numbers_[at]));
        model_.set_number(cell_, at, value, ++drag_);
    } catch (const Error& error) {
        Q_EMIT model_.refused(cell_, error.what());
    }
    show_value();
}

}  // namespace ghostlight
