#pragma once

#include <QImage>
#include <QSize>

#include "core/flare/flare_image.h"
#include "render/flare_renderer.h"
#include "render/picture_frame.h"

namespace ghostlight {

/// What FlareRenderer draws, made in memory for machines without OpenGL: the picture tone-mapped
/// by core, upright, in its frame. Highlighted ghosts are tinted, without an outline. Left of
/// `look.from_share` it is transparent.
QImage software_picture(const FlareImage& image, const PictureFrame& frame, QSize size_px,
                        const PictureLook& look);

}  // namespace ghostlight
