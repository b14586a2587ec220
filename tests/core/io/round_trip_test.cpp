// Lenses written in foreign formats and read back; ghosts unfolded and traced another way.

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <sstream>

#include "core/io/formats.h"
#include "core/io/imported_lens.h"
#include "core/io/unfolded_ghost.h"
#include "core/optics/mend.h"
#include "core/optics/paraxial.h"
#include "core/optics/trace.h"
#include "tests/support/error_of.h"
#include "tests/support/import_kit.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double same = 1e-9;  ///< mm, and of ghosts' weights: radii and curvatures of 16 digits

LensFile through(const Prescription& lens, const std::string& name) {
    Notes notes;
    const std::string text = writable_format(name).write(lens, notes);
    return format_of({text, name}).read({text, name});
}

Prescription uncoated(Prescription lens) {
    for (Surface& surface : lens.surfaces) surface.coating = Uncoated{};
    lens.stop.blades = 0;
    return lens;
}

void expect_same_lens(const Prescription& back, const Prescription& lens, const std::string& what,
                      bool with_glass_dispersion) {
    SCOPED_TRACE(what + " " + lens.name);
    ASSERT_EQ(back.surfaces.size(), lens.surfaces.size());
    const OpticalSystem a = compile(back, d_line_nm), b = compile(lens, d_line_nm);
    const FirstOrder first = first_order(a), wanted = first_order(b);
    EXPECT_NEAR(first.efl_mm, wanted.efl_mm, same);
    EXPECT_NEAR(first.bfd_mm, wanted.bfd_mm, same);
    EXPECT_NEAR(first.f_number, wanted.f_number, same);
    EXPECT_NEAR(first.sensor_distance_mm, wanted.sensor_distance_mm, same);
    EXPECT_EQ(back.stop.surface, lens.stop.surface);
    const TracedRay direct = trace_ray(a, {}, ray_at_entrance({2.0}, 0.3, 0.5));
    const TracedRay before = trace_ray(b, {}, ray_at_entrance({2.0}, 0.3, 0.5));
    EXPECT_NEAR(direct.sensor_point.y, before.sensor_point.y, same);
    for (const GhostPath& ghost : two_reflection_ghosts(b)) {
        const Ray ray = ray_at_entrance({3.0}, 0.5, 1.0);
        const TracedRay left = trace_ray(a, ghost, ray), right = trace_ray(b, ghost, ray);
        ASSERT_EQ(left.status, right.status) << name(ghost);
        if (!left.status.reaches_sensor()) continue;
        // Far ghosts grow what rounding there is.
        const double scale = 1.0 + std::abs(right.sensor_point.y);
        EXPECT_NEAR(left.sensor_point.y, right.sensor_point.y, 1e2 * same * scale) << name(ghost);
        EXPECT_NEAR(left.weight, right.weight, same) << name(ghost);
    }
    if (!with_glass_dispersion) return;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
        for (const double nm : {c_line_nm, f_line_nm})
            EXPECT_NEAR(refractive_index(back.surfaces[row].medium_after, nm),
                        refractive_index(lens.surfaces[row].medium_after, nm), same);
}

TEST(RoundTrip, BundledLensesThroughZemax) {
    for (const BundledLens& each : bundled_lenses()) {
        const Prescription lens = uncoated(read_lens(each.file).lens);
        const Prescription back = through(lens, "x.zmx").lens;
        expect_same_lens(back, lens, "zmx", true);
        for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
            EXPECT_EQ(back.surfaces[row].semi_diameter_mm, lens.surfaces[row].semi_diameter_mm);
        EXPECT_EQ(back.sensor.width_mm, lens.sensor.width_mm);
        EXPECT_EQ(back.sensor.height_mm, lens.sensor.height_mm);
        // What has been through once does not change any more.
        EXPECT_EQ(through(back, "x.zmx").lens, back) << each.name;
    }
}

TEST(RoundTrip, BundledLensesThroughCodeV) {
    for (const BundledLens& each : bundled_lenses()) {
        const Prescription lens = uncoated(read_lens(each.file).lens);
        const Prescription back = through(lens, "x.seq").lens;
        expect_same_lens(back, lens, "seq", true);
        for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
            EXPECT_EQ(back.surfaces[row].semi_diameter_mm, lens.surfaces[row].semi_diameter_mm);
        ASSERT_EQ(back.configurations.size(), lens.configurations.size());
    }
}

TEST(RoundTrip, ConfigurationsKeepTheirNumbers) {
    const Prescription lens = uncoated(bundled("canon_zoom_70_200_f2.8"));
    for (const char* file : {"x.zmx", "x.seq"}) {
        const Prescription back = through(lens, file).lens;
        ASSERT_EQ(back.configurations.size(), lens.configurations.size());
        for (const Configuration& each : lens.configurations) {
            const FirstOrder a = first_order(compile(back, d_line_nm, each.name));
            const FirstOrder b = first_order(compile(lens, d_line_nm, each.name));
            EXPECT_NEAR(a.efl_mm, b.efl_mm, same) << file << " " << each.name;
            EXPECT_NEAR(a.bfd_mm, b.bfd_mm, same) << file << " " << each.name;
        }
    }
}

TEST(RoundTrip, StopsOfConfigurations) {
    Prescription lens = uncoated(bundled("canon_zoom_70_200_f2.8"));
    double width_mm = 8.0;
    for (Configuration& each : lens.configurations) each.stop_semi_diameter_mm = width_mm += 2.0;
    for (const char* file : {"x.zmx", "x.seq"}) {
        const Prescription back = through(lens, file).lens;
        for (const Configuration& each : lens.configurations) {
            const OpticalSystem system = compile(back, d_line_nm, each.name);
            EXPECT_NEAR(system.stop_mask.semi_diameter_mm, *each.stop_semi_diameter_mm, same)
                << file << " " << each.name;
        }
    }
}

TEST(RoundTrip, ShapesStopsAndGlasses) {
    Prescription lens = uncoated(bundled("cooke_triplet_50_f5"));
    lens.surfaces[0].aspheric = {1e-6, -2e-9, 3e-12, 4e-15, 5e-18, 6e-21, 7e-24};
    lens.surfaces[2].conic = -0.7;
    lens.surfaces[3].aspheric = std::vector<double>(9, 1e-20);
    lens.surfaces[5].medium_after = {"", ConstantIndex{1.65}};
    lens.surfaces[1].semi_diameter_sized = true;
    lens.surfaces[1].comment = "a comment";
    lens.stop.semi_diameter_mm = 3.0;
    lens.sensor = {23.5, 15.6, true, {}, {}};
    const Prescription zmx = through(lens, "x.zmx").lens;
    expect_same_lens(zmx, lens, "zmx", true);
    EXPECT_EQ(zmx.surfaces[0].aspheric, lens.surfaces[0].aspheric);
    EXPECT_EQ(zmx.surfaces[3].aspheric, lens.surfaces[3].aspheric);
    EXPECT_EQ(zmx.surfaces[2].conic, -0.7);
    EXPECT_EQ(zmx.surfaces[5].medium_after.dispersion, Dispersion(ConstantIndex{1.65}));
    EXPECT_TRUE(zmx.surfaces[1].semi_diameter_sized);
    EXPECT_EQ(zmx.surfaces[1].comment, "a comment");
    EXPECT_TRUE(zmx.sensor.at_paraxial_focus);
    EXPECT_EQ(zmx.sensor.width_mm, 23.5);
    const Prescription seq = through(lens, "x.seq").lens;
    expect_same_lens(seq, lens, "seq", true);
    EXPECT_EQ(seq.surfaces[3].aspheric, lens.surfaces[3].aspheric);
    EXPECT_TRUE(seq.surfaces[1].semi_diameter_sized);
    EXPECT_EQ(seq.surfaces[1].comment, "a comment");
    EXPECT_TRUE(seq.sensor.at_paraxial_focus);
}

TEST(RoundTrip, FlareSimKeepsWhatItHas) {
    // Spheres alone. The name states an f-number, which is not what the stop is open to.
    const Prescription lens = uncoated(bundled("double_gauss_tronnier_100_f2"));
    const Prescription back = through(lens, "x.lens").lens;
    expect_same_lens(back, lens, "lens", false);
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
        EXPECT_EQ(back.surfaces[row].semi_diameter_mm, lens.surfaces[row].semi_diameter_mm);
}

TEST(RoundTrip, WhatIsLostIsNamed) {
    Prescription lens = bundled("canon_zoom_70_200_f2.8");
    lens.stop.blades = 8;
    lens.surfaces[0].conic = -0.5;
    lens.unknown["elsewhere"] = "1";
    for (const char* file : {"x.zmx", "x.seq", "x.lens"}) {
        SCOPED_TRACE(file);
        Notes notes;
        writable_format(file).write(lens, notes);
        EXPECT_TRUE(note_with(notes, "8 blades")->matters_for_flare);
        EXPECT_NE(note_with(notes, "what the source states of the lens"), nullptr);
        EXPECT_NE(note_with(notes, "fields that other programs"), nullptr);
        if (std::string(file) == "x.lens") {
            EXPECT_TRUE(note_with(notes, "conic and aspheric")->matters_for_flare);
            EXPECT_TRUE(note_with(notes, "one position")->matters_for_flare);
        } else {
            EXPECT_EQ(note_with(notes, "MgF2")->fate, Note::Fate::left_out);
        }
    }
}

// The unfolded ghost, traced as a sequence by a tracer of its own: vectors, Newton's iteration on
// the sag, Snell's law in vector form. It shares nothing with the program's but the file.

struct Step {
    double curvature = 0.0, conic = 0.0, gap_mm = 0.0, index = 1.0;
    std::vector<double> terms;
    bool mirror = false;
};

std::vector<Step> steps_of(const std::string& zmx) {
    std::vector<Step> steps;
    std::istringstream lines(zmx);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream text(line);
        std::string word, first, flag, pickup;
        text >> word;
        if (word == "SURF") steps.emplace_back();
        if (steps.empty()) continue;
        Step& step = steps.back();
        if (word == "CURV") text >> step.curvature;
        if (word == "CONI") text >> step.conic;
        if (word == "DISZ") {
            text >> first;
            step.gap_mm = first == "INFINITY" ? 0.0 : std::stod(first);
        }
        if (word == "PARM") {
            std::size_t number = 0;
            double value = 0.0;
            text >> number >> value;
            step.terms.resize(std::max(step.terms.size(), number));
            step.terms[number - 1] = value;  // r^(2 number)
        }
        if (word == "GLAS") {
            text >> first >> flag >> pickup >> step.index;
            step.mirror = first == "MIRROR";
        }
    }
    return steps;
}

glm::dvec3 traced_by_hand(const std::vector<Step>& steps, glm::dvec3 point, glm::dvec3 direction) {
    double index = 1.0;
    for (std::size_t i = 1; i + 1 < steps.size(); ++i) {
        const Step& step = steps[i];
        const auto sag = [&](double r2) {
            double z =
                step.curvature * r2 /
                (1.0 + std::sqrt(1.0 - (1.0 + step.conic) * step.curvature * step.curvature * r2));
            for (std::size_t k = 0; k < step.terms.size(); ++k)
                z += step.terms[k] * std::pow(r2, static_cast<double>(k) + 1.0);
            return z;
        };
        const auto slope = [&](double r2) {
            double s = 0.5 * step.curvature /
                       std::sqrt(1.0 - (1.0 + step.conic) * step.curvature * step.curvature * r2);
            for (std::size_t k = 0; k < step.terms.size(); ++k)
                s += step.terms[k] * (static_cast<double>(k) + 1.0) *
                     std::pow(r2, static_cast<double>(k));
            return s;  // dz/d(r²)
        };
        // The conic by its quadratic, the root nearer to the vertex; Newton for what is on top.
        const double k1 = 1.0 + step.conic, c = step.curvature;
        const double a = c * (1.0 + step.conic * direction.z * direction.z);
        const double b =
            c * (point.x * direction.x + point.y * direction.y + k1 * point.z * direction.z) -
            direction.z;
        const double q =
            c * (point.x * point.x + point.y * point.y + k1 * point.z * point.z) - 2.0 * point.z;
        double t = -0.5 * q / b;
        if (std::abs(a) > 1e-9) {
            const double root = std::sqrt(b * b - a * q);
            const double near = (-b + root) / a, far = (-b - root) / a;
            t = std::abs(point.z + near * direction.z) < std::abs(point.z + far * direction.z)
                    ? near
                    : far;
        }
        glm::dvec3 normal;
        for (int round = 0; round < 20; ++round) {
            const glm::dvec3 at = point + t * direction;
            const double r2 = at.x * at.x + at.y * at.y;
            normal = {-2.0 * slope(r2) * at.x, -2.0 * slope(r2) * at.y, 1.0};
            t -= (at.z - sag(r2)) / glm::dot(normal, direction);
        }
        point += t * direction;
        normal = glm::normalize(normal);
        if (glm::dot(normal, direction) < 0.0) normal = -normal;
        const double cosine = glm::dot(normal, direction);
        if (step.mirror) {
            direction -= 2.0 * cosine * normal;
        } else {
            const double eta = index / step.index;
            direction =
                eta * direction +
                (std::sqrt(1.0 - eta * eta * (1.0 - cosine * cosine)) - eta * cosine) * normal;
            index = step.index;
        }
        point.z -= step.gap_mm;
    }
    return point - point.z / direction.z * direction;
}

TEST(UnfoldedGhost, TracesAsTheGhostItself) {
    for (const BundledLens& each : bundled_lenses()) {
        const Prescription lens = uncoated(configured(read_lens(each.file).lens, {}));
        const OpticalSystem system = compile(lens, d_line_nm);
        int compared = 0;
        for (const GhostPath& ghost : two_reflection_ghosts(system)) {
            const Ray ray = ray_at_entrance({1.5, 60.0}, 0.4, 0.7);
            const TracedRay ours = trace_ray(system, ghost, ray);
            if (!ours.status.reaches_sensor()) continue;
            Notes notes;
            const std::string text = unfolded_ghost(lens, ghost, notes);
            const glm::dvec3 theirs = traced_by_hand(steps_of(text), ray.origin, ray.direction);
            // Indices at d are written with every digit; mirrors and far planes multiply rounding.
            const double tolerance_mm = 1e-8 * (1.0 + glm::length(ours.sensor_point));
            EXPECT_NEAR(theirs.x, ours.sensor_point.x, tolerance_mm) << each.name << name(ghost);
            EXPECT_NEAR(theirs.y, ours.sensor_point.y, tolerance_mm) << each.name << name(ghost);
            ++compared;
        }
        EXPECT_GT(compared, 0) << each.name;
    }
}

TEST(UnfoldedGhost, OnlyGhostsOfTheLensAndOnlyZmx) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    Notes notes;
    EXPECT_EQ(error_of([&] { unfolded_ghost(lens, "3-1", "x.seq", notes); }).found, ".seq");
    EXPECT_NE(
        error_of([&] { unfolded_ghost(lens, "5-1", "x.zmx", notes); }).problem.find("reflect"),
        std::string::npos)
        << "row 5 is the stop";
}

// Mending.

TEST(Mend, ScalingScalesWhatIsMeasured) {
    const Prescription lens = uncoated(bundled("nikkor_z_58_f0.95_noct"));
    const Prescription large = scaled(lens, 10.0);
    const FirstOrder a = first_order(compile(lens, d_line_nm));
    const FirstOrder b = first_order(compile(large, d_line_nm));
    EXPECT_NEAR(b.efl_mm, 10.0 * a.efl_mm, 1e-9 * b.efl_mm);
    EXPECT_NEAR(b.f_number, a.f_number, 1e-9);
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
        EXPECT_NEAR(sag_mm(large.surfaces[row], 50.0), 10.0 * sag_mm(lens.surfaces[row], 5.0),
                    1e-9);
}

TEST(Mend, InvertedAndHalved) {
    const Prescription lens = bundled("cooke_triplet_50_f5");
    Prescription twice = with_radii_as_curvatures(with_radii_as_curvatures(lens));
    EXPECT_EQ(twice, lens);
    Prescription wide = lens;
    wide.surfaces[2].semi_diameter_sized = true;
    const Prescription halved = with_halved_semi_diameters(wide);
    EXPECT_EQ(halved.surfaces[0].semi_diameter_mm, 0.5 * lens.surfaces[0].semi_diameter_mm);
    EXPECT_EQ(halved.surfaces[2].semi_diameter_mm, lens.surfaces[2].semi_diameter_mm);
}

}  // namespace
}  // namespace ghostlight
