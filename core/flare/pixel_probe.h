#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/color_mesh.h"
#include "core/flare/flare_image.h"
#include "core/flare/ghost_mesh.h"

namespace ghostlight {

/// What one ghost leaves in a pixel.
struct GhostInPixel {
    GhostPath path;
    double irradiance = 0.0;  ///< mean over the pixel, over E0
    double share = 0.0;       ///< of all ghosts together there
};

/// Which ghosts light a pixel.
struct ProbedPixel {
    int column = 0, row = 0;           ///< from the sensor's lowest x and y, as in FlareImage
    double irradiance = 0.0;           ///< of all ghosts together, over E0
    std::vector<GhostInPixel> ghosts;  ///< those that reach it, the strongest first
};

/// The ghosts of a picture apart from one another, to be asked pixel by pixel. They are drawn by
/// the plan of the picture (or uniformly, where that cannot plan), each at the picture's full size,
/// and kept as outlines: so many numbers as there are edges, not pixels times ghosts.
class PixelProbe {
   public:
    /// Takes the request's light, spectrum, tolerance and width. Throws Error like compile().
    /// Nothing when stopped.
    static std::optional<PixelProbe> make(const Prescription& lens, const FlareRequest& request,
                                          std::stop_token stop = {});

    /// The pixel that a point of the sensor is in; nothing beside the sensor. Up to a millisecond
    /// for each ghost that covers its row.
    std::optional<ProbedPixel> at(double x_mm, double y_mm) const;

   private:
    struct Ghost {
        GhostPath path;
        std::vector<ColorMesh<gray_channels>> meshes;
        double lowest_px = 0.0, highest_px = 0.0;  ///< rows that it may reach
    };
    PixelFrame frame_;
    std::vector<Ghost> ghosts_;

    void bound(Ghost& ghost) const;
    static bool draw_planned(const FlareScene& scene, const FlareRequest& request,
                             const std::stop_token& stop, PixelProbe& probe);
    static bool draw_uniform(const Prescription& lens, const FlareRequest& request,
                             const std::stop_token& stop, PixelProbe& probe);
};

}  // namespace ghostlight
