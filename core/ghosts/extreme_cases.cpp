#include "core/ghosts/extreme_cases.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/ghosts/bundle.h"
#include "core/ghosts/path_stability.h"
#include "core/ghosts/pupil.h"
#include "core/optics/mend.h"
#include "core/optics/thin_film.h"
#include "core/optics/trace_steps.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr double rounding = 0x1p-53;

Surface surface(double radius_mm, double thickness_mm, double n_after,
                double semi_diameter_mm = 10.0) {
    Surface made;
    if (radius_mm != 0.0) made.curve = Radius{radius_mm};
    made.thickness_mm = thickness_mm;
    made.medium_after = {n_after == 1.0 ? "" : "glass", ConstantIndex{n_after}};
    made.semi_diameter_mm = semi_diameter_mm;
    return made;
}

Prescription lens_of(std::vector<Surface> surfaces) {
    Prescription lens;
    lens.surfaces = std::move(surfaces);
    return lens;
}

struct Landed {
    double x_mm = 0.0, y_mm = 0.0, weight = 0.0;
};

template <class T>
Landed land(const Prescription& lens, const GhostPath& path, const LightDirection& light,
            double u_mm, double v_mm) {
    Bundle<T> rays;
    rays.u_mm = {static_cast<T>(u_mm)};
    rays.v_mm = {static_cast<T>(v_mm)};
    trace_bundle(trace_path<T>(compile(lens, d_line_nm), path), beam_frame(light),
                 Weights::polarised, rays);
    return {static_cast<double>(rays.x_mm[0]), static_cast<double>(rays.y_mm[0]),
            static_cast<double>(rays.weight[0])};
}

/// `measure` takes a function that lands a ray in either precision.
template <class Measure>
ExtremeCase traced(std::string name, std::string physics, std::string unit, double expected,
                   double bound, Measure measure) {
    ExtremeCase made{
        std::move(name), std::move(physics), std::move(unit), expected, 0.0, 0.0, bound};
    made.double_error =
        std::abs(measure([](const auto&... a) { return land<double>(a...); }) - expected);
    made.float_error =
        std::abs(measure([](const auto&... a) { return land<float>(a...); }) - expected);
    return made;
}

const LightDirection axis{0.0, 90.0};
const GhostPath back_and_forth{{1, 0}};

ExtremeCase nearly_plane(double radius_mm) {
    constexpr double n = 1.5, z_mm = 100.0, h_mm = 5.0;
    return traced(
        radius_mm > 0.0 ? "radius of 1e9 mm against a plane" : "radius of -1e9 mm against a plane",
        "∓(n − 1) h z / (n R) from where the plane sends it", "mm",
        -(n - 1.0) * h_mm * z_mm / (n * radius_mm), 8.0 * rounding * h_mm, [&](auto land) {
            return land(lens_of({surface(radius_mm, z_mm, n)}), GhostPath{}, axis, 0.0, h_mm).y_mm -
                   land(lens_of({surface(0.0, z_mm, n)}), GhostPath{}, axis, 0.0, h_mm).y_mm;
        });
}

/// Axial light at the rim of a surface that is nearly a hemisphere, into glass.
ExtremeCase steep() {
    constexpr double n = 1.5, a_mm = 10.0, radius_mm = 1.0001 * a_mm, gap_mm = 1.0;
    const double sag_mm = radius_mm - std::sqrt(radius_mm * radius_mm - a_mm * a_mm);
    const double incidence = std::asin(a_mm / radius_mm);
    const double turned = incidence - std::asin(std::sin(incidence) / n);
    // The height's rounding becomes 1 / cos θ = 71 times that in the slope.
    return traced("radius of 1.0001 semi-diameters", "sphere and Snell's law at the rim", "mm",
                  a_mm - (gap_mm + radius_mm - sag_mm) * std::tan(turned), 5e3 * rounding * a_mm,
                  [&](auto land) {
                      return land(lens_of({surface(radius_mm, radius_mm + gap_mm, n, a_mm)}),
                                  GhostPath{}, axis, 0.0, a_mm)
                          .y_mm;
                  });
}

double fresnel_transmittance(double n, double cosine) {
    const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
    const double r_s = (cosine - n * inside) / (cosine + n * inside);
    const double r_p = (n * cosine - inside) / (n * cosine + inside);
    return 1.0 - 0.5 * (r_s * r_s + r_p * r_p);
}

ExtremeCase grazing() {
    constexpr double n = 1.5, field_deg = 89.999;
    return traced("incidence of 89.999 degrees", "Fresnel's transmittance", "1",
                  fresnel_transmittance(n, cos_from_deg(field_deg)), 1e-13, [&](auto land) {
                      return land(lens_of({surface(0.0, 1.0, n, 1e6)}), GhostPath{},
                                  LightDirection{field_deg, 90.0}, 0.0, 0.0)
                          .weight;
                  });
}

ExtremeCase normal() {
    constexpr double n = 1.7;
    const double r = (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0));
    return traced("normal incidence, a plate's ghost", "R² T²", "1", r * r * (1.0 - r) * (1.0 - r),
                  8.0 * rounding, [&](auto land) {
                      return land(lens_of({surface(0.0, 3.0, n), surface(0.0, 5.0, 1.0)}),
                                  back_and_forth, axis, 0.0, 0.0)
                          .weight;
                  });
}

/// Closer to the critical angle than a float of the cosine tells.
std::vector<ExtremeCase> onset() {
    constexpr double n = 1.5, distance = 1e-9;
    Film film;
    film.n_in = n;
    film.n_out = 1.0;
    const double critical = std::sqrt(1.0 - 1.0 / (n * n));
    const double cosine = critical * (1.0 + distance);
    const double outside = std::sqrt(1.0 - n * n * (1.0 - cosine * cosine));
    const double r = (n * cosine - outside) / (n * cosine + outside);
    auto made = [](std::string name, std::string physics, double expected, double found,
                   double bound) {
        return ExtremeCase{std::move(name),
                           std::move(physics),
                           "1",
                           expected,
                           std::abs(found - expected),
                           std::numeric_limits<double>::quiet_NaN(),
                           bound};
    };
    // 1 − R goes as the root of the distance, and so does its rounding.
    return {made("1e-9 before total reflection", "Fresnel's R_s", r * r,
                 reflectances(film, cosine).r_s, 8.0 * rounding / std::sqrt(distance)),
            made("1e-9 beyond it", "R_s = 1", 1.0,
                 reflectances(film, critical * (1.0 - distance)).r_s, 8.0 * rounding)};
}

/// A plate's ghost with a film on its back, against the same plate with another.
ExtremeCase film(std::string name, std::string physics, const Coating& coating,
                 const Coating& equal, double bound) {
    auto plate = [](const Coating& on_back) {
        Prescription lens = lens_of({surface(0.0, 3.0, 1.52), surface(0.0, 5.0, 1.0)});
        lens.surfaces.back().coating = on_back;
        return lens;
    };
    const LightDirection light{20.0, 90.0};
    const double expected = land<double>(plate(equal), back_and_forth, light, 0.0, 0.0).weight;
    return traced(std::move(name), std::move(physics), "1", expected, bound, [&](auto land) {
        return land(plate(coating), back_and_forth, light, 0.0, 0.0).weight;
    });
}

ExtremeCase same_landing(std::string name, std::string physics, const Prescription& lens,
                         const Prescription& equal) {
    const LightDirection light{11.0, 30.0};
    const double expected = land<double>(equal, {}, light, 1.0, 2.0).y_mm;
    return traced(std::move(name), std::move(physics), "mm", expected, 16.0 * rounding * 10.0,
                  [&](auto land) { return land(lens, GhostPath{}, light, 1.0, 2.0).y_mm; });
}

ExtremeCase kilometre() {
    constexpr double far_mm = 1e6, field_deg = 3.0, n = 1.5, plate_mm = 4.0;
    const double theta = rad_from_deg(field_deg);
    const double y_mm =
        plate_mm * std::tan(std::asin(std::sin(theta) / n)) + far_mm * std::tan(theta);
    return traced(
        "gap of 1e6 mm", "a plate's shift and a straight line", "mm", y_mm, 8.0 * rounding * far_mm,
        [&](auto land) {
            return land(lens_of({surface(0.0, plate_mm, n, 1e6), surface(0.0, far_mm, 1.0, 1e6)}),
                        GhostPath{}, LightDirection{field_deg, 90.0}, 0.0, 0.0)
                .y_mm;
        });
}

Prescription train(int surfaces) {
    std::vector<Surface> rows;
    for (int k = 0; k < surfaces; ++k)
        rows.push_back(surface(k % 4 < 2 ? 300.0 + k : -330.0 - k, k % 2 == 0 ? 1.0 : 0.5,
                               k % 2 == 0 ? 1.5 : 1.0, 14.0));
    rows.back().thickness_mm = 40.0;
    Prescription lens = lens_of(std::move(rows));
    lens.stop.surface = static_cast<std::size_t>(surfaces) / 2;
    return lens;
}

ExtremeCase sized(double factor) {
    const Prescription lens = train(12);
    const LightDirection light{3.0, 70.0};
    const double expected = land<double>(lens, back_and_forth, light, 0.4, 0.7).y_mm;
    return traced(factor > 1.0 ? "lens of 1e3 times the size" : "lens of 1e-3 times the size",
                  "the same lens", "mm of the usual size", expected, 1e-12, [&](auto land) {
                      return land(scaled(lens, factor), back_and_forth, light, factor * 0.4,
                                  factor * 0.7)
                                 .y_mm /
                             factor;
                  });
}

/// Some ten roundings at each meeting, where the amplification counts one.
ExtremeCase two_hundred_surfaces() {
    using Real = long double;
    const Prescription lens = train(200);
    const GhostPath path{{199, 0}};
    const LightDirection light{1.0, 90.0};
    const OpticalSystem system = compile(lens, d_line_nm);
    const BeamFrame frame = beam_frame(light);
    const auto wide = trace_path<Real>(system, path);
    const glm::dvec3 start = 0.3 * frame.e1 + 0.2 * frame.e2;
    RayAt<Real> ray{{Real(start.x), Real(start.y), Real(start.z)},
                    {Real(frame.direction.x), Real(frame.direction.y), Real(frame.direction.z)}};
    for (const TraceStep<Real>& step : wide.steps)
        turn(step, meet(step, wide.aspheric.data(), Real(1), ray), ray);
    const Real t = -(ray.position.z + wide.sensor_gap_mm) / ray.direction.z;
    const double amplification_mm = ray_condition(system, path, frame, 0.3, 0.2).amplification_mm;
    return traced("200 surfaces, the ghost 200-1", "the same steps in long double", "mm",
                  static_cast<double>(ray.position.y + t * ray.direction.y),
                  10.0 * rounding * amplification_mm,
                  [&](auto land) { return land(lens, path, light, 0.3, 0.2).y_mm; });
}

}  // namespace

std::vector<ExtremeCase> extreme_cases() {
    const Medium magnesium_fluoride{"MgF2", ConstantIndex{1.38}};
    const Medium glass{"glass", ConstantIndex{1.52}};
    const double weight_rounding = 16.0 * rounding;
    std::vector<ExtremeCase> cases = {nearly_plane(1e9), nearly_plane(-1e9), steep(), grazing(),
                                      normal()};
    for (ExtremeCase& each : onset()) cases.push_back(std::move(each));
    cases.push_back(film("coating of no thickness", "bare glass",
                         QuarterWave{550.0, magnesium_fluoride, 0.0}, Uncoated{}, weight_rounding));
    cases.push_back(film("coating of its neighbour's index", "bare glass",
                         QuarterWave{550.0, glass, 1.0}, Uncoated{}, weight_rounding));
    cases.push_back(same_landing(
        "equal media on both sides", "straight on",
        lens_of({surface(17.0, 2.0, 1.6), surface(-13.0, 3.0, 1.6), surface(25.0, 10.0, 1.6)}),
        lens_of({surface(17.0, 15.0, 1.6)})));
    cases.push_back(same_landing("gap of 0 between cemented surfaces", "as if it were not there",
                                 lens_of({surface(30.0, 0.0, 1.6), surface(30.0, 8.0, 1.7)}),
                                 lens_of({surface(30.0, 8.0, 1.7)})));
    cases.push_back(kilometre());
    cases.push_back(sized(1e-3));
    cases.push_back(sized(1e3));
    cases.push_back(two_hundred_surfaces());
    return cases;
}

}  // namespace ghostlight
