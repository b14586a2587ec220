#pragma once

#include <QWidget>

#include <chrono>
#include <memory>

#include "core/flare/plan_proof.h"
#include "widgets/jobs.h"

namespace ghostlight {

class Document;
class TabularLabel;

/// The bottom line: what was computed, how well, how fast, on what, and whether it is saved.
class StatusLine : public QWidget {
    Q_OBJECT
   public:
    explicit StatusLine(Document& document, QWidget* parent = nullptr);

    void show_table(const GhostTable& table);
    void show_progress(double share);
    /// A picture is on screen: its parts, and the time since the change that asked for it.
    void show_picture(const FlarePicture& picture, double upload_ms);
    /// What draws the flare; says why where OpenGL has failed.
    void show_engine(const EngineState& state);
    /// How far the proof of the search for ghosts is, or what it came to.
    void show_proving(double share);
    void show_proof(const std::shared_ptr<const PlanProof>& proof);
    void clear_proof();
    /// A thing that was done ("Wrote flare.exr"), until the next change.
    void show_message(const QString& message);
    QString timing_text() const;
    QString table_text() const;
    QString picture_text() const;
    QString engine_text() const;
    QString proof_text() const;
    QString message_text() const;

   private:
    void follow_document();
    void show_saved();
    void show_plan(const FlarePlan& plan);
    void show_without_plan(std::size_t ghosts);

    Document& document_;
    TabularLabel* table_;
    TabularLabel* timing_;
    TabularLabel* picture_;
    TabularLabel* proof_;
    TabularLabel* message_;
    TabularLabel* engine_;
    TabularLabel* saved_;
    std::uint64_t timed_revision_ = 0;
    QString proven_;  ///< what the last proof came to
};

}  // namespace ghostlight
