#include "core/flare/reference_image.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <numeric>

#include "core/elapsed.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

/// Part of the tolerance that is granted: the estimates of the first look are good to that.
constexpr double granted = 0.8;
constexpr double first_look_share = 0.1;  ///< of the progress
/// Where the picture's own levels begin: coarser ones might agree by chance.
constexpr int coarsest_drawn = 2;

/// Sums of pictures in units of a quantum far below a float's rounding: integers add to the same in
/// any order.
class FixedPoint {
   public:
    FixedPoint(std::size_t size, double quantum) : quantum_(quantum), sums_(size, 0) {}
    void add(std::size_t at, double value) { sums_[at] += std::llrint(value / quantum_); }
    double operator[](std::size_t at) const { return static_cast<double>(sums_[at]) * quantum_; }

   private:
    double quantum_;
    std::vector<std::int64_t> sums_;
};

/// A ghost at its two latest levels.
struct Ladder {
    int level = 0;
    std::vector<Pupil> pupils;
    SampledGhost coarse, fine;
    double error_mm2 = 0.0;
    std::size_t rays = 0;
};

class Levels {
   public:
    Levels(const SamplingScene& scene, int finest) : scene_(scene) {
        for (int k = 0; k <= finest; ++k) {
            levels_.push_back(sampling_level(k, scene.has_disc(), !scene.is_gray()));
            spectra_.push_back(k > 0 && scene.is_gray() ? spectra_.front()
                                                        : sampled_spectrum(scene, levels_.back()));
        }
    }
    int finest() const { return static_cast<int>(levels_.size()) - 1; }
    const SamplingLevel& at(int level) const { return levels_[idx(level)]; }
    const OpticalSystem& system() const { return spectra_.front().systems.front(); }
    /// Rays of a level, in those of the first.
    double work(int level) const {
        auto rays = [](const SamplingLevel& l) {
            return static_cast<double>(l.cells) * l.cells * l.directions * l.wavelengths;
        };
        return rays(at(level)) / rays(at(0));
    }

    Ladder climb(const GhostPath& path, int level, std::vector<Pupil> pupils) const {
        Ladder ladder;
        ladder.level = level;
        ladder.pupils = std::move(pupils);
        ladder.coarse = sampled(path, level - 1, ladder.pupils);
        ladder.fine = sampled(path, level, ladder.pupils);
        ladder.rays = ladder.coarse.rays + ladder.fine.rays;
        judge(ladder);
        return ladder;
    }
    void climb_on(const GhostPath& path, Ladder& ladder) const {
        ladder.coarse = std::move(ladder.fine);
        ladder.fine = sampled(path, ++ladder.level, ladder.pupils);
        ladder.rays += ladder.fine.rays;
        judge(ladder);
    }

   private:
    const SamplingScene& scene_;
    std::vector<SamplingLevel> levels_;
    std::vector<SampledSpectrum> spectra_;

    static std::size_t idx(int i) { return static_cast<std::size_t>(i); }
    SampledGhost sampled(const GhostPath& path, int level, std::vector<Pupil>& pupils) const {
        if (scene_.has_disc()) pupils.clear();
        return sample_ghost(scene_, spectra_[idx(level)], at(level), path, pupils);
    }
    void judge(Ladder& ladder) const {
        ladder.error_mm2 = l1_distance_mm2(ladder.fine.picture, ladder.coarse.picture,
                                           scene_.pixels.pixel_area_mm2());
    }
};

/// Shares an error out among ghosts whose first look left `errors`: with the work on each going as
/// its error over its share, the least work in all has shares in proportion to the errors' roots.
std::vector<double> allowances_of(const std::vector<double>& errors, double allowed) {
    double roots = 0.0, sum = 0.0;
    for (const double e : errors) {
        roots += std::sqrt(e);
        sum += e;
    }
    if (sum <= allowed) return errors;
    auto shared = [&](double factor) {
        std::vector<double> shares;
        for (const double e : errors) shares.push_back(std::min(e, factor * std::sqrt(e)));
        return shares;
    };
    double low = 0.0, high = std::sqrt(*std::ranges::max_element(errors));
    constexpr int halvings = 60;
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (low + high);
        const auto shares = shared(middle);
        (std::accumulate(shares.begin(), shares.end(), 0.0) < allowed ? low : high) = middle;
    }
    return shared(low);
}

/// Where all ghosts' pictures come together.
class Sums {
   public:
    Sums(const SamplingScene& scene, double quantum, bool highlight)
        : channels_(static_cast<std::size_t>(scene.channels())),
          width_(static_cast<std::size_t>(scene.pixels.width_px)),
          pixels_(width_ * static_cast<std::size_t>(scene.pixels.height_px)),
          light_(pixels_ * channels_, quantum),
          coarse_(pixels_, quantum),
          error_(pixels_, quantum),
          highlight_(highlight ? pixels_ : 0, quantum) {}

    void add(const Ladder& ladder, bool highlighted, std::vector<float>* layer) {
        const std::lock_guard lock(guard_);
        if (layer) layer->assign(pixels_, 0.0F);
        for (std::size_t b = 0; b < ladder.fine.picture.bands.size(); ++b) {
            const BandedPicture &fine = ladder.fine.picture, &coarse = ladder.coarse.picture;
            const bool in_fine = !fine.bands[b].empty(), in_coarse = !coarse.bands[b].empty();
            if (!in_fine && !in_coarse) continue;
            const std::size_t count = static_cast<std::size_t>(fine.rows(b)) * width_;
            const std::size_t first =
                b * static_cast<std::size_t>(BandedPicture::band_rows) * width_;
            for (std::size_t i = 0; i < count; ++i) {
                const double f = in_fine ? fine.irradiance(b, i) : 0.0;
                const double c = in_coarse ? coarse.irradiance(b, i) : 0.0;
                if (f == 0.0 && c == 0.0) continue;
                if (in_fine)
                    for (std::size_t k = 0; k < channels_; ++k)
                        light_.add((first + i) * channels_ + k, fine.bands[b][i * channels_ + k]);
                coarse_.add(first + i, c);
                error_.add(first + i, std::abs(f - c));
                if (highlighted) highlight_.add(first + i, f);
                if (layer) (*layer)[first + i] = static_cast<float>(f);
            }
        }
    }

    void finish(ReferenceImage& result, double pixel_area_mm2, bool highlight) const {
        FlareImage& image = result.image;
        image.irradiance.resize(pixels_);
        image.rgb.resize(3 * pixels_);
        result.error.resize(pixels_);
        if (highlight) image.highlight.resize(pixels_);
        double sum = 0.0;
        for (std::size_t i = 0; i < pixels_; ++i) {
            const double value = light_[i * channels_ + channels_ - 1];
            sum += value;
            result.disagreement_mm2 += std::abs(value - coarse_[i]) * pixel_area_mm2;
            image.irradiance[i] = static_cast<float>(value);
            result.error[i] = static_cast<float>(error_[i]);
            if (highlight) image.highlight[i] = static_cast<float>(highlight_[i]);
            for (std::size_t c = 0; c < 3; ++c)
                image.rgb[3 * i + c] = static_cast<float>(light_[i * channels_ + c % channels_]);
        }
        image.flux_on_sensor_mm2 = sum * pixel_area_mm2;
    }

   private:
    std::size_t channels_, width_, pixels_;
    FixedPoint light_, coarse_, error_, highlight_;
    std::mutex guard_;
};

void fill(const SamplingLevel& level, const Ladder& ladder, double allowance_mm2,
          ReferenceGhost& ghost) {
    ghost.flux_mm2 = ladder.fine.flux_mm2;
    ghost.flux_error_mm2 = std::abs(ladder.fine.flux_mm2 - ladder.coarse.flux_mm2);
    ghost.on_sensor_mm2 = ladder.fine.on_sensor_mm2;
    ghost.on_sensor_error_mm2 = std::abs(ladder.fine.on_sensor_mm2 - ladder.coarse.on_sensor_mm2);
    ghost.allowance_mm2 = allowance_mm2;
    ghost.error_mm2 = ladder.error_mm2;
    ghost.level = ladder.level;
    ghost.sampling = level;
    ghost.rays = ladder.rays;
    ghost.converged = ladder.error_mm2 <= allowance_mm2;
}

FlarePlan plan_of(const ReferenceImage& result, double tolerance) {
    FlarePlan plan;
    plan.tolerance = tolerance;
    for (const ReferenceGhost& ghost : result.ghosts) {
        PlannedGhost& planned = plan.ghosts.emplace_back();
        planned.path = ghost.path;
        planned.fate = ghost.on_sensor_mm2 > 0.0 ? GhostFate::drawn
                       : ghost.flux_mm2 > 0.0    ? GhostFate::off_sensor
                                                 : GhostFate::nothing_passes;
        planned.cells = ghost.sampling.cells;
        planned.bands = ghost.sampling.wavelengths;
        planned.flux_mm2 = ghost.on_sensor_mm2;
        planned.whole_flux_mm2 = ghost.flux_mm2;
        planned.allowance_mm2 = ghost.allowance_mm2;
        planned.error_mm2 = ghost.error_mm2;
        planned.rays = ghost.rays;
        plan.flux_mm2 += ghost.on_sensor_mm2;
        plan.error_mm2 += ghost.error_mm2;
    }
    return plan;
}

}  // namespace

double ReferenceImage::relative_error() const {
    return image.flux_on_sensor_mm2 > 0.0 ? error_mm2 / image.flux_on_sensor_mm2 : 0.0;
}

std::optional<ReferenceImage> render_reference(const Prescription& lens,
                                               const ReferenceRequest& request,
                                               std::stop_token stop,
                                               const std::function<void(double)>& progress) {
    const auto began = Clock::now();
    SamplingScene scene{
        .lens = lens,
        .light = request.light,
        .disc_diameter_deg = request.disc_diameter_deg,
        .spectrum = request.spectrum,
        .pixels = pixel_frame(lens.sensor.width_mm, lens.sensor.height_mm, request.width_px),
        .weights = request.weights,
        .precision = request.precision};
    const Levels levels(scene, std::max(coarsest_drawn, request.finest_level));
    const std::vector<GhostPath> paths =
        request.only.empty() ? two_reflection_ghosts(levels.system()) : request.only;
    const double pixel_area_mm2 = scene.pixels.pixel_area_mm2();
    auto say = [&](double share) {
        if (progress) progress(share);
    };

    // A first look at every ghost, of which only the numbers are kept.
    std::vector<double> errors(paths.size()), fluxes(paths.size());
    std::vector<std::vector<Pupil>> pupils(paths.size());
    std::vector<std::size_t> rays(paths.size());
    std::atomic<std::size_t> looked{0};
    bool finished = parallel_for(paths.size(), request.threads, stop, [&](std::size_t g) {
        Ladder ladder = levels.climb(paths[g], 1, {});
        pupils[g] = std::move(ladder.pupils);
        rays[g] = ladder.rays;
        errors[g] = ladder.error_mm2;
        fluxes[g] = ladder.fine.on_sensor_mm2;
        say(first_look_share * static_cast<double>(++looked) / static_cast<double>(paths.size()));
    });
    if (!finished) return std::nullopt;
    const double flux_mm2 = std::accumulate(fluxes.begin(), fluxes.end(), 0.0);
    const std::vector<double> allowances =
        allowances_of(errors, granted * request.tolerance * flux_mm2);

    // The costly ones first, so that no thread is left with one in the end.
    std::vector<int> begin_at(paths.size());
    std::vector<std::size_t> order(paths.size());
    double work = 0.0;
    for (std::size_t g = 0; g < paths.size(); ++g) {
        const double ratio = errors[g] > 0.0 ? errors[g] / allowances[g] : 1.0;
        begin_at[g] =
            std::min(levels.finest(), 1 + static_cast<int>(std::ceil(std::log2(ratio) - 1e-9)));
        work += levels.work(begin_at[g]);
    }
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&](std::size_t g) { return begin_at[g]; });

    ReferenceImage result;
    result.ghosts.resize(paths.size());
    constexpr double least_flux_mm2 = 1e-9;  // of a picture that is dark
    const double quantum = std::max(flux_mm2, least_flux_mm2) / pixel_area_mm2 * 0x1p-55;
    const bool highlight = !request.highlighted.empty();
    Sums sums(scene, quantum, highlight);
    std::mutex done_guard;
    double done = 0.0;
    finished = parallel_for(paths.size(), request.threads, stop, [&](std::size_t k) {
        const std::size_t g = order[k];
        Ladder ladder = levels.climb(paths[g], begin_at[g], std::move(pupils[g]));
        ladder.rays += rays[g];
        while (request.levels.empty() && ladder.error_mm2 > allowances[g] &&
               ladder.level < levels.finest() && !stop.stop_requested())
            levels.climb_on(paths[g], ladder);
        ReferenceGhost& ghost = result.ghosts[g];
        ghost.path = paths[g];
        fill(levels.at(ladder.level), ladder, allowances[g], ghost);
        sums.add(ladder,
                 std::ranges::find(request.highlighted, paths[g]) != request.highlighted.end(),
                 request.layers ? &ghost.layer : nullptr);
        const std::lock_guard lock(done_guard);
        done += levels.work(begin_at[g]);
        say(first_look_share + (1.0 - first_look_share) * done / work);
    });
    if (!finished || stop.stop_requested()) return std::nullopt;

    FlareImage& image = result.image;
    image.width_px = scene.pixels.width_px;
    image.height_px = scene.pixels.height_px;
    image.sensor_width_mm = lens.sensor.width_mm;
    image.sensor_height_mm = lens.sensor.height_mm;
    image.ghosts = paths.size();
    sums.finish(result, pixel_area_mm2, highlight);
    for (const ReferenceGhost& ghost : result.ghosts) {
        image.flux_mm2 += ghost.flux_mm2;
        image.rays += ghost.rays;
        result.error_mm2 += ghost.error_mm2;
        result.converged = result.converged && ghost.converged;
    }
    image.plan = plan_of(result, request.tolerance);
    image.times.total_ms = ms_since(began);
    return result;
}

}  // namespace ghostlight
