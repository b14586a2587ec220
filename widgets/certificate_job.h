#pragma once

#include <QObject>
#include <QTimer>

#include <atomic>
#include <cstdint>
#include <memory>

#include "core/flare/plan_proof.h"
#include "widgets/document.h"
#include "widgets/jobs.h"
#include "widgets/newest_job.h"

namespace ghostlight {

/// While the picture is at rest and everything else is done: proves, in the background, what the
/// search for where ghosts enter can have missed, in rounds of ever more work until all of it is
/// certified. Any change of the document ends it.
class CertificateJob : public QObject {
    Q_OBJECT
   public:
    CertificateJob(Document& document, Jobs& jobs, QObject* parent = nullptr);
    ~CertificateJob() override;

    /// True while a proof is under way or about to begin.
    bool is_busy() const { return is_busy_; }
    /// How long the picture has to be at rest before a proof begins.
    void set_delay_ms(int delay_ms) { rest_.setInterval(delay_ms); }

   Q_SIGNALS:
    void progressed(double share);
    /// A round is done; is_busy() tells whether another follows.
    void certified(std::shared_ptr<const ghostlight::PlanProof> proof);
    /// What was said of the last picture holds no more.
    void withdrawn();

   private:
    struct Task {
        Prescription lens;  ///< configured
        Scene scene;
        FlarePlan plan;
        std::uint64_t revision = 0;
    };
    void take_picture(const FlarePicture& picture);
    void begin();
    void withdraw();
    void work(const Task& task, const std::stop_token& stop);

    Document& document_;
    Jobs& jobs_;
    QTimer rest_;
    std::shared_ptr<const FlareImage> image_;  ///< the present one, when it is final
    std::uint64_t revision_ = 0;
    bool is_busy_ = false;
    std::unique_ptr<NewestJob<Task>> job_;
};

}  // namespace ghostlight
