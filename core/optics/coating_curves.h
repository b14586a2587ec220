#pragma once

#include <vector>

#include "core/optics/coating.h"

namespace ghostlight {

/// An interface's reflectances at one place of a curve.
struct CurvePoint {
    double x = 0.0;  ///< nm, or degrees in the medium that the light comes from
    double r_s = 0.0, r_p = 0.0;
    double mean() const { return 0.5 * (r_s + r_p); }
};

/// A surface's coating between its media, seen from its front or from behind.
struct CoatedSurface {
    Coating coating;
    Medium before, after;
    bool from_front = true;
};

/// Shares reflected against wavelength at one angle of incidence, `count` points from `first_nm`
/// to `last_nm`. Throws Error where a medium has no index.
std::vector<CurvePoint> over_wavelength(const CoatedSurface& surface, double incidence_deg,
                                        double first_nm, double last_nm, int count);

/// The same against the angle of incidence, from 0 to `last_deg`, at one wavelength.
std::vector<CurvePoint> over_angle(const CoatedSurface& surface, double wavelength_nm,
                                   double last_deg, int count);

}  // namespace ghostlight
