#include "core/flare/planned_flare.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>

#include "core/flare/picture_levels.h"
#include "core/flare/planned_ghost.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point began) {
    return std::chrono::duration<double, std::milli>(Clock::now() - began).count();
}

constexpr int band_rows = 16;
/// Errors of ghosts cancel in part where they overlap, and the estimates are cautious: what is
/// granted in all, over what is asked.
constexpr double granted_share = 1.0;
constexpr double most_share = 0.5;  ///< of a ghost's own light

/// Which bands of its level's picture each item touches, by counting sort.
struct ByBand {
    std::vector<std::uint32_t> first, sorted;

    template <class Item, class RangeOf>
    void sort(const std::vector<Item>& items, int bands, RangeOf range_of) {
        first.assign(static_cast<std::size_t>(bands) + 1, 0);
        for (const Item& item : items) {
            const auto [low, high] = range_of(item);
            for (int b = low; b <= high; ++b) ++first[static_cast<std::size_t>(b) + 1];
        }
        for (std::size_t b = 1; b < first.size(); ++b) first[b] += first[b - 1];
        sorted.resize(first.back());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for (std::uint32_t i = 0; i < items.size(); ++i) {
            const auto [low, high] = range_of(items[i]);
            for (int b = low; b <= high; ++b) sorted[next[static_cast<std::size_t>(b)]++] = i;
        }
    }
    std::span<const std::uint32_t> of(int band) const {
        const auto b = static_cast<std::size_t>(band);
        return {sorted.data() + first[b], sorted.data() + first[b + 1]};
    }
};

int band_count(const RasterSize& size) { return (size.height_px + band_rows - 1) / band_rows; }

template <int C>
struct DrawnGhost {
    ColorMesh<C> mesh;
    int level = 0;
    ByBand edges, points;

    void sort_into_bands(const PixelFrame& frame) {
        const RasterSize size = level_size(frame, level);
        auto band_of = [&](double y) {
            return static_cast<int>(
                       std::clamp(y * size.scale + size.margin_px, 0.0, size.height_px - 0.5)) /
                   band_rows;
        };
        edges.sort(mesh.edges, band_count(size), [&](const ColorEdge<C>& e) {
            return std::pair{band_of(std::min(e.y0, e.y1)), band_of(std::max(e.y0, e.y1))};
        });
        points.sort(mesh.points, band_count(size), [&](const ColorPoint<C>& p) {
            return std::pair{band_of(p.y), band_of(p.y)};
        });
    }
};

/// Draws all ghosts, level by level, and brings the levels together; C values a pixel.
template <int C>
std::optional<std::vector<float>> draw_levels(const std::vector<DrawnGhost<C>>& ghosts,
                                              const PixelFrame& frame, unsigned threads,
                                              std::stop_token stop, FlareTimes& times) {
    const auto rastered = Clock::now();
    struct Task {
        int level, band;
    };
    std::vector<std::vector<float>> pictures(picture_levels);
    std::vector<std::vector<const DrawnGhost<C>*>> at_level(picture_levels);
    for (const auto& ghost : ghosts)
        if (!ghost.mesh.edges.empty() || !ghost.mesh.points.empty())
            at_level[static_cast<std::size_t>(ghost.level)].push_back(&ghost);
    std::vector<Task> tasks;
    for (int level = 0; level < picture_levels; ++level) {
        const RasterSize size = level_size(frame, level);
        pictures[static_cast<std::size_t>(level)].assign(
            static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px) * C,
            0.0F);
        if (at_level[static_cast<std::size_t>(level)].empty()) continue;
        for (int band = 0; band < band_count(size); ++band) tasks.push_back({level, band});
    }
    bool finished = parallel_for(tasks.size(), threads, stop, [&](std::size_t t) {
        const auto [level, b] = tasks[t];
        const RasterSize size = level_size(frame, level);
        const int first_row = b * band_rows;
        const int rows = std::min(band_rows, size.height_px - first_row);
        ColorBand<C> band(size, first_row, rows);
        for (const DrawnGhost<C>* ghost : at_level[static_cast<std::size_t>(level)]) {
            band.add(ghost->mesh.edges, ghost->edges.of(b));
            for (const std::uint32_t k : ghost->points.of(b)) band.add(ghost->mesh.points[k]);
        }
        const std::size_t row_values = static_cast<std::size_t>(size.width_px) * C;
        band.resolve({pictures[static_cast<std::size_t>(level)].data() +
                          static_cast<std::size_t>(first_row) * row_values,
                      static_cast<std::size_t>(rows) * row_values});
    });
    if (!finished) return std::nullopt;
    times.raster_ms += ms_since(rastered);

    const auto composed = Clock::now();
    int coarsest = 0;
    for (int level = 0; level < picture_levels; ++level)
        if (!at_level[static_cast<std::size_t>(level)].empty()) coarsest = level;
    for (int level = coarsest - 1; level >= 0; --level) {
        const RasterSize size = level_size(frame, level), coarser = level_size(frame, level + 1);
        std::vector<float>& picture = pictures[static_cast<std::size_t>(level)];
        finished = parallel_for(
            static_cast<std::size_t>(band_count(size)), threads, stop, [&](std::size_t b) {
                const int first = static_cast<int>(b) * band_rows;
                add_coarser_rows(pictures[static_cast<std::size_t>(level) + 1], coarser, size, C,
                                 first, std::min(first + band_rows, size.height_px), picture);
            });
        if (!finished) return std::nullopt;
    }
    times.composite_ms += ms_since(composed);
    return std::move(pictures[0]);
}

template <int C>
std::optional<FlareImage> render(const FlareScene& scene, const FlareRequest& request,
                                 std::stop_token stop) {
    const auto began = Clock::now();
    const OpticalSystem& system = scene.system();
    FlareImage image;
    const PixelFrame frame =
        pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    image.width_px = frame.width_px;
    image.height_px = frame.height_px;
    image.sensor_width_mm = system.sensor_width_mm;
    image.sensor_height_mm = system.sensor_height_mm;
    image.ghosts = scene.ghosts.size();
    image.plan.tolerance = request.tolerance;

    const GhostPlanner planner(scene, request.light, frame);
    std::vector<ProbedGhost> probed(scene.ghosts.size());
    bool finished = parallel_for(probed.size(), request.threads, stop, [&](std::size_t g) {
        probed[g] = planner.probe(scene.ghosts[g]);
    });
    if (!finished) return std::nullopt;
    image.times.bounds_ms = ms_since(began);

    const auto traced = Clock::now();
    std::vector<double> flux;
    double total = 0.0;
    for (const ProbedGhost& ghost : probed) {
        flux.push_back(ghost.planned.flux_mm2);
        total += flux.back();
    }
    const std::vector<double> allowance =
        share_out(flux, granted_share * request.tolerance * total, most_share);
    for (std::size_t g = 0; g < probed.size(); ++g) probed[g].planned.allowance_mm2 = allowance[g];
    std::vector<DrawnGhost<C>> drawn(probed.size());
    std::vector<DrawnGhost<gray_channels>> highlighted(request.highlighted.empty() ? 0
                                                                                   : probed.size());
    finished = parallel_for(probed.size(), request.threads, stop, [&](std::size_t g) {
        if (probed[g].planned.fate != GhostFate::drawn) return;
        planner.draw(probed[g], drawn[g].mesh);
        drawn[g].level = probed[g].planned.level;
        drawn[g].sort_into_bands(frame);
        if (std::ranges::find(request.highlighted, scene.ghosts[g]) != request.highlighted.end()) {
            highlighted[g].mesh = last_channel(drawn[g].mesh);
            highlighted[g].level = drawn[g].level;
            highlighted[g].sort_into_bands(frame);
        }
    });
    if (!finished) return std::nullopt;
    image.times.trace_ms = ms_since(traced);

    const auto picture = draw_levels(drawn, frame, request.threads, stop, image.times);
    if (!picture) return std::nullopt;
    if (!highlighted.empty()) {
        const auto layer = draw_levels(highlighted, frame, request.threads, stop, image.times);
        if (!layer) return std::nullopt;
        image.highlight = *layer;
        for (float& value : image.highlight) value = std::max(0.0F, value);
    }

    const auto composed = Clock::now();
    const auto count =
        static_cast<std::size_t>(frame.width_px) * static_cast<std::size_t>(frame.height_px);
    image.irradiance.resize(count);
    image.rgb.resize(3 * count);
    std::vector<double> row_sums(static_cast<std::size_t>(frame.height_px), 0.0);
    finished = parallel_for(
        static_cast<std::size_t>(band_count(level_size(frame, 0))), request.threads, stop,
        [&](std::size_t b) {
            const int first = static_cast<int>(b) * band_rows;
            for (int row = first; row < std::min(first + band_rows, frame.height_px); ++row) {
                const std::size_t offset =
                    static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.width_px);
                double sum = 0.0;
                for (std::size_t i = offset; i < offset + static_cast<std::size_t>(frame.width_px);
                     ++i) {
                    // What rounding leaves below zero is no light; colours outside the gamut stay.
                    const float* from = picture->data() + i * C;
                    image.irradiance[i] = std::max(0.0F, from[C - 1]);
                    for (std::size_t c = 0; c < 3; ++c)
                        image.rgb[3 * i + c] = C == 1 ? image.irradiance[i] : from[c];
                    sum += static_cast<double>(image.irradiance[i]);
                }
                row_sums[static_cast<std::size_t>(row)] = sum;
            }
        });
    if (!finished) return std::nullopt;
    for (const double sum : row_sums) image.flux_on_sensor_mm2 += sum * frame.pixel_area_mm2();
    for (std::size_t g = 0; g < probed.size(); ++g) {
        image.flux_mm2 += drawn[g].mesh.flux_mm2[C - 1];
        image.cells += drawn[g].mesh.cells;
        image.rays += probed[g].planned.rays;
        image.plan.flux_mm2 += probed[g].planned.flux_mm2;
        image.plan.error_mm2 += probed[g].planned.error_mm2;
        image.plan.ghosts.push_back(std::move(probed[g].planned));
    }
    image.times.composite_ms += ms_since(composed);
    image.times.total_ms = ms_since(began);
    return image;
}

}  // namespace

std::optional<FlareImage> render_planned(const FlareScene& scene, const FlareRequest& request,
                                         std::stop_token stop) {
    return scene.is_gray() ? render<gray_channels>(scene, request, std::move(stop))
                           : render<color_channels>(scene, request, std::move(stop));
}

}  // namespace ghostlight
