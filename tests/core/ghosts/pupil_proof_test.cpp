#include "core/ghosts/pupil_proof.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/ghosts/cell_proof.h"
#include "core/ghosts/ghost_table.h"
#include "core/ghosts/reflectance_bound.h"
#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

constexpr std::array all_lenses = {"angenieux_1953_100_f1.1",  "canon_zoom_70_200_f2.8",
                                   "cooke_triplet_50_f5",      "double_gauss_tronnier_100_f2",
                                   "fisheye_nikkor_10.5_f2.8", "heliar_tronnier_100",
                                   "nikkor_z_14_30_f4_wide",   "nikkor_z_58_f0.95_noct",
                                   "nikon_zoom_80_200_f2.8",   "tessar_brendel_100_f2.8"};

/// Proofs are about exact arithmetic; the trace's own rounding over 60 surfaces stays below this.
constexpr double trace_rounding_mm = 1e-9, trace_rounding = 1e-10;

/// A lens of strong aspheres and conics, the stop in the middle.
Prescription aspheric_lens() {
    Prescription lens = lens_of(
        {row(40.0, 6.0, 1.6, 15.0, -0.6), row(-200.0, 8.0, 1.0, 15.0), row(0.0, 5.0, 1.0, 8.0),
         row(-60.0, 4.0, 1.7, 12.0, 0.8), row(90.0, 40.0, 1.0, 13.0)},
        2);
    lens.surfaces[1].aspheric = {2e-6, -3e-9};
    lens.surfaces[4].aspheric = {-4e-6, 1e-8, -2e-11};
    return lens;
}

struct Passing {
    bool passes;
    double u_mm, v_mm, x_mm, y_mm, cosine[2];
};

/// One ray by core/optics/trace.h, judged by physics.md §6 with the stop's circle.
Passing traced(const OpticalSystem& system, const GhostPath& ghost, const BeamFrame& frame,
               double u_mm, double v_mm) {
    const TracedRay ray =
        trace_ray(system, ghost, {u_mm * frame.e1 + v_mm * frame.e2, frame.direction});
    Passing result{ray.status.fate == RayFate::ok,
                   u_mm,
                   v_mm,
                   ray.sensor_point.x,
                   ray.sensor_point.y,
                   {1.0, 1.0}};
    int reflection = 0;
    for (const RayHit& hit : ray.hits)
        if (hit.reflected && reflection < 2) result.cosine[reflection++] = hit.cos_incidence;
    return result;
}

struct Checked {
    int passing = 0, dark_cells = 0, complete_cells = 0;
};

/// Cells of every size about random points: a ray that passes is never in one proven dark, and
/// lies within all that was said of the cell.
void check_cells(const OpticalSystem& system, const BeamFrame& frame, int ghosts_tried, int tries,
                 std::uint64_t seed, Checked& checked) {
    const auto ghosts = two_reflection_ghosts(system);
    Random random(seed);
    for (int g = 0; g < ghosts_tried; ++g) {
        const GhostPath& ghost = ghosts[static_cast<std::size_t>(
            random.integer(0, static_cast<int>(ghosts.size()) - 1))];
        const ProofPath path = proof_path(system, ghost);
        // Half of the cells where light passes, as the search for the pupil has it.
        const Pupil pupil = find_pupil(system, trace_path<double>(system, ghost), frame);
        for (int i = 0; i < tries; ++i) {
            const PupilBox& within = i % 2 == 0 || pupil.empty() ? pupil.entrance : pupil.box;
            const double half =
                0.5 * (within.u1_mm - within.u0_mm) * std::exp2(random.between(-10.0, -1.0));
            const double u = random.between(within.u0_mm, within.u1_mm);
            const double v = random.between(within.v0_mm, within.v1_mm);
            const PupilBox cell{u - half, u + half, v - half, v + half};
            const CellVerdict verdict = prove_cell(path, frame, cell, false);
            checked.dark_cells += verdict.may_pass ? 0 : 1;
            checked.complete_cells += verdict.complete ? 1 : 0;
            for (int k = 0; k < 12; ++k) {
                const Passing ray =
                    traced(system, ghost, frame, random.between(cell.u0_mm, cell.u1_mm),
                           random.between(cell.v0_mm, cell.v1_mm));
                if (!ray.passes) continue;
                ++checked.passing;
                ASSERT_TRUE(verdict.may_pass) << name(ghost) << " " << ray.u_mm << " " << ray.v_mm;
                const PupilBox& live = verdict.live;
                ASSERT_TRUE(ray.u_mm >= live.u0_mm - trace_rounding_mm &&
                            ray.u_mm <= live.u1_mm + trace_rounding_mm &&
                            ray.v_mm >= live.v0_mm - trace_rounding_mm &&
                            ray.v_mm <= live.v1_mm + trace_rounding_mm)
                    << name(ghost);
                for (int r = 0; r < 2; ++r)
                    ASSERT_TRUE(ray.cosine[r] >= verdict.cosine[r].low - trace_rounding &&
                                ray.cosine[r] <= verdict.cosine[r].high + trace_rounding)
                        << name(ghost) << " reflection " << r;
                if (!verdict.complete) continue;
                auto inside = [](const Interval& range, double value) {
                    return value >= range.low - trace_rounding_mm &&
                           value <= range.high + trace_rounding_mm;
                };
                ASSERT_TRUE(inside(verdict.sensor_x_mm, ray.x_mm) &&
                            inside(verdict.sensor_y_mm, ray.y_mm))
                    << name(ghost) << " sensor";
            }
        }
    }
}

TEST(PupilProof, NoRayThatPassesIsOutsideWhatIsProven) {
    for (const char* file : all_lenses) {
        Checked checked;
        for (const double field : {0.0, 9.0, 24.0}) {
            const OpticalSystem system = compile(bundled(file), d_line_nm);
            check_cells(system, beam_frame({field, 90.0}), 8, 120, 17, checked);
        }
        // The checks mean something only if there is light, and darkness, and whole paths.
        EXPECT_GT(checked.passing, 300) << file;
        EXPECT_GT(checked.dark_cells, 300) << file;
        EXPECT_GT(checked.complete_cells, 30) << file;
    }
}

TEST(PupilProof, HoldsForAspheresAndConics) {
    const OpticalSystem system = compile(aspheric_lens(), d_line_nm);
    Checked checked;
    for (const double field : {0.0, 6.0, 15.0})
        check_cells(system, beam_frame({field, 90.0}), 12, 200, 23, checked);
    EXPECT_GT(checked.passing, 1000);
    EXPECT_GT(checked.dark_cells, 500);
    EXPECT_GT(checked.complete_cells, 200);
}

TEST(ReflectanceBound, IsAboveTheFilmAndCloseToIt) {
    constexpr double slack = 0.02;  // of R: a slice of 1/128 of the cosine, away from the onset
    const std::array films = {parse_stack("1.0 | 1.5", 550.0), parse_stack("1.8 | 1.0", 550.0),
                              parse_stack("1.0 | 1.38:99.6 | 1.52", 550.0),
                              parse_stack("1.52 | 1.38:99.6 | 1.0", 450.0),
                              parse_stack("1.0 | 1.38:100 | 2.1:130 | 1.62:85 | 1.6", 620.0)};
    for (const Film& film : films) {
        const ReflectanceBound bound(film);
        for (int i = 0; i <= 4000; ++i) {
            const double cosine = i / 4000.0;
            const Reflectances exact = reflectances(film, cosine);
            const double most = std::max(exact.r_s, exact.r_p);
            const double proven = bound.over({cosine, cosine});
            ASSERT_GE(proven, most - 1e-12) << cosine;
            if (cosine > 0.9) {
                ASSERT_LE(proven, most + slack) << cosine;
            }
        }
        EXPECT_GE(bound.over({0.2, 0.9}), bound.over({0.5, 0.6}));
    }
    EXPECT_EQ(ReflectanceBound(parse_stack("1.0 | 1.5,0.1:30 | 1.6", 550.0)).over({0.5, 1.0}), 1.0);
}

TEST(PupilProof, FluxBoundIsAboveTheTablesFlux) {
    for (const char* file : {"tessar_brendel_100_f2.8", "double_gauss_tronnier_100_f2",
                             "fisheye_nikkor_10.5_f2.8", "nikkor_z_58_f0.95_noct"}) {
        const Prescription lens = bundled(file);
        const OpticalSystem system = compile(lens, d_line_nm);
        const LightDirection light{12.0, 90.0};
        const auto table = ghost_table(lens, {.light = light,
                                              .spectrum = Monochromatic{d_line_nm},
                                              .tolerance = 0.05,
                                              .peaks = false});
        ASSERT_TRUE(table);
        for (std::size_t i = 0; i < table->ghosts.size(); i += 1 + table->ghosts.size() / 25) {
            const GhostRow& r = table->ghosts[i];
            const double bound =
                flux_bound_mm2(system, r.path, beam_frame(light), {.most_cells = 200});
            EXPECT_GE(bound, r.flux_mm2 - r.flux_error_mm2) << file << " " << name(r.path);
        }
    }
}

TEST(PupilProof, GhostsProvenDarkCarryNothingInTheTable) {
    const Prescription lens = bundled("double_gauss_tronnier_100_f2");
    const OpticalSystem system = compile(lens, d_line_nm);
    const LightDirection light{28.0, 90.0};
    const auto table = ghost_table(
        lens,
        {.light = light, .spectrum = Monochromatic{d_line_nm}, .tolerance = 0.05, .peaks = false});
    ASSERT_TRUE(table);
    int dark = 0;
    for (std::size_t i = 0; i < table->ghosts.size(); i += 2) {
        const GhostRow& r = table->ghosts[i];
        const double bound =
            flux_bound_mm2(system, r.path, beam_frame(light), {.most_cells = 4000});
        if (bound > 0.0) continue;
        ++dark;
        EXPECT_EQ(r.flux_mm2, 0.0) << name(r.path);
    }
    EXPECT_GT(dark, 0);
}

TEST(PupilProof, BoundFallsWithEffortAndClaim) {
    const OpticalSystem system = compile(bundled("tessar_brendel_100_f2.8"), d_line_nm);
    const BeamFrame frame = beam_frame({10.0, 90.0});
    const GhostPath ghost = parse_ghost("6-3", system);
    const Pupil pupil = find_pupil(system, trace_path<double>(system, ghost), frame);
    double before = 1e300;
    for (const std::size_t cells : {50U, 400U, 3000U}) {
        const PupilProof proof =
            prove_pupil(system, ghost, frame, pupil.box, {.most_cells = cells});
        EXPECT_LE(proof.missed_flux_bound_mm2, before);
        EXPECT_LE(proof.uncertain_mm2, proof.searched_mm2);
        before = proof.missed_flux_bound_mm2;
    }
    EXPECT_EQ(before, 0.0);
    // Half of the light claimed: the other half shows.
    std::vector<double> passing_v;
    Random random(3);
    while (passing_v.size() < 101) {
        const double u = random.between(pupil.box.u0_mm, pupil.box.u1_mm);
        const double v = random.between(pupil.box.v0_mm, pupil.box.v1_mm);
        if (traced(system, ghost, frame, u, v).passes) passing_v.push_back(v);
    }
    std::ranges::nth_element(passing_v, passing_v.begin() + 50);
    PupilBox half = pupil.box;
    half.v1_mm = passing_v[50];
    EXPECT_GT(prove_pupil(system, ghost, frame, half, {.most_cells = 3000}).missed_flux_bound_mm2,
              0.0);
}

TEST(PupilProof, StopsWhenAsked) {
    const OpticalSystem system = compile(bundled("tessar_brendel_100_f2.8"), d_line_nm);
    std::stop_source source;
    source.request_stop();
    const PupilProof proof =
        prove_pupil(system, parse_ghost("8-2", system), beam_frame({10.0, 90.0}), {},
                    {.most_cells = 100000}, source.get_token());
    EXPECT_FALSE(proof.finished);
    EXPECT_LT(proof.cells, 100U);
    EXPECT_GT(proof.missed_flux_bound_mm2, 0.0);
}

}  // namespace
}  // namespace ghostlight
