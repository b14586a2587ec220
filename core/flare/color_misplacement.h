#pragma once

namespace ghostlight {

struct MeshNodes;
struct PixelFrame;

/// L1 distance of the pictures of two grids over the same cells of the entrance, as a share of the
/// first one's light on the frame; 0 where neither has any there. The second takes the first one's
/// weights, one a node: only where light lands and what is clipped makes the difference. Pictures
/// are small ones of the part of the frame that either reaches.
double picture_distance(const MeshNodes& first, const MeshNodes& second, const PixelFrame& frame);

/// What drawing a ghost's colours in bands gets wrong.
struct ColorMisplacement {
    /// picture_distance() of the main geometry wavelength to the outer ones, their mean.
    double distance = 0.0;
    double shift_px = 0.0;       ///< between the outer ones
    double failing_share = 0.0;  ///< of its rays, that fail in some colours and not in others

    /// Share of the light that `bands` bands misplace: of a sharp edge that a spectrum spreads
    /// evenly over D pixels, n steps leave D/(2n) pixels in error, less where a step is within a
    /// pixel.
    double error(int bands) const;
    /// The fewest bands within an error.
    int bands_for(double error, int most) const;
};

}  // namespace ghostlight
