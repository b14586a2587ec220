#pragma once

#include <complex>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/mask_raster.h"

namespace ghostlight {

/// Fresnel's integrals C(x) = ∫₀ˣ cos(πt²/2) dt and S(x), to 1e-12 (power series and the continued
/// fraction of the complementary error function; Abramowitz and Stegun 7.3, 7.1.14).
struct FresnelIntegrals {
    double c = 0.0, s = 0.0;
};
FresnelIntegrals fresnel_integrals(double x);

/// Irradiance behind a straight edge over that without it: ½[(½ + C(w))² + (½ + S(w))²] (Born and
/// Wolf 8.7.3), w = depth · √(2/(λ z)), positive in the light. 1/4 at the edge, 1.370 at w = 1.217.
/// With the depth in semi-diameters of a stop of Fresnel number N: w = depth · √(2N).
double straight_edge(double w);

/// A mask's field after a length of Fresnel number N = a²/(λz): irradiance over that of the open
/// beam, by the angular spectrum. Over −`reach` … `reach` semi-diameters, row 0 the lowest y. For N
/// from 0.3 to 50; beyond, fringes are finer than the grid.
struct PropagatedMask {
    int across = 0;
    double reach = 2.0;
    std::vector<float> irradiance;
    double at(double x, double y) const;  ///< bilinear; 0 beyond the reach
};
inline constexpr double least_propagated = 0.3, most_propagated = 50.0;
std::optional<PropagatedMask> propagated(const MaskRaster& raster, double fresnel_number,
                                         unsigned threads, const std::stop_token& stop = {});

/// A mask's spectrum on the padded grid that suits a Fresnel number, for several numbers about it.
struct MaskSpectrum {
    int across = 0;
    double width = 0.0;     ///< of the padded grid, semi-diameters
    double reach = 2.0;     ///< of what propagated() makes of it
    double furthest = 1.0;  ///< that light may go without running round the grid into that
    std::vector<std::complex<float>> field;
};
std::optional<MaskSpectrum> mask_spectrum(const MaskRaster& raster, double fresnel_number,
                                          unsigned threads, const std::stop_token& stop = {});
std::optional<PropagatedMask> propagated(const MaskSpectrum& mask, double fresnel_number,
                                         unsigned threads, const std::stop_token& stop = {});

/// The pixels across a stop that propagated() wants for a Fresnel number.
int propagation_raster(double fresnel_number);

}  // namespace ghostlight
