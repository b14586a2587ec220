#pragma once

#include <array>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/mask_raster.h"
#include "core/flare/polar_pattern.h"

namespace ghostlight {

/// What the direct beam meets at the stop.
struct PatternMask {
    StopMask stop;
    StopDirt dirt;
    std::optional<ApertureOutline> beam;  ///< what else limits it, where something does
};

/// Beyond this Fresnel number fringes are finer than the transform's grid: light goes straight.
inline constexpr double most_fresnel_number = 40.0;

/// The pattern of any mask, by discrete Fourier transforms of its raster: one coarse and wide
/// padded for the core, one fine for the rest; beyond that, as the outermost octave goes on, ∝ 1/k³
/// in every direction. With a Fresnel number other than 0 the sensor is out of focus by it, and the
/// mask carries the phase π N ρ² (physics.md §9: Collins): k = 2π N ρ is then where a ray through ρ
/// lands, and for a negative number −k. Beyond `most_fresnel_number` the rays alone. Nothing when
/// stopped.
std::optional<PolarPattern> masked_pattern(const PatternMask& mask, double fresnel_number,
                                           double last_k, unsigned threads,
                                           const std::stop_token& stop = {});

/// |F|² of a raster on a grid of k, by a transform padded to `across` pixels.
class PowerGrid {
   public:
    PowerGrid(const MaskRaster& raster, int across, double fresnel_number, unsigned threads,
              const std::stop_token& stop = {});
    /// Of two rasters without phases by one transform, the one as its real and the other as its
    /// imaginary part.
    static std::array<PowerGrid, 2> of_two(const MaskRaster& a, const MaskRaster& b, int across,
                                           unsigned threads, const std::stop_token& stop = {});
    bool is_complete() const { return is_complete_; }
    double step() const { return step_; }
    /// At grid indices from −across/2 to across/2 − 1.
    double at(int i, int j) const;
    /// Bilinear between them.
    double at_k(double kx, double ky) const;

   private:
    PowerGrid(int across, double pitch);
    /// Pixels are means: their own spectrum is divided out.
    void sharpen(double pitch);

    int across_ = 0;
    double step_ = 0.0;
    bool is_complete_ = false;
    std::vector<float> power_;
};

}  // namespace ghostlight
