#include "widgets/file_actions.h"

#include <QAction>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/io/formats.h"
#include "core/io/image_file.h"
#include "core/io/lens_file.h"
#include "core/io/table_file.h"
#include "core/io/unfolded_ghost.h"
#include "widgets/actions.h"
#include "widgets/document.h"
#include "widgets/glass_folders.h"
#include "widgets/lens_filters.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/status_line.h"
#include "widgets/settings.h"
#include "widgets/unknown_glass.h"

namespace ghostlight {

namespace {

constexpr const char* topic = "file";

QString text_of(const std::filesystem::path& file) { return QString::fromStdString(file.string()); }

}  // namespace

FileActions::FileActions(Document& document, const Actions& actions, Banner& banner,
                         StatusLine& status, Shown shown, QWidget* window)
    : QObject(window),
      document_(document),
      banner_(banner),
      status_(status),
      shown_(std::move(shown)),
      window_(window) {
    ask_about_unsaved = [this] {
        const auto button = QMessageBox::question(
            window_, tr("Unsaved edits"),
            tr("%1 has edits that are not saved.").arg(document_.title()),
            QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
        return button == QMessageBox::Save      ? Answer::save
               : button == QMessageBox::Discard ? Answer::discard
                                                : Answer::cancel;
    };
    ask_glass_folders = [this](const QStringList& folders) -> std::optional<QStringList> {
        GlassFoldersDialog dialog(folders, window_);
        return dialog.exec() == QDialog::Accepted ? std::optional(dialog.folders()) : std::nullopt;
    };
    ask_file_to_write = [this](const QString& title, const QString& suggested,
                               const QString& filter) {
        QFileDialog dialog(window_, title, settings::folder(), filter);
        dialog.setAcceptMode(QFileDialog::AcceptSave);
        dialog.selectFile(suggested);
        dialog.setDefaultSuffix(QFileInfo(suggested).suffix());
        return dialog.exec() == QDialog::Accepted ? dialog.selectedFiles().value(0) : QString();
    };
    const auto on = [&](const char* id, auto run) {
        connect(&actions[id], &QAction::triggered, this, run);
    };
    on("file.open", [this] { choose_and_open(); });
    on("file.save", [this] { save(); });
    on("file.save_as", [this] { choose_and_save(); });
    on("file.export_lens", [this] {
        const bool ends_in_zmx = document_.file().extension() == ".zmx";
        choose_and(&FileActions::export_lens, tr("Export lens"),
                   !document_.is_own_file() && ends_in_zmx ? "_exported.zmx" : ".zmx",
                   lens_export_filter());
    });
    on("file.export_ghost", [this] {
        const auto ghosts = shown_.ghosts();
        if (document_.is_empty()) {
            return;
        }
        if (ghosts.empty()) {
            banner_.show_text(topic,
                              tr("Choose a ghost in the table first: it is the one to export."));
            return;
        }
        const auto count = document_.lens().surfaces.size();
        choose_and(
            &FileActions::export_ghost, tr("Export unfolded ghost"),
            QStringLiteral("_ghost_%1.zmx").arg(QString::fromStdString(name(ghosts[0], count))),
            tr("Zemax (*.zmx)"));
    });
    on("file.glass_folders", [this] { choose_glass_folders(); });
    on("file.export_table", [this] {
        choose_and(&FileActions::export_table, tr("Export ghost table"), "_ghosts.csv",
                   tr("Comma-separated values (*.csv)"));
    });
    on("file.export_exr", [this] {
        choose_and(&FileActions::export_exr, tr("Export flare"), "_flare.exr",
                   tr("OpenEXR (*.exr)"));
    });
    on("file.export_png", [this] {
        choose_and(&FileActions::export_png, tr("Export flare"), "_flare.png", "PNG (*.png)");
    });
}

bool FileActions::attempt(const QString& done, const std::function<void()>& write) {
    try {
        write();
        banner_.clear(topic);
        status_.show_message(done);
        return true;
    } catch (const std::exception& error) {
        banner_.show_text(topic, QString::fromUtf8(error.what()));
        return false;
    }
}

bool FileActions::open(const std::filesystem::path& file) {
    if (!may_leave()) {
        return false;
    }
    const QString name = text_of(file);
    if (const auto error = document_.open(file)) {
        settings::forget_recent_file(name);
        banner_.show_text(topic, error->what());
        return false;
    }
    banner_.clear(topic);
    if (!is_bundled(document_.file())) {
        settings::add_recent_file(text_of(document_.file()));
    }
    return true;
}

bool FileActions::is_bundled(const std::filesystem::path& file) const {
    try {
        const auto inside = std::filesystem::weakly_canonical(file).lexically_relative(
            std::filesystem::weakly_canonical(data_directory()));
        return !inside.empty() && *inside.begin() != "..";
    } catch (const std::exception&) {
        return false;  // no bundled data at all
    }
}

bool FileActions::save() {
    // A bundled lens is a reference, and another program's file is that program's: edits of either
    // go to a file of the person's own.
    const bool asks =
        document_.file().empty() || !document_.is_own_file() || is_bundled(document_.file());
    return asks ? choose_and_save() : save_as(document_.file());
}

bool FileActions::save_as(const std::filesystem::path& file) {
    return attempt(tr("Saved %1").arg(text_of(file.filename())), [&] {
        const bool is_in_hand = document_.is_own_file() && file == document_.file();
        if (!is_in_hand && !has_own_extension(file)) {
            throw Error({.problem = tr("lenses are saved in Ghostlight's own format; File ▸ Export "
                                       "Lens writes others")
                                        .toStdString(),
                         .file = file.string(),
                         .where = {},
                         .found = file.extension().string(),
                         .expected = tr("a name that ends in .json").toStdString()});
        }
        if (!may_be_saved_over(file)) {
            throw Error(
                {.problem =
                     tr("the file is another program's, and is not written over").toStdString(),
                 .file = file.string(),
                 .where = {},
                 .found = {},
                 .expected = tr("another name").toStdString()});
        }
        if (const auto error = document_.save_as(file)) {
            throw *error;
        }
        settings::add_recent_file(text_of(file));
    });
}

bool FileActions::choose_and_save() {
    if (document_.is_empty()) {
        return false;
    }
    const std::filesystem::path& present = document_.file();
    const bool same_name = document_.is_own_file();
    QString suggested = QStringLiteral("lens.json");
    if (!present.empty()) {
        // Beside "lens.json" of another program there is room for "lens_ghostlight.json".
        suggested = same_name                    ? text_of(present.filename())
                    : has_own_extension(present) ? text_of(present.stem()) + "_ghostlight.json"
                                                 : text_of(present.stem()) + ".json";
    }
    const QString file =
        ask_file_to_write(tr("Save lens"), suggested, tr("Ghostlight lens (*.json)"));
    if (file.isEmpty()) {
        return false;
    }
    settings::set_folder(QFileInfo(file).absolutePath());
    return save_as(file.toStdString());
}

void FileActions::choose_and_open() {
    const QString file = QFileDialog::getOpenFileName(window_, tr("Open lens"), settings::folder(),
                                                      lens_open_filter());
    if (!file.isEmpty()) {
        settings::set_folder(QFileInfo(file).absolutePath());
        open(file.toStdString());
    }
}

bool FileActions::may_leave() {
    if (document_.is_empty() || !document_.is_modified()) {
        return true;
    }
    switch (ask_about_unsaved()) {
        case Answer::save:
            return save();
        case Answer::discard:
            return true;
        default:
            return false;
    }
}

void FileActions::choose_and(bool (FileActions::*write)(const std::filesystem::path&),
                             const QString& title, const QString& suffix, const QString& filter) {
    if (document_.is_empty()) {
        return;
    }
    const QString stem =
        document_.file().empty() ? QStringLiteral("lens") : text_of(document_.file().stem());
    const QString file = ask_file_to_write(title, stem + suffix, filter);
    if (!file.isEmpty()) {
        settings::set_folder(QFileInfo(file).absolutePath());
        (this->*write)(file.toStdString());
    }
}

bool FileActions::export_table(const std::filesystem::path& file) {
    return attempt(tr("Wrote %1").arg(text_of(file.filename())), [&] {
        const auto table = shown_.table();
        if (!table) {
            throw Error(
                tr("there is no ghost table yet: it is still being computed").toStdString());
        }
        write_file_safely(file, ghost_table_csv(*table, GhostColumns::all));
    });
}

bool FileActions::export_exr(const std::filesystem::path& file) {
    return attempt(tr("Wrote %1").arg(text_of(file.filename())), [&] {
        const auto image = shown_.image();
        if (!image) {
            throw Error(tr("there is no flare yet: it is still being computed").toStdString());
        }
        // A layer alone is the picture.
        std::vector<FlareImage> images;
        std::vector<FlareLayer> named;
        const std::vector<ShownLayer> layers = shown_.layers();
        for (const ShownLayer& layer : layers) {
            const LayerImage one{layer.kind, layer.image.get()};
            images.push_back(compose(std::span(&one, 1), document_.scene().layers));
        }
        for (std::size_t k = 0; k < layers.size() && layers.size() > 1; ++k) {
            if (!images[k].irradiance.empty()) {
                named.push_back({std::string(name(layers[k].kind)), &images[k]});
            }
        }
        write_exr(*image, file, {}, named);
    });
}

bool FileActions::export_png(const std::filesystem::path& file) {
    return attempt(tr("Wrote %1").arg(text_of(file.filename())), [&] {
        const auto image = shown_.image();
        if (!image) {
            throw Error(tr("there is no flare yet: it is still being computed").toStdString());
        }
        write_display(*image, shown_.exposure_ev(), file);
    });
}

bool FileActions::export_lens(const std::filesystem::path& file) {
    return attempt(tr("Wrote %1").arg(text_of(file.filename())), [&] {
        Notes notes;
        write_file_safely(file, writable_format(file).write(document_.lens(), notes));
        Q_EMIT exported(text_of(file.filename()), notes);
    });
}

bool FileActions::export_ghost(const std::filesystem::path& file) {
    return attempt(tr("Wrote %1").arg(text_of(file.filename())), [&] {
        const auto ghosts = shown_.ghosts();
        if (ghosts.empty()) {
            throw Error(tr("no ghost is chosen").toStdString());
        }
        Notes notes;
        const Prescription lens = document_.configured_lens();
        write_file_safely(
            file, unfolded_ghost(lens, name(ghosts.front(), lens.surfaces.size()), file, notes));
        Q_EMIT exported(text_of(file.filename()), notes);
    });
}

void FileActions::choose_glass_folders() {
    const auto folders = ask_glass_folders(settings::glass_folders());
    if (!folders) {
        return;
    }
    settings::set_glass_folders(*folders);
    use_glass_folders();
    document_.edit_lens(with_known_glasses(document_.lens()), tr("look up unknown glasses"));
}

void FileActions::fill_bundled(QMenu& menu) {
    menu.clear();
    try {
        for (const BundledLens& lens : bundled_lenses()) {
            menu.addAction(QString::fromStdString(lens.name).replace('&', "&&"), this,
                           [this, file = lens.file] { open(file); });
        }
    } catch (const Error& error) {
        menu.addAction(QString::fromUtf8(error.what()))->setEnabled(false);
    }
}

void FileActions::fill_recent(QMenu& menu) {
    menu.clear();
    for (const QString& file : settings::recent_files()) {
        QAction* action = menu.addAction(QFileInfo(file).fileName().replace('&', "&&"), this,
                                         [this, file] { open(file.toStdString()); });
        action->setToolTip(file);
    }
    if (menu.isEmpty()) {
        menu.addAction(tr("No lens opened yet"))->setEnabled(false);
    }
    menu.setToolTipsVisible(true);
}

}  // namespace ghostlight
