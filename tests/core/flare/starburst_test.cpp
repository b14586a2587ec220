#include "core/flare/starburst.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/ghosts/flux_quadrature.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double pi = std::numbers::pi;

/// A thin lens of 100 mm, its stop in front, free of ghosts and nearly of aberrations at f/20.
Prescription simple_lens(double stop_mm = 2.5) {
    Prescription lens = lens_of(
        {row(0.0, 0.0, 1.0, stop_mm), row(100.0, 1.0, 1.5, 20.0), row(-100.0, 98.0, 1.0, 20.0)});
    lens.sensor.at_paraxial_focus = true;
    return lens;
}

StarburstRequest request_of(double width_mm, int width_px, double field_deg = 0.0) {
    StarburstRequest request;
    request.light = {field_deg, 90.0};
    request.width_px = width_px;
    (void)width_mm;
    return request;
}

double direct_flux(const Prescription& lens, const LightDirection& light, double wavelength_nm) {
    const OpticalSystem system = compile(lens, wavelength_nm);
    const PathQuadrature quadrature(system, {}, beam_frame(light));
    PathFlux flux = quadrature.start();
    quadrature.refine(flux, 1e-4, 0.0, {});
    return flux.sums.flux;
}

TEST(Starburst, FluxIsTheDirectPathsAtEveryResolution) {
    Prescription lens = bundled("tessar_brendel_100_f2.8");
    lens.stop.f_number = 8.0;
    for (const int blades : {0, 6, 7}) {
        lens.stop.blades = blades;
        for (const double nm : {450.0, 650.0}) {
            const double expected = direct_flux(lens, {4.0, 90.0}, nm);
            for (const int width_px : {40, 333, 1000}) {
                StarburstRequest request = request_of(36.0, width_px, 4.0);
                request.spectrum = Monochromatic{nm};
                const FlareImage image = *render_starburst(lens, request);
                // The quadrature's own 0.2 %.
                EXPECT_NEAR(image.flux_mm2 / expected, 1.0, 3e-3);
                // Between the middle and the corners all but what the far field takes outside,
                // here 1/(k r) ~ 1e-4; polar means of square pixels to 0.1 %.
                EXPECT_NEAR(image.flux_on_sensor_mm2 / image.flux_mm2, 1.0, 2e-3)
                    << blades << " blades, " << nm << " nm, " << width_px << " px";
            }
        }
    }
}

TEST(Starburst, ResolutionChangesNothingButTheResolution) {
    // Nine pixels of a fine picture and the one of a coarse picture that they fill.
    Prescription lens = bundled("tessar_brendel_100_f2.8");
    lens.stop.f_number = 11.0;
    lens.stop.blades = 5;
    StarburstRequest request = request_of(36.0, 101, 0.0);
    request.spectrum = StandardLight{};
    const FlareImage coarse = *render_starburst(lens, request);
    request.width_px = 303;
    const FlareImage fine = *render_starburst(lens, request);
    ASSERT_EQ(fine.height_px, 3 * coarse.height_px + 1);  // 202 of 67 and a third: cut at the rim
    double difference = 0.0, sum = 0.0;
    for (int j = 4; j < coarse.height_px - 4; ++j)
        for (int i = 0; i < coarse.width_px; ++i) {
            double mean = 0.0;
            // Both are centred on the axis; the rows differ by half a fine pixel.
            for (int b = 0; b < 3; ++b)
                for (int a = 0; a < 3; ++a) {
                    const auto at = [&](int row) {
                        return static_cast<double>(fine.irradiance[static_cast<std::size_t>(
                            row * fine.width_px + 3 * i + a)]);
                    };
                    mean += 0.5 * (at(3 * j + b) + at(3 * j + b + 1)) / 9.0;
                }
            const double here = static_cast<double>(
                coarse.irradiance[static_cast<std::size_t>(j * coarse.width_px + i)]);
            difference += std::abs(mean - here);
            sum += here;
        }
    EXPECT_LT(difference / sum, 0.03);
}

TEST(Starburst, RoundStopsFirstDarkRingIs122LambdaN) {
    // A sensor of 0.1 mm: the pattern itself. N = f'/2a of the compiled lens.
    Prescription lens = simple_lens();
    lens.sensor.width_mm = lens.sensor.height_mm = 0.2;
    StarburstRequest request = request_of(0.2, 401);
    request.spectrum = Monochromatic{550.0};
    const FlareImage image = *render_starburst(lens, request);
    const double n = first_order(compile(lens, 550.0)).f_number;
    const double expected_mm = 1.2197 * mm_from_nm(550.0) * n;
    int darkest = 0;
    const auto row = static_cast<std::size_t>(image.height_px / 2 * image.width_px);
    for (int i = 203; i < 203 + static_cast<int>(1.5 * expected_mm / 0.2 * 401.0); ++i) {
        const auto at = [&](int column) {
            return image.irradiance[row + static_cast<std::size_t>(column)];
        };
        if (at(i) < at(i - 1) && at(i) <= at(i + 1)) {
            darkest = i;
            break;
        }
    }
    // A pixel of 0.5 µm, a ring of 1.4 %.
    EXPECT_NEAR((darkest - 200) * 0.2 / 401.0, expected_mm, 1.2 * 0.2 / 401.0);
    // 83.8 % of the light within it (Born and Wolf 8.5.2).
    double within = 0.0;
    for (int j = 0; j < image.height_px; ++j)
        for (int i = 0; i < image.width_px; ++i)
            if (std::hypot(i - 200.0, j - 200.0) * 0.2 / 401.0 < expected_mm)
                within += static_cast<double>(
                    image.irradiance[static_cast<std::size_t>(j * image.width_px + i)]);
    EXPECT_NEAR(within * std::pow(0.2 / 401.0, 2) / image.flux_mm2, 0.838, 0.01);
}

/// Radius that holds half of what lands on the sensor.
double half_light_mm(const FlareImage& image, double pitch_mm) {
    std::vector<std::pair<double, double>> pixels;
    double sum = 0.0;
    for (int j = 0; j < image.height_px; ++j)
        for (int i = 0; i < image.width_px; ++i) {
            const auto value = static_cast<double>(
                image.irradiance[static_cast<std::size_t>(j * image.width_px + i)]);
            pixels.emplace_back(
                std::hypot(i + 0.5 - 0.5 * image.width_px, j + 0.5 - 0.5 * image.height_px) *
                    pitch_mm,
                value);
            sum += value;
        }
    std::ranges::sort(pixels);
    double below = 0.0;
    for (const auto& [radius, value] : pixels)
        if ((below += value) > 0.5 * sum) return radius;
    return 0.0;
}

TEST(Starburst, TwiceTheFNumberIsTwiceTheSize) {
    Prescription lens = simple_lens();
    lens.sensor.width_mm = lens.sensor.height_mm = 0.4;
    StarburstRequest request = request_of(0.4, 401);
    lens.stop.f_number = 20.0;
    const double once = half_light_mm(*render_starburst(lens, request), 0.4 / 401.0);
    lens.stop.f_number = 40.0;
    const double twice = half_light_mm(*render_starburst(lens, request), 0.4 / 401.0);
    // A pixel is a tenth of the smaller one.
    EXPECT_NEAR(twice / once, 2.0, 0.15);
}

TEST(Starburst, DirtDimsByWhatItCovers) {
    Prescription lens = bundled("tessar_brendel_100_f2.8");
    lens.stop.f_number = 8.0;
    StarburstRequest request = request_of(36.0, 100);
    const double clean = render_starburst(lens, request)->flux_mm2;
    lens.stop.dirt.dust_coverage = 0.1;
    lens.stop.dirt.dust_smallest_mm = 0.05;
    const FlareImage dusty = *render_starburst(lens, request);
    EXPECT_NEAR(dusty.flux_mm2 / clean, 0.9, 0.01);  // hundreds of specks
    EXPECT_EQ(render_starburst(lens, request)->irradiance, dusty.irradiance);
    lens.stop.dirt.seed = 7;
    EXPECT_NE(render_starburst(lens, request)->irradiance, dusty.irradiance);
}

TEST(Starburst, RimsOfTheLensTurnTheStopIntoACatsEye) {
    // Wide open and off the axis other rims cut the beam: more spread across the cut than along.
    const Prescription lens = bundled("double_gauss_tronnier_100_f2");
    const std::vector<OpticalSystem> systems = {compile(lens, d_line_nm)};
    const DirectBeam middle = *direct_beam(systems, {0.0, 90.0}, 1);
    const DirectBeam edge = *direct_beam(systems, {14.0, 90.0}, 1);
    ASSERT_TRUE(edge.limits.has_value());
    double width = 0.0, height = 0.0;
    for (const glm::dvec2& corner : edge.limits->corners) {
        width = std::max(width, std::abs(corner.x));
        height = std::max(height, std::abs(corner.y));
    }
    // What passes is the share of the stop that its flux says, to the films' change and the
    // pupil's.
    const double open = edge.limits->area() / pi;
    EXPECT_NEAR(open,
                edge.flux_mm2.front() / middle.flux_mm2.front() / std::cos(rad_from_deg(14.0)),
                0.2 * open);
    EXPECT_LT(open, 0.9);
}

TEST(Starburst, FieldStretchesThePattern) {
    // 1/cosθ' across the field, 1/cos³θ' along it.
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    const DirectBeam beam =
        *direct_beam(std::vector<OpticalSystem>{compile(lens, d_line_nm)}, {10.0, 90.0}, 1);
    // The image-side chief ray of a lens whose exit pupil stands z before the sensor.
    const FirstOrder order = first_order(compile(lens, d_line_nm));
    const double z = order.sensor_distance_mm - order.exit_pupil_z_mm;
    EXPECT_NEAR(beam.cos_image_angle, std::cos(std::atan(beam.y_mm / z)), 2e-3);
    EXPECT_NEAR(std::sin(beam.tangential_rad), 1.0, 1e-9);
    // λz/D of the exit pupil is |B|/D of the stop.
    EXPECT_NEAR(beam.radius_per_k_mm,
                mm_from_nm(d_line_nm) * z / (2.0 * pi * order.exit_pupil_radius_mm),
                1e-6 * beam.radius_per_k_mm + 1e-12);
}

TEST(Starburst, LightThatDoesNotComeThroughIsDark) {
    const FlareImage image =
        *render_starburst(bundled("tessar_brendel_100_f2.8"), request_of(36.0, 64, 80.0));
    EXPECT_EQ(image.flux_mm2, 0.0);
    EXPECT_EQ(image.irradiance.size(), static_cast<std::size_t>(image.width_px * image.height_px));
}

TEST(Starburst, IsTheSameForAnyNumberOfThreads) {
    Prescription lens = bundled("tessar_brendel_100_f2.8");
    lens.stop.f_number = 8.0;
    lens.stop.blades = 7;
    StarburstRequest request = request_of(36.0, 120, 5.0);
    request.spectrum = StandardLight{};
    request.threads = 1;
    const FlareImage one = *render_starburst(lens, request);
    request.threads = 3;
    EXPECT_EQ(render_starburst(lens, request)->rgb, one.rgb);
}

TEST(Starburst, MovingLightShowsTheSamePattern) {
    Prescription lens = bundled("tessar_brendel_100_f2.8");
    lens.stop.f_number = 8.0;
    lens.stop.blades = 6;
    StarburstRequest request = request_of(36.0, 160);
    request.spectrum = StandardLight{};
    MovingStarburst moving(lens, request);
    request.light = {4.0, 90.0};
    const FlareImage rest = *render_starburst(lens, request);
    const FlareImage& moved = moving.frame(request.light);
    double sum = 0.0, rest_sum = 0.0;
    for (std::size_t k = 0; k < rest.irradiance.size(); ++k) {
        sum += static_cast<double>(moved.irradiance[k]);
        rest_sum += static_cast<double>(rest.irradiance[k]);
    }
    EXPECT_NEAR(sum / rest_sum, 1.0, 1e-3);
    auto brightest = [](const FlareImage& image) {
        return std::max_element(image.irradiance.begin(), image.irradiance.end()) -
               image.irradiance.begin();
    };
    const auto apart = std::abs(brightest(moved) - brightest(rest));
    EXPECT_TRUE(apart == 0 || apart == 1 || apart == 160 || apart == 161 || apart == 159) << apart;
}

}  // namespace
}  // namespace ghostlight
