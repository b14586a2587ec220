#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/ghost_mesh.h"
#include "core/ghosts/ghost_path.h"
#include "core/optics/prescription.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// A second route to the picture, which shares with the reference only the trace of a ray: rays at
/// random over the whole entrance, each put where it lands, nothing interpolated and no pupil
/// searched for. Slow and noisy, and its noise is known.
struct RandomRaysRequest {
    LightDirection light;
    double wavelength_nm = 587.5618;
    int width_px = 320;
    int block_px = 16;  ///< sums are over square blocks of pixels, the last ones cut
    std::size_t rays_per_ghost = 100'000;
    std::uint64_t seed = 1;
    std::vector<GhostPath> only;  ///< empty = all ghosts of two reflections
    unsigned threads = 0;         ///< 0 = all cores; the result does not depend on it
};

/// Light of all ghosts together on blocks of the sensor, over E0.
struct RandomRays {
    PixelFrame pixels;
    int block_px = 16, across = 0, down = 0;
    std::vector<double> flux_mm2;      ///< of each block, row by row
    std::vector<double> variance_mm4;  ///< of that, from the scatter of the rays
    std::vector<std::size_t> hits;     ///< rays that landed in it
};

/// Throws Error like compile(). Returns nothing when stopped.
std::optional<RandomRays> random_rays(const Prescription& lens, const RandomRaysRequest& request,
                                      std::stop_token stop = {});

/// How well a picture with an error of its own agrees with random rays.
struct RayAgreement {
    std::size_t blocks = 0;  ///< compared; those with too few rays count as one
    double chi2 = 0.0;       ///< Σ difference² / (variance + the picture's error²)
    /// Where chi² lies in its distribution, in standard deviations of a normal one (E. B. Wilson
    /// and M. M. Hilferty, 1931): above 3 the two do not agree.
    double deviation = 0.0;
    double flux_ratio = 0.0;        ///< picture over rays, all blocks
    double flux_ratio_sigma = 0.0;  ///< of the rays
    /// Part of the chi² variance that is the picture's own error: how much that could excuse.
    double share_of_picture_error = 0.0;
};
/// `irradiance` and `error` are over the pixels of the rays' frame, row by row.
RayAgreement agreement(const RandomRays& rays, const std::vector<float>& irradiance,
                       const std::vector<float>& error);

}  // namespace ghostlight
