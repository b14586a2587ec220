#pragma once

#include <QTimer>
#include <QWidget>

#include <optional>
#include <vector>

#include "core/io/glass_search.h"

class QLabel;
class QLineEdit;
class QStandardItemModel;
class QTableView;
class QToolButton;

namespace ghostlight {

class Document;
class GlassMapView;
class PanelHeader;

/// The glasses of all catalogues at hand: on the nd–Vd map and in a list, searched by name, code or
/// place; one is put behind the surface in hand, or the nearest to what is there.
class GlassPanel : public QWidget {
    Q_OBJECT
   public:
    explicit GlassPanel(Document& document, QWidget* parent = nullptr);
    ~GlassPanel() override;

    /// Row from 0; −1 for none.
    void set_row(int row);
    QLineEdit& search() { return *search_; }
    QTableView& table() { return *table_; }
    GlassMapView& map() { return *map_; }
    QToolButton& use() { return *use_; }
    QToolButton& nearest() { return *nearest_; }
    const std::vector<MappedGlass>& glasses() const { return glasses_; }
    const std::vector<std::size_t>& found() const { return found_; }

   Q_SIGNALS:
    /// Something was not done, and why; empty when something was.
    void refused(const QString& reason);

   protected:
    void showEvent(QShowEvent* event) override;

   private:
    void read_library();
    void find();
    void follow_document();
    void choose(std::optional<std::size_t> glass);
    void put(std::size_t glass);
    void put_nearest();
    /// nd and Vd behind the surface in hand; none for air and what nobody knows.
    std::optional<ModelGlass> present() const;

    Document& document_;
    int row_ = -1;
    std::shared_ptr<const GlassLibrary> library_;
    std::vector<MappedGlass> glasses_;
    std::vector<std::size_t> found_;
    std::optional<std::size_t> chosen_;
    PanelHeader* header_;
    QLineEdit* search_;
    GlassMapView* map_;
    QStandardItemModel* model_;
    QTableView* table_;
    QLabel* surface_;
    QToolButton* use_;
    QToolButton* nearest_;
    QTimer update_;
    bool is_filling_ = false;
};

}  // namespace ghostlight
