#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/flare_image.h"
#include "core/flare/planned_ghost.h"

namespace ghostlight {

/// All ghosts of a scene after their first look, each with its share of the error asked for. The
/// weakest are left out, by their bounds, as long as these add up to a small part of that error.
/// Nothing when stopped.
std::optional<std::vector<ProbedGhost>> probe_all(const FlareScene& scene,
                                                  const GhostPlanner& planner,
                                                  const FlareRequest& request,
                                                  std::stop_token stop);

/// The plan of ghosts that have been drawn; takes what is planned of each.
FlarePlan plan_of(const FlareScene& scene, const FlareRequest& request,
                  std::vector<ProbedGhost>& ghosts);

/// Errors of ghosts that lie over each other make up for each other in part, the more of them share
/// the light: what their sum may be over what it is taken for, 1 for few ghosts. `fluxes_mm2` of
/// those that are drawn.
double made_up(const std::vector<double>& fluxes_mm2);

}  // namespace ghostlight
