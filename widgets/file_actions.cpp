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
#include "core/io/image_file.h"
#include "core/io/lens_file.h"
#include "core/io/table_file.h"
#include "widgets/actions.h"
#include "widgets/document.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/status_line.h"
#include "widgets/settings.h"

namespace ghostlight {

namespace {

constexpr const char* topic = "file";
constexpr const char* lens_filter = "Lens files (*.json);;All files (*)";

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
            window_, "Unsaved edits",
            QStringLiteral("%1 has edits that are not saved.").arg(document_.title()),
            QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
        return button == QMessageBox::Save      ? Answer::save
               : button == QMessageBox::Discard ? Answer::discard
                                                : Answer::cancel;
    };
    ask_file_to_write = [this](const QString& title, const QString& suggested,
                               const QString& filter) {
        return QFileDialog::getSaveFileName(window_, title,
                                            QDir(settings::folder()).filePath(suggested), filter);
    };
    const auto on = [&](const char* id, auto run) {
        connect(&actions[id], &QAction::triggered, this, run);
    };
    on("file.open", [this] { choose_and_open(); });
    on("file.save", [this] { save(); });
    on("file.save_as", [this] { choose_and_save(); });
    on("file.export_table", [this] {
        choose_and(&FileActions::export_table, "Export ghost table", "_ghosts.csv",
                   "Comma-separated values (*.csv)");
    });
    on("file.export_exr", [this] {
        choose_and(&FileActions::export_exr, "Export flare", "_flare.exr", "OpenEXR (*.exr)");
    });
    on("file.export_png", [this] {
        choose_and(&FileActions::export_png, "Export flare", "_flare.png", "PNG (*.png)");
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
    QStringList warnings;
    for (const Note& note : document_.notes()) {
        if (note.severity == Note::Severity::warning) {
            warnings << QString::fromStdString(note.where + ": " + note.text);
        }
    }
    if (!warnings.isEmpty()) {
        banner_.show_text(topic, QStringLiteral("%1 was read with reservations: %2")
                                     .arg(document_.title(), warnings.join("; ")));
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
    // A bundled lens is a reference; edits of it go to a file of the person's own.
    return document_.file().empty() || is_bundled(document_.file()) ? choose_and_save()
                                                                    : save_as(document_.file());
}

bool FileActions::save_as(const std::filesystem::path& file) {
    return attempt(QStringLiteral("Saved %1").arg(text_of(file.filename())), [&] {
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
    const QString suggested = document_.file().empty() ? QStringLiteral("lens.json")
                                                       : text_of(document_.file().filename());
    const QString file = ask_file_to_write("Save lens", suggested, lens_filter);
    if (file.isEmpty()) {
        return false;
    }
    settings::set_folder(QFileInfo(file).absolutePath());
    return save_as(file.toStdString());
}

void FileActions::choose_and_open() {
    const QString file =
        QFileDialog::getOpenFileName(window_, "Open lens", settings::folder(), lens_filter);
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
    return attempt(QStringLiteral("Wrote %1").arg(text_of(file.filename())), [&] {
        const auto table = shown_.table();
        if (!table) {
            throw Error("there is no ghost table yet: it is still being computed");
        }
        write_file_safely(file, ghost_table_csv(*table, GhostColumns::all));
    });
}

bool FileActions::export_exr(const std::filesystem::path& file) {
    return attempt(QStringLiteral("Wrote %1").arg(text_of(file.filename())), [&] {
        const auto image = shown_.image();
        if (!image) {
            throw Error("there is no flare yet: it is still being computed");
        }
        write_exr(*image, file);
    });
}

bool FileActions::export_png(const std::filesystem::path& file) {
    return attempt(QStringLiteral("Wrote %1").arg(text_of(file.filename())), [&] {
        const auto image = shown_.image();
        if (!image) {
            throw Error("there is no flare yet: it is still being computed");
        }
        write_display(*image, shown_.exposure_ev(), file);
    });
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
        menu.addAction("No lens opened yet")->setEnabled(false);
    }
    menu.setToolTipsVisible(true);
}

}  // namespace ghostlight
