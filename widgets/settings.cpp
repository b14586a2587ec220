#include "widgets/settings.h"

#include <QDir>
#include <QSettings>

#include <algorithm>

namespace ghostlight::settings {

QStringList recent_files() { return QSettings().value("recent_files").toStringList(); }

void add_recent_file(const QString& file) {
    QStringList files = recent_files();
    files.removeAll(file);
    files.prepend(file);
    while (files.size() > recent_limit) {
        files.removeLast();
    }
    QSettings().setValue("recent_files", files);
}

void forget_recent_file(const QString& file) {
    QStringList files = recent_files();
    files.removeAll(file);
    QSettings().setValue("recent_files", files);
}

Theme theme() {
    return QSettings().value("theme").toString() == "light" ? Theme::light : Theme::dark;
}

void set_theme(Theme theme) {
    QSettings().setValue("theme", theme == Theme::light ? "light" : "dark");
}

Look look() {
    const QSettings stored;
    return {
        std::clamp(stored.value("text_scale", 1.0).toDouble(), least_text_scale, most_text_scale),
        stored.value("safe_colors", false).toBool()};
}

void set_look(const Look& look) {
    QSettings stored;
    stored.setValue("text_scale", look.text_scale);
    stored.setValue("safe_colors", look.safe_colors);
}

bool tour_is_due() { return !QSettings().value("tour_seen", false).toBool(); }

void set_tour_seen() { QSettings().setValue("tour_seen", true); }

bool is_news(const QString& remark) {
    QSettings stored;
    const bool is_new = stored.value("told").toString() != remark;
    stored.setValue("told", remark);
    return is_new;
}

FlareEngine flare_engine() {
    return parse_engine(QSettings().value("flare_engine").toString().toStdString())
        .value_or(FlareEngine::automatic);
}

void set_flare_engine(FlareEngine engine) {
    QSettings().setValue("flare_engine", QString::fromLatin1(engine_name(engine)));
}

QByteArray window_geometry() { return QSettings().value("window/geometry").toByteArray(); }

QByteArray window_state() { return QSettings().value("window/state").toByteArray(); }

void set_window(const QByteArray& geometry, const QByteArray& state) {
    QSettings stored;
    stored.setValue("window/geometry", geometry);
    stored.setValue("window/state", state);
}

double ghost_threshold() { return QSettings().value("ghost_threshold", 0.0).toDouble(); }

void set_ghost_threshold(double share) { QSettings().setValue("ghost_threshold", share); }

bool shows_aspheres() { return QSettings().value("columns/aspheres", false).toBool(); }

void set_shows_aspheres(bool shown) { QSettings().setValue("columns/aspheres", shown); }

bool shows_comments() { return QSettings().value("columns/comments", false).toBool(); }

void set_shows_comments(bool shown) { QSettings().setValue("columns/comments", shown); }

QString folder() { return QSettings().value("folder", QDir::homePath()).toString(); }

void set_folder(const QString& folder) { QSettings().setValue("folder", folder); }

QStringList glass_folders() { return QSettings().value("glass_folders").toStringList(); }

void set_glass_folders(const QStringList& folders) {
    QSettings().setValue("glass_folders", folders);
}

}  // namespace ghostlight::settings
