#pragma once

#include <QTimer>
#include <QWidget>

class QComboBox;
class QLabel;
class QSlider;
class QStandardItemModel;
class QTableView;
class QToolButton;

namespace ghostlight {

class Document;
class PanelHeader;

/// The lens's zoom and focus positions: the one looked at is the chosen row; they are added,
/// renamed and removed here, and a slider goes from one to another. What the slider makes is a
/// position of the lens, in one step of the history: it is kept by leaving it.
class ConfigurationPanel : public QWidget {
    Q_OBJECT
   public:
    explicit ConfigurationPanel(Document& document, QWidget* parent = nullptr);

    QTableView& table() { return *table_; }
    QSlider& slider() { return *slider_; }
    QToolButton& add() { return *add_; }
    QToolButton& remove() { return *remove_; }

   Q_SIGNALS:
    /// Something was not done, and why; empty when something was.
    void refused(const QString& reason);

   private:
    template <class Edit>
    void attempt(const QString& text, const Edit& edit, const QString& field = {});
    void follow_document();
    void show_lens();
    void go_between(int value);
    std::string chosen() const;

    Document& document_;
    PanelHeader* header_;
    QStandardItemModel* model_;
    QTableView* table_;
    QToolButton* add_;
    QToolButton* remove_;
    QComboBox* first_;
    QComboBox* second_;
    QSlider* slider_;
    QLabel* share_;
    QTimer update_;  ///< many changes, one look at every position
    int drag_ = 0;
    bool is_filling_ = false;
};

}  // namespace ghostlight
