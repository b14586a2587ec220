#pragma once

#include <glm/vec2.hpp>

namespace ghostlight {

/// Where the upright camera picture lies in a viewport. Positions are in pixels from the
/// viewport's top left corner; the picture's right is the sensor's −x, its top the sensor's −y.
struct PictureFrame {
    double left_px = 0.0, top_px = 0.0, width_px = 1.0, height_px = 1.0;
    double sensor_width_mm = 36.0, sensor_height_mm = 24.0;

    glm::dvec2 sensor_from_view(glm::dvec2 position_px) const;
    glm::dvec2 view_from_sensor(glm::dvec2 point_mm) const;
    bool contains(glm::dvec2 position_px) const;
    /// The same in a viewport of another resolution.
    PictureFrame scaled(double ratio) const;
    bool operator==(const PictureFrame&) const = default;
};

/// How much of the picture is in view: 1 shows all of it. The centre is in mm on the sensor.
struct PictureZoom {
    double factor = 1.0;
    glm::dvec2 center_mm{0.0, 0.0};
    bool operator==(const PictureZoom&) const = default;
};

/// The largest frame of the sensor's shape in the viewport, centred, then zoomed.
PictureFrame framed(double viewport_width_px, double viewport_height_px, double sensor_width_mm,
                    double sensor_height_mm, const PictureZoom& zoom = {});

}  // namespace ghostlight
