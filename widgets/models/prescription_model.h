#pragma once

#include <QAbstractTableModel>
#include <QColor>

#include <optional>
#include <vector>

#include "widgets/document.h"

namespace ghostlight {

/// The document's surfaces, one row each, in the scene's configuration. What cannot be taken is
/// refused with a reason and leaves the lens as it was.
class PrescriptionModel : public QAbstractTableModel {
    Q_OBJECT
   public:
    enum Column {
        number,
        radius,
        thickness,
        medium,
        semi_diameter,
        conic,
        aspheric,
        coating,
        comment,
        column_count
    };
    enum Role {
        offers_role = Qt::UserRole,  ///< glasses that may be meant, best first
        must_be_mended_role          ///< true where the lens cannot be traced as it stands
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

    /// The row that is pointed at elsewhere, −1 for none.
    void set_marked_row(int row);

    /// Each is one step of the history; false if it was refused.
    bool insert_after(int row);
    bool remove(int row);
    bool move(int row, int to);
    bool make_stop(int row);

   Q_SIGNALS:
    /// Something was not done, and why. The index is invalid when no one cell is to blame.
    void refused(const QModelIndex& index, const QString& reason);

   private:
    void follow_document();
    QString display_text(std::size_t row, int column) const;
    QString edit_text(std::size_t row, int column) const;
    QString tool_tip(std::size_t row, int column) const;
    bool is_stop(std::size_t row) const { return row == shown_.stop.surface; }
    Prescription edited(const QModelIndex& index, const QString& text) const;
    template <class Edit>
    bool attempt(const QString& text, const Edit& edit);

    Document& document_;
    Prescription shown_;  ///< what views have been told of
    std::string configuration_;
    Spectrum spectrum_;
    std::vector<std::optional<QColor>> chips_;
    int marked_row_ = -1;
};

}  // namespace ghostlight
