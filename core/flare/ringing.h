#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/draw_picture.h"
#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"
#include "core/flare/planned_ghost.h"
#include "core/flare/rung_mesh.h"

namespace ghostlight {

/// What diffraction at their rims changes of a picture's ghosts, once these are drawn: irradiance
/// × (the straight edge's profile − 1) inside of a rim and × the profile outside, at the depth that
/// every pixel's ray has where the rim is cut: at every crossing of the stop, and at the surface
/// whose clear radius cuts most; at a corner the product. Where the last crossing's Fresnel number
/// is small, the whole mask propagated, its dirt included. Each profile is the spectrum's, at each
/// wavelength's own Fresnel number, and takes from a ghost in all as much as it gives.
///
/// Left as they are: rims whose fringes would be finer than a pixel or than what the picture's
/// size misplaces, or that are too close to their focus (below `least_propagated`); and of a whole
/// picture's ghosts those whose fringes change least for the work that they are, as long as all
/// that they would change is less than half of its tolerance. Ghosts in the order of `ghosts`;
/// nothing when stopped. Meshes of ghosts that are left out have RungMesh::left_out_mm2 alone.
std::optional<std::vector<RungMesh>> ringing_of(const FlareScene& scene,
                                                const FlareRequest& request,
                                                const GhostPlanner& planner,
                                                const std::vector<ProbedGhost>& ghosts,
                                                const std::stop_token& stop);

/// Of one ghost, drawn at its plan's level, for those who draw ghosts one by one. Empty where what
/// its fringes change is less than an equal share of what may be left out of a layer of this light
/// and so many ghosts.
RungMesh ringing_of(const FlareScene& scene, const FlareRequest& request,
                    const GhostPlanner& planner, const ProbedGhost& ghost, double layer_flux_mm2,
                    std::size_t ghosts, const std::stop_token& stop);

/// Names those that are drawn in FlareImage::ringing; what is left out in all.
FringesLeftOut take_reports(const std::vector<RungMesh>& rung, FlareImage& image);

/// Adds that to the levels of a picture that is not finished. False when stopped.
template <int C>
bool draw_ringing(const std::vector<RungMesh>& rung, const PixelFrame& frame, unsigned threads,
                  const std::stop_token& stop, LevelPictures<C>& picture);

/// Both, for a picture that is finished, whose plan, if it has one, says what is drawn. Fills
/// FlareImage::ringing and times.ringing_ms. False when stopped.
bool add_ringing(const FlareScene& scene, const FlareRequest& request, const std::stop_token& stop,
                 FlareImage& image);

}  // namespace ghostlight
