#include "core/flare/ghost_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "core/flare/raster.h"
#include "core/ghosts/cells.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr int coarsest_cells = 24, fewest_directions = 12, fewest_wavelengths = 8;
constexpr int tile_cells = 64;  ///< across: bounds the memory whatever the level
constexpr int split_cells = 6;  ///< across a cell beside failing rays or total reflection
/// Of a pupil's breadth, beside where the outer and the middle wavelengths find it.
constexpr double color_margin = 0.04;

double fraction(double x) { return x - std::floor(x); }

/// The disc's directions, of equal weight: a sunflower's seeds (H. Vogel, 1979), of which every
/// count is even over the disc.
std::vector<LightDirection> directions_of(const SamplingScene& scene, int count) {
    if (!scene.has_disc()) return {scene.light};
    const BeamFrame middle = beam_frame(scene.light);
    const double radius_rad = 0.5 * rad_from_deg(scene.disc_diameter_deg);
    const double golden_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));
    std::vector<LightDirection> directions;
    for (int k = 0; k < count; ++k) {
        const double r = std::tan(radius_rad * std::sqrt((k + 0.5) / count));
        const double turn = golden_rad * k + count;
        const glm::dvec3 d =
            middle.direction + (r * std::cos(turn)) * middle.e1 + (r * std::sin(turn)) * middle.e2;
        const double across = std::hypot(d.x, d.y);
        directions.push_back({deg_from_rad(std::atan2(across, d.z)),
                              across > 0.0 ? deg_from_rad(std::atan2(d.y, d.x)) : 90.0});
    }
    return directions;
}

/// Bands of a raster, made where an edge first touches them.
class LazyRaster {
   public:
    explicit LazyRaster(const PixelFrame& frame)
        : frame_(frame),
          bands_(static_cast<std::size_t>((frame.height_px + BandedPicture::band_rows - 1) /
                                          BandedPicture::band_rows)) {}

    void add(const GhostMesh& mesh) {
        for (const RasterEdge& e : mesh.edges) {
            const std::size_t last = band_of(std::max(e.y0, e.y1));
            for (std::size_t b = band_of(std::min(e.y0, e.y1)); b <= last; ++b) band(b).add(e);
        }
        for (const RasterPoint& p : mesh.points) band(band_of(p.y)).add_point(p.x, p.y, p.flux);
    }

    /// Calls visit(band, values) for every band that was touched, and clears them.
    template <class Visit>
    void resolve(Visit visit) {
        std::vector<double> values;
        for (std::size_t b = 0; b < bands_.size(); ++b) {
            if (!bands_[b]) continue;
            values.resize(static_cast<std::size_t>(frame_.width_px) *
                          static_cast<std::size_t>(rows(b)));
            bands_[b]->resolve(values);
            visit(b, values);
        }
    }

   private:
    const PixelFrame& frame_;
    std::vector<std::optional<BandRaster>> bands_;

    std::size_t band_of(double y) const {
        return static_cast<std::size_t>(std::clamp(y, 0.0, frame_.height_px - 0.5)) /
               BandedPicture::band_rows;
    }
    int rows(std::size_t b) const {
        return std::min(BandedPicture::band_rows,
                        frame_.height_px - static_cast<int>(b) * BandedPicture::band_rows);
    }
    BandRaster& band(std::size_t b) {
        if (!bands_[b])
            bands_[b].emplace(frame_.width_px, static_cast<int>(b) * BandedPicture::band_rows,
                              rows(b));
        return *bands_[b];
    }
};

PupilBox shifted(const PupilBox& box, const SamplingLevel& level) {
    const double du = (box.u1_mm - box.u0_mm) / (level.cells - 1);
    const double dv = (box.v1_mm - box.v0_mm) / (level.cells - 1);
    const double u0 = box.u0_mm - level.shift_u * du, v0 = box.v0_mm - level.shift_v * dv;
    return {u0, u0 + level.cells * du, v0, v0 + level.cells * dv};
}

PupilBox widened(const PupilBox& box, double share) {
    const double du = share * (box.u1_mm - box.u0_mm), dv = share * (box.v1_mm - box.v0_mm);
    return {box.u0_mm - du, box.u1_mm + du, box.v0_mm - dv, box.v1_mm + dv};
}

/// Around all of them that are not empty.
PupilBox hull(std::span<const Pupil> pupils) {
    PupilBox box{1e300, -1e300, 1e300, -1e300};
    for (const Pupil& pupil : pupils) {
        if (pupil.empty()) continue;
        box = {std::min(box.u0_mm, pupil.box.u0_mm), std::max(box.u1_mm, pupil.box.u1_mm),
               std::min(box.v0_mm, pupil.box.v0_mm), std::max(box.v1_mm, pupil.box.v1_mm)};
    }
    return box;
}

/// Whether any of the pupils' cells, widened as their box was, reaches into a tile.
bool may_hold_light(std::span<const Pupil> pupils, const PupilBox& tile, double margin_u,
                    double margin_v) {
    return std::ranges::any_of(pupils, [&](const Pupil& pupil) {
        const double du = (pupil.entrance.u1_mm - pupil.entrance.u0_mm) / pupil.across;
        const double dv = (pupil.entrance.v1_mm - pupil.entrance.v0_mm) / pupil.across;
        return std::ranges::any_of(pupil.cells, [&](const PupilCell& cell) {
            const double u = pupil.entrance.u0_mm + du * cell.i;
            const double v = pupil.entrance.v0_mm + dv * cell.j;
            return u - margin_u <= tile.u1_mm && u + du + margin_u >= tile.u0_mm &&
                   v - margin_v <= tile.v1_mm && v + dv + margin_v >= tile.v0_mm;
        });
    });
}

template <class T>
void keep_reflections_only(RayField<T>& field) {
    Bundle<T>& rays = field.rays;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        T weight = T(1);
        for (std::size_t k = 0; k < static_cast<std::size_t>(rays.reflections); ++k)
            weight *= rays.reflectance[k][i];
        rays.weight[i] = weight;
    }
}

template <class T>
class Sampler {
   public:
    Sampler(const SamplingScene& scene, const SamplingLevel& level, const GhostPath& path)
        : scene_(scene), level_(level), path_(path), raster_(scene.pixels) {}

    SampledGhost draw(const SampledSpectrum& spectrum, std::vector<Pupil>& pupils) {
        SampledGhost ghost;
        ghost.picture.width_px = scene_.pixels.width_px;
        ghost.picture.height_px = scene_.pixels.height_px;
        ghost.picture.channels = scene_.channels();
        ghost.picture.bands.resize(static_cast<std::size_t>(
            (scene_.pixels.height_px + BandedPicture::band_rows - 1) / BandedPicture::band_rows));
        const auto directions = directions_of(scene_, level_.directions);
        const bool many = spectrum.systems.size() > 1;
        std::vector<BeamFrame> frames;
        for (const LightDirection& direction : directions) frames.push_back(beam_frame(direction));
        const std::vector<std::size_t> searched = searched_systems(spectrum);
        if (pupils.empty())
            for (const BeamFrame& frame : frames)
                for (const std::size_t s : searched) {
                    const OpticalSystem& system = spectrum.systems[s];
                    pupils.push_back(find_pupil(system, trace_path<double>(system, path_), frame));
                    ghost.rays += pupils.back().rays;
                }
        for (std::size_t s = 0; s < spectrum.systems.size(); ++s) {
            const double share = spectrum.samples[s].weight / static_cast<double>(frames.size());
            const auto path = trace_path<T>(spectrum.systems[s], path_);
            for (std::size_t d = 0; d < frames.size(); ++d) {
                const std::span<const Pupil> found(pupils.data() + d * searched.size(),
                                                   searched.size());
                if (!std::ranges::all_of(found, &Pupil::empty))
                    draw_beam(spectrum.systems[s], path, frames[d], found, many, share, ghost);
            }
            put(spectrum, s, ghost);
        }
        ghost.on_sensor_mm2 *= scene_.pixels.pixel_area_mm2();
        return ghost;
    }

   private:
    /// Where colours fail apart, each enters by another part of the entrance.
    static std::vector<std::size_t> searched_systems(const SampledSpectrum& spectrum) {
        const std::size_t count = spectrum.systems.size();
        if (count == 1) return {0};
        return {0, count / 2, count - 1};
    }

    const SamplingScene& scene_;
    const SamplingLevel& level_;
    const GhostPath& path_;
    LazyRaster raster_;

    void draw_beam(const OpticalSystem& system, const TracePath<T>& path, const BeamFrame& frame,
                   std::span<const Pupil> pupils, bool many_wavelengths, double share,
                   SampledGhost& ghost) {
        const double margin = many_wavelengths ? color_margin : 0.0;
        const PupilBox around = hull(pupils);
        const PupilBox box = shifted(widened(around, margin), level_);
        const double margin_u = margin * (around.u1_mm - around.u0_mm);
        const double margin_v = margin * (around.v1_mm - around.v0_mm);
        const int tiles = (level_.cells + tile_cells - 1) / tile_cells;
        // Tiles of equal size, so that their seams fall elsewhere on every level.
        const int across = (level_.cells + tiles - 1) / tiles;
        const Weights weights =
            scene_.weights == WeightModel::carried ? Weights::polarised : Weights::average;
        for (int j = 0; j < tiles; ++j)
            for (int i = 0; i < tiles; ++i) {
                const double u_share = static_cast<double>(across) / level_.cells;
                const PupilBox tile{std::lerp(box.u0_mm, box.u1_mm, i * u_share),
                                    std::lerp(box.u0_mm, box.u1_mm, (i + 1) * u_share),
                                    std::lerp(box.v0_mm, box.v1_mm, j * u_share),
                                    std::lerp(box.v0_mm, box.v1_mm, (j + 1) * u_share)};
                if (!may_hold_light(pupils, tile, margin_u, margin_v)) continue;
                auto grid = trace_grid(system, path, frame, tile, across, split_cells, weights);
                if (scene_.weights == WeightModel::reflections_only) {
                    keep_reflections_only(grid.base.field);
                    for (auto& split : grid.splits) keep_reflections_only(split.field);
                }
                ghost.rays += grid.rays();
                const GhostMesh mesh = ghost_mesh(grid, scene_.pixels, share);
                ghost.flux_mm2 += mesh.flux_mm2;
                ghost.pieces += mesh.cells;
                raster_.add(mesh);
            }
    }

    /// What the raster holds of one wavelength goes into the picture.
    void put(const SampledSpectrum& spectrum, std::size_t s, SampledGhost& ghost) {
        const auto channels = static_cast<std::size_t>(scene_.channels());
        raster_.resolve([&](std::size_t b, const std::vector<double>& values) {
            std::vector<double>& band = ghost.picture.bands[b];
            band.resize(values.size() * channels, 0.0);
            for (std::size_t i = 0; i < values.size(); ++i) {
                const double value = std::max(0.0, values[i]);  // rounding below zero is no light
                ghost.on_sensor_mm2 += value;
                double* pixel = &band[i * channels];
                if (channels > 1) {
                    pixel[0] += value * spectrum.colors[s].r;
                    pixel[1] += value * spectrum.colors[s].g;
                    pixel[2] += value * spectrum.colors[s].b;
                }
                pixel[channels - 1] += value;
            }
        });
    }
};

}  // namespace

SamplingLevel sampling_level(int level, bool disc, bool spectrum) {
    const double finer = std::pow(2.0, 0.5 * level);
    auto scaled = [&](int count) { return static_cast<int>(std::lround(count * finer)); };
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    SamplingLevel at;
    // Even, then odd: a node on the middle of the beam, then none.
    at.cells = 2 * (scaled(coarsest_cells) / 2) + level % 2;
    at.shift_u = fraction(0.37 + golden * level);
    at.shift_v = fraction(0.71 + golden * level);
    // As many per area as that: their number grows by two.
    if (disc) at.directions = static_cast<int>(std::lround(fewest_directions * finer * finer));
    if (spectrum) at.wavelengths = scaled(fewest_wavelengths);
    return at;
}

SampledSpectrum sampled_spectrum(const SamplingScene& scene, const SamplingLevel& level) {
    SampledSpectrum spectrum;
    spectrum.samples = sample(scene.spectrum, level.wavelengths);
    spectrum.colors = sample_colors(scene.spectrum, spectrum.samples);
    for (const SpectralSample& each : spectrum.samples)
        spectrum.systems.push_back(compile(scene.lens, each.wavelength_nm));
    return spectrum;
}

int BandedPicture::rows(std::size_t band) const {
    return std::min(band_rows, height_px - static_cast<int>(band) * band_rows);
}

SampledGhost sample_ghost(const SamplingScene& scene, const SampledSpectrum& spectrum,
                          const SamplingLevel& level, const GhostPath& path,
                          std::vector<Pupil>& pupils) {
    return scene.precision == TracePrecision::double_precision
               ? Sampler<double>(scene, level, path).draw(spectrum, pupils)
               : Sampler<float>(scene, level, path).draw(spectrum, pupils);
}

double l1_distance_mm2(const BandedPicture& a, const BandedPicture& b, double pixel_area_mm2) {
    double sum = 0.0;
    for (std::size_t band = 0; band < a.bands.size(); ++band) {
        const bool in_a = !a.bands[band].empty(), in_b = !b.bands[band].empty();
        if (!in_a && !in_b) continue;
        const auto pixels =
            static_cast<std::size_t>(a.rows(band)) * static_cast<std::size_t>(a.width_px);
        for (std::size_t i = 0; i < pixels; ++i)
            sum += std::abs((in_a ? a.irradiance(band, i) : 0.0) -
                            (in_b ? b.irradiance(band, i) : 0.0));
    }
    return sum * pixel_area_mm2;
}

}  // namespace ghostlight
