#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/fit/flare_fit.h"
#include "core/fit/synthetic_photo.h"

namespace ghostlight::cli {

/// The bundled Tessar with these λ0 on its six surfaces that meet air.
Prescription tessar_with(const std::vector<double>& centers_nm);
inline const std::vector<double> true_centers_nm = {520, 585, 540, 600, 505, 560};
/// Off by up to 105 nm.
inline const std::vector<double> first_centers_nm = {620, 480, 500, 610, 490, 600};

/// The camera of the study: 1 % shot noise, unbalanced channels.
SyntheticPhotoRequest study_camera(double field_deg, bool quick);

/// A photograph as a fit takes it: unusable pixels and the light's own image masked.
FitPhoto fit_photo(Photo photo, const Prescription& lens, const LightDirection& light);

/// The fit that a user gets, of these numbers.
FitRequest usual_fit(const Prescription& lens, const std::string& vary, bool quick);

/// Whether a number's 95 % interval holds the truth, and how many of a report's do.
bool holds(const FittedNumber& number, double truth);
std::size_t covered(const FitReport& report, const std::vector<double>& truth);

double chi2_per_value(const FitReport& report);

/// The fit's report as a page, and its photograph, model and residuals as one picture, in the
/// folder under that name. Returns the picture's file name.
std::string write_pages(const FitReport& report, const std::string& heading,
                        const std::filesystem::path& folder, const std::string& name);

}  // namespace ghostlight::cli
