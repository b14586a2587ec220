#pragma once

#include <QImage>

#include <vector>

#include "core/fit/flare_fit.h"

namespace ghostlight {

/// Upright pictures of a fit for the screen.

/// A photograph, at most so many pixels wide, its brightest parts but the clipped light at the
/// shoulder of the tone curve.
inline constexpr int preview_width_px = 960;
QImage photo_picture(const Photo& photo);

/// What of a photograph is masked, at the scale of photo_picture(): amber where painted, teal about
/// the light, red where clipped, hot or no number, dark outside of the crop; transparent elsewhere.
QImage mask_picture(const Photo& photo);

/// Exposure in stops at which the brightest hundredth of a photograph on the fit's scale is light.
double fit_exposure_ev(const FittedPhoto& photo);

/// Values on the fit's scale (FittedPhoto::measured, after); what is masked is dark.
QImage fit_picture(const FittedPhoto& photo, const std::vector<double>& values, double exposure_ev);

/// Residuals in standard deviations, the mean of the channels: red where the model is
/// too bright, blue where it is too dark, full at five.
QImage residual_picture(const FittedPhoto& photo);

}  // namespace ghostlight
