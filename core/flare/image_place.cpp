#include "core/flare/image_place.h"

#include <cmath>

#include "core/error.h"
#include "core/units.h"

namespace ghostlight {

ImagePlace::ImagePlace(const OpticalSystem& system) {
    const double needed_mm = 0.6 * std::hypot(system.sensor_width_mm, system.sensor_height_mm);
    constexpr double points_per_deg = 4.0;
    // No further than the picture reaches: far off the axis chief rays are hard to find.
    for (const double last_deg : {10.0, 20.0, 40.0, 89.0}) {
        curve_.clear();
        for (const FieldPoint& point :
             field_curves(system, last_deg, static_cast<int>(points_per_deg * last_deg) + 1)) {
            const bool rises = curve_.empty() || std::abs(point.image_height_mm) >
                                                     std::abs(curve_.back().image_height_mm);
            if (!std::isfinite(point.image_height_mm) || !rises) break;
            curve_.push_back(point);
        }
        if (curve_.empty() || std::abs(curve_.back().image_height_mm) > needed_mm) break;
    }
    if (curve_.size() < 2)
        throw Error("no chief ray of the lens gets to the sensor: no image could have a light");
}

std::optional<LightDirection> ImagePlace::light_at(double x_mm, double y_mm) const {
    const double height_mm = std::hypot(x_mm, y_mm);
    for (std::size_t k = 1; k < curve_.size(); ++k) {
        const double low = std::abs(curve_[k - 1].image_height_mm);
        const double high = std::abs(curve_[k].image_height_mm);
        if (height_mm > high) continue;
        const double field_deg = std::lerp(curve_[k - 1].field_deg, curve_[k].field_deg,
                                           (height_mm - low) / (high - low));
        // An image on the far side of the axis: its light comes the other way round.
        const double turn = curve_[k].image_height_mm < 0.0 ? std::numbers::pi : 0.0;
        return LightDirection{field_deg, deg_from_rad(std::atan2(y_mm, x_mm) + turn)};
    }
    return std::nullopt;
}

}  // namespace ghostlight
