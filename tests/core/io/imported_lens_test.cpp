#include "core/io/imported_lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "core/optics/trace.h"
#include "core/units.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr double exact_mm = 1e-9;  ///< mm: rounding of sums of lengths near 100 mm
constexpr double edge_mm = 1e-5;   ///< mm: the search for a beam's edge ends at 6e-8 of the pupil

ImportedLens imported(Prescription lens) {
    ImportedLens made;
    made.surfaces.resize(lens.surfaces.size());
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        made.surfaces[row].where = "row " + std::to_string(row + 1);
        made.surfaces[row].semi_diameter_mm = lens.surfaces[row].semi_diameter_mm;
    }
    made.stop = lens.stop.surface;
    made.sensor_distance_mm = lens.surfaces.back().thickness_mm;
    made.lens = std::move(lens);
    return made;
}

const Note* noted(const LensFile& file, std::string_view words) {
    const auto found = std::ranges::find_if(
        file.notes, [&](const Note& note) { return note.text.find(words) != std::string::npos; });
    return found == file.notes.end() ? nullptr : &*found;
}

/// What is stated is kept to the last bit, and nothing but the sensor's size is said.
TEST(ImportedLens, WhatIsStatedIsKept) {
    for (const BundledLens& each : bundled_lenses()) {
        const Prescription lens = read_lens(each.file).lens;
        ImportedLens open = imported(lens);
        open.has_sensor_size = true;
        const LensFile file = complete_import(open, "test");
        EXPECT_EQ(file.lens.surfaces, lens.surfaces) << each.name;
        EXPECT_EQ(file.lens.stop, lens.stop) << each.name;
        for (const Note& note : file.notes) EXPECT_NE(note.fate, Note::Fate::assumed) << note.text;
    }
}

/// A stop in front of a plane plate: the beam's edge at the back is a + t tan θ', by Snell's law.
TEST(ImportedLens, SemiDiametersFollowTheBeam) {
    constexpr double a = 3.0, t = 8.0, n = 1.5, field_deg = 25.0, gap = 2.0;
    ImportedLens open = imported(lens_of({row(0, gap, 1.0), row(0, t, n), row(0, 20, 1.0)}, 0));
    for (ImportedSurface& surface : open.surfaces) surface.semi_diameter_mm.reset();
    open.surfaces[0].semi_diameter_mm = a;
    open.half_field_deg = field_deg;
    const LensFile file = complete_import(open, "test");
    const double outside = std::tan(rad_from_deg(field_deg));
    const double inside = std::tan(std::asin(std::sin(rad_from_deg(field_deg)) / n));
    EXPECT_NEAR(file.lens.surfaces[1].semi_diameter_mm, a + gap * outside, edge_mm);
    EXPECT_NEAR(file.lens.surfaces[2].semi_diameter_mm, a + gap * outside + t * inside, edge_mm);
    EXPECT_FALSE(file.lens.surfaces[0].semi_diameter_sized);
    EXPECT_TRUE(file.lens.surfaces[1].semi_diameter_sized);
    const Note* note = noted(file, "no semi-diameter for surfaces 2, 3");
    ASSERT_NE(note, nullptr);
    EXPECT_TRUE(note->matters_for_flare);
    EXPECT_EQ(note->fate, Note::Fate::assumed);
    // The mark is kept in a file.
    EXPECT_EQ(lens_from_json(lens_to_json(file.lens), "again").lens, file.lens);
}

/// Half of the upper pupil vignetted: the upper edge of the beam is at a/2.
TEST(ImportedLens, VignettingNarrowsTheBeam) {
    constexpr double a = 3.0, gap = 5.0, field_deg = 20.0;
    ImportedLens open = imported(lens_of({row(0, gap, 1.0), row(0, 2, 1.5), row(0, 20, 1.0)}, 0));
    for (ImportedSurface& surface : open.surfaces) surface.semi_diameter_mm.reset();
    open.surfaces[0].semi_diameter_mm = a;
    open.fields = {{field_deg, 0.5, 0.0, 0.5}};
    const LensFile file = complete_import(open, "test");
    const double chief = gap * std::tan(rad_from_deg(field_deg));
    EXPECT_NEAR(file.lens.surfaces[1].semi_diameter_mm, chief + 0.5 * a, edge_mm);
}

/// Each bundled lens without its rims: the beam that its own rims let through fits through the
/// sized ones, and the axial beam fills them at least.
TEST(ImportedLens, EveryLensCanBeSized) {
    for (const BundledLens& each : bundled_lenses()) {
        const Prescription lens = read_lens(each.file).lens;
        ImportedLens open = imported(lens);
        for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
            if (row != lens.stop.surface) open.surfaces[row].semi_diameter_mm.reset();
        open.half_field_deg = 5.0;
        const LensFile file = complete_import(open, "test");
        const OpticalSystem system = compile(file.lens, d_line_nm);
        const FirstOrder order = first_order(system);
        const TracedRay edge =
            trace_ray(system, {}, ray_at_entrance({}, 0.0, order.entrance_pupil_radius_mm * 0.9));
        EXPECT_EQ(edge.status, RayStatus{}) << each.name;
        for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
            EXPECT_EQ(file.lens.surfaces[row].semi_diameter_sized, row != lens.stop.surface);
        EXPECT_EQ(noted(file, "does not get through"), nullptr) << each.name;
    }
}

TEST(ImportedLens, MissingSensorDistanceIsTheParaxialFocus) {
    ImportedLens open = imported(bundled("cooke_triplet_50_f5"));
    open.sensor_distance_mm.reset();
    const LensFile file = complete_import(open, "test");
    EXPECT_TRUE(file.lens.sensor.at_paraxial_focus);
    const FirstOrder order = first_order(compile(file.lens, d_line_nm));
    EXPECT_NEAR(order.paraxial_defocus_mm, 0.0, exact_mm);
    ASSERT_NE(noted(file, "paraxial focus"), nullptr);
    // A window has no focus: the sensor is somewhere, and that is said.
    ImportedLens window = imported(lens_of({row(0, 5, 1.5), row(0, 0, 1.0)}));
    window.sensor_distance_mm.reset();
    const LensFile flat = complete_import(window, "test");
    EXPECT_FALSE(flat.lens.sensor.at_paraxial_focus);
    EXPECT_NE(noted(flat, "no real focus"), nullptr);
}

TEST(ImportedLens, ApertureBecomesTheStop) {
    const Prescription lens = bundled("tessar_brendel_100_f2.8");
    ImportedLens open = imported(lens);
    open.surfaces[lens.stop.surface].semi_diameter_mm.reset();
    open.entrance_pupil_diameter_mm = 20.0;
    FirstOrder order = first_order(compile(complete_import(open, "test").lens, d_line_nm));
    EXPECT_NEAR(order.entrance_pupil_radius_mm, 10.0, exact_mm);
    open.entrance_pupil_diameter_mm.reset();
    open.f_number = 5.6;
    order = first_order(compile(complete_import(open, "test").lens, d_line_nm));
    EXPECT_NEAR(order.f_number, 5.6, exact_mm);
    // A stop that is listed too small stays, and that is said.
    open.surfaces[lens.stop.surface].semi_diameter_mm = 1.0;
    const LensFile narrow = complete_import(open, "test");
    EXPECT_EQ(narrow.lens.surfaces[lens.stop.surface].semi_diameter_mm, 1.0);
    EXPECT_NE(noted(narrow, "which limits it"), nullptr);
}

TEST(ImportedLens, MissingStopIsChosenAndSaid) {
    ImportedLens open = imported(bundled("cooke_triplet_50_f5"));
    open.stop.reset();
    const LensFile file = complete_import(open, "test");
    EXPECT_EQ(file.lens.stop.surface, 4U);  // the row without glass
    ASSERT_NE(noted(file, "names no stop"), nullptr);
    EXPECT_EQ(noted(file, "names no stop")->severity, Note::Severity::warning);
}

TEST(ImportedLens, SensorFollowsTheImageHeight) {
    ImportedLens open = imported(bundled("cooke_triplet_50_f5"));
    open.image_height_mm = 14.2;
    const LensFile file = complete_import(open, "test");
    EXPECT_NEAR(0.5 * std::hypot(file.lens.sensor.width_mm, file.lens.sensor.height_mm), 14.2,
                exact_mm);
    EXPECT_NEAR(file.lens.sensor.width_mm / file.lens.sensor.height_mm, 1.5, exact_mm);
    EXPECT_NE(noted(file, "how large the sensor is"), nullptr);
}

// Sanity checks: each slip is found in every bundled lens, and none where there is none.

TEST(ImportedLens, SlipsAreNotFoundWhereThereAreNone) {
    for (const BundledLens& each : bundled_lenses()) {
        ImportedLens open = imported(read_lens(each.file).lens);
        const LensFile file = complete_import(open, "test");
        for (const char* words : {"look like diameters", "look like curvatures", "numbers look"})
            EXPECT_EQ(noted(file, words), nullptr) << each.name << ": " << words;
    }
}

TEST(ImportedLens, DiametersAreNoticed) {
    for (const BundledLens& each : bundled_lenses()) {
        ImportedLens open = imported(read_lens(each.file).lens);
        open.f_number = first_order(compile(open.lens, d_line_nm)).f_number;
        for (ImportedSurface& surface : open.surfaces) *surface.semi_diameter_mm *= 2.0;
        const LensFile file = complete_import(open, "test");
        const Note* note = noted(file, "look like diameters");
        ASSERT_NE(note, nullptr) << each.name;
        EXPECT_FALSE(note->proposal.empty());
        // Nothing is changed.
        EXPECT_EQ(file.lens.surfaces[0].semi_diameter_mm, *open.surfaces[0].semi_diameter_mm);
    }
}

TEST(ImportedLens, CurvaturesAreNoticed) {
    for (const BundledLens& each : bundled_lenses()) {
        ImportedLens open = imported(read_lens(each.file).lens);
        for (Surface& surface : open.lens.surfaces)
            if (auto* radius = std::get_if<Radius>(&surface.curve)) radius->mm = 1.0 / radius->mm;
        EXPECT_NE(noted(complete_import(open, "test"), "look like curvatures"), nullptr)
            << each.name;
    }
}

TEST(ImportedLens, UnitsAreNoticed) {
    for (const double factor : {10.0, 0.1, 25.4}) {
        ImportedLens open = imported(bundled("tessar_brendel_100_f2.8"));
        open.stated_efl_mm = factor * first_order(compile(open.lens, d_line_nm)).efl_mm;
        const LensFile file = complete_import(open, "test");
        const Note* note = noted(file, "numbers look");
        ASSERT_NE(note, nullptr) << factor;
        EXPECT_NE(note->proposal.find("--scale"), std::string::npos);
    }
}

TEST(ImportedLens, SurfacesOutOfOrderAreRefused) {
    ImportedLens open = imported(bundled("cooke_triplet_50_f5"));
    open.lens.surfaces[1].thickness_mm = -2.0;
    const Error::Parts parts = error_of([&] { complete_import(open, "lens.zmx"); });
    EXPECT_EQ(parts.file, "lens.zmx");
    EXPECT_EQ(parts.where, "row 2");
    EXPECT_NE(parts.problem.find("out of order"), std::string::npos);
}

/// A dummy that goes back and forth changes nothing.
TEST(ImportedLens, DummiesWithNegativeThicknessAreMerged) {
    const Prescription plain = bundled("cooke_triplet_50_f5");
    ImportedLens open = imported(plain);
    Surface dummy = row(0, -1.5, 1.0, 8.0);
    open.lens.surfaces[1].thickness_mm += 1.5;
    open.lens.surfaces.insert(open.lens.surfaces.begin() + 2, dummy);
    open.surfaces.insert(open.surfaces.begin() + 2, {8.0, "the dummy"});
    open.stop = plain.stop.surface + 1;
    const LensFile file = complete_import(open, "test");
    ASSERT_EQ(file.lens.surfaces.size(), plain.surfaces.size());
    EXPECT_EQ(file.lens.stop.surface, plain.stop.surface);
    EXPECT_NEAR(file.lens.surfaces[1].thickness_mm, plain.surfaces[1].thickness_mm, exact_mm);
    EXPECT_NE(noted(file, "merged"), nullptr);
}

/// The stop given as the entrance pupil in front of the lens: the same beam, by the plane inside.
TEST(ImportedLens, StopGivenAsAPupilIsMovedToItsImage) {
    const Prescription plain = bundled("cooke_triplet_50_f5");
    const FirstOrder before = first_order(compile(plain, d_line_nm));
    ImportedLens open = imported(plain);
    Surface pupil = row(0, -before.entrance_pupil_z_mm, 1.0, before.entrance_pupil_radius_mm);
    open.lens.surfaces.insert(open.lens.surfaces.begin(), pupil);
    open.surfaces.insert(open.surfaces.begin(), {before.entrance_pupil_radius_mm, "the pupil"});
    open.stop = 0;
    ASSERT_LT(pupil.thickness_mm, 0.0);
    const LensFile file = complete_import(open, "test");
    const FirstOrder after = first_order(compile(file.lens, d_line_nm));
    EXPECT_NEAR(after.efl_mm, before.efl_mm, exact_mm);
    EXPECT_NEAR(after.entrance_pupil_z_mm, before.entrance_pupil_z_mm, exact_mm);
    EXPECT_NEAR(after.entrance_pupil_radius_mm, before.entrance_pupil_radius_mm, exact_mm);
    EXPECT_NEAR(after.exit_pupil_z_mm, before.exit_pupil_z_mm, exact_mm);
    EXPECT_NE(noted(file, "it is a pupil"), nullptr);
}

TEST(ImportedLens, UnknownGlassIsOpenedAndSized) {
    ImportedLens open = imported(bundled("cooke_triplet_50_f5"));
    open.lens.surfaces[0].medium_after = {"XYZ1", UnknownGlass{"nobody knows it"}};
    open.surfaces[1].semi_diameter_mm.reset();
    const LensFile file = complete_import(open, "test");
    EXPECT_TRUE(
        std::holds_alternative<UnknownGlass>(file.lens.surfaces[0].medium_after.dispersion));
    EXPECT_TRUE(file.lens.surfaces[1].semi_diameter_sized);
}

}  // namespace
}  // namespace ghostlight
