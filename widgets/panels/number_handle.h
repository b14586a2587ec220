#pragma once

#include <QPersistentModelIndex>
#include <QWidget>

#include <vector>

#include "widgets/models/prescription_cells.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QSlider;

namespace ghostlight {

class PrescriptionModel;

/// Below the table: the number in the cell in hand, to be drawn up and down while the flare
/// follows. A drag of the slider, or of the number's name, is one step of the history; of an
/// asphere, a stack or a glass given by its index, one of several numbers is chosen.
class NumberHandle : public QWidget {
    Q_OBJECT
   public:
    explicit NumberHandle(PrescriptionModel& model, QWidget* parent = nullptr);

    void set_cell(const QModelIndex& cell);
    QSlider& slider() { return *slider_; }
    QComboBox& choice() { return *choice_; }
    QLineEdit& editor() { return *editor_; }
    /// A number in any cell, drawn by its share of the slider's reach: for drags over the table.
    void begin(const QModelIndex& cell);
    void draw(double share);

   private:
    void refresh();
    void show_value();
    void take_entry();
    std::size_t which() const;

    PrescriptionModel& model_;
    QPersistentModelIndex cell_;
    std::vector<CellNumber> numbers_;
    QLabel* name_;
    QComboBox* choice_;
    QSlider* slider_;
    QLineEdit* editor_;
    QLabel* unit_;
    // While a number is drawn.
    QPersistentModelIndex drawn_cell_;
    std::size_t drawn_which_ = 0;
    CellNumber drawn_from_;
    int drag_ = 0;
};

}  // namespace ghostlight
