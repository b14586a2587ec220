#include "core/optics/coating_curves.h"

#include <cmath>

#include "core/units.h"

namespace ghostlight {

namespace {

Film film_of(const CoatedSurface& surface, double wavelength_nm) {
    const Film film = film_at(surface.coating, surface.before, surface.after, wavelength_nm);
    return surface.from_front ? film : reversed(film);
}

CurvePoint point(double x, const Film& film, double incidence_deg) {
    const Reflectances shares = reflectances(film, std::cos(rad_from_deg(incidence_deg)));
    return {x, shares.r_s, shares.r_p};
}

}  // namespace

std::vector<CurvePoint> over_wavelength(const CoatedSurface& surface, double incidence_deg,
                                        double first_nm, double last_nm, int count) {
    std::vector<CurvePoint> curve;
    for (int k = 0; k < count; ++k) {
        const double nm = std::lerp(first_nm, last_nm, static_cast<double>(k) / (count - 1));
        curve.push_back(point(nm, film_of(surface, nm), incidence_deg));
    }
    return curve;
}

std::vector<CurvePoint> over_angle(const CoatedSurface& surface, double wavelength_nm,
                                   double last_deg, int count) {
    std::vector<CurvePoint> curve;
    const Film film = film_of(surface, wavelength_nm);
    for (int k = 0; k < count; ++k) {
        const double deg = last_deg * k / (count - 1);
        curve.push_back(point(deg, film, deg));
    }
    return curve;
}

}  // namespace ghostlight
