#include "core/flare/pixel_probe.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/flare/picture_levels.h"
#include "core/flare/planned_ghost.h"
#include "core/flare/probe_all.h"
#include "core/ghosts/pupil.h"
#include "core/ghosts/weighted_grid.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

/// Of a pupil's breadth, where one wavelength finds it for all.
constexpr double color_margin = 0.04;
/// Cells across a ghost where an image lies over the stop, as pictures have them.
constexpr int coarsest_pictured = 128;

PupilBox widened(const PupilBox& box, double share) {
    const double du = share * (box.u1_mm - box.u0_mm), dv = share * (box.v1_mm - box.v0_mm);
    return {box.u0_mm - du, box.u1_mm + du, box.v0_mm - dv, box.v1_mm + dv};
}

/// The same outlines for the raster of pictures, times a factor.
ColorMesh<gray_channels> as_color_mesh(const GhostMesh& from, double factor) {
    ColorMesh<gray_channels> mesh;
    for (const RasterEdge& edge : from.edges)
        mesh.edges.push_back({edge.x0,
                              edge.y0,
                              edge.x1,
                              edge.y1,
                              {factor * edge.value.e},
                              {factor * edge.value.gx},
                              {factor * edge.value.gy}});
    for (const RasterPoint& point : from.points)
        mesh.points.push_back({point.x, point.y, {factor * point.flux}});
    return mesh;
}

/// Mean irradiance over one pixel.
double in_pixel(const ColorMesh<gray_channels>& mesh, const PixelFrame& frame, int column, int row,
                std::vector<std::uint32_t>& chosen, std::vector<float>& values) {
    chosen.clear();
    for (std::uint32_t k = 0; k < mesh.edges.size(); ++k) {
        const auto& edge = mesh.edges[k];
        if (std::max(edge.y0, edge.y1) >= row && std::min(edge.y0, edge.y1) <= row + 1)
            chosen.push_back(k);
    }
    ColorBand<gray_channels> band(level_size(frame, 0), row, 1);
    band.add(mesh.edges, chosen, mesh.reaches_past_right);
    for (const auto& point : mesh.points)
        if (point.y >= row && point.y < row + 1) band.add(point);
    values.assign(static_cast<std::size_t>(frame.width_px), 0.0F);
    band.resolve(values);
    return std::max(0.0, static_cast<double>(values[static_cast<std::size_t>(column)]));
}

}  // namespace

void PixelProbe::bound(Ghost& ghost) const {
    ghost.lowest_px = std::numeric_limits<double>::infinity();
    ghost.highest_px = -ghost.lowest_px;
    for (const auto& mesh : ghost.meshes) {
        for (const auto& edge : mesh.edges) {
            ghost.lowest_px = std::min({ghost.lowest_px, edge.y0, edge.y1});
            ghost.highest_px = std::max({ghost.highest_px, edge.y0, edge.y1});
        }
        for (const auto& point : mesh.points) {
            ghost.lowest_px = std::min(ghost.lowest_px, point.y);
            ghost.highest_px = std::max(ghost.highest_px, point.y);
        }
    }
}

bool PixelProbe::draw_planned(const FlareScene& scene, const FlareRequest& request,
                              const std::stop_token& stop, PixelProbe& probe) {
    const GhostPlanner planner(scene, request.light, probe.frame_, request.search);
    auto found = probe_all(scene, planner, request, stop);
    if (!found) return false;
    probe.ghosts_.resize(found->size());
    return parallel_for(found->size(), request.threads, stop, [&](std::size_t g) {
        Ghost& ghost = probe.ghosts_[g];
        ghost.path = (*found)[g].planned.path;
        if ((*found)[g].planned.fate != GhostFate::drawn) return;
        // In the picture's own channels, so that bands and grids are the picture's.
        ghost.meshes.resize(1);
        if (scene.is_gray()) {
            planner.draw(found->at(g), ghost.meshes.front());
        } else {
            ColorMesh<color_channels> colored;
            planner.draw(found->at(g), colored);
            ghost.meshes.front() = last_channel(colored);
        }
        probe.bound(ghost);
    });
}

bool PixelProbe::draw_uniform(const Prescription& lens, const FlareRequest& request,
                              const std::stop_token& stop, PixelProbe& probe) {
    const auto samples = sample(request.spectrum, request.spectral_samples);
    std::vector<OpticalSystem> systems;
    for (const SpectralSample& s : samples) systems.push_back(compile(lens, s.wavelength_nm));
    const OpticalSystem& middle = systems[samples.size() / 2];
    const std::vector<GhostPath> paths =
        request.only.empty() ? two_reflection_ghosts(middle) : request.only;
    const BeamFrame beam = beam_frame(request.light);
    const double reach_mm = std::hypot(middle.sensor_width_mm, middle.sensor_height_mm);
    probe.ghosts_.resize(paths.size());
    return parallel_for(paths.size(), request.threads, stop, [&](std::size_t g) {
        Ghost& ghost = probe.ghosts_[g];
        ghost.path = paths[g];
        Pupil pupil =
            find_pupil(middle, trace_path<float>(middle, paths[g]), beam, PupilSearch::quick);
        if (samples.size() > 1) pupil.box = widened(pupil.box, color_margin);
        if (pupil.empty()) return;
        for (std::size_t s = 0; s < samples.size(); ++s) {
            const auto path = trace_path<float>(systems[s], paths[g]);
            const auto first = probe_bundle(systems[s], path, beam, pupil.box);
            int cells = cells_for_bend(first, request.bend_px * probe.frame_.pitch_mm, reach_mm);
            if (systems[s].stop_mask.picture) cells = std::max(cells, coarsest_pictured);
            const auto grid = weighted_grid(systems[s], path, beam, pupil.box, first, cells);
            ghost.meshes.push_back(
                as_color_mesh(ghost_mesh(grid, probe.frame_, 1.0), samples[s].weight));
        }
        probe.bound(ghost);
    });
}

std::optional<PixelProbe> PixelProbe::make(const Prescription& lens, const FlareRequest& request,
                                           std::stop_token stop) {
    const FlareScene scene = flare_scene(lens, request.spectrum, FlareScene::usual_samples,
                                         request.threads, request.coating_model);
    PixelProbe probe;
    probe.frame_ = pixel_frame(scene.system().sensor_width_mm, scene.system().sensor_height_mm,
                               request.width_px);
    const bool finished = can_be_planned(scene.system(), request.light)
                              ? draw_planned(scene, request, stop, probe)
                              : draw_uniform(lens, request, stop, probe);
    if (!finished) return std::nullopt;
    std::erase_if(probe.ghosts_, [](const Ghost& ghost) { return ghost.meshes.empty(); });
    return probe;
}

std::optional<ProbedPixel> PixelProbe::at(double x_mm, double y_mm) const {
    const double column = std::floor(frame_.column(x_mm)), row = std::floor(frame_.row(y_mm));
    if (!(column >= 0.0 && column < frame_.width_px && row >= 0.0 && row < frame_.height_px))
        return std::nullopt;
    ProbedPixel pixel;
    pixel.column = static_cast<int>(column);
    pixel.row = static_cast<int>(row);
    std::vector<std::uint32_t> chosen;
    std::vector<float> values;
    // Rounding of a row's running sums leaves next to nothing where there is nothing.
    constexpr double least_share = 1e-6;
    for (const Ghost& ghost : ghosts_) {
        if (ghost.highest_px < pixel.row || ghost.lowest_px > pixel.row + 1) continue;
        GhostInPixel here{ghost.path, 0.0, 0.0};
        for (const auto& mesh : ghost.meshes)
            here.irradiance += in_pixel(mesh, frame_, pixel.column, pixel.row, chosen, values);
        pixel.irradiance += here.irradiance;
        if (here.irradiance > 0.0) pixel.ghosts.push_back(std::move(here));
    }
    for (GhostInPixel& ghost : pixel.ghosts) ghost.share = ghost.irradiance / pixel.irradiance;
    std::erase_if(pixel.ghosts, [](const GhostInPixel& g) { return g.share < least_share; });
    std::ranges::stable_sort(pixel.ghosts, std::ranges::greater{}, &GhostInPixel::irradiance);
    return pixel;
}

}  // namespace ghostlight
