#pragma once

#include <QAbstractTableModel>
#include <QColor>

#include <optional>
#include <vector>

#include "widgets/document.h"
#include "widgets/models/prescription_cells.h"

namespace ghostlight {

/// The document's surfaces, one row each, in the scene's configuration. What cannot be taken is
/// refused with a reason and leaves the lens as it was.
class PrescriptionModel : public QAbstractTableModel, public PrescriptionColumns {
    Q_OBJECT
   public:
    enum Role {
        offers_role = Qt::UserRole,  ///< glasses that may be meant, best first
        must_be_mended_role,         ///< true where the lens cannot be traced as it stands
        mark_role,      ///< "V" of what a fit may vary, "A" of an automatic semi-diameter
        vary_kind_role  ///< the kind of fit parameter that a cell is; empty for none
    };
    explicit PrescriptionModel(Document& document, QObject* parent = nullptr);

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;

    /// Why a text cannot go into a cell; empty if it can.
    QString refusal(const QModelIndex& index, const QString& text) const;

    /// The column of radii as curvatures in 1/mm.
    void set_shows_curvatures(bool shown);
    bool shows_curvatures() const { return curvatures_; }

    /// Texts into several cells as one step of that name; all or none.
    bool set_texts(const std::vector<CellText>& cells, const QString& name);
    /// The numbers of a cell that can be drawn up and down.
    std::vector<CellNumber> numbers(const QModelIndex& index) const;
    /// A number while it is drawn: edits with one `drag` are one step. Says why it was refused.
    bool set_number(const QModelIndex& index, std::size_t which, double value, int drag);
    /// Marks cells as variable for a fit, or takes the marks away. Cells that no fit varies stay.
    void set_varied(const QModelIndexList& cells, bool varies);
    /// A thickness with a value of its own in the configuration in hand, or as listed again.
    void set_own_thickness(int row, bool own);

    /// The row that is pointed at elsewhere, −1 for none.
    void set_marked_row(int row);

    /// Each is one step of the history; false if it was refused.
    bool insert_after(int row);
    bool remove(int row);
    bool move(int row, int to);
    bool make_stop(int row);
    bool reverse();
    bool scale(double factor);

   Q_SIGNALS:
    /// Something was not done, and why. The index is invalid when no one cell is to blame.
    void refused(const QModelIndex& index, const QString& reason);

   private:
    void follow_document();
    ShownLens shown() const { return {shown_, configuration_, curvatures_}; }
    QString mark(std::size_t row, int column) const;
    bool is_stop(std::size_t row) const { return row == shown_.stop.surface; }
    template <class Edit>
    bool attempt(const QString& text, const Edit& edit);

    Document& document_;
    Prescription shown_;  ///< what views have been told of
    std::string configuration_;
    Spectrum spectrum_;
    std::vector<std::optional<QColor>> chips_;
    int marked_row_ = -1;
    bool curvatures_ = false;
};

}  // namespace ghostlight
