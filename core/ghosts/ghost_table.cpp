#include "core/ghosts/ghost_table.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "core/flare/raster.h"
#include "core/ghosts/flux_quadrature.h"
#include "core/parallel.h"

namespace ghostlight {
namespace {

constexpr int peak_width_px = 1280;
constexpr int coarsest_peak_grid = 32, finest_peak_grid = 512;
constexpr double peak_tolerance = 0.05;  ///< change on doubling the grid at which a peak is settled
constexpr int fewest_nodes = 5;          ///< of the spectrum; refined until two sets agree
constexpr int coarser_nodes = 3;         ///< every other one of the fewest
constexpr int most_nodes = 33;
constexpr double faint_share = 1e-6;  ///< of the strongest ghost: nothing is refined below it

/// One path over the spectrum.
struct PathOverSpectrum {
    std::map<double, PathFlux> at;  ///< by wavelength, nm
    int nodes = 1;
    FluxSums sums;
    double error_mm2 = 0.0;
};

double peak_of(const std::vector<GhostMesh>& meshes, const PixelFrame& pixels) {
    constexpr int rows_at_once = 16;
    double bottom = pixels.height_px, top = 0.0;
    for (const GhostMesh& mesh : meshes) {
        for (const RasterEdge& edge : mesh.edges) {
            bottom = std::min({bottom, edge.y0, edge.y1});
            top = std::max({top, edge.y0, edge.y1});
        }
        for (const RasterPoint& point : mesh.points) {
            bottom = std::min(bottom, point.y);
            top = std::max(top, point.y);
        }
    }
    const int first = static_cast<int>(std::max(0.0, bottom)) / rows_at_once * rows_at_once;
    const int last = static_cast<int>(std::min<double>(pixels.height_px, std::ceil(top)));
    double peak = 0.0;
    std::vector<double> values;
    for (int row = first; row < last; row += rows_at_once) {
        const int count = std::min(rows_at_once, pixels.height_px - row);
        BandRaster band(pixels.width_px, row, count);
        for (const GhostMesh& mesh : meshes) {
            for (const RasterEdge& edge : mesh.edges) band.add(edge);
            for (const RasterPoint& point : mesh.points)
                band.add_point(point.x, point.y, point.flux);
        }
        values.resize(static_cast<std::size_t>(pixels.width_px) * static_cast<std::size_t>(count));
        band.resolve(values);
        peak = std::max(peak, *std::ranges::max_element(values));
    }
    return peak;
}

class TableBuilder {
   public:
    TableBuilder(const Prescription& lens, const GhostTableRequest& request)
        : request_(request),
          frame_(beam_frame(request.light)),
          monochromatic_(std::holds_alternative<Monochromatic>(request.spectrum)) {
        // All that could be asked for, so that threads only read.
        for (int nodes = first_nodes(); nodes <= last_nodes(); nodes = next(nodes))
            for (const SpectralSample& s : nested_samples(request.spectrum, nodes))
                if (!systems_.contains(s.wavelength_nm))
                    systems_.emplace(s.wavelength_nm, compile(lens, s.wavelength_nm));
        const OpticalSystem& any = systems_.begin()->second;
        paths_ = two_reflection_ghosts(any);
        paths_.insert(paths_.begin(), GhostPath{});
        pixels_ = pixel_frame(any.sensor_width_mm, any.sensor_height_mm, peak_width_px);
    }

    std::optional<GhostTable> build(std::stop_token stop, const Progress& progress) const {
        const auto began = std::chrono::steady_clock::now();
        std::atomic<std::size_t> done{0};
        auto report = [&] {
            const double share =
                static_cast<double>(++done) / (2.0 * static_cast<double>(paths_.size()));
            if (progress) progress(share);
        };
        std::vector<PathOverSpectrum> paths(paths_.size());
        bool finished = parallel_for(paths.size(), request_.threads, stop, [&](std::size_t i) {
            start(paths[i], paths_[i]);
            report();
        });
        if (!finished) return std::nullopt;
        double strongest = 0.0;
        for (std::size_t i = 1; i < paths.size(); ++i)
            strongest = std::max(strongest, paths[i].sums.flux);
        std::vector<GhostRow> rows(paths.size());
        finished = parallel_for(paths.size(), request_.threads, stop, [&](std::size_t i) {
            const double floor_mm2 = i == 0 ? 0.0 : faint_share * strongest;
            refine(paths[i], paths_[i], floor_mm2, stop);
            rows[i] = row(paths[i], paths_[i], floor_mm2);
            report();
        });
        if (!finished || stop.stop_requested()) return std::nullopt;

        GhostTable table;
        for (const GhostRow& r : rows) table.rays += r.rays;
        const double image = rows.front().flux_mm2;
        for (GhostRow& r : rows)
            r.relative_flux =
                image > 0.0 ? r.flux_mm2 / image : std::numeric_limits<double>::quiet_NaN();
        table.direct = rows.front();
        table.ghosts.assign(rows.begin() + 1, rows.end());
        std::ranges::stable_sort(table.ghosts, [](const GhostRow& a, const GhostRow& b) {
            return a.flux_mm2 > b.flux_mm2;
        });
        table.light = request_.light;
        table.spectrum = name(request_.spectrum);
        table.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
        return table;
    }

   private:
    const GhostTableRequest& request_;
    BeamFrame frame_;
    bool monochromatic_;
    std::map<double, OpticalSystem> systems_;  ///< by wavelength, nm
    std::vector<GhostPath> paths_;             ///< the direct path first
    PixelFrame pixels_;

    /// Two refinements of one another; a single wavelength has one node and no next.
    static int next(int nodes) { return 2 * nodes - 1 + (nodes == 1 ? 1 : 0); }
    int first_nodes() const { return monochromatic_ ? 1 : fewest_nodes; }
    int last_nodes() const { return monochromatic_ ? 1 : most_nodes; }

    PathQuadrature quadrature(const GhostPath& ghost, double wavelength_nm) const {
        return {systems_.at(wavelength_nm), ghost, frame_};
    }

    void sum_up(PathOverSpectrum& path, int nodes) const {
        path.nodes = nodes;
        path.sums = {};
        path.error_mm2 = 0.0;
        for (const SpectralSample& s : nested_samples(request_.spectrum, nodes)) {
            const PathFlux& at = path.at.at(s.wavelength_nm);
            path.sums += s.weight * at.sums;
            path.error_mm2 += s.weight * at.error_mm2;
        }
    }

    void start(PathOverSpectrum& path, const GhostPath& ghost) const {
        for (const SpectralSample& s : nested_samples(request_.spectrum, first_nodes()))
            path.at[s.wavelength_nm] = quadrature(ghost, s.wavelength_nm).start();
        sum_up(path, first_nodes());
    }

    double flux_on(const PathOverSpectrum& path, int nodes) const {
        double flux = 0.0;
        for (const SpectralSample& s : nested_samples(request_.spectrum, nodes))
            flux += s.weight * path.at.at(s.wavelength_nm).sums.flux;
        return flux;
    }

    /// Pupil and spectrum share what is allowed in halves. The spectral rule converges
    /// geometrically: what is left is the last change times the ratio of the last two, taken twice.
    void refine(PathOverSpectrum& path, const GhostPath& ghost, double floor_mm2,
                std::stop_token stop) const {
        const double part = monochromatic_ ? 1.0 : 0.5;
        const double share = part * request_.tolerance;
        double spectral_error = 0.0, before = 0.0, change_before = 0.0;
        for (int nodes = first_nodes(); nodes <= last_nodes(); nodes = next(nodes)) {
            for (const SpectralSample& s : nested_samples(request_.spectrum, nodes)) {
                const PathQuadrature at_nm = quadrature(ghost, s.wavelength_nm);
                auto [entry, is_new] = path.at.try_emplace(s.wavelength_nm);
                if (is_new) entry->second = at_nm.start();
                at_nm.refine(entry->second, share, part * floor_mm2, stop);
            }
            sum_up(path, nodes);
            if (monochromatic_) break;
            if (nodes == first_nodes()) before = flux_on(path, coarser_nodes);
            const double change = std::abs(path.sums.flux - before);
            const double ratio = change_before > 0.0 ? 2.0 * change / change_before : 1.0;
            spectral_error = change * std::min(1.0, ratio);
            before = path.sums.flux;
            change_before = change;
            if (spectral_error <= std::max(share * before, part * floor_mm2)) break;
        }
        if (!monochromatic_) path.error_mm2 += spectral_error;
    }

    /// On grids twice as fine until the peak settles: at a caustic it keeps growing for a while.
    /// The coarsest set of the spectrum's nodes is enough for that.
    double peak(PathOverSpectrum& path, const GhostPath& ghost) const {
        double before = 0.0;
        for (int cells = coarsest_peak_grid;; cells *= 2) {
            std::vector<GhostMesh> meshes;
            for (const SpectralSample& s : nested_samples(request_.spectrum, first_nodes()))
                meshes.push_back(quadrature(ghost, s.wavelength_nm)
                                     .mesh(path.at.at(s.wavelength_nm), pixels_, cells, s.weight));
            const double now = peak_of(meshes, pixels_);
            if (cells >= finest_peak_grid || std::abs(now - before) <= peak_tolerance * now)
                return now;
            before = now;
        }
    }

    GhostRow row(PathOverSpectrum& path, const GhostPath& ghost, double floor_mm2) const {
        GhostRow r;
        r.path = ghost;
        const FluxSums& sums = path.sums;
        r.flux_mm2 = sums.flux;
        r.flux_error_mm2 = path.error_mm2;
        r.converged = path.error_mm2 <= std::max(request_.tolerance * sums.flux, floor_mm2);
        if (sums.flux > 0.0) {
            r.centroid_x_mm = sums.x / sums.flux;
            r.centroid_y_mm = sums.y / sums.flux;
            const double variance = sums.r2 / sums.flux - r.centroid_x_mm * r.centroid_x_mm -
                                    r.centroid_y_mm * r.centroid_y_mm;
            r.rms_radius_mm = std::sqrt(std::max(0.0, variance));
            r.on_sensor = sums.on_sensor / sums.flux;
            r.reflectance_1 = sums.reflectance[0] / sums.flux;
            r.reflectance_2 = sums.reflectance[1] / sums.flux;
        }
        if (request_.peaks && sums.on_sensor > 0.0) r.peak_per_e0 = peak(path, ghost);
        for (const auto& [nm, at] : path.at) r.rays += at.rays;
        return r;
    }
};

}  // namespace

std::optional<GhostTable> ghost_table(const Prescription& lens, const GhostTableRequest& request,
                                      std::stop_token stop, const Progress& progress) {
    return TableBuilder(lens, request).build(std::move(stop), progress);
}

}  // namespace ghostlight
