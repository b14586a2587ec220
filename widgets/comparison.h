#pragma once

#include <QObject>
#include <QTimer>

#include <memory>
#include <optional>

#include "core/flare/flare_image.h"
#include "core/ghosts/ghost_table.h"
#include "widgets/document.h"
#include "widgets/newest_job.h"

namespace ghostlight {

/// The pinned lens A, seen in the light of the lens that is edited on, B: its flare and its ghost
/// table follow the light, its own numbers stay. Not saved.
class Comparison : public QObject {
    Q_OBJECT
   public:
    explicit Comparison(Document& document, QObject* parent = nullptr);
    ~Comparison() override;

    bool is_pinned() const { return pinned_.has_value(); }
    /// A is the document as it is now.
    void pin();
    void unpin();
    const std::optional<DocumentState>& pinned() const { return pinned_; }
    /// A picture or table of A is still to come.
    bool is_busy() const { return open_; }

   Q_SIGNALS:
    void pinned_changed();
    void picture_ready(std::shared_ptr<const ghostlight::FlareImage> image);
    void table_ready(std::shared_ptr<const ghostlight::GhostTable> table);
    void failed(const QString& reason);

   private:
    struct Wanted {
        Prescription lens;  ///< configured
        Scene scene;        ///< of the document in hand
        std::uint64_t serial = 0;
    };
    void follow_document();
    void submit();
    void work(const Wanted& wanted, const std::stop_token& stop);

    Document& document_;
    std::optional<DocumentState> pinned_;
    std::optional<Scene> scene_;  ///< that the last results are for
    QTimer delay_;
    std::uint64_t serial_ = 0;
    bool open_ = false;
    std::unique_ptr<NewestJob<Wanted>> job_;
};

}  // namespace ghostlight
