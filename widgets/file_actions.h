#pragma once

#include <QObject>
#include <QString>
#include <QStringList>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/flare/flare_image.h"
#include "core/ghosts/ghost_path.h"
#include "core/ghosts/ghost_table.h"
#include "widgets/layered_picture.h"

class QMenu;
class QWidget;

namespace ghostlight {

class Actions;
class Banner;
class Document;
class StatusLine;

/// Everything that goes through a file: opening, saving, exporting, and the questions before.
/// What fails is said in the banner and leaves everything as it was.
class FileActions : public QObject {
    Q_OBJECT
   public:
    enum class Answer { save, discard, cancel };
    /// What the window shows now, for exports.
    struct Shown {
        std::function<std::shared_ptr<const GhostTable>()> table;
        std::function<std::shared_ptr<const FlareImage>()> image;
        std::function<double()> exposure_ev;
        std::function<std::vector<GhostPath>()> ghosts;   ///< that are chosen
        std::function<std::vector<ShownLayer>()> layers;  ///< of the image
    };

    FileActions(Document& document, const Actions& actions, Banner& banner, StatusLine& status,
                Shown shown, QWidget* window);

    bool open(const std::filesystem::path& file);
    bool save();
    bool save_as(const std::filesystem::path& file);
    /// Saves or discards unsaved edits as the person answers; false to stay.
    bool may_leave();
    bool export_table(const std::filesystem::path& file);
    bool export_exr(const std::filesystem::path& file);
    bool export_png(const std::filesystem::path& file);
    /// In the format that the name's extension says.
    bool export_lens(const std::filesystem::path& file);
    /// The first of the chosen ghosts, as a .zmx.
    bool export_ghost(const std::filesystem::path& file);

    /// Asks for the folders with catalogues, keeps them and looks glasses up in them from now on.
    void choose_glass_folders();

    void fill_bundled(QMenu& menu);
    void fill_recent(QMenu& menu);

    /// The questions, which tests answer without a dialog.
    std::function<Answer()> ask_about_unsaved;
    /// Title, suggested name, filter; an empty answer cancels.
    std::function<QString(const QString&, const QString&, const QString&)> ask_file_to_write;

    /// The folders in use; nothing to leave them as they are.
    std::function<std::optional<QStringList>(const QStringList&)> ask_glass_folders;

   Q_SIGNALS:
    /// A lens was written for another program, and what became of it.
    void exported(const QString& file, const ghostlight::Notes& notes);

   private:
    bool choose_and_save();
    void choose_and_open();
    bool attempt(const QString& done, const std::function<void()>& write);
    void choose_and(bool (FileActions::*write)(const std::filesystem::path&), const QString& title,
                    const QString& suffix, const QString& filter);
    bool is_bundled(const std::filesystem::path& file) const;

    Document& document_;
    Banner& banner_;
    StatusLine& status_;
    Shown shown_;
    QWidget* window_;
};

}  // namespace ghostlight
