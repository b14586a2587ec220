#include "widgets/autosave.h"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonValue>
#include <QStandardPaths>

#include "core/io/lens_file.h"

namespace ghostlight {

namespace {

/// A crash costs at most the last 2 s: half of that, so that a busy machine has time to write. It
/// runs from the first edit after a copy, since a hand that never rests must not put it off.
constexpr int delay_ms = 1000;
/// In the copy: which file the edits belong to.
constexpr const char* origin_field = "autosaved_from";

/// By a program of this name: the numbers of those that ended are given to others.
bool is_running(const QString& process_id) {
    const QString program = QFile::symLinkTarget("/proc/" + process_id + "/exe");
    return !program.isEmpty() && QFileInfo(program).fileName() ==
                                     QFileInfo(QCoreApplication::applicationFilePath()).fileName();
}

}  // namespace

Autosave::Autosave(Document& document, const QString& folder, QObject* parent)
    : QObject(parent),
      document_(document),
      file_(QDir(folder).filePath(QString::number(QCoreApplication::applicationPid()) + ".json")) {
    QDir().mkpath(folder);
    delay_.setSingleShot(true);
    delay_.setInterval(delay_ms);
    connect(&delay_, &QTimer::timeout, this, &Autosave::write_now);
    connect(&document_, &Document::changed, this, &Autosave::follow_document);
    connect(&document_, &Document::file_changed, this, &Autosave::follow_document);
}

Autosave::~Autosave() { remove(); }

QString Autosave::default_folder() {
    return QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation) + "/unsaved";
}

std::optional<LeftoverEdits> Autosave::find_leftover(const QString& folder) {
    const QFileInfoList copies = QDir(folder).entryInfoList({"*.json"}, QDir::Files, QDir::Time);
    for (const QFileInfo& copy : copies) {
        if (is_running(copy.baseName())) {
            continue;
        }
        try {
            Prescription lens = read_lens(copy.filePath().toStdString()).lens;
            const auto origin = lens.unknown.extract(origin_field);
            LeftoverEdits found;
            if (origin) {
                const auto text = "[" + QByteArray::fromStdString(origin.mapped()) + "]";
                found.file = QJsonDocument::fromJson(text)[0].toString().toStdString();
            }
            found.autosave = copy.filePath();
            found.time = copy.lastModified();
            found.state = document_from_lens(std::move(lens));
            return found;
        } catch (const Error&) {
            QFile::remove(copy.filePath());  // nothing in it to recover
        }
    }
    return std::nullopt;
}

void Autosave::follow_document() {
    if (document_.is_modified()) {
        if (!delay_.isActive()) {
            delay_.start();
        }
    } else {
        remove();
    }
}

void Autosave::write_now() {
    DocumentState state = document_.state();
    const QByteArray origin =
        QJsonDocument(QJsonArray{QString::fromStdString(document_.file().string())})
            .toJson(QJsonDocument::Compact);
    state.lens.unknown[origin_field] = origin.mid(1, origin.size() - 2).toStdString();
    try {
        write_file_safely(file_.toStdString(), document_to_json(state));
    } catch (const Error&) {
        // A copy that cannot be kept must not disturb the work; saving will say what is wrong.
    }
}

void Autosave::remove() {
    delay_.stop();
    QFile::remove(file_);
}

}  // namespace ghostlight
