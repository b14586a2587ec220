#pragma once

#include <QObject>
#include <QTimer>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"
#include "core/ghosts/ghost_table.h"
#include "render/gl_flare/flare_engines.h"
#include "widgets/document.h"
#include "widgets/layered_picture.h"
#include "widgets/newest_job.h"
#include "widgets/selection.h"

namespace ghostlight {

/// A picture, and what it is a picture of.
struct FlarePicture {
    std::shared_ptr<const FlareImage> image;
    std::uint64_t revision = 0;
    std::chrono::steady_clock::time_point changed_at{};  ///< of that revision
    bool is_final = false;                ///< else a coarse one, to be followed by a finer
    bool is_first_look = false;           ///< of a lens just opened: each ghost from a few rays
    std::vector<ShownLayer> layers = {};  ///< that the image is the sum of, without their gains
};

/// The work behind the views, off the GUI thread: after every change a coarse picture at once (for
/// a lens just opened a first look even before), a fine one next, then, once, the trial of the
/// engines, and the ghost table when the hand has come to rest. Newer changes replace older
/// ones. A coarse picture that is done while the light moves on is still shown, so that there is
/// motion; every other result that is out of date is dropped.
class Jobs : public QObject {
    Q_OBJECT
   public:
    Jobs(Document& document, Selection& selection, MakeGlEngine make_gl = offscreen_gl_engine,
         QObject* parent = nullptr);
    ~Jobs() override;

    /// True while a result for the document's present revision is still to come.
    bool is_busy() const { return flare_open_ || table_open_; }
    bool awaits_table() const { return table_open_; }
    /// What flares are drawn with from the next picture on; pictures at rest are drawn anew.
    void set_engine(FlareEngine wish);
    /// Gives up the ghost table until the next change.
    void cancel_table();

   Q_SIGNALS:
    /// Which engine is in use, and why; after every change of it.
    void engine_changed(const ghostlight::EngineState& state);
    void flare_ready(const ghostlight::FlarePicture& picture);
    void table_ready(std::shared_ptr<const ghostlight::GhostTable> table);
    void table_progress(double share);
    void table_cancelled();
    /// The lens cannot be traced as it stands, and why.
    void failed(const QString& reason);
    /// All results for the present revision are there, or have failed.
    void settled();

   private:
    struct Snapshot {
        Prescription lens;  ///< configured
        Scene scene;
        std::vector<GhostPath> highlighted;
        std::uint64_t revision = 0;
        std::uint64_t serial = 0;
        std::chrono::steady_clock::time_point changed_at{};
        bool coarse_first = false;
        bool first_look = false;
        FlareEngine engine = FlareEngine::automatic;
    };
    Snapshot snapshot(std::uint64_t serial) const;
    /// What the ghost table is made from: changes of anything else leave it as it is.
    struct TableSubject {
        Prescription lens;
        std::string configuration;
        LightDirection light;
        Spectrum spectrum;
        double tolerance = 0.0;
        bool operator==(const TableSubject&) const = default;
    };
    TableSubject table_subject() const;
    void follow_document();
    void request_flare(bool coarse_first);
    void request_table();
    void work_on_flare(const Snapshot& snapshot, const std::stop_token& stop);
    void draw_flare(const Snapshot& snapshot, const std::stop_token& stop);
    void show(LayeredPicture::Result made, const Snapshot& snapshot, bool is_final,
              bool is_first_look);
    void report_engine();
    void work_on_table(const Snapshot& snapshot, const std::stop_token& stop);
    void take_flare(const FlarePicture& picture, std::uint64_t serial);
    void take_table(std::shared_ptr<const GhostTable> table, std::uint64_t serial);
    void fail(const QString& reason, std::uint64_t serial, bool& open, std::uint64_t newest);
    void close(bool& open);

    Document& document_;
    Selection& selection_;
    QTimer table_delay_;
    std::uint64_t flare_serial_ = 0;
    std::uint64_t table_serial_ = 0;
    bool flare_open_ = false;
    bool table_open_ = false;
    std::optional<TableSubject> table_subject_;  ///< of the table that is there or to come
    bool awaits_first_look_ = true;
    FlareEngine engine_ = FlareEngine::automatic;
    // These belong to the flare's thread.
    FlareEngines engines_;
    EngineState reported_;
    std::optional<FlareEngine> drawn_with_;
    int coarseness_ = 0;                          ///< of coarse pictures
    std::shared_ptr<const FlarePlan> last_plan_;  ///< where the next picture looks first
    int turn_ = 0;
    LayeredPicture layered_;
    std::unique_ptr<NewestJob<Snapshot>> flare_job_;
    std::unique_ptr<NewestJob<Snapshot>> table_job_;
};

}  // namespace ghostlight
