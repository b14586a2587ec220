#pragma once

#include <optional>
#include <vector>

#include "core/ghosts/field_curves.h"
#include "core/optics/optical_system.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// From where a light comes whose image is at a place of the sensor: by the real chief ray's image
/// heights, the lens's distortion included.
class ImagePlace {
   public:
    /// Throws Error when no chief ray gets to the sensor.
    explicit ImagePlace(const OpticalSystem& system);
    /// Nothing beyond what the lens images.
    std::optional<LightDirection> light_at(double x_mm, double y_mm) const;

   private:
    std::vector<FieldPoint> curve_;  ///< image heights rising in size
};

}  // namespace ghostlight
