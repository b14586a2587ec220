#pragma once

#include <QObject>

#include <glm/vec2.hpp>

#include <memory>
#include <optional>

#include "core/flare/pixel_probe.h"
#include "widgets/document.h"
#include "widgets/newest_job.h"

namespace ghostlight {

/// Names the ghosts at a place of the flare, off the GUI thread. The first question about a lens
/// and light has its ghosts drawn apart; those that follow are quick. It is about the active light
/// and the physics: gains, tints and offsets of artistic changes are not in it.
class ProbeJob : public QObject {
    Q_OBJECT
   public:
    explicit ProbeJob(Document& document, QObject* parent = nullptr);
    ~ProbeJob() override;

    /// What an answer is for.
    struct Purpose {
        glm::dvec2 point_mm{0.0, 0.0};
        bool picks = false;  ///< a click, whose strongest ghost is to be selected
        bool adds = false;
    };
    void ask(const Purpose& purpose);

   Q_SIGNALS:
    void answered(const ghostlight::ProbeJob::Purpose& purpose,
                  const ghostlight::ProbedPixel& pixel);

   private:
    struct Question {
        Prescription lens;  ///< configured
        FlareRequest request;
        Purpose purpose;
        std::uint64_t revision = 0;
    };
    void work(const Question& question, const std::stop_token& stop);

    Document& document_;
    std::optional<PixelProbe> probe_;  ///< of the lens and light below; the job's thread's alone
    Prescription probed_lens_;
    LightDirection probed_light_;
    Spectrum probed_spectrum_;
    double probed_tolerance_ = 0.0;
    std::unique_ptr<NewestJob<Question>> job_;
};

}  // namespace ghostlight
