#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/glare_spread.h"
#include "core/flare/spectrum.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// How the veiling glare index is worked out.
struct VeilingIndexRequest {
    Spectrum spectrum = Monochromatic{};
    double last_deg = 88.0;  ///< of the bright surround: to there, from the axis
    int fields = 44;         ///< rings of it, equally wide
    int azimuths = 4;        ///< in a quarter of a turn: the sensor is no circle
    GlareSpread spread;      ///< scatter to count in
    unsigned threads = 0;
};

/// Light of one ring of the surround.
struct VeilingRing {
    double field_deg = 0.0;  ///< its middle
    double solid_angle_sr = 0.0;
    double ghosts_mm2 = 0.0;     ///< flux of all ghosts on the sensor / E0, mean over the ring
    double center_per_e0 = 0.0;  ///< their irradiance / E0 at the sensor's middle
    double direct_mm2 = 0.0;     ///< the image's flux where that is on the sensor / E0
};

/// The veiling glare index of ISO 9358 for a small black spot in an evenly bright surround of
/// radiance L: irradiance in the spot's image over that of the white around it. Irradiances here
/// are over L, in steradians.
struct VeilingIndex {
    std::vector<VeilingRing> rings;
    double glare_sr = 0.0, direct_sr = 0.0;                ///< means over the sensor
    double center_glare_sr = 0.0, center_direct_sr = 0.0;  ///< at its middle
    double outside_share = 0.0;  ///< of the glare that comes from beyond the picture
    double scatter_share = 0.0;  ///< of the direct light, as asked
    double index() const { return of(glare_sr, direct_sr); }
    double center_index() const { return of(center_glare_sr, center_direct_sr); }

   private:
    double of(double glare, double direct) const {
        const double all = glare + scatter_share * direct;
        return all + direct > 0.0 ? all / (all + direct) : 0.0;
    }
};

/// Integrates the planned pictures of all two-reflection ghosts over the surround. The spot takes
/// no light away; there is no barrel, no sensor reflection that the lens does not state, no scatter
/// but the one asked for, which is taken to be even, and no ghost of four reflections: the index
/// of a real lens is higher. Throws Error like compile(); nothing when stopped. `progress` is
/// called with the share done.
std::optional<VeilingIndex> veiling_index(const Prescription& lens,
                                          const VeilingIndexRequest& request = {},
                                          std::stop_token stop = {},
                                          const std::function<void(double)>& progress = {});

}  // namespace ghostlight
