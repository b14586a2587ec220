#include "core/ghosts/ghost_table.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/flare/raster.h"
#include "core/ghosts/four_reflections.h"
#include "core/ghosts/row_details.h"
#include "core/parallel.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr int peak_width_px = 1280;
constexpr int coarsest_peak_grid = 32, finest_peak_grid = 512;
constexpr double peak_tolerance = 0.05;  ///< change on doubling the grid at which a peak is settled
constexpr int fewest_nodes = 5;          ///< of the spectrum; refined until two sets agree
constexpr int coarser_nodes = 3;         ///< every other one of the fewest
constexpr int most_nodes = 33;
constexpr double faint_share = 1e-6;  ///< of the strongest ghost: nothing is refined below it
// What the bounds on four reflections allow beyond the angles seen with two.
constexpr double steeper_by_rad = 0.1;
constexpr double least_steepest_rad = 0.5;

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
          monochromatic_(is_of_lines(request.spectrum)) {
        // All that could be asked for, so that threads only read.
        for (int nodes = first_nodes(); nodes <= last_nodes(); nodes = next(nodes))
            for (const SpectralSample& s : nested_samples(request.spectrum, nodes))
                if (!systems_.contains(s.wavelength_nm))
                    systems_.emplace(s.wavelength_nm, compile(lens, s.wavelength_nm));
        reference_ = compile(lens, line_nm(request.spectrum).value_or(d_line_nm));
        paths_ = two_reflection_ghosts(systems_.begin()->second);
        paths_.insert(paths_.begin(), GhostPath{});
        pixels_ =
            pixel_frame(reference_.sensor_width_mm, reference_.sensor_height_mm, peak_width_px);
        media_ = media_of(lens);
        sensor_medium_ = sensor_medium_of(lens.sensor);
    }

    std::optional<GhostTable> build(std::stop_token stop, const Progress& progress) const {
        const auto began = std::chrono::steady_clock::now();
        std::atomic<std::size_t> done{0};
        const std::function<void()> report = [&] {
            const double share =
                static_cast<double>(++done) / (2.0 * static_cast<double>(paths_.size()));
            if (progress) progress(share);
        };
        std::vector<GhostRow> rows(paths_.size());
        double strongest = 0.0;
        if (!trace(paths_, rows, strongest, stop, report)) return std::nullopt;
        GhostTable table;
        if (request_.four_reflections > 0) {
            const RankedPaths four = four_reflections(rows);
            std::vector<GhostPath> more;
            table.not_traced = {four.count, four.flux_bound_mm2};
            for (const BoundedPath& each : four.strongest) {
                more.push_back(each.path);
                --table.not_traced.count;
                table.not_traced.flux_bound_mm2 -= each.flux_bound_mm2;
            }
            table.not_traced.flux_bound_mm2 =
                table.not_traced.count > 0 ? std::max(0.0, table.not_traced.flux_bound_mm2) : 0.0;
            std::vector<GhostRow> rows_of_four(more.size());
            if (!trace(more, rows_of_four, strongest, stop, [] {})) return std::nullopt;
            rows.insert(rows.end(), rows_of_four.begin(), rows_of_four.end());
        }

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
        table.surface_count = reference_.surfaces.size();
        table.media = media_;
        table.sensor_medium = sensor_medium_;
        if (image > 0.0) {
            double on_sensor = 0.0;
            for (const GhostRow& ghost : table.ghosts)
                on_sensor += ghost.flux_mm2 * ghost.on_sensor;
            table.veiling_fraction = on_sensor / image;
            table.sun_image_per_e0 = sun_image_per_e0(image);
        }
        table.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
        return table;
    }

   private:
    const GhostTableRequest& request_;
    BeamFrame frame_;
    bool monochromatic_;
    std::map<double, OpticalSystem> systems_;  ///< by wavelength, nm
    OpticalSystem reference_;                  ///< for first-order data and the image's scale
    std::vector<std::string> media_;
    std::string sensor_medium_;
    std::vector<GhostPath> paths_;  ///< the direct path first
    PixelFrame pixels_;

    /// Rows of some paths; `strongest` is the largest flux of any ghost so far, mm². Returns false
    /// when stopped.
    bool trace(const std::vector<GhostPath>& which, std::vector<GhostRow>& rows, double& strongest,
               const std::stop_token& stop, const std::function<void()>& report) const {
        std::vector<PathOverSpectrum> paths(which.size());
        if (!parallel_for(paths.size(), request_.threads, stop, [&](std::size_t i) {
                start(paths[i], which[i]);
                report();
            }))
            return false;
        for (std::size_t i = 0; i < paths.size(); ++i)
            if (!which[i].is_direct()) strongest = std::max(strongest, paths[i].sums.flux);
        const double faint_mm2 = faint_share * strongest;
        return parallel_for(paths.size(), request_.threads, stop,
                            [&](std::size_t i) {
                                const double floor_mm2 = which[i].is_direct() ? 0.0 : faint_mm2;
                                refine(paths[i], which[i], floor_mm2, stop);
                                rows[i] = row(paths[i], which[i], floor_mm2);
                                paths[i] = {};  // its rays are no longer needed
                                report();
                            }) &&
               !stop.stop_requested();
    }

    /// Ranked by bounds from the steepest incidences that the two-reflection ghosts show on either
    /// side of each surface: these are the same sides at which light of four reflections turns.
    RankedPaths four_reflections(const std::vector<GhostRow>& two) const {
        const std::size_t rows = turning_count(reference_);
        SteepestIncidence steepest{std::vector<double>(rows, least_steepest_rad),
                                   std::vector<double>(rows, least_steepest_rad)};
        double all_mm2 = 0.0;
        for (const GhostRow& r : two) {
            if (r.path.is_direct()) continue;
            all_mm2 += r.flux_mm2;
            auto widen_to = [&](double& so_far, const TurnOfGhost& turn) {
                const double angle = rad_from_deg(turn.largest_incidence_deg) + steeper_by_rad;
                so_far = std::clamp(angle, so_far, 0.5 * std::numbers::pi);
            };
            widen_to(steepest.forward_rad[r.path.reflections[0]], r.turns[0]);
            widen_to(steepest.backward_rad[r.path.reflections[1]], r.turns[1]);
        }
        LargestReflectances bounds = largest_reflectances(reference_, steepest);
        for (const SpectralSample& s : nested_samples(request_.spectrum, first_nodes()))
            widen(bounds, largest_reflectances(systems_.at(s.wavelength_nm), steepest));
        const double area_mm2 = entrance_box(reference_, frame_).area_mm2();
        return strongest_four_reflections(bounds, area_mm2, request_.four_reflections,
                                          request_.tolerance * all_mm2);
    }

    /// Irradiance of the sun's image that holds `image_mm2`: spread over the disc's own image.
    double sun_image_per_e0(double image_mm2) const {
        const Pupil pupil =
            find_pupil(reference_, trace_path<double>(reference_, {}), frame_, PupilSearch::quick);
        const double u = 0.5 * (pupil.box.u0_mm + pupil.box.u1_mm);
        const double v = 0.5 * (pupil.box.v0_mm + pupil.box.v1_mm);
        const double radius = rad_from_deg(sun_radius_deg);
        const double solid_angle_sr = std::numbers::pi * radius * radius;
        return image_mm2 /
               (solid_angle_sr * image_area_per_steradian_mm2(reference_, request_.light, u, v));
    }

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

    GhostColor color(const PathOverSpectrum& path) const {
        std::vector<double> fluxes;
        for (const SpectralSample& s : nested_samples(request_.spectrum, path.nodes))
            fluxes.push_back(path.at.at(s.wavelength_nm).sums.flux);
        const PassedColor passed = passed_color(request_.spectrum, fluxes);
        return {passed.x, passed.y,
                srgb_swatch(passed.balanced.r, passed.balanced.g, passed.balanced.b)};
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
            for (std::size_t k = 0; k < ghost.reflections.size(); ++k)
                r.turns[k] = {sums.reflectance[k] / sums.flux,
                              deg_from_rad(sums.incidence_rad[k] / sums.flux),
                              deg_from_rad(sums.largest_incidence_rad[k])};
        }
        r.area_mm2 = sums.area_mm2;
        r.pupil_area_mm2 = sums.pupil_area_mm2;
        r.box = sums.box;
        r.paraxial = paraxial_ghost(reference_, ghost);
        r.vignetting = vignetting(reference_, r.paraxial, request_.light, r.pupil_area_mm2);
        if (!monochromatic_ && sums.flux > 0.0) r.color = color(path);
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
