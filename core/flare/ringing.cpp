#include "core/flare/ringing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/elapsed.h"
#include "core/flare/fresnel.h"
#include "core/flare/ghost_mesh.h"
#include "core/flare/grid_light.h"
#include "core/flare/picture_levels.h"
#include "core/flare/rim_profile.h"
#include "core/ghosts/ghost_probe.h"
#include "core/parallel.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr int grid_cells = 40;   ///< across a ghost's beam, its shadow's side included
constexpr int weight_cells = 4;  ///< for the polarisation's share
constexpr int band_rows = 16;
/// Below this Fresnel number the rim's curvature shows in the fringes: the mask is propagated.
constexpr double whole_mask_below = 20.0;
constexpr int propagated_colors = 5;
/// Ghosts with less of the layer's light are left as they are.
constexpr double least_flux_share = 1e-4;
/// Those whose fringes change least are left out while what they would change adds up to less than
/// this share of the picture's tolerance.
constexpr double left_out_share = 0.25;
/// ∫ |profile − 1 in the light, profile in the shadow| dw of a straight edge, to w = 6.
constexpr double change_per_w = 1.04;
/// Pixels of a level per w: fringes are then resolved up to where colours run into one another.
constexpr double least_px_per_w = 8.0;
/// A rim drawn at half the size and brought up bilinearly is a ramp this many of its pixels long.
constexpr double coarse_rim_px = 2.2;
std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// A rung ghost ready to be drawn: triangles of rays with where they land, where they met the stop,
/// their light per area, and what clips them.
struct Node {
    double column, row;  ///< pixels
    double u, v;         ///< last stop crossing, semi-diameters
    double light;        ///< irradiance / E0
    double clear;        ///< least of all that clips but the last stop crossing
};
struct Triangle {
    Node nodes[3];
};
struct Rung {
    RungGhost report;
    StopMask stop;  ///< turned into the beam's plane
    std::vector<EdgeLine> edges;
    EdgeChange edge;
    std::array<double, rim_channels> color{};  ///< over irradiance
    std::vector<PropagatedMask> masks;         ///< by colour, where it is propagated
    std::vector<std::array<double, rim_channels>> mask_shares;
    int level = 0, most_level = 0;  ///< it is drawn at, and the one that its picture has
    double rim_px = 1.0;            ///< how softly the picture has its rim
    double reach = 1.0;             ///< of what is drawn, in semi-diameters from the middle
    std::optional<MaskRaster> raster;
    std::vector<Triangle> triangles;
    std::vector<std::vector<std::uint32_t>> by_band;
};

/// What is drawn into: a picture, or a level of one with its four rim_channels side by side.
struct Canvas {
    int width_px = 0, height_px = 0;
    float* irradiance = nullptr;
    std::size_t irradiance_step = 1;
    float* rgb = nullptr;
    std::size_t rgb_step = 3;
};

/// Share of a pixel inside an edge.
double coverage(double depth, double depth_per_px) {
    return std::clamp(0.5 + depth / std::max(depth_per_px, 1e-12), 0.0, 1.0);
}

class Ringing {
   public:
    Ringing(const FlareScene& scene, const FlareRequest& request, const PixelFrame& frame)
        : scene_(scene),
          frame_(frame),
          beam_(beam_frame({request.light.field_deg, 90.0})),
          entrance_(entrance_box(scene.system(), beam_)),
          turn_rad_(rad_from_deg(request.light.azimuth_deg - 90.0)),
          search_(request.search) {}

    /// Traces a ghost and works out its fringes; false where there is nothing to draw.
    bool prepare(const GhostPath& path, const GhostFringes& fringes, const PlannedGhost* planned,
                 unsigned threads, const std::stop_token& stop, Rung& rung) const {
        const OpticalSystem& system = scene_.system();
        const auto trace = trace_path<float>(system, path);
        if (trace.stop_crossings == 0) return false;
        PupilBox box;
        if (planned != nullptr && planned->box.area_mm2() > 0.0) {
            box = planned->box;
        } else {
            const GhostProbe probe = probe_ghost(system, trace, beam_, entrance_, 12, search_);
            if (probe.empty) return false;
            box = probe.grid.box;
        }
        rung.report = {path, fringes.fresnel_number, fringes.first_fringe_px, false};
        const bool pictured = system.stop_mask.picture != nullptr;
        if (pictured && fringes.fresnel_number > most_propagated) return false;
        rung.report.propagated = pictured || fringes.fresnel_number < whole_mask_below;
        rung.stop = system.stop_mask;
        rung.stop.rotation_rad -= turn_rad_;
        rung.edges = edge_lines(rung.stop);
        rung.reach = rung.report.propagated
                         ? 1.0 + std::min(1.0, 4.0 / std::sqrt(2.0 * fringes.fresnel_number))
                         : 1.0 + into_shadow / std::sqrt(2.0 * fringes.fresnel_number);

        MirrorGrid grid{widened(box, rung.reach - 1.0), grid_cells, {}};
        grid.half.keep_cosines = true;
        trace_mirrored(trace, beam_, Weights::none, grid);
        MirrorGrid polarised{box, weight_cells, {}};
        trace_mirrored(trace, beam_, Weights::polarised, polarised);
        double exact = 0.0, average = 0.0;
        for (std::size_t k = 0; k < polarised.half.size(); ++k) {
            if (polarised.half.margin[k] < 0.0F) continue;
            exact += static_cast<double>(polarised.half.weight[k]);
            average += static_cast<double>(polarised.half.weight_average[k]);
        }
        const double ratio = average > 0.0 ? exact / average : 1.0;
        std::vector<float> weights;
        scene_.films.weights(trace, grid.half, weights);
        fill_failed(grid, static_cast<int>(scene_.films.stride()), weights);
        const std::vector<double> spectrum = mean_spectrum(grid, weights);
        const ColorShares shares = color_shares(scene_, spectrum);
        for (const auto& share : shares)
            for (std::size_t c = 0; c < rim_channels; ++c) rung.color[c] += share[c];
        const double px_per_w = fringes.first_fringe_px / first_maximum_w;
        if (!rung.report.propagated)
            rung.edge =
                edge_change(scene_, shares, fringes.fresnel_number, px_per_w, rung.stop.blades < 3);
        else if (!propagate(shares, threads, stop, rung))
            return false;
        lay_triangles(grid, weights, ratio, rung);
        // A broad ghost whose fringes are broad too is drawn as small as its own picture.
        while (rung.level < rung.most_level &&
               px_per_w >= std::ldexp(least_px_per_w, rung.level + 1))
            ++rung.level;
        const RasterSize size = level_size(frame_, rung.level);
        rung.rim_px *= size.scale;
        for (Triangle& triangle : rung.triangles)
            for (Node& node : triangle.nodes) {
                node.column = node.column * size.scale + size.margin_px;
                node.row = node.row * size.scale + size.margin_px;
            }
        rung.by_band.resize(idx((size.height_px + band_rows - 1) / band_rows));
        const double most = size.height_px - 0.5;
        for (std::uint32_t t = 0; t < rung.triangles.size(); ++t) {
            const auto& n = rung.triangles[t].nodes;
            const auto [low, high] = std::minmax({n[0].row, n[1].row, n[2].row});
            for (int b = static_cast<int>(std::clamp(low, 0.0, most)) / band_rows;
                 b <= static_cast<int>(std::clamp(high, 0.0, most)) / band_rows; ++b)
                rung.by_band[idx(b)].push_back(t);
        }
        return !rung.triangles.empty();
    }

    /// Draws the rows of a band: what the fringes change.
    void draw(const Rung& rung, int band, const Canvas& canvas) const {
        const int first = band * band_rows, last = std::min(first + band_rows, canvas.height_px);
        for (const std::uint32_t t : rung.by_band[idx(band)])
            draw(rung, rung.triangles[t], first, last, canvas);
    }

   private:
    static constexpr double first_maximum_w = 1.2172;

    const FlareScene& scene_;
    const PixelFrame& frame_;
    BeamFrame beam_;
    PupilBox entrance_;
    double turn_rad_;
    ProbeSearch search_;

    static PupilBox widened(const PupilBox& box, double share) {
        const double du = (0.5 * share + 1.0 / grid_cells) * (box.u1_mm - box.u0_mm);
        const double dv = (0.5 * share + 1.0 / grid_cells) * (box.v1_mm - box.v0_mm);
        return {box.u0_mm - du, box.u1_mm + du, box.v0_mm - dv, box.v1_mm + dv};
    }

    std::vector<double> mean_spectrum(const MirrorGrid& grid,
                                      const std::vector<float>& weights) const {
        std::vector<double> mean(scene_.samples.size(), 0.0);
        const std::size_t stride = scene_.films.stride();
        for (std::size_t k = 0; k < grid.half.size(); ++k) {
            if (grid.half.margin[k] < 0.0F || grid.half.r_rel[k] > 1.0F) continue;
            for (std::size_t w = 0; w < mean.size(); ++w)
                mean[w] += static_cast<double>(weights[k * stride + w]);
        }
        return mean;
    }

    bool propagate(const ColorShares& shares, unsigned threads, const std::stop_token& stop,
                   Rung& rung) const {
        const double number = rung.report.fresnel_number;
        const int across = propagation_raster(number);
        rung.raster = mask_raster(rung.stop, scene_.dirt, across);
        const auto spectrum = mask_spectrum(*rung.raster, number, threads, stop);
        if (!spectrum) return false;
        const std::size_t samples = shares.size();
        const std::size_t count = std::min<std::size_t>(samples, propagated_colors);
        for (std::size_t p = 0; p < count; ++p) {
            std::array<double, rim_channels> share{};
            double middle_nm = 0.0, weight = 0.0;
            for (std::size_t w = p * samples / count; w < (p + 1) * samples / count; ++w) {
                for (std::size_t c = 0; c < rim_channels; ++c) share[c] += shares[w][c];
                middle_nm += shares[w][rim_channels - 1] * scene_.samples[w].wavelength_nm;
                weight += shares[w][rim_channels - 1];
            }
            if (!(weight > 0.0)) continue;
            auto mask =
                propagated(*spectrum,
                           std::max(least_propagated,
                                    number * scene_.system().wavelength_nm * weight / middle_nm),
                           threads, stop);
            if (!mask) return false;
            rung.masks.push_back(std::move(*mask));
            rung.mask_shares.push_back(share);
        }
        return true;
    }

    void lay_triangles(const MirrorGrid& grid, const std::vector<float>& weights, double ratio,
                       Rung& rung) const {
        const Bundle<float>& rays = grid.half;
        const int side = grid.side(), cells = grid.cells;
        const double a = rung.stop.semi_diameter_mm;
        const double xc = std::cos(turn_rad_), xs = std::sin(turn_rad_);
        const auto last = static_cast<std::size_t>(rays.stop_crossings - 1);
        const std::size_t stride = scene_.films.stride();
        std::vector<Node> nodes(idx(side * side));
        std::vector<char> valid(nodes.size());
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) {
                const std::size_t of = grid.of_node(i, j);
                const double mirror = grid.is_mirrored(i) ? -1.0 : 1.0;
                const double x = mirror * static_cast<double>(rays.x_mm[of]);
                const double y = static_cast<double>(rays.y_mm[of]);
                Node& node = nodes[idx(j * side + i)];
                node.column = frame_.column(xc * x - xs * y);
                node.row = frame_.row(xs * x + xc * y);
                node.u = mirror * static_cast<double>(rays.stop_u_mm[last][of]) / a;
                node.v = static_cast<double>(rays.stop_v_mm[last][of]) / a;
                double sum = 0.0;
                for (std::size_t w = 0; w < scene_.samples.size(); ++w)
                    sum += scene_.samples[w].weight * static_cast<double>(weights[of * stride + w]);
                node.light = ratio * sum;
                node.clear = 1.0 - static_cast<double>(rays.r_rel[of]);
                for (std::size_t s = 0; s < last; ++s) {
                    const double u = mirror * static_cast<double>(rays.stop_u_mm[s][of]);
                    const double v = static_cast<double>(rays.stop_v_mm[s][of]);
                    for (int edge = 0; edge < stop_edges(rung.stop); ++edge)
                        node.clear = std::min(node.clear, stop_margin(rung.stop, edge, u, v));
                }
                valid[idx(j * side + i)] = rays.margin[of] >= 0.0F ? 1 : 0;
            }
        // Light per area on the sensor: both areas summed over the cells about a node.
        std::vector<double> area(nodes.size(), 0.0), count(nodes.size(), 0.0);
        auto cross = [&](std::size_t p, std::size_t q, std::size_t r) {
            return (nodes[q].column - nodes[p].column) * (nodes[r].row - nodes[p].row) -
                   (nodes[r].column - nodes[p].column) * (nodes[q].row - nodes[p].row);
        };
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i) {
                const std::size_t p = idx(j * side + i), q = p + 1, r = p + idx(side), s = r + 1;
                if (!(valid[p] && valid[q] && valid[r] && valid[s])) continue;
                const double size = 0.5 * (std::abs(cross(p, q, r)) + std::abs(cross(s, r, q)));
                for (const std::size_t k : {p, q, r, s}) {
                    area[k] += size;
                    count[k] += 1.0;
                }
            }
        const double cell_px2 = grid.box.area_mm2() / (cells * cells) / frame_.pixel_area_mm2();
        for (std::size_t k = 0; k < nodes.size(); ++k)
            nodes[k].light = area[k] > 0.0 ? nodes[k].light * cell_px2 * count[k] / area[k] : 0.0;
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i) {
                const std::size_t p = idx(j * side + i), q = p + 1, r = p + idx(side), s = r + 1;
                if (!(valid[p] && valid[q] && valid[r] && valid[s])) continue;
                for (const auto& [x, y, z] : {std::array{p, q, r}, std::array{s, r, q}}) {
                    const Triangle triangle{{nodes[x], nodes[y], nodes[z]}};
                    if (matters(rung, triangle)) rung.triangles.push_back(triangle);
                }
            }
    }

    /// Within reach of the rim, and on the frame.
    bool matters(const Rung& rung, const Triangle& t) const {
        double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300, clear = -1e300;
        double nearest = 1e300;
        for (const Node& n : t.nodes) {
            left = std::min(left, n.column);
            right = std::max(right, n.column);
            bottom = std::min(bottom, n.row);
            top = std::max(top, n.row);
            clear = std::max(clear, n.clear);
            nearest = std::min(nearest, std::hypot(n.u, n.v));
        }
        if (right < 0.0 || top < 0.0 || left > frame_.width_px || bottom > frame_.height_px)
            return false;
        if (clear < 0.0 || nearest > rung.reach) return false;
        if (rung.report.propagated) return true;
        double least = 1e300, most = -1e300;
        for (const EdgeLine& edge : rung.edges) {
            double edge_most = -1e300;
            for (const Node& n : t.nodes) {
                const double depth = edge_at(edge, n.u, n.v).depth;
                least = std::min(least, depth);
                edge_most = std::max(edge_most, depth);
            }
            if (edge_most < -rung.edge.shadow) return false;
            most = std::max(most, edge_most);
        }
        return least < rung.edge.light;
    }

    void draw(const Rung& rung, const Triangle& t, int first_row, int last_row,
              const Canvas& canvas) const {
        const Node &p = t.nodes[0], &q = t.nodes[1], &r = t.nodes[2];
        const double ax = q.column - p.column, ay = q.row - p.row;
        const double bx = r.column - p.column, by = r.row - p.row;
        const double twice = ax * by - ay * bx;
        if (!(std::abs(twice) > 1e-9)) return;
        const int low =
            std::max(first_row, static_cast<int>(std::ceil(std::min({p.row, q.row, r.row}) - 0.5)));
        const int high =
            std::min(last_row, static_cast<int>(std::ceil(std::max({p.row, q.row, r.row}) - 0.5)));
        const double left = std::min({p.column, q.column, r.column});
        const double right = std::max({p.column, q.column, r.column});
        // Change of the stop's coordinates by a pixel to the right and upwards.
        const double du1 = q.u - p.u, du2 = r.u - p.u, dv1 = q.v - p.v, dv2 = r.v - p.v;
        const double ux = (du1 * by - du2 * ay) / twice, uy = (du2 * ax - du1 * bx) / twice;
        const double vx = (dv1 * by - dv2 * ay) / twice, vy = (dv2 * ax - dv1 * bx) / twice;
        for (int row = low; row < high; ++row) {
            const double y = row + 0.5 - p.row;
            // Where the row crosses the sides: half-open spans, so that neighbours share no pixel.
            double from = 1e300, to = -1e300;
            for (int s = 0; s < 3; ++s) {
                const Node &a = t.nodes[s], &b = t.nodes[(s + 1) % 3];
                if ((a.row <= row + 0.5) == (b.row <= row + 0.5)) continue;
                // From the lower end, so that both neighbours compute the same.
                const Node &below = a.row < b.row ? a : b, &above = a.row < b.row ? b : a;
                const double x = below.column + (row + 0.5 - below.row) *
                                                    (above.column - below.column) /
                                                    (above.row - below.row);
                from = std::min(from, x);
                to = std::max(to, x);
            }
            if (!(from < to) || to < left - 1.0 || from > right + 1.0) continue;
            const int first = std::max(0, static_cast<int>(std::ceil(from - 0.5)));
            const int end = std::min(canvas.width_px, static_cast<int>(std::ceil(to - 0.5)));
            for (int column = first; column < end; ++column) {
                const double x = column + 0.5 - p.column;
                const double b = (x * by - y * bx) / twice, c = (y * ax - x * ay) / twice;
                auto mix = [&](double at_p, double at_q, double at_r) {
                    return at_p + b * (at_q - at_p) + c * (at_r - at_p);
                };
                if (mix(p.clear, q.clear, r.clear) < 0.0) continue;
                const double u = mix(p.u, q.u, r.u), v = mix(p.v, q.v, r.v);
                const double light = mix(p.light, q.light, r.light);
                const RimColor change = rung.report.propagated
                                            ? mask_change(rung, u, v, ux, uy, vx, vy)
                                            : rim_change(rung, u, v, ux, uy, vx, vy);
                const std::size_t pixel = idx(row) * idx(canvas.width_px) + idx(column);
                canvas.irradiance[canvas.irradiance_step * pixel] +=
                    static_cast<float>(light) * change[rim_channels - 1];
                for (std::size_t k = 0; k < 3; ++k)
                    canvas.rgb[canvas.rgb_step * pixel + k] +=
                        static_cast<float>(light) * change[k];
            }
        }
    }

    RimColor rim_change(const Rung& rung, double u, double v, double ux, double uy, double vx,
                        double vy) const {
        RimColor profile{1.0F, 1.0F, 1.0F, 1.0F};
        double covered = 1.0;
        for (const EdgeLine& line : rung.edges) {
            const EdgeDepth edge = edge_at(line, u, v);
            if (edge.depth > rung.edge.light + 0.5) continue;
            const RimColor own = rung.edge.at(edge.depth);
            for (std::size_t c = 0; c < rim_channels; ++c) profile[c] *= own[c];
            const double slope =
                std::abs(edge.nx * ux + edge.ny * vx) + std::abs(edge.nx * uy + edge.ny * vy);
            covered *= coverage(edge.depth, slope * rung.rim_px);
        }
        RimColor change;
        for (std::size_t c = 0; c < rim_channels; ++c)
            change[c] =
                static_cast<float>(rung.color[c]) * (profile[c] - static_cast<float>(covered));
        return change;
    }

    RimColor mask_change(const Rung& rung, double u, double v, double ux, double uy, double vx,
                         double vy) const {
        RimColor change{};
        // What the picture holds: the mask without its dirt, its rim as pixels cover it.
        double lit = 1.0;
        if (rung.stop.picture &&
            !stop_passes(rung.stop, u * rung.stop.semi_diameter_mm, v * rung.stop.semi_diameter_mm))
            lit = 0.0;
        for (const EdgeLine& line : rung.edges) {
            const EdgeDepth edge = edge_at(line, u, v);
            const double slope =
                std::abs(edge.nx * ux + edge.ny * vx) + std::abs(edge.nx * uy + edge.ny * vy);
            lit *= coverage(edge.depth, slope * rung.rim_px);
        }
        for (std::size_t p = 0; p < rung.masks.size(); ++p) {
            const double irradiance = rung.masks[p].at(u, v);
            for (std::size_t c = 0; c < rim_channels; ++c)
                change[c] += static_cast<float>(rung.mask_shares[p][c] * (irradiance - lit));
        }
        return change;
    }
};

const PlannedGhost* planned_of(const FlarePlan& plan, const GhostPath& path) {
    const auto found = std::ranges::find(plan.ghosts, path, &PlannedGhost::path);
    return found == plan.ghosts.end() ? nullptr : &*found;
}

/// Of a whole planned picture, leaves out the ghosts whose fringes change least.
void leave_out_weakest(const OpticalSystem& system, const FlareRequest& request,
                       const PixelFrame& frame, const FlarePlan& plan,
                       std::vector<GhostPath>& chosen) {
    if (!request.only.empty() || !(plan.flux_mm2 > 0.0)) return;
    struct Change {
        GhostPath path;
        double mm2;
    };
    std::vector<Change> changes;
    for (const GhostPath& path : chosen) {
        const PlannedGhost* planned = planned_of(plan, path);
        const double number =
            ghost_fringes(system, paraxial_ghost(system, path), frame.pitch_mm).fresnel_number;
        // A rim of two semi-diameters per area, as deep as w = 1 is; at most all of it moves.
        const double share = std::min(1.0, 2.0 * change_per_w / std::sqrt(2.0 * number));
        changes.push_back({path, planned != nullptr ? share * planned->flux_mm2 : 0.0});
    }
    std::ranges::stable_sort(changes, std::ranges::less{}, &Change::mm2);
    double budget_mm2 = left_out_share * request.tolerance * plan.flux_mm2;
    auto kept = changes.begin();
    for (; kept != changes.end() && kept->mm2 <= budget_mm2; ++kept) budget_mm2 -= kept->mm2;
    std::erase_if(chosen, [&](const GhostPath& path) {
        return std::find_if(changes.begin(), kept,
                            [&](const Change& change) { return change.path == path; }) != kept;
    });
}

/// Draws all fringes, level by level, brings the levels together and sums up the picture's flux.
bool draw_rung(const Ringing& ringing, const std::vector<Rung>& rung,
               const std::vector<char>& drawn, const PixelFrame& frame, unsigned threads,
               const std::stop_token& stop, FlareImage& image) {
    std::array<std::vector<float>, picture_levels> levels;
    int coarsest = 0;
    for (std::size_t g = 0; g < rung.size(); ++g)
        if (drawn[g]) coarsest = std::max(coarsest, rung[g].level);
    struct Task {
        int level, band;
    };
    std::vector<Task> tasks;
    auto bands_of = [&](int level) {
        return (level_size(frame, level).height_px + band_rows - 1) / band_rows;
    };
    for (int level = 0; level <= coarsest; ++level) {
        const RasterSize size = level_size(frame, level);
        if (level > 0)
            levels[idx(level)].assign(idx(size.width_px) * idx(size.height_px) * rim_channels,
                                      0.0F);
        for (int band = 0; band < bands_of(level); ++band) tasks.push_back({level, band});
    }
    if (!parallel_for(tasks.size(), threads, stop, [&](std::size_t t) {
            const auto [level, band] = tasks[t];
            const RasterSize size = level_size(frame, level);
            float* own = levels[idx(level)].data();
            const Canvas canvas =
                level == 0
                    ? Canvas{size.width_px,           size.height_px,
                             image.irradiance.data(), 1,
                             image.rgb.data(),        3}
                    : Canvas{size.width_px, size.height_px, own + rim_channels - 1, rim_channels,
                             own,           rim_channels};
            for (std::size_t g = 0; g < rung.size(); ++g)
                if (drawn[g] && rung[g].level == level) ringing.draw(rung[g], band, canvas);
        }))
        return false;
    const int bands = bands_of(0);
    if (coarsest > 0)
        levels[0].assign(idx(frame.width_px) * idx(frame.height_px) * rim_channels, 0.0F);
    for (int level = coarsest - 1; level >= 0; --level)
        if (!parallel_for(idx(bands_of(level)), threads, stop, [&](std::size_t b) {
                const RasterSize size = level_size(frame, level);
                const int first = static_cast<int>(b) * band_rows;
                add_coarser_rows<rim_channels>(
                    levels[idx(level) + 1], level_size(frame, level + 1), size, first,
                    std::min(first + band_rows, size.height_px), levels[idx(level)]);
            }))
            return false;
    std::vector<double> sums(idx(bands), 0.0);
    if (!parallel_for(idx(bands), threads, stop, [&](std::size_t b) {
            const std::size_t first = b * band_rows * idx(frame.width_px);
            const std::size_t last = std::min(first + band_rows * idx(frame.width_px),
                                              idx(frame.width_px) * idx(frame.height_px));
            for (std::size_t k = first; k < last; ++k) {
                if (coarsest > 0) {
                    image.irradiance[k] += levels[0][rim_channels * k + rim_channels - 1];
                    for (std::size_t c = 0; c < 3; ++c)
                        image.rgb[3 * k + c] += levels[0][rim_channels * k + c];
                }
                // Where the picture's own rim is softer than the fringes' a trace would be below
                // zero.
                image.irradiance[k] = std::max(0.0F, image.irradiance[k]);
                sums[b] += static_cast<double>(image.irradiance[k]);
            }
        }))
        return false;
    image.flux_on_sensor_mm2 = 0.0;
    for (const double sum : sums) image.flux_on_sensor_mm2 += sum * frame.pixel_area_mm2();
    return true;
}

}  // namespace

GhostFringes ghost_fringes(const OpticalSystem& system, const ParaxialGhost& ghost,
                           double pitch_mm) {
    // |M| from the Fresnel number, which is that of the last crossing: N = a²|M|/(λ|B|).
    const double a = system.stop_mask.semi_diameter_mm;
    const double wavelength_mm =
        mm_from_nm(system.wavelength_nm) / system.surfaces[system.stop].n_before;
    GhostFringes fringes;
    fringes.fresnel_number = ghost.fresnel_number;
    const double spread = wavelength_mm * std::abs(ghost.stop_to_sensor.b);
    const double magnified = ghost.fresnel_number * spread / (a * a);
    constexpr double first_maximum = 0.8607;  // of √(λ|z_eff|), z_eff = B/M
    fringes.first_fringe_px =
        std::isfinite(magnified) ? first_maximum * std::sqrt(spread * magnified) / pitch_mm : 0.0;
    return fringes;
}

std::vector<bool> shows_fringes(const OpticalSystem& system, const std::vector<GhostPath>& paths,
                                double pitch_mm) {
    std::vector<bool> shows;
    for (const GhostPath& path : paths) {
        const GhostFringes fringes = ghost_fringes(system, paraxial_ghost(system, path), pitch_mm);
        shows.push_back(std::isfinite(fringes.fresnel_number) &&
                        fringes.fresnel_number >= least_propagated &&
                        fringes.first_fringe_px >= least_fringe_px);
    }
    return shows;
}

bool add_ringing(const FlareScene& scene, const FlareRequest& request, const std::stop_token& stop,
                 FlareImage& image) {
    const auto began = Clock::now();
    const OpticalSystem& system = scene.system();
    const PixelFrame frame =
        pixel_frame(system.sensor_width_mm, system.sensor_height_mm, request.width_px);
    const std::vector<GhostPath>& paths = request.only.empty() ? scene.ghosts : request.only;
    const std::vector<bool> shows = shows_fringes(system, paths, frame.pitch_mm);
    const bool upright = std::abs(std::fmod(request.light.azimuth_deg, 180.0)) == 90.0;
    std::vector<GhostPath> chosen;
    for (std::size_t g = 0; g < paths.size(); ++g) {
        if (!shows[g]) continue;
        // Half of the beam stands for the other, which a sensor's rectangle may not be alike in.
        const bool at_sensor = std::ranges::any_of(
            paths[g].reflections, [&](std::size_t s) { return s >= system.surfaces.size(); });
        if (at_sensor && !upright) continue;
        const PlannedGhost* planned = planned_of(image.plan, paths[g]);
        if (planned != nullptr && (planned->fate != GhostFate::drawn ||
                                   planned->flux_mm2 < least_flux_share * image.plan.flux_mm2))
            continue;
        chosen.push_back(paths[g]);
    }
    leave_out_weakest(system, request, frame, image.plan, chosen);
    const Ringing ringing(scene, request, frame);
    std::vector<Rung> rung(chosen.size());
    std::vector<char> drawn(chosen.size(), 0);
    const bool finished = parallel_for(chosen.size(), request.threads, stop, [&](std::size_t g) {
        const PlannedGhost* planned = planned_of(image.plan, chosen[g]);
        if (planned != nullptr && planned->level > 0) {
            rung[g].most_level = planned->level;
            rung[g].rim_px = coarse_rim_px * std::exp2(planned->level);
        }
        const GhostFringes fringes =
            ghost_fringes(system, paraxial_ghost(system, chosen[g]), frame.pitch_mm);
        drawn[g] = ringing.prepare(chosen[g], fringes, planned, 1, stop, rung[g]) ? 1 : 0;
    });
    if (!finished || stop.stop_requested()) return false;
    if (!draw_rung(ringing, rung, drawn, frame, request.threads, stop, image)) return false;
    for (std::size_t g = 0; g < rung.size(); ++g)
        if (drawn[g]) image.ringing.push_back(rung[g].report);
    image.times.ringing_ms = ms_since(began);
    return true;
}

}  // namespace ghostlight
