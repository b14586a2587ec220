#include "render/picture_frame.h"

#include <algorithm>

namespace ghostlight {

glm::dvec2 PictureFrame::sensor_from_view(glm::dvec2 position_px) const {
    const double across = (position_px.x - left_px) / width_px;
    const double down = (position_px.y - top_px) / height_px;
    return {(0.5 - across) * sensor_width_mm, (down - 0.5) * sensor_height_mm};
}

glm::dvec2 PictureFrame::view_from_sensor(glm::dvec2 point_mm) const {
    const double across = 0.5 - point_mm.x / sensor_width_mm;
    const double down = 0.5 + point_mm.y / sensor_height_mm;
    return {left_px + across * width_px, top_px + down * height_px};
}

bool PictureFrame::contains(glm::dvec2 position_px) const {
    return position_px.x >= left_px && position_px.x < left_px + width_px &&
           position_px.y >= top_px && position_px.y < top_px + height_px;
}

PictureFrame PictureFrame::scaled(double ratio) const {
    PictureFrame frame = *this;
    frame.left_px *= ratio;
    frame.top_px *= ratio;
    frame.width_px *= ratio;
    frame.height_px *= ratio;
    return frame;
}

PictureFrame framed(double viewport_width_px, double viewport_height_px, double sensor_width_mm,
                    double sensor_height_mm, const PictureZoom& zoom) {
    const double px_per_mm = zoom.factor * std::min(viewport_width_px / sensor_width_mm,
                                                    viewport_height_px / sensor_height_mm);
    PictureFrame frame;
    frame.sensor_width_mm = sensor_width_mm;
    frame.sensor_height_mm = sensor_height_mm;
    frame.width_px = sensor_width_mm * px_per_mm;
    frame.height_px = sensor_height_mm * px_per_mm;
    // Picture right is −x and picture down is +y.
    frame.left_px = viewport_width_px / 2.0 - frame.width_px / 2.0 + zoom.center_mm.x * px_per_mm;
    frame.top_px = viewport_height_px / 2.0 - frame.height_px / 2.0 - zoom.center_mm.y * px_per_mm;
    return frame;
}

}  // namespace ghostlight
