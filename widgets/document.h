#pragma once

#include <QDateTime>
#include <QObject>
#include <QString>
#include <QUndoStack>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/flare/scene.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// All that is undone and saved.
struct DocumentState {
    Prescription lens;
    Scene scene;
    std::string fit = {};  ///< how a fit to photographs is set up (fit_setup_to_json); may be empty
    bool operator==(const DocumentState&) const = default;
};

/// The lens in hand and how it is looked at, its file and its history.
class Document : public QObject {
    Q_OBJECT
   public:
    explicit Document(QObject* parent = nullptr);
    ~Document() override;

    const DocumentState& state() const { return state_; }
    const Prescription& lens() const { return state_.lens; }
    const Scene& scene() const { return state_.scene; }
    const std::string& fit() const { return state_.fit; }
    bool is_empty() const { return state_.lens.surfaces.empty(); }
    /// The lens in the scene's configuration.
    Prescription configured_lens() const;

    /// Counts every change of state.
    std::uint64_t revision() const { return revision_; }
    /// The revision that began the lens in hand: older results belong to another one.
    std::uint64_t first_revision() const { return first_revision_; }
    /// When the present revision came about: where the time to a new picture is measured from.
    std::chrono::steady_clock::time_point changed_at() const { return changed_at_; }

    /// One step of the history. `text` names it ("change radius of surface 3"). Successive edits
    /// of the same `field` become one step; an edit that changes nothing leaves no trace.
    void edit(DocumentState after, const QString& text, const QString& field = {});
    void edit_lens(Prescription after, const QString& text, const QString& field = {});
    void edit_scene(Scene after, const QString& text, const QString& field = {});
    void edit_fit(std::string after, const QString& text, const QString& field = {});
    QUndoStack& history() { return history_; }

    /// A failing open or save changes nothing and says why.
    [[nodiscard]] std::optional<Error> open(const std::filesystem::path& file);
    [[nodiscard]] std::optional<Error> save_as(const std::filesystem::path& file);
    /// Reads the file again, as one step of the history: what was in hand can be had back.
    [[nodiscard]] std::optional<Error> reload();
    /// The file no longer holds what was read from it: the lens in hand counts as unsaved.
    void lose_saved();
    /// Takes over a lens that has no file of its own, or not this content on file.
    void adopt(DocumentState state, const std::filesystem::path& file);

    const std::filesystem::path& file() const { return file_; }
    /// What the file's reader noticed.
    const Notes& notes() const { return notes_; }
    /// The file is in our format, or there is none. Another program's file is never written over.
    bool is_own_file() const { return is_own_file_; }
    /// The lens differs from its file. The scene is saved too, but looking around is no edit.
    bool is_modified() const { return state_.lens != saved_lens_; }
    QDateTime saved_at() const { return saved_at_; }
    /// The lens's name, or that of its file.
    QString title() const;

   Q_SIGNALS:
    /// The state has another revision. `lens_changed` is false when only the scene is another.
    void changed(bool lens_changed);
    /// How a fit is set up is another; comes alone where lens and scene are as they were.
    void fit_changed();
    /// Another lens is in hand; comes before changed().
    void opened();
    /// The file, or whether the lens differs from it, may have changed.
    void file_changed();

   private:
    friend class EditCommand;
    void apply(const DocumentState& state);
    void begin(DocumentState state, const std::filesystem::path& file, Notes notes);

    DocumentState state_;
    Prescription saved_lens_;
    std::filesystem::path file_;
    Notes notes_;
    bool is_own_file_ = true;
    QDateTime saved_at_;
    std::uint64_t revision_ = 0;
    std::uint64_t first_revision_ = 0;
    std::chrono::steady_clock::time_point changed_at_{};
    QUndoStack history_;
};

/// Whether a file is one that saving may write over: in our format, or not there yet.
bool may_be_saved_over(const std::filesystem::path& file);

/// A lens file's text with the scene in it, and back.
/// `folder` is where the text will be, see lens_to_json().
std::string document_to_json(const DocumentState& state, const std::filesystem::path& folder = {});
DocumentState document_from_lens(Prescription lens);

}  // namespace ghostlight
