#pragma once

#include <QPointF>
#include <QSizeF>
#include <QString>

#include <optional>

#include "core/flare/flare_image.h"
#include "core/optics/trace.h"
#include "render/picture_frame.h"

class QPainter;

namespace ghostlight {

/// A small ring where the light's image is, or an arrow at the border towards it.
void paint_light(QPainter& painter, const PictureFrame& frame, QSizeF view_px,
                 const LightDirection& light, double efl_mm);

/// Position and irradiance under the cursor, in a box beside it; nothing outside the sensor.
void paint_readout(QPainter& painter, const PictureFrame& frame, QSizeF view_px,
                   const FlareImage& image, QPointF cursor);

/// Irradiance / E0 of the pixel at a point of the sensor; nothing outside it.
std::optional<float> irradiance_at(const FlareImage& image, double x_mm, double y_mm);

/// "12.41, −3.07 mm"
QString position_text(double x_mm, double y_mm);

}  // namespace ghostlight
