#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/fit/fit_scene.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// One meeting of the light with an interface that does something to it.
struct FilmEvent {
    std::size_t surface = 0;
    bool forward = true, reflects = false;
};
std::vector<FilmEvent> film_events(const FitScene& scene, const GhostPath& path);

/// One ray that stands for its part of the pupil: what films need of it.
struct FilmRay {
    std::vector<double> cosines;  ///< of incidence, event by event, wavelengths running faster
    std::vector<double> passed;   ///< by the glasses, wavelength by wavelength; empty: all
    std::vector<double> turn_cos, turn_sin;  ///< of the frame of s and p into each event's plane
};
/// The ray through u, v (mm across the beam): in double at every geometry node, its cosines
/// interpolated to every wavelength.
FilmRay film_ray(const FitScene& scene, const GhostPath& path, const BeamFrame& frame,
                 const std::array<double, 2>& place);

}  // namespace ghostlight
