// Derivatives of fluxes against differences of fluxes on the same rays.

#include "core/ghosts/sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/ghosts/flux_quadrature.h"
#include "core/optics/optical_system.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

using Kind = CoatingParameter::Kind;

double flux_of(const OpticalSystem& system, const LightDirection& light, const GhostPath& path) {
    PathQuadrature quadrature(system, path, beam_frame(light));
    return quadrature.start().sums.flux;
}

Prescription coated_tessar() {
    Prescription lens = with_air_coating(bundled("tessar_brendel_100_f2.8"),
                                         QuarterWave{.center_nm = 540.0, .thickness_factor = 1.1});
    lens.surfaces[2].coating = LayerStack{
        {{medium(1.63), 85.0, 0.0}, {medium(2.0), 60.0, 0.02}, {medium(1.38), 95.0, 0.0}}};
    lens.sensor.reflectance =
        SensorFilms{{{{medium(1.46), 80.0, 0.0}, {medium(2.1), 45.0, 0.0}}}, medium(3.5)};
    // Glass that absorbs gives rays of one ghost other weights, and no other derivative of a ray.
    for (Surface& surface : lens.surfaces)
        if (!is_air(surface.medium_after))
            surface.medium_after.transmittance = {{550.0, 0.6, 10.0}};
    lens.internal_transmittance = true;
    return lens;
}

/// The lens with one parameter at another value, written out by hand.
Prescription with_value(Prescription lens, const CoatingParameter& parameter, double value) {
    if (parameter.surface == lens.surfaces.size()) {
        std::get<SensorFilms>(*lens.sensor.reflectance).stack.layers[parameter.layer].thickness_nm =
            value;
        return lens;
    }
    Coating& coating = lens.surfaces[parameter.surface].coating;
    if (auto* stack = std::get_if<LayerStack>(&coating))
        stack->layers[parameter.layer].thickness_nm = value;
    else if (parameter.kind == Kind::center)
        std::get<QuarterWave>(coating).center_nm = value;
    else
        std::get<QuarterWave>(coating).thickness_factor *= value / parameter.value;
    return lens;
}

TEST(FluxSensitivity, IsTheLimitOfDifferences) {
    const Prescription lens = coated_tessar();
    constexpr double nm = 530.0;
    const LightDirection light{3.0, 60.0};
    const auto parameters = coating_parameters(lens, nm);
    // The rule of weights at a triangle's middle against that of its corners, on first cells.
    constexpr double tolerance = 0.02;
    int compared = 0;
    for (const GhostPath& path : {GhostPath{}, GhostPath{{4, 2}}, GhostPath{{7, 5}},
                                  GhostPath{{lens.surfaces.size(), 2}}, GhostPath{{7, 2, 5, 1}}}) {
        const auto slopes = flux_sensitivities(lens, Monochromatic{nm}, light, path, parameters);
        double largest = 0.0;
        for (std::size_t k = 0; k < parameters.size(); ++k)
            if (parameters[k].kind != Kind::reflectance)
                largest = std::max(largest, std::abs(slopes[k]));
        ASSERT_GT(largest, 0.0);
        for (std::size_t k = 0; k < parameters.size(); ++k) {
            if (parameters[k].kind == Kind::reflectance) continue;
            const double step = 0.2, value = parameters[k].value;  // nm
            auto log_flux = [&](double at) {
                return std::log(
                    flux_of(compile(with_value(lens, parameters[k], at), nm), light, path));
            };
            const double slope = (log_flux(value + step) - log_flux(value - step)) / (2.0 * step);
            EXPECT_NEAR(slopes[k], slope, tolerance * (std::abs(slope) + 0.05 * largest))
                << name(path) << ": surface " << parameters[k].surface + 1 << ", "
                << name(parameters[k]);
            ++compared;
        }
    }
    EXPECT_GT(compared, 60);
}

TEST(FluxSensitivity, InWhiteLightIsThatOfTheFluxOverTheSpectrum) {
    const Prescription lens = coated_tessar();
    const Spectrum light = StandardLight{Illuminant::d65};
    const LightDirection direction{3.0, 60.0};
    const GhostPath path{{7, 5}};
    const auto parameters = coating_parameters(lens, 550.0);
    const auto slopes = flux_sensitivities(lens, light, direction, path, parameters);
    const auto at_d = flux_sensitivities(lens, Monochromatic{}, direction, path, parameters);
    // Bands' midpoints, another rule than the nodes': 10 nm of a smooth film are good to 0.2 %.
    auto log_flux = [&](const Prescription& changed) {
        double flux = 0.0;
        for (const SpectralSample& band : sample(light, 30))
            flux += band.weight * flux_of(compile(changed, band.wavelength_nm), direction, path);
        return std::log(flux);
    };
    int compared = 0;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
        if (parameters[k].kind != Kind::center) continue;
        if (parameters[k].surface != 7 && parameters[k].surface != 5) continue;
        const double step = 0.5, value = parameters[k].value;  // nm
        const double slope = (log_flux(with_value(lens, parameters[k], value + step)) -
                              log_flux(with_value(lens, parameters[k], value - step))) /
                             (2.0 * step);
        EXPECT_NEAR(slopes[k], slope, 0.02 * std::abs(slope)) << name(parameters[k]);
        EXPECT_GT(std::abs(at_d[k] - slope), 0.1 * std::abs(slope)) << "d says the same";
        ++compared;
    }
    EXPECT_EQ(compared, 2);
}

TEST(FluxSensitivity, OfAReflectanceCountsTurnsAndCrossings) {
    // Surfaces of one reflectance at all angles: the flux is a power of R and of 1 − R.
    Prescription lens = bundled("tessar_brendel_100_f2.8");
    lens.sensor.reflectance = UniformReflectance{0.08};
    const LightDirection light{2.0, 90.0};
    const std::size_t sensor = lens.surfaces.size();
    const auto parameters = coating_parameters(lens, 550.0);
    for (const auto& [path, turns] :
         {std::pair{GhostPath{{sensor, 2}}, 1.0}, std::pair{GhostPath{{sensor, 2, sensor, 1}}, 2.0},
          std::pair{GhostPath{{4, 2}}, 0.0}}) {
        const auto slopes = flux_sensitivities(lens, Monochromatic{550.0}, light, path, parameters);
        for (std::size_t k = 0; k < parameters.size(); ++k)
            if (parameters[k].surface == sensor) {
                EXPECT_NEAR(slopes[k], turns / 0.08, 1e-9);
            }
    }
    // A surface's own R scales the ghost that turns there as its mean R does.
    const auto slopes =
        flux_sensitivities(lens, Monochromatic{550.0}, light, GhostPath{{4, 2}}, parameters);
    for (std::size_t k = 0; k < parameters.size(); ++k)
        if (parameters[k].surface == 6 && parameters[k].kind == Kind::reflectance) {
            EXPECT_NEAR(slopes[k], -1.0, 0.1);  // one crossing: −1/T
        }
}

TEST(FluxSensitivity, AQuarterWaveAtItsCentreHasItsLeastReflectance) {
    // A plate whose back has the ideal index at λ0: R² there, to second order in λ0.
    Prescription lens = lens_of({row(0.0, 2.0, 1.0, 5.0), row(0.0, 4.0, 1.5), row(0.0, 20.0, 1.0)});
    lens.surfaces[2].coating = QuarterWave{.center_nm = 550.0, .layer = medium(1.38)};
    const auto parameters = coating_parameters(lens, 550.0);
    const auto slopes =
        flux_sensitivities(lens, Monochromatic{550.0}, {}, GhostPath{{2, 1}}, parameters);
    for (std::size_t k = 0; k < parameters.size(); ++k)
        if (parameters[k].kind == Kind::center || parameters[k].kind == Kind::layer_thickness) {
            EXPECT_NEAR(slopes[k], 0.0, 1e-6) << name(parameters[k]);
        }
}

}  // namespace
}  // namespace ghostlight
