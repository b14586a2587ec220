#pragma once

#include <stop_token>
#include <vector>

#include "core/fit/ghost_basis.h"
#include "core/fit/ghost_weights.h"
#include "core/fit/lens_move.h"
#include "core/fit/photo_model.h"

namespace ghostlight {

/// Columns of slopes by the place: x and y, a mm each, and rotation, a radian.
inline constexpr std::size_t place_slopes = 3;

/// Slopes of one ghost's picture by the place and by moves of lens and light (place_slopes +
/// moves columns), added to `to`. Of the picture that the basis is: the rays of its grid on
/// ceres::Jet, points that move on the sensor, corners of cut cells that move in the pupil, and
/// weights at given places of the pupil. `coefficients` as GhostWeights has them.
void add_picture_slopes(const FitScene& scene, const GhostBasis& basis, const LightDirection& light,
                        const PixelFrame& frame, const FitPlace& place,
                        const std::vector<double>& coefficients, const LensMoves& moves,
                        ModelPicture& to);

/// Of all ghosts, weights as they stand. Nothing when stopped; the same for any number of threads.
ModelPicture picture_slopes(const FitScene& scene, const std::vector<GhostBasis>& bases,
                            const GhostWeights& weights, const LightDirection& light,
                            const PixelFrame& frame, const FitPlace& place, const LensMoves& moves,
                            unsigned threads, std::stop_token stop);

}  // namespace ghostlight
