#pragma once

#include <QColor>
#include <QPointF>
#include <QSizeF>
#include <QString>

#include <optional>
#include <vector>

#include "core/flare/flare_image.h"
#include "core/optics/trace.h"
#include "render/flare_renderer.h"
#include "render/picture_frame.h"

class QPainter;

namespace ghostlight {

/// A small ring where the light's image is, or an arrow at the border towards it.
void paint_light(QPainter& painter, const PictureFrame& frame, QSizeF view_px,
                 const LightDirection& light, double efl_mm);
/// Smaller, thinner rings where the images of the scene's other lights are, within the view.
void paint_other_lights(QPainter& painter, const PictureFrame& frame, QSizeF view_px,
                        const std::vector<LightDirection>& lights, double efl_mm);

/// A line of the readout: "5-3" and "62 %", with the ghost's swatch.
struct ReadoutLine {
    QString name, amount;
    QColor swatch;  ///< not valid: none
};

/// Position and irradiance under the cursor and more lines, in a box beside it; nothing outside the
/// sensor.
void paint_readout(QPainter& painter, const PictureFrame& frame, QSizeF view_px,
                   const FlareImage& image, QPointF cursor,
                   const std::vector<ReadoutLine>& lines = {});

/// The colours between two decades with their values and unit, at the view's right edge.
void paint_false_color_scale(QPainter& painter, QSizeF view_px,
                             const PictureLook::Decades& decades);

/// Irradiance / E0 of the pixel at a point of the sensor; nothing outside it.
std::optional<float> irradiance_at(const FlareImage& image, double x_mm, double y_mm);

/// "12.41, −3.07 mm"
QString position_text(double x_mm, double y_mm);

}  // namespace ghostlight
