#pragma once

#include <QAbstractTableModel>
#include <QSortFilterProxyModel>

#include <optional>
#include <vector>

#include "core/error.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// What became of each thing in a file, one row a note: first what has to be mended, then what
/// matters, then the rest.
class NoteTableModel : public QAbstractTableModel {
    Q_OBJECT
   public:
    enum Column { place, fate, matters, text, proposal, column_count };
    enum Role {
        matters_role = Qt::UserRole,  ///< true for what changes ghosts or has to be mended
        surface_role                  ///< row of the prescription, from 0; −1 for none
    };
    using QAbstractTableModel::QAbstractTableModel;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

    /// `lens` is the one that the notes are about.
    void set_notes(Notes notes, const Prescription& lens);
    const Notes& notes() const { return notes_; }
    /// How many notes are at least so severe.
    int count(Note::Severity least) const;
    int count_what_matters() const;

   private:
    Notes notes_;
    std::vector<std::optional<std::size_t>> surfaces_;
};

/// All notes, or those that matter.
class NoteFilter : public QSortFilterProxyModel {
    Q_OBJECT
   public:
    using QSortFilterProxyModel::QSortFilterProxyModel;
    void set_only_what_matters(bool only);
    bool only_what_matters() const { return only_what_matters_; }

   protected:
    bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

   private:
    bool only_what_matters_ = false;
};

}  // namespace ghostlight
