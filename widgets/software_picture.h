#pragma once

#include <QColor>
#include <QImage>
#include <QSize>

#include "core/flare/flare_image.h"
#include "render/picture_frame.h"

namespace ghostlight {

/// What FlareRenderer draws, made in memory for machines without OpenGL: the picture tone-mapped
/// by core, upright, in its frame. Highlighted ghosts are tinted, without an outline.
QImage software_picture(const FlareImage& image, const PictureFrame& frame, QSize size_px,
                        double exposure_ev, const QColor& surround, const QColor& highlight);

}  // namespace ghostlight
