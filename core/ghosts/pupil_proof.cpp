#include "core/ghosts/pupil_proof.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/ghosts/cell_proof.h"
#include "core/ghosts/reflectance_bound.h"

namespace ghostlight {
namespace {

/// A cell of the half u ≥ 0 that light may pass through.
struct OpenCell {
    PupilBox box;
    double reflectance = 1.0;  ///< bound of the product over the path's reflections
    std::size_t number = 0;    ///< in order of making: ties are broken the same way always

    double bound_mm2() const { return 2.0 * box.area_mm2() * reflectance; }
    bool operator<(const OpenCell& other) const {
        const double mine = bound_mm2(), theirs = other.bound_mm2();
        return mine != theirs ? mine < theirs : number > other.number;
    }
};

/// All points of the entrance plane from which a ray can meet the first surface within its clear
/// radius; only u ≥ 0.
PupilBox reachable_half(const ProofPath& path, const BeamFrame& frame) {
    const Interval within{-path.steps.front().limit_mm, path.steps.front().limit_mm};
    const Interval v =
        frame.e2.x * within + frame.e2.y * within + frame.e2.z * path.steps.front().sag_mm;
    const Interval u =
        frame.e1.x * within + frame.e1.y * within + frame.e1.z * path.steps.front().sag_mm;
    return {0.0, u.magnitude(), v.low, v.high};
}

/// The parts of a half box outside a claim.
std::vector<PupilBox> outside(const PupilBox& half, const PupilBox& claimed) {
    const double u1 = std::min(half.u1_mm, std::max(std::abs(claimed.u0_mm), claimed.u1_mm));
    const double v0 = std::max(half.v0_mm, claimed.v0_mm);
    const double v1 = std::min(half.v1_mm, claimed.v1_mm);
    if (!(claimed.area_mm2() > 0.0) || !(v0 < v1)) return {half};
    std::vector<PupilBox> parts;
    auto add = [&](const PupilBox& part) {
        if (part.u1_mm > part.u0_mm && part.v1_mm > part.v0_mm) parts.push_back(part);
    };
    add({0.0, half.u1_mm, half.v0_mm, v0});
    add({0.0, half.u1_mm, v1, half.v1_mm});
    add({u1, half.u1_mm, v0, v1});
    return parts;
}

class PupilProver {
   public:
    PupilProver(const OpticalSystem& system, const GhostPath& ghost, const BeamFrame& frame,
                const ProofEffort& effort)
        : path_(proof_path(system, ghost)), frame_(frame), effort_(effort) {
        for (const PathEvent& event : events(ghost, system.surfaces.size())) {
            if (!event.reflects) continue;
            const Film& film = system.surfaces[event.surface].film;
            films_.emplace_back(event.forward ? film : reversed(film));
        }
    }

    PupilProof prove(const PupilBox& claimed, std::stop_token stop) {
        for (const PupilBox& part : outside(reachable_half(path_, frame_), claimed)) {
            proof_.searched_mm2 += 2.0 * part.area_mm2();
            judge(part, most_reflected({{0.0, 1.0}, {0.0, 1.0}}));
        }
        while (!open_.empty() && bound_mm2_ > effort_.enough_mm2 &&
               proof_.cells < effort_.most_cells) {
            if (stop.stop_requested()) {
                proof_.finished = false;
                break;
            }
            std::pop_heap(open_.begin(), open_.end());
            const OpenCell cell = open_.back();
            open_.pop_back();
            bound_mm2_ -= cell.bound_mm2();
            const PupilBox& box = cell.box;
            PupilBox low = box, high = box;
            if (box.u1_mm - box.u0_mm > box.v1_mm - box.v0_mm)
                low.u1_mm = high.u0_mm = 0.5 * (box.u0_mm + box.u1_mm);
            else
                low.v1_mm = high.v0_mm = 0.5 * (box.v0_mm + box.v1_mm);
            judge(low, cell.reflectance);
            judge(high, cell.reflectance);
        }
        // Summed anew: the running sum has picked up rounding.
        for (const OpenCell& cell : open_) {
            proof_.uncertain_mm2 += 2.0 * cell.box.area_mm2();
            proof_.missed_flux_bound_mm2 += cell.bound_mm2();
        }
        return proof_;
    }

   private:
    /// A cell is begun anew on what is left of it this often at most: each time halves it.
    static constexpr int most_restarts = 40;

    ProofPath path_;
    BeamFrame frame_;
    ProofEffort effort_;
    std::vector<ReflectanceBound> films_;
    std::vector<OpenCell> open_;  ///< a heap, the largest bound first
    double bound_mm2_ = 0.0;
    std::size_t made_ = 0;
    PupilProof proof_;

    double most_reflected(const Interval (&cosine)[2]) const {
        double product = 1.0;
        for (std::size_t k = 0; k < films_.size() && k < 2; ++k)
            product *= films_[k].over(cosine[k]);
        return product;
    }

    void judge(PupilBox box, double reflectance) {
        for (int restart = 0; restart < most_restarts; ++restart) {
            ++proof_.cells;
            const CellVerdict verdict = prove_cell(path_, frame_, box, effort_.on_sensor);
            if (!verdict.may_pass) return;
            reflectance = std::min(reflectance, most_reflected(verdict.cosine));
            const double before = box.area_mm2();
            box = verdict.live;
            if (box.area_mm2() > restart_below * before) break;
        }
        if (!(box.area_mm2() > 0.0) || reflectance == 0.0) return;
        open_.push_back({box, reflectance, made_++});
        bound_mm2_ += open_.back().bound_mm2();
        std::push_heap(open_.begin(), open_.end());
    }
    static constexpr double restart_below = 0.7;  ///< of its area left, a cell is judged again
};

}  // namespace

PupilProof prove_pupil(const OpticalSystem& system, const GhostPath& ghost, const BeamFrame& frame,
                       const PupilBox& claimed, const ProofEffort& effort, std::stop_token stop) {
    return PupilProver(system, ghost, frame, effort).prove(claimed, std::move(stop));
}

double flux_bound_mm2(const OpticalSystem& system, const GhostPath& ghost, const BeamFrame& frame,
                      const ProofEffort& effort) {
    return prove_pupil(system, ghost, frame, {}, effort).missed_flux_bound_mm2;
}

}  // namespace ghostlight
