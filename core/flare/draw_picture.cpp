#include "core/flare/draw_picture.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "core/elapsed.h"
#include "core/flare/picture_levels.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

constexpr int band_rows = 16;

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
struct BandedGhost {
    const ColorMesh<C>* mesh = nullptr;
    ByBand edges, points;

    void sort(const DrawnGhost<C>& ghost, const PixelFrame& frame) {
        mesh = &ghost.mesh;
        const RasterSize size = level_size(frame, ghost.level);
        auto band_of = [&](double y) {
            return static_cast<int>(
                       std::clamp(y * size.scale + size.margin_px, 0.0, size.height_px - 0.5)) /
                   band_rows;
        };
        edges.sort(mesh->edges, band_count(size), [&](const ColorEdge<C>& e) {
            return std::pair{band_of(std::min(e.y0, e.y1)), band_of(std::max(e.y0, e.y1))};
        });
        points.sort(mesh->points, band_count(size), [&](const ColorPoint<C>& p) {
            return std::pair{band_of(p.y), band_of(p.y)};
        });
    }
};

}  // namespace

template <int C>
LevelPictures<C>::LevelPictures(const PixelFrame& frame) : frame_(frame), levels_(picture_levels) {
    for (int level = 0; level < picture_levels; ++level) {
        const RasterSize size = level_size(frame, level);
        levels_[static_cast<std::size_t>(level)].assign(
            static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px) * C,
            0.0F);
    }
}

template <int C>
bool LevelPictures<C>::add(const std::vector<DrawnGhost<C>>& ghosts, unsigned threads,
                           const std::stop_token& stop, FlareTimes& times) {
    const auto rastered = Clock::now();
    struct Task {
        int level, band;
    };
    std::vector<BandedGhost<C>> banded(ghosts.size());
    if (!parallel_for(ghosts.size(), threads, stop,
                      [&](std::size_t g) { banded[g].sort(ghosts[g], frame_); }))
        return false;
    std::vector<std::vector<const BandedGhost<C>*>> at_level(picture_levels);
    for (std::size_t g = 0; g < ghosts.size(); ++g)
        if (!ghosts[g].mesh.edges.empty() || !ghosts[g].mesh.points.empty())
            at_level[static_cast<std::size_t>(ghosts[g].level)].push_back(&banded[g]);
    std::vector<Task> tasks;
    for (int level = 0; level < picture_levels; ++level) {
        if (at_level[static_cast<std::size_t>(level)].empty()) continue;
        coarsest_ = std::max(coarsest_, level);
        for (int band = 0; band < band_count(level_size(frame_, level)); ++band)
            tasks.push_back({level, band});
    }
    const bool finished = parallel_for(tasks.size(), threads, stop, [&](std::size_t t) {
        const auto [level, b] = tasks[t];
        const RasterSize size = level_size(frame_, level);
        const int first_row = b * band_rows;
        const int rows = std::min(band_rows, size.height_px - first_row);
        ColorBand<C> band(size, first_row, rows);
        for (const BandedGhost<C>* ghost : at_level[static_cast<std::size_t>(level)]) {
            band.add(ghost->mesh->edges, ghost->edges.of(b), ghost->mesh->reaches_past_right);
            for (const std::uint32_t k : ghost->points.of(b)) band.add(ghost->mesh->points[k]);
        }
        const std::size_t row_values = static_cast<std::size_t>(size.width_px) * C;
        band.resolve({levels_[static_cast<std::size_t>(level)].data() +
                          static_cast<std::size_t>(first_row) * row_values,
                      static_cast<std::size_t>(rows) * row_values});
    });
    times.raster_ms += ms_since(rastered);
    return finished;
}

template <int C>
void LevelPictures<C>::bring_up(int level, std::size_t band) {
    if (level >= coarsest_) return;
    const RasterSize size = level_size(frame_, level);
    const int first = static_cast<int>(band) * band_rows;
    add_coarser_rows<C>(levels_[static_cast<std::size_t>(level) + 1], level_size(frame_, level + 1),
                        size, first, std::min(first + band_rows, size.height_px),
                        levels_[static_cast<std::size_t>(level)]);
}

template <int C>
bool LevelPictures<C>::bring_up_to(int last, unsigned threads, const std::stop_token& stop) {
    for (int level = coarsest_ - 1; level >= last; --level)
        if (!parallel_for(static_cast<std::size_t>(band_count(level_size(frame_, level))), threads,
                          stop, [&](std::size_t band) { bring_up(level, band); }))
            return false;
    return true;
}

template <int C>
std::vector<float>& LevelPictures<C>::level(int level) {
    coarsest_ = std::max(coarsest_, level);
    return levels_[static_cast<std::size_t>(level)];
}

template <int C>
std::optional<std::vector<float>> LevelPictures<C>::take(unsigned threads,
                                                         const std::stop_token& stop,
                                                         FlareTimes& times) {
    const auto composed = Clock::now();
    if (!bring_up_to(0, threads, stop)) return std::nullopt;
    times.composite_ms += ms_since(composed);
    return std::move(levels_[0]);
}

FlareImage empty_image(const OpticalSystem& system, const PixelFrame& frame) {
    FlareImage image;
    image.width_px = frame.width_px;
    image.height_px = frame.height_px;
    image.sensor_width_mm = system.sensor_width_mm;
    image.sensor_height_mm = system.sensor_height_mm;
    return image;
}

template <int C>
bool LevelPictures<C>::finish(unsigned threads, const std::stop_token& stop, FlareImage& image) {
    const auto composed = Clock::now();
    const auto width = static_cast<std::size_t>(frame_.width_px);
    const auto height = static_cast<std::size_t>(frame_.height_px);
    // Clearing as much memory takes as long as filling it.
    parallel_for(2, threads, {}, [&](std::size_t k) {
        k == 0 ? image.rgb.resize(3 * width * height) : image.irradiance.resize(width * height);
    });
    if (!bring_up_to(1, threads, stop)) return false;
    std::vector<double> row_sums(height, 0.0);
    // The last step band by band, while what has been brought up is still at hand.
    const auto bands = static_cast<std::size_t>(band_count(level_size(frame_, 0)));
    const bool finished = parallel_for(bands, threads, stop, [&](std::size_t band) {
        bring_up(0, band);
        const std::size_t first = band * band_rows;
        for (std::size_t row = first; row < std::min(first + band_rows, height); ++row) {
            double sum = 0.0;
            for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
                // What rounding leaves below zero is no light; colours outside the gamut stay.
                const float* from = levels_[0].data() + i * C;
                image.irradiance[i] = std::max(0.0F, from[C - 1]);
                for (std::size_t c = 0; c < 3; ++c)
                    image.rgb[3 * i + c] = C == 1 ? image.irradiance[i] : from[c];
                sum += static_cast<double>(image.irradiance[i]);
            }
            row_sums[row] = sum;
        }
    });
    for (const double sum : row_sums) image.flux_on_sensor_mm2 += sum * frame_.pixel_area_mm2();
    image.times.composite_ms += ms_since(composed);
    return finished;
}
template class LevelPictures<gray_channels>;
template class LevelPictures<color_channels>;

template <int C>
bool draw_picture(const std::vector<DrawnGhost<C>>& ghosts, const PixelFrame& frame,
                  unsigned threads, const std::stop_token& stop, FlareImage& image) {
    LevelPictures<C> levels(frame);
    return levels.add(ghosts, threads, stop, image.times) && levels.finish(threads, stop, image);
}
template bool draw_picture(const std::vector<DrawnGhost<gray_channels>>&, const PixelFrame&,
                           unsigned, const std::stop_token&, FlareImage&);
template bool draw_picture(const std::vector<DrawnGhost<color_channels>>&, const PixelFrame&,
                           unsigned, const std::stop_token&, FlareImage&);

bool finish_highlight(LevelPictures<gray_channels>& ghosts, unsigned threads,
                      const std::stop_token& stop, FlareImage& image) {
    auto picture = ghosts.take(threads, stop, image.times);
    if (!picture) return false;
    image.highlight = std::move(*picture);
    for (float& value : image.highlight) value = std::max(0.0F, value);
    return true;
}

}  // namespace ghostlight
