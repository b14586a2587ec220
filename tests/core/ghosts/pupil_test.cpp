#include "core/ghosts/pupil.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "core/units.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

TEST(Pupil, EntranceBoxHoldsTheFirstSurfacesCap) {
    for (const char* file : {"tessar_brendel_100_f2.8", "fisheye_nikkor_10.5_f2.8"}) {
        const OpticalSystem system = compile(bundled(file), d_line_nm);
        const SurfaceAt& first = system.surfaces.front();
        for (const double field : {0.0, 40.0, 88.0, 90.0}) {
            const BeamFrame frame = beam_frame({field, 63.0});
            const PupilBox box = entrance_box(system, frame);
            const double a = first.semi_diameter_mm, c = first.curvature_per_mm;
            for (double phi = 0.0; phi < 6.3; phi += 0.01) {
                const double sag = c * a * a / (1.0 + std::sqrt(1.0 - c * c * a * a));
                const glm::dvec3 rim(a * std::cos(phi), a * std::sin(phi), sag);
                const double u = rim.x * frame.e1.x + rim.y * frame.e1.y + rim.z * frame.e1.z;
                const double v = rim.x * frame.e2.x + rim.y * frame.e2.y + rim.z * frame.e2.z;
                ASSERT_TRUE(u >= box.u0_mm && u <= box.u1_mm && v >= box.v0_mm && v <= box.v1_mm);
            }
            EXPECT_LT(box.area_mm2(), 4.2 * a * (a + std::abs(first.curvature_per_mm) * a * a));
        }
    }
}

struct Loss {
    double flux_mm2, lost_mm2;
};

/// Flux of random rays that pass, and the part of it that lies outside the cells found.
Loss loss_of(const OpticalSystem& system, const GhostPath& ghost, const BeamFrame& frame,
             const Pupil& pupil, int rays, std::uint64_t seed) {
    const PupilBox& box = pupil.entrance;
    Random random(seed);
    Bundle<double> bundle;
    for (int i = 0; i < rays; ++i) {
        bundle.u_mm.push_back(random.between(box.u0_mm, box.u1_mm));
        bundle.v_mm.push_back(random.between(box.v0_mm, box.v1_mm));
    }
    trace_bundle(trace_path<double>(system, ghost), frame, Weights::polarised, bundle);
    std::set<std::pair<std::uint32_t, std::uint32_t>> cells;
    for (const PupilCell& cell : pupil.cells) cells.insert({cell.i, cell.j});
    double all = 0.0, lost = 0.0;
    for (std::size_t n = 0; n < bundle.size(); ++n) {
        bool passes = bundle.margin[n] >= 0.0 && bundle.r_rel[n] <= 1.0;
        for (std::size_t k = 0; passes && k < static_cast<std::size_t>(bundle.stop_crossings); ++k)
            passes = stop_passes(system.stop_mask, bundle.stop_u_mm[k][n], bundle.stop_v_mm[k][n]);
        if (!passes) continue;
        all += bundle.weight[n];
        const auto cell = [&](double at, double low, double high) {
            return static_cast<std::uint32_t>((at - low) / (high - low) * pupil.across);
        };
        const bool found = cells.contains({cell(bundle.u_mm[n], box.u0_mm, box.u1_mm),
                                           cell(bundle.v_mm[n], box.v0_mm, box.v1_mm)});
        if (!found) lost += bundle.weight[n];
    }
    const double per_ray = box.area_mm2() / rays;
    return {all * per_ray, lost * per_ray};
}

TEST(Pupil, ThoroughSearchLosesNoLight) {
    // 1e-3 of a ghost, or 1e-6 of the strongest: nothing fainter is promised.
    constexpr double of_itself = 1e-3, of_strongest = 1e-6;
    for (const char* file :
         {"tessar_brendel_100_f2.8", "fisheye_nikkor_10.5_f2.8", "nikkor_z_58_f0.95_noct"}) {
        const OpticalSystem system = compile(bundled(file), d_line_nm);
        const auto ghosts = two_reflection_ghosts(system);
        for (const double field : {0.0, 17.0, 60.0}) {
            std::vector<std::pair<std::size_t, Loss>> losses;
            double strongest = 0.0;
            for (std::size_t i = 0; i < ghosts.size(); i += 1 + ghosts.size() / 12) {
                const BeamFrame frame = beam_frame({field, 90.0});
                const Pupil pupil =
                    find_pupil(system, trace_path<double>(system, ghosts[i]), frame);
                losses.emplace_back(i, loss_of(system, ghosts[i], frame, pupil, 20000, 61 + i));
                strongest = std::max(strongest, losses.back().second.flux_mm2);
            }
            for (const auto& [i, loss] : losses)
                EXPECT_LE(loss.lost_mm2, of_itself * loss.flux_mm2 + of_strongest * strongest)
                    << file << " " << name(ghosts[i]) << " at " << field << ": of " << loss.flux_mm2
                    << " mm2, strongest " << strongest;
        }
    }
}

TEST(Pupil, CellsLieInTheirBox) {
    const OpticalSystem system =
        compile(stopped_down(bundled("tessar_brendel_100_f2.8"), 0.02), d_line_nm);
    const BeamFrame frame = beam_frame({10.0, 90.0});
    for (const PupilSearch search : {PupilSearch::quick, PupilSearch::thorough}) {
        const Pupil pupil = find_pupil(system, trace_path<double>(system, {}), frame, search);
        ASSERT_FALSE(pupil.empty());
        EXPECT_LT(pupil.box.area_mm2(), 1e-3 * pupil.entrance.area_mm2());
        EXPECT_LT(pupil.rays, 100000U);
    }
}

TEST(Pupil, GridRowsRunFromTheLowCorner) {
    Bundle<double> bundle;
    lay_grid({-1.0, 3.0, 10.0, 20.0}, 4, bundle);
    ASSERT_EQ(bundle.size(), 25U);
    EXPECT_EQ(bundle.u_mm[0], -1.0);
    EXPECT_EQ(bundle.u_mm[1], 0.0);
    EXPECT_EQ(bundle.v_mm[4], 10.0);
    EXPECT_EQ(bundle.v_mm[5], 12.5);
    EXPECT_EQ(bundle.u_mm[24], 3.0);
    EXPECT_EQ(bundle.v_mm[24], 20.0);
}

}  // namespace
}  // namespace ghostlight
