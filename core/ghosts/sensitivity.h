#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/flare/spectrum.h"
#include "core/ghosts/ghost_path.h"
#include "core/optics/prescription.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// A number of a coating that a ghost's flux depends on.
struct CoatingParameter {
    enum class Kind {
        layer_thickness,  ///< nm, of one layer
        center,           ///< λ0 of a quarter-wave layer, nm
        reflectance       ///< R of the surface, raised by the same at every angle, T lowered by it
    };
    std::size_t surface = 0;  ///< row from 0; the count of surfaces for the sensor
    Kind kind = Kind::reflectance;
    std::size_t layer = 0;  ///< from 0
    double value = 0.0;     ///< as it stands; of a reflectance the one at normal incidence
};
/// "thickness of layer 1", "center", "reflectance".
std::string name(const CoatingParameter& parameter);
/// "nm" or "1".
std::string unit(const CoatingParameter& parameter);

/// All of a lens's, at a wavelength: of surfaces that reflect, thicknesses and λ0 where there is a
/// coating, and R everywhere.
std::vector<CoatingParameter> coating_parameters(const Prescription& lens, double wavelength_nm);

/// ∂ ln(flux) / ∂ parameter of one path in a light, per unit of each parameter: the derivative of
/// the weights (automatic, exact films, polarisation carried) over the beam that passes, which no
/// coating moves; of a continuous light the integral over 17 wavelengths. A reflectance is raised
/// at all of them. Zeros where no light passes.
std::vector<double> flux_sensitivities(const Prescription& lens, const Spectrum& spectrum,
                                       const LightDirection& light, const GhostPath& path,
                                       const std::vector<CoatingParameter>& parameters);

}  // namespace ghostlight
