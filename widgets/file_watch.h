#pragma once

#include <QByteArray>
#include <QFileSystemWatcher>
#include <QObject>
#include <QTimer>

#include <filesystem>

namespace ghostlight {

class Banner;
class Document;

/// Notices when another program changes or removes the file of the lens in hand, and offers to read
/// it again. What is in hand is never touched without being asked, and counts as unsaved from then
/// on, since no file holds it.
class FileWatch : public QObject {
    Q_OBJECT
   public:
    FileWatch(Document& document, Banner& banner, QObject* parent = nullptr);

   private:
    void follow_document();
    void watch();
    void look();
    void answer(bool reload);

    Document& document_;
    Banner& banner_;
    QFileSystemWatcher watcher_;
    QTimer settle_;
    std::filesystem::path file_;
    QByteArray known_;  ///< a digest of the content that was read, written, or declined
    QByteArray found_;  ///< of the content that is offered
};

}  // namespace ghostlight
