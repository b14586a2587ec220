#pragma once

#include <memory>
#include <mutex>
#include <stop_token>
#include <utility>
#include <vector>

#include "core/flare/fresnel.h"
#include "core/flare/spectrum.h"

namespace ghostlight {

struct FlareScene;

/// Groups of a spectrum's samples that one propagated field stands for: samples [first, last).
struct ColorGroup {
    std::size_t first = 0, last = 0;
    double middle_nm = 0.0;
};
std::vector<ColorGroup> color_groups(const std::vector<SpectralSample>& samples);

/// The stop's mask, its dirt included, as ghosts near their focus show it. That depends on their
/// Fresnel numbers alone and not on where the light is: fields are kept for the next picture.
/// Threads may use it together.
class PropagatedMasks {
   public:
    using Fields = std::shared_ptr<const std::vector<PropagatedMask>>;
    /// One field a colour group, of this Fresnel number at the scene's main wavelength, in the
    /// stop's own directions. Nothing when stopped.
    Fields of(const FlareScene& scene, double fresnel_number, const std::stop_token& stop);

   private:
    static constexpr std::size_t most_kept = 8;  ///< 5 MB each, for N from 4 up 20
    std::mutex mutex_;
    std::vector<std::pair<double, Fields>> kept_;
};

}  // namespace ghostlight
