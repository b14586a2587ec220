#include "core/flare/flare_image.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/elapsed.h"
#include "core/flare/ghost_mesh.h"
#include "core/flare/paraxial_flare.h"
#include "core/flare/planned_flare.h"
#include "core/flare/reference_image.h"
#include "core/flare/ringing.h"
#include "core/ghosts/pupil.h"
#include "core/ghosts/weighted_grid.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

constexpr int band_rows = 16;
/// Where the stop is an image, whose shape is followed from node to node.
constexpr int coarsest_pictured = 128;
constexpr double color_margin = 0.04;  ///< of a pupil's breadth, when it is shared by wavelengths

PupilBox widened(const PupilBox& box, double share) {
    const double du = share * (box.u1_mm - box.u0_mm), dv = share * (box.v1_mm - box.v0_mm);
    return {box.u0_mm - du, box.u1_mm + du, box.v0_mm - dv, box.v1_mm + dv};
}

/// Mesh of one ghost at one wavelength, its edges and points sorted by the bands they touch.
struct BandedMesh {
    GhostMesh mesh;
    std::vector<std::uint32_t> first_edge, edges;  ///< edges of band b: [first[b], first[b+1])
    std::vector<std::uint32_t> first_point, points;
    std::size_t rays = 0;
};

struct BandRange {
    int first, last;
};

template <class Item, class RangeOf>
void sort_by_band(const std::vector<Item>& items, int bands, RangeOf range_of,
                  std::vector<std::uint32_t>& first, std::vector<std::uint32_t>& sorted) {
    first.assign(static_cast<std::size_t>(bands) + 1, 0);
    for (const Item& item : items) {
        const BandRange range = range_of(item);
        for (int b = range.first; b <= range.last; ++b) ++first[static_cast<std::size_t>(b) + 1];
    }
    for (std::size_t b = 1; b < first.size(); ++b) first[b] += first[b - 1];
    sorted.resize(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t i = 0; i < items.size(); ++i) {
        const BandRange range = range_of(items[i]);
        for (int b = range.first; b <= range.last; ++b)
            sorted[next[static_cast<std::size_t>(b)]++] = i;
    }
}

void sort_into_bands(BandedMesh& banded, const PixelFrame& pixels, int bands) {
    auto band_of = [&](double y) {
        return static_cast<int>(std::clamp(y, 0.0, pixels.height_px - 0.5)) / band_rows;
    };
    sort_by_band(
        banded.mesh.edges, bands,
        [&](const RasterEdge& e) {
            return BandRange{band_of(std::min(e.y0, e.y1)), band_of(std::max(e.y0, e.y1))};
        },
        banded.first_edge, banded.edges);
    sort_by_band(
        banded.mesh.points, bands,
        [&](const RasterPoint& p) {
            return BandRange{band_of(p.y), band_of(p.y)};
        },
        banded.first_point, banded.points);
}

void add_band(const BandedMesh& banded, std::size_t band, BandRaster& raster) {
    for (std::uint32_t k = banded.first_edge[band]; k < banded.first_edge[band + 1]; ++k)
        raster.add(banded.mesh.edges[banded.edges[k]]);
    for (std::uint32_t k = banded.first_point[band]; k < banded.first_point[band + 1]; ++k) {
        const RasterPoint& p = banded.mesh.points[banded.points[k]];
        raster.add_point(p.x, p.y, p.flux);
    }
}

/// Drops the ghosts with the least flux: their share in number, as the 2011 paper does.
void cull_weakest(std::vector<BandedMesh>& meshes, const std::vector<SpectralSample>& samples,
                  double share) {
    const std::size_t ghosts = meshes.size() / samples.size();
    std::vector<double> flux(ghosts, 0.0);
    for (std::size_t t = 0; t < meshes.size(); ++t)
        flux[t / samples.size()] += samples[t % samples.size()].weight * meshes[t].mesh.flux_mm2;
    std::vector<std::size_t> order(ghosts);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t g) { return flux[g]; });
    const auto count = static_cast<std::size_t>(share * static_cast<double>(ghosts));
    for (std::size_t k = 0; k < std::min(count, ghosts); ++k)
        for (std::size_t s = 0; s < samples.size(); ++s) meshes[order[k] * samples.size() + s] = {};
}

FlareScene compiled_scene(const Prescription& lens, const FlareRequest& request) {
    return flare_scene(lens, request.spectrum, FlareScene::usual_samples, request.threads,
                       request.coating_model);
}

ReferenceRequest reference_request(const FlareRequest& request) {
    ReferenceRequest reference;
    reference.light = request.light;
    reference.spectrum = request.spectrum;
    reference.width_px = request.width_px;
    reference.tolerance = request.tolerance;
    reference.only = request.only;
    reference.highlighted = request.highlighted;
    reference.threads = request.threads;
    return reference;
}

}  // namespace

bool can_be_planned(const OpticalSystem& system, const LightDirection& light) {
    if (system.stop_mask.picture) return false;
    return !system.sensor_face || std::abs(std::fmod(light.azimuth_deg, 180.0)) == 90.0;
}

std::optional<FlareImage> render_flare(const Prescription& lens, const FlareRequest& request,
                                       std::stop_token stop) {
    switch (request.method) {
        case FlareMethod::planned: {
            const FlareScene scene = compiled_scene(lens, request);
            if (!can_be_planned(scene.system(), request.light)) break;
            return render_planned(scene, request, std::move(stop));
        }
        case FlareMethod::paraxial:
            return render_paraxial(compiled_scene(lens, request), request, std::move(stop));
        case FlareMethod::reference: {
            auto reference = render_reference(lens, reference_request(request), std::move(stop));
            if (!reference) return std::nullopt;
            return std::move(reference->image);
        }
        case FlareMethod::uniform:
            break;
    }
    return render_uniform(lens, request, std::move(stop));
}

std::optional<FlareImage> render_uniform(const Prescription& lens, const FlareRequest& request,
                                         std::stop_token stop) {
    const auto began = Clock::now();
    const auto samples = sample(request.spectrum, request.spectral_samples);
    const auto colors = sample_colors(request.spectrum, samples);
    std::vector<OpticalSystem> systems;
    for (const SpectralSample& s : samples) systems.push_back(compile(lens, s.wavelength_nm));
    const std::vector<GhostPath> ghosts =
        request.only.empty() ? two_reflection_ghosts(systems.front()) : request.only;
    const BeamFrame frame = beam_frame(request.light);
    const PixelFrame pixels = pixel_frame(systems.front().sensor_width_mm,
                                          systems.front().sensor_height_mm, request.width_px);
    const double reach_mm =
        std::hypot(systems.front().sensor_width_mm, systems.front().sensor_height_mm);
    const int bands = (pixels.height_px + band_rows - 1) / band_rows;

    FlareImage image;
    image.width_px = pixels.width_px;
    image.height_px = pixels.height_px;
    image.sensor_width_mm = systems.front().sensor_width_mm;
    image.sensor_height_mm = systems.front().sensor_height_mm;
    image.ghosts = ghosts.size();

    // One task per ghost and wavelength; task t is ghost t / samples at wavelength t % samples.
    const std::size_t tasks = ghosts.size() * samples.size();
    std::vector<Pupil> pupils(ghosts.size());
    bool finished = parallel_for(ghosts.size(), request.threads, stop, [&](std::size_t g) {
        // Colour moves a pupil's edge by far less than a cell: one wavelength finds it for all.
        const OpticalSystem& system = systems[samples.size() / 2];
        pupils[g] =
            find_pupil(system, trace_path<float>(system, ghosts[g]), frame, PupilSearch::quick);
        if (samples.size() > 1) pupils[g].box = widened(pupils[g].box, color_margin);
    });
    if (!finished) return std::nullopt;
    image.times.bounds_ms = ms_since(began);

    const auto traced = Clock::now();
    std::vector<BandedMesh> meshes(tasks);
    finished = parallel_for(tasks, request.threads, stop, [&](std::size_t t) {
        const Pupil& pupil = pupils[t / samples.size()];
        if (pupil.empty()) return;
        const OpticalSystem& system = systems[t % samples.size()];
        const GhostPath& ghost = ghosts[t / samples.size()];
        const auto path = trace_path<float>(system, ghost);
        const auto probe = probe_bundle(system, path, frame, pupil.box);
        int cells = request.grid != 0
                        ? request.grid
                        : cells_for_bend(probe, request.bend_px * pixels.pitch_mm, reach_mm);
        if (request.grid == 0 && system.stop_mask.picture)
            cells = std::max(cells, coarsest_pictured);
        const auto grid = weighted_grid(system, path, frame, pupil.box, probe, cells);
        meshes[t].mesh = ghost_mesh(grid, pixels, 1.0);
        meshes[t].rays = grid.rays() + probe.rays.size();
        sort_into_bands(meshes[t], pixels, bands);
    });
    if (!finished) return std::nullopt;
    image.times.trace_ms = ms_since(traced);

    cull_weakest(meshes, samples, request.culled);

    const auto rastered = Clock::now();
    const std::size_t count =
        static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
    image.irradiance.assign(count, 0.0F);
    image.rgb.assign(3 * count, 0.0F);
    if (!request.highlighted.empty()) image.highlight.assign(count, 0.0F);
    auto is_highlighted = [&](std::size_t t) {
        return std::ranges::find(request.highlighted, ghosts[t / samples.size()]) !=
               request.highlighted.end();
    };
    finished =
        parallel_for(static_cast<std::size_t>(bands), request.threads, stop, [&](std::size_t b) {
            const int first_row = static_cast<int>(b) * band_rows;
            const int rows = std::min(band_rows, pixels.height_px - first_row);
            BandRaster raster(pixels.width_px, first_row, rows);
            std::vector<double> values(static_cast<std::size_t>(pixels.width_px) *
                                       static_cast<std::size_t>(rows));
            const std::size_t offset =
                static_cast<std::size_t>(first_row) * static_cast<std::size_t>(pixels.width_px);
            auto put = [&](std::size_t s, bool highlight) {
                raster.resolve(values);
                for (std::size_t i = 0; i < values.size(); ++i) {
                    // What rounding leaves below zero is no light.
                    const float value =
                        static_cast<float>(std::max(0.0, values[i]) * samples[s].weight);
                    image.irradiance[offset + i] += value;
                    float* rgb = &image.rgb[3 * (offset + i)];
                    rgb[0] += value * static_cast<float>(colors[s].r);
                    rgb[1] += value * static_cast<float>(colors[s].g);
                    rgb[2] += value * static_cast<float>(colors[s].b);
                    if (highlight) image.highlight[offset + i] += value;
                }
            };
            for (std::size_t s = 0; s < samples.size(); ++s) {
                for (const bool highlight : {false, true}) {
                    if (highlight && request.highlighted.empty()) continue;
                    for (std::size_t t = s; t < tasks; t += samples.size())
                        if (!meshes[t].first_edge.empty() && is_highlighted(t) == highlight)
                            add_band(meshes[t], b, raster);
                    put(s, highlight);
                }
            }
        });
    if (!finished) return std::nullopt;
    image.times.raster_ms = ms_since(rastered);
    for (std::size_t t = 0; t < tasks; ++t) {
        image.flux_mm2 += samples[t % samples.size()].weight * meshes[t].mesh.flux_mm2;
        image.rays += meshes[t].rays;
        image.cells += meshes[t].mesh.cells;
    }
    for (const Pupil& pupil : pupils) image.rays += pupil.rays;
    double sum = 0.0;
    for (const float value : image.irradiance) sum += static_cast<double>(value);
    image.flux_on_sensor_mm2 = sum * pixels.pixel_area_mm2();
    if (request.ringing && !add_ringing(compiled_scene(lens, request), request, stop, image))
        return std::nullopt;
    image.times.total_ms = ms_since(began);
    return image;
}

std::vector<float> upright_picture(const std::vector<float>& data, int width_px, int height_px,
                                   int channels) {
    std::vector<float> picture(data.size());
    for (int row = 0; row < height_px; ++row)
        for (int column = 0; column < width_px; ++column)
            for (int c = 0; c < channels; ++c) {
                const auto at = [&](int i) {
                    return static_cast<std::size_t>((row * width_px + i) * channels + c);
                };
                picture[at(column)] = data[at(width_px - 1 - column)];
            }
    return picture;
}

}  // namespace ghostlight
