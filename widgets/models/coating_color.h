#pragma once

#include <QColor>

#include <optional>

#include "core/flare/spectrum.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// The colour in which a surface reflects a light, near normal incidence; brighter for more
/// reflectance, but not in proportion: a good coating would be black. Nothing where no light is
/// reflected, or where a medium has no index.
std::optional<QColor> coating_color(const Medium& before, const Coating& coating,
                                    const Medium& after, const Spectrum& light);

}  // namespace ghostlight
