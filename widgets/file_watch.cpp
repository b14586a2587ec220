#include "widgets/file_watch.h"

#include <QCryptographicHash>
#include <QFile>
#include <QFileInfo>

#include <utility>

#include "widgets/document.h"
#include "widgets/panels/banner.h"

namespace ghostlight {

namespace {

constexpr const char* topic = "disk";
/// Programs write a file in several steps: look when they are done.
constexpr int settle_ms = 200;

/// Empty when the file is not there or cannot be read.
QByteArray digest(const std::filesystem::path& path) {
    QFile file(QString::fromStdString(path.string()));
    QCryptographicHash hash(QCryptographicHash::Sha1);
    return file.open(QIODevice::ReadOnly) && hash.addData(&file) ? hash.result() : QByteArray();
}

}  // namespace

FileWatch::FileWatch(Document& document, Banner& banner, QObject* parent)
    : QObject(parent), document_(document), banner_(banner) {
    settle_.setSingleShot(true);
    settle_.setInterval(settle_ms);
    connect(&settle_, &QTimer::timeout, this, &FileWatch::look);
    // A file that is written aside and renamed is another file: its folder tells of that.
    connect(&watcher_, &QFileSystemWatcher::fileChanged, &settle_, qOverload<>(&QTimer::start));
    connect(&watcher_, &QFileSystemWatcher::directoryChanged, &settle_,
            qOverload<>(&QTimer::start));
    connect(&document_, &Document::opened, this, [this] {
        file_.clear();
        follow_document();
    });
    connect(&document_, &Document::file_changed, this, &FileWatch::follow_document);
    connect(&banner_, &Banner::offer_taken, this, [this](const QString& taken) {
        if (taken == topic) {
            answer(true);
        }
    });
    connect(&banner_, &Banner::offer_declined, this, [this](const QString& declined) {
        if (declined == topic) {
            answer(false);
        }
    });
    follow_document();
}

void FileWatch::follow_document() {
    const bool is_saved = !document_.is_modified() && document_.saved_at().isValid();
    if (document_.file() == file_ && !is_saved) {
        return;
    }
    file_ = document_.file();
    known_ = file_.empty() ? QByteArray() : digest(file_);
    banner_.clear(topic);
    watch();
}

void FileWatch::watch() {
    const QStringList before = watcher_.files() + watcher_.directories();
    if (!before.isEmpty()) {
        watcher_.removePaths(before);
    }
    if (file_.empty()) {
        return;
    }
    const QFileInfo info(QString::fromStdString(file_.string()));
    watcher_.addPath(info.absolutePath());
    if (info.exists()) {
        watcher_.addPath(info.absoluteFilePath());
    }
}

void FileWatch::look() {
    watch();
    const QByteArray now = file_.empty() ? QByteArray() : digest(file_);
    if (now == known_) {
        banner_.clear(topic);  // changed back
        return;
    }
    const QString name = QString::fromStdString(file_.filename().string());
    document_.lose_saved();
    if (now.isEmpty()) {
        known_.clear();
        banner_.show_text(topic, tr("%1 was removed by another program. The lens in hand is "
                                    "whole; saving writes it anew.")
                                     .arg(name));
        return;
    }
    if (now != found_ || banner_.text().isEmpty()) {
        found_ = now;
        banner_.show_offer(
            topic, tr("%1 was changed by another program. Reloading can be undone.").arg(name),
            tr("Reload"), tr("Keep Mine"));
    }
}

void FileWatch::answer(bool reload) {
    known_ = std::exchange(found_, {});
    if (!reload) {
        return;
    }
    if (const auto error = document_.reload()) {
        banner_.show_text(topic,
                          tr("The changed file cannot be read, and the lens in hand stays. ") +
                              QString::fromUtf8(error->what()));
    }
}

}  // namespace ghostlight
