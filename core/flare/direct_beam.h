#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/aperture_outline.h"
#include "core/optics/optical_system.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// The light that reaches the sensor without turning, as far as its diffraction needs it.
struct DirectBeam {
    std::vector<double> flux_mm2;   ///< Φ/E0 at each wavelength asked for; 0 where nothing passes
    double x_mm = 0.0, y_mm = 0.0;  ///< where it lands: its centroid
    double tangential_rad = 0.0;    ///< direction on the sensor in which the field spreads it
    double cos_image_angle = 1.0;   ///< of its middle ray at the sensor
    /// What besides the stop limits it there, where something does, in semi-diameters.
    std::optional<ApertureOutline> limits;
    double wavelength_nm = 587.5618;  ///< of what follows, and of the geometry
    /// How far from the centroid light of k = 1/semi-diameter lands, to first order: λB/(2π a), λ
    /// that of the stop's medium, B from the stop to the sensor. Finite when telecentric; negative
    /// where the pattern is upside down.
    double radius_per_k_mm = 0.0;
    /// a²M/(λB), M by real rays: 0 in focus; its sign is that of M/B.
    double fresnel_number = 0.0;

    bool is_dark() const;
};

/// `systems`: the lens at each wavelength; the one in the middle is the geometry's. Nothing when
/// stopped.
std::optional<DirectBeam> direct_beam(const std::vector<OpticalSystem>& systems,
                                      const LightDirection& light, unsigned threads,
                                      const std::stop_token& stop = {});

}  // namespace ghostlight
