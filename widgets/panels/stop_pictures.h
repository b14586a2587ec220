#pragma once

#include <QImage>
#include <QString>

#include <optional>
#include <stop_token>

#include "core/flare/spectrum.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// Side of the Stop panel's pictures.
inline constexpr int stop_picture_px = 168;

/// What the Stop panel shows of a lens.
struct StopPictures {
    QImage opening;      ///< its right +x and its top +y
    QImage starburst;    ///< of light on the axis, the middle sixth of the sensor's width
    QString state;       ///< diameter, and what dirt leaves
    QString statistics;  ///< what blades and dirt come to, a line each
    QString reason;      ///< why there is no starburst; empty where there is one
};

/// Works them out, on any thread; nothing when stopped.
std::optional<StopPictures> stop_pictures(const Prescription& lens, const Spectrum& spectrum,
                                          const std::stop_token& stop);

}  // namespace ghostlight
