#pragma once

#include <QTimer>

#include <memory>
#include <vector>

#include "core/ghosts/ghost_table.h"
#include "core/ghosts/surface_ghosts.h"
#include "core/optics/coating.h"
#include "widgets/panels/paged_panel.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QStandardItem;
class QStandardItemModel;
class QTableView;
class QToolButton;

namespace ghostlight {

class CurveChart;
class Document;
class Selection;

/// The coating of the surface in hand: its kind and layers, what it reflects against wavelength
/// and angle, the angles at which ghosts meet it, and the two ghosts that it feeds most.
class CoatingPanel : public PagedPanel {
    Q_OBJECT
   public:
    CoatingPanel(Document& document, Selection& selection, const Actions& actions,
                 QWidget* parent = nullptr);

    /// Row from 0; −1 for none.
    void set_row(int row);
    void set_table(std::shared_ptr<const GhostTable> table);

    QComboBox& kind() { return *kind_; }
    QTableView& layers() { return *table_; }
    QLineEdit& targets() { return *targets_; }
    CurveChart& over_wavelength_chart() { return *wavelength_chart_; }
    CurveChart& over_angle_chart() { return *angle_chart_; }
    /// "Feeds 5-3 and 7-3": what is said of the ghosts.
    QString ghosts_text() const;

   Q_SIGNALS:
    /// Something was not done, and why; empty when something was.
    void refused(const QString& reason);

   private:
    /// Of the table of layers.
    enum Column { number_column, material_column, index_column, thickness_column, k_column };

    void build();
    void follow();
    void show_coating();
    void show_layers();
    void show_curves();
    void show_ghosts();
    void choose_kind(int at);
    void change_layer(QStandardItem* item);
    void change_stack(const QString& what, void (*change)(LayerStack&, std::size_t row));
    void copy_to(const std::vector<std::size_t>& rows);
    void copy_to_targets();
    bool has_surface() const;
    const Coating& coating() const;
    template <class Edit>
    bool attempt(const QString& text, const Edit& edit, const QString& field = {});

    Document& document_;
    Selection& selection_;
    int row_ = -1;
    std::shared_ptr<const GhostTable> ghosts_;
    std::vector<SurfaceGhost> fed_;
    QComboBox* kind_;
    QStandardItemModel* model_;
    QTableView* table_;
    QToolButton* add_;
    QToolButton* remove_;
    QToolButton* turn_;
    QLabel* fed_label_;
    QComboBox* side_;
    QLineEdit* wavelength_;
    CurveChart* wavelength_chart_;
    CurveChart* angle_chart_;
    QLineEdit* targets_;
    QTimer update_;  ///< many changes, one drawing
    bool is_filling_ = false;
    bool side_is_chosen_ = false;
};

}  // namespace ghostlight
