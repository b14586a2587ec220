#pragma once

#include <QDateTime>
#include <QObject>
#include <QString>
#include <QTimer>

#include <optional>

#include "widgets/document.h"

namespace ghostlight {

/// Unsaved edits that a program which ended without closing left behind.
struct LeftoverEdits {
    QString autosave;  ///< where they are
    std::filesystem::path file;
    QDateTime time;
    DocumentState state;
};

/// Keeps a copy of unsaved edits aside, a moment after each, and removes it when they are saved
/// or given up.
class Autosave : public QObject {
    Q_OBJECT
   public:
    Autosave(Document& document, const QString& folder, QObject* parent = nullptr);
    ~Autosave() override;

    static QString default_folder();
    /// The newest copy of which no running program takes care.
    static std::optional<LeftoverEdits> find_leftover(const QString& folder);

    void write_now();

   private:
    void follow_document();
    void remove();

    Document& document_;
    QString file_;
    QTimer delay_;
};

}  // namespace ghostlight
