#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/artistic.h"
#include "core/flare/flare_image.h"
#include "core/flare/flare_plan.h"
#include "core/flare/flare_scene.h"
#include "core/flare/light_pattern.h"
#include "core/flare/spread_mesh.h"

namespace ghostlight {

/// Moments of each ghost's light, from the first look of the planned picture: ghosts in the order
/// of `paths`. Nothing when stopped.
std::optional<std::vector<GhostSpot>> ghost_spots(const FlareScene& scene,
                                                  const std::vector<GhostPath>& paths,
                                                  const FlareRequest& request,
                                                  std::stop_token stop = {});

/// The planned picture of a light of some extent, and of ghosts that an artist has changed.
///
/// A small turn of the light moves a ghost over the sensor, nearly rigidly; how far follows from
/// its centroids. Its picture is then the point light's, folded with the light's pattern as that
/// ghost maps it. Where flux or size change over the pattern by more than `rigid_share`, the
/// pattern is cut into up to 6 × 6 patches, each drawn for a direction of its own. Folding is done
/// at a scale where the pattern has a dozen pixels. Bit-identical for any number of threads.
/// Returns nothing when stopped.
std::optional<FlareImage> render_extended(const FlareScene& scene, const FlareRequest& request,
                                          const LightPattern& pattern, const Artistic& artistic,
                                          std::stop_token stop = {});

/// How a path's picture is drawn out by a light's shape, and how far, px.
struct ImageSpread {
    GhostShift shift;
    int pad_px = 0;
};
/// Nothing when stopped.
std::optional<ImageSpread> image_spread(const FlareScene& scene, const FlareRequest& request,
                                        const LightPattern& pattern, const GhostPath& path,
                                        std::stop_token stop = {});

/// A point light's picture, drawn with `spread.pad_px` more on every side, folded with the light's
/// shape and cut to the request's width.
FlareImage spread_image(const FlareImage& wide, const ImageSpread& spread,
                        const LightPattern& pattern, const LightDirection& light,
                        const FlareRequest& request);

/// The same by any engine, as the mean over `across` × `across` patches of the pattern.
std::optional<FlareImage> render_sampled(const Prescription& lens, const FlareRequest& request,
                                         const LightPattern& pattern, int across,
                                         std::stop_token stop = {});

/// image += gain × other, flux and counts with it; of the same size. `gain` by channel: linear
/// Rec.709, irradiance.
void add_image(FlareImage& image, const FlareImage& other, const std::array<double, 4>& gain);

/// Moves a picture by whole pixels; what comes in is dark.
void move_image(FlareImage& image, int right_px, int up_px);

}  // namespace ghostlight
