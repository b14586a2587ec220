#include "core/flare/rung_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/flare/ghost_weights.h"
#include "core/flare/picture_levels.h"

namespace ghostlight {
namespace {

/// Cells across a ghost's beam, its shadow's side included: of those, as many as draw a round rim
/// by chords that are off by at most so much of w, and no fewer than the ghost itself has. Straight
/// blades are no rounder than the map.
constexpr int fewest_cells = 20, fewest_straight_cells = 12, most_cells = 40;
constexpr double most_chord_w = 0.025;
/// Below this Fresnel number the rim's curvature shows in the fringes: the mask is propagated.
constexpr double whole_mask_below = 20.0;
/// A rim drawn small and brought up bilinearly is a ramp this many of its pixels long.
constexpr double coarse_rim_px = 2.2;
/// Pixels per w of a level. Blurred by a level's σ = p/2 px, a profile f is off by p²/8 ∫|f''|,
/// four for white light, a sharp edge by 0.4 p, which the ghost's allowance covers: the profile is
/// as good from 1.25 of the level's pixels per w on. Twice that, and more for one wavelength's many
/// fringes.
constexpr double least_px_per_w = 2.5, least_px_per_w_gray = 5.0;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// Of rims whose largest Fresnel number is this, where they are round; 0: none is.
int cells_for(const PlannedGhost& planned, double round_number, double reach) {
    int wanted = std::max(planned.cells, fewest_straight_cells);
    if (round_number > 0.0) {
        const double breadth = std::sqrt(8.0 * most_chord_w / std::sqrt(2.0 * round_number));
        wanted =
            std::max({wanted, fewest_cells, static_cast<int>(std::ceil(2.0 * reach / breadth))});
    }
    return std::min((wanted + 1) / 2 * 2, most_cells);
}

/// The largest Fresnel number of the round rims that show.
double round_number_of(const GhostRims& rims, const StopMask& stop) {
    double most = shows(rims.surface) ? rims.surface.fresnel_number : 0.0;
    if (stop.blades >= 3 && stop.blade_curvature <= 0.0 && stop.picture == nullptr) return most;
    for (const GhostFringes& rim : rims.crossings)
        if (shows(rim)) most = std::max(most, rim.fresnel_number);
    return most;
}

PupilBox widened(const PupilBox& box, double share, int cells) {
    const double du = (0.5 * share + 1.0 / cells) * (box.u1_mm - box.u0_mm);
    const double dv = (0.5 * share + 1.0 / cells) * (box.v1_mm - box.v0_mm);
    return {box.u0_mm - du, box.u1_mm + du, box.v0_mm - dv, box.v1_mm + dv};
}

/// Half grid values at the nodes of a full grid over a wider box: bilinear, and beyond the box as
/// at its edge.
std::vector<float> continued(const MirrorGrid& from, const std::vector<float>& values,
                             const PupilBox& box, int cells) {
    struct Between {
        int low;
        float share;
    };
    auto between = [&](double mm, double first, double last) {
        const double at = std::clamp((mm - first) / (last - first), 0.0, 1.0) * from.cells;
        const int low = std::min(static_cast<int>(at), from.cells - 1);
        return Between{low, static_cast<float>(at - low)};
    };
    const int side = cells + 1;
    std::vector<Between> columns;
    for (int i = 0; i < side; ++i)
        columns.push_back(between(std::lerp(box.u0_mm, box.u1_mm, static_cast<double>(i) / cells),
                                  from.box.u0_mm, from.box.u1_mm));
    std::vector<float> nodes;
    nodes.reserve(idx(side * side));
    for (int j = 0; j < side; ++j) {
        const Between row = between(std::lerp(box.v0_mm, box.v1_mm, static_cast<double>(j) / cells),
                                    from.box.v0_mm, from.box.v1_mm);
        for (const Between& column : columns) {
            auto at = [&](int i, int n) { return values[from.of_node(i, n)]; };
            const int i = column.low, n = row.low;
            const float low = at(i, n) + column.share * (at(i + 1, n) - at(i, n));
            const float high = at(i, n + 1) + column.share * (at(i + 1, n + 1) - at(i, n + 1));
            nodes.push_back(low + row.share * (high - low));
        }
    }
    return nodes;
}

std::vector<double> mean_spectrum(const FlareScene& scene, const ProbedGhost& ghost) {
    std::vector<double> mean(scene.samples.size(), 0.0);
    const std::size_t stride = scene.films.stride();
    const Bundle<float>& rays = ghost.grid.half;
    for (std::size_t k = 0; k < rays.size(); ++k) {
        if (rays.margin[k] < 0.0F || rays.r_rel[k] > 1.0F) continue;
        for (std::size_t w = 0; w < mean.size(); ++w)
            mean[w] += static_cast<double>(ghost.weights[k * stride + w]);
    }
    return mean;
}

/// Where the last crossing of the stop is met, in semi-diameters and the stop's own directions.
struct StopPlaces {
    std::vector<float> u, v;
};
StopPlaces stop_places(const MirrorGrid& grid, const NodePlacement& placement) {
    StopPlaces places;
    const Bundle<float>& rays = grid.half;
    const auto last = idx(rays.stop_crossings - 1);
    const double a = placement.stop_mask().semi_diameter_mm;
    const auto c = static_cast<float>(placement.cos_azimuth() / a);
    const auto s = static_cast<float>(placement.sin_azimuth() / a);
    for (int j = 0; j < grid.side(); ++j)
        for (int i = 0; i < grid.side(); ++i) {
            const std::size_t k = grid.of_node(i, j);
            const float u = (grid.is_mirrored(i) ? -1.0F : 1.0F) * rays.stop_u_mm[last][k];
            const float v = rays.stop_v_mm[last][k];
            places.u.push_back(c * u - s * v);
            places.v.push_back(s * u + c * v);
        }
    return places;
}

/// One of MeshNodes::clearances as a rim.
struct Rim {
    const std::vector<float>* clearance = nullptr;
    float w_per_clearance = 0.0F;
    std::uint32_t group = 0;
};

class Laying {
   public:
    Laying(const MeshNodes& nodes, const PixelFrame& frame, const std::vector<float>& light,
           const StopPlaces& places, const std::vector<Rim>& rims, double reach, RungMesh& mesh)
        : nodes_(nodes),
          frame_(frame),
          light_(light),
          places_(places),
          rims_(rims),
          reach_(static_cast<float>(reach)),
          mesh_(mesh) {}

    void lay() {
        const int side = nodes_.cells + 1;
        find_far();
        const std::vector<float> irradiance = spread();
        for (int j = 0; j < nodes_.cells; ++j)
            for (int i = 0; i < nodes_.cells; ++i) {
                const std::size_t p = idx(j * side + i), q = p + 1, r = p + idx(side), s = r + 1;
                if ((far_[p] & far_[q] & far_[r] & far_[s]) != 0 || !is_valid(p)) continue;
                for (const auto& corners : {std::array{p, q, r}, std::array{s, r, q}})
                    add(corners, irradiance);
            }
    }

   private:
    const MeshNodes& nodes_;
    const PixelFrame& frame_;
    const std::vector<float>& light_;
    const StopPlaces& places_;
    const std::vector<Rim>& rims_;
    float reach_;
    RungMesh& mesh_;
    /// Of each node, one bit for being out of all fringes' reach in the light, and one for each of
    /// the first rims in whose dark it lies. A cell whose corners share one is not looked at.
    std::vector<std::uint64_t> far_;

    void find_far() {
        far_.assign(light_.size(), mesh_.masks == nullptr ? 1 : 0);
        for (std::size_t r = 0; r < rims_.size(); ++r) {
            const RimGroup& group = mesh_.groups[rims_[r].group];
            if (group.kind == RimKind::masked) continue;
            const std::uint64_t bit = r < 63 ? std::uint64_t{2} << r : 0;
            const float scale = rims_[r].w_per_clearance;
            const bool fringed = group.kind == RimKind::fringed;
            const float dark = fringed ? -group.profile.shadow : 0.0F;
            const float light = fringed ? group.profile.light : -1e30F;
            for (std::size_t k = 0; k < far_.size(); ++k) {
                const float w = scale * (*rims_[r].clearance)[k];
                if (w < dark) far_[k] |= bit;
                if (w < light) far_[k] &= ~std::uint64_t{1};
            }
        }
    }

    /// All four corners of a cell, by the first of them.
    bool is_valid(std::size_t p) const {
        const std::size_t r = p + idx(nodes_.cells + 1);
        return nodes_.margin[p] >= 0.0F && nodes_.margin[p + 1] >= 0.0F &&
               nodes_.margin[r] >= 0.0F && nodes_.margin[r + 1] >= 0.0F;
    }

    double twice_area(std::size_t p, std::size_t q, std::size_t r) const {
        const auto x = [&](std::size_t k) { return static_cast<double>(nodes_.column[k]); };
        const auto y = [&](std::size_t k) { return static_cast<double>(nodes_.row[k]); };
        return (x(q) - x(p)) * (y(r) - y(p)) - (x(r) - x(p)) * (y(q) - y(p));
    }

    /// Light per area on the sensor: both areas summed over the cells about a node.
    std::vector<float> spread() const {
        const int side = nodes_.cells + 1;
        std::vector<double> area(light_.size(), 0.0), count(light_.size(), 0.0);
        for (int j = 0; j < nodes_.cells; ++j)
            for (int i = 0; i < nodes_.cells; ++i) {
                const std::size_t p = idx(j * side + i), q = p + 1, r = p + idx(side), s = r + 1;
                if (!is_valid(p)) continue;
                const double size =
                    0.5 * (std::abs(twice_area(p, q, r)) + std::abs(twice_area(s, r, q)));
                for (const std::size_t k : {p, q, r, s}) {
                    area[k] += size;
                    count[k] += 1.0;
                }
            }
        const double cell_px2 = nodes_.cell_area_mm2 / frame_.pixel_area_mm2();
        std::vector<float> irradiance(light_.size(), 0.0F);
        for (std::size_t k = 0; k < light_.size(); ++k)
            if (area[k] > 0.0)
                irradiance[k] = static_cast<float>(static_cast<double>(light_[k]) * cell_px2 *
                                                   count[k] / area[k]);
        return irradiance;
    }

    /// Where it is within reach of a rim, and on the frame.
    void add(const std::array<std::size_t, 3>& corners, const std::vector<float>& irradiance) {
        const auto [left, right] = std::minmax(
            {nodes_.column[corners[0]], nodes_.column[corners[1]], nodes_.column[corners[2]]});
        const auto [low, high] =
            std::minmax({nodes_.row[corners[0]], nodes_.row[corners[1]], nodes_.row[corners[2]]});
        if (right < 0.0F || high < 0.0F || left > static_cast<float>(frame_.width_px) ||
            low > static_cast<float>(frame_.height_px))
            return;
        RungTriangle triangle;
        triangle.first_rim = static_cast<std::uint32_t>(mesh_.rims.size());
        bool is_near = mesh_.masks != nullptr;
        float nearest = 1e30F;
        for (std::size_t n = 0; n < 3; ++n) {
            const std::size_t k = corners[n];
            triangle.column[n] = nodes_.column[k];
            triangle.row[n] = nodes_.row[k];
            triangle.light[n] = irradiance[k];
            triangle.u[n] = places_.u[k];
            triangle.v[n] = places_.v[k];
            if (mesh_.masks != nullptr)
                nearest = std::min(nearest, std::hypot(places_.u[k], places_.v[k]));
        }
        if (mesh_.masks != nullptr && nearest > reach_) return;
        for (const Rim& rim : rims_) {
            const RimGroup& group = mesh_.groups[rim.group];
            const bool fringed = group.kind == RimKind::fringed;
            RimAt at;
            at.group = rim.group;
            for (std::size_t n = 0; n < 3; ++n)
                at.w[n] = rim.w_per_clearance * (*rim.clearance)[corners[n]];
            const auto [least, most] = std::minmax({at.w[0], at.w[1], at.w[2]});
            const bool is_dark = group.kind == RimKind::sharp ? most < 0.0F
                                 : fringed                    ? most <= -group.profile.shadow
                                                              : false;
            if (is_dark) {
                mesh_.rims.resize(triangle.first_rim);
                return;
            }
            // A rim without fringes may still be seen by a pixel up to a triangle's breadth away.
            if (least >= (fringed ? group.profile.light : most - least)) continue;
            mesh_.rims.push_back(at);
            is_near = is_near || fringed;
        }
        triangle.rim_count = static_cast<std::uint32_t>(mesh_.rims.size()) - triangle.first_rim;
        if (is_near)
            mesh_.triangles.push_back(triangle);
        else
            mesh_.rims.resize(triangle.first_rim);
    }
};

/// Fields of the mask, and each colour group's share.
bool propagate(const FlareScene& scene, const ColorShares& shares, double fresnel_number,
               const std::stop_token& stop, RungMesh& mesh) {
    mesh.masks = scene.propagated_masks->of(scene, fresnel_number, stop);
    if (!mesh.masks) return false;
    for (const ColorGroup& group : color_groups(scene.samples)) {
        std::array<float, rim_channels> share{};
        for (std::size_t w = group.first; w < group.last; ++w)
            for (std::size_t c = 0; c < rim_channels; ++c)
                share[c] += static_cast<float>(shares[w][c]);
        mesh.mask_shares.push_back(share);
    }
    return true;
}

}  // namespace

RungMesh rung_mesh(const FlareScene& scene, const GhostPlanner& planner, const EdgeFringes& edge,
                   const ProbedGhost& ghost, const GhostRims& rims, const std::stop_token& stop) {
    RungMesh mesh;
    const double least_number = rims.least_fresnel_number();
    if (!(least_number > 0.0) || stop.stop_requested()) return mesh;
    const int level = ghost.planned.level;
    mesh.px_per_w = rims.px_per_w();
    // The picture's own size misplaces more than these fringes would: within its allowance.
    if (rims.changed_px() < blur_px(level)) return mesh;

    const StopMask& stop_mask = planner.placement().stop_mask();
    const GhostFringes last = rims.crossings.empty() ? GhostFringes{} : rims.crossings.back();
    const bool pictured = stop_mask.picture != nullptr;
    const bool propagates = shows(last) && (last.fresnel_number < whole_mask_below ||
                                            (pictured && last.fresnel_number <= most_propagated));
    const auto shown = std::ranges::find_if(rims.crossings, shows);
    const GhostFringes& named = shows(last)                     ? last
                                : shown != rims.crossings.end() ? *shown
                                                                : rims.surface;
    mesh.report = {ghost.planned.path, named.fresnel_number, named.first_fringe_px, propagates};
    const ColorShares shares = color_shares(scene, mean_spectrum(scene, ghost));
    for (const auto& share : shares)
        for (std::size_t c = 0; c < rim_channels; ++c)
            mesh.color[c] += static_cast<float>(share[c]);
    if (propagates && !propagate(scene, shares, last.fresnel_number, stop, mesh)) return {};

    const double reach = propagates
                             ? 1.0 + std::min(1.0, 4.0 / std::sqrt(2.0 * last.fresnel_number))
                             : 1.0 + std::min(1.0, into_shadow / std::sqrt(2.0 * least_number));
    const int cells =
        propagates ? most_cells : cells_for(ghost.planned, round_number_of(rims, stop_mask), reach);
    MirrorGrid grid{widened(ghost.planned.box, reach - 1.0, cells), cells, {}};
    lay_mirrored(grid);
    planner.trace_main(ghost, grid.half);
    const MeshNodes nodes = planner.placement().place(grid);
    const std::vector<float> light =
        continued(ghost.grid,
                  ray_light<gray_channels>(scene, ghost.grid, ghost.weights,
                                           channel_shares<gray_channels>(scene, 0, 1)),
                  grid.box, grid.cells);

    // Clearances: of all clear radii, then of the stop's edges, crossing by crossing.
    std::vector<Rim> cutting;
    auto add = [&](const GhostFringes& fringes, std::size_t first, std::size_t count, bool round,
                   bool masked) {
        const auto group = static_cast<std::uint32_t>(mesh.groups.size());
        const bool fringed = shows(fringes) && !masked;
        mesh.groups.push_back(
            {masked    ? RimKind::masked
             : fringed ? RimKind::fringed
                       : RimKind::sharp,
             fringed ? rim_profile(edge, shares, fringes.fresnel_number, fringes.px_per_w(), round)
                     : RimProfile{}});
        const double scale = fringed ? std::sqrt(2.0 * fringes.fresnel_number) : 1.0;
        for (std::size_t c = first; c < first + count; ++c)
            cutting.push_back({&nodes.clearances[c], static_cast<float>(scale), group});
    };
    const auto edges = idx(stop_edges(stop_mask));
    add(rims.surface, 0, 1, true, false);
    for (std::size_t s = 0; s < rims.crossings.size(); ++s)
        add(rims.crossings[s], 1 + s * edges, edges, stop_mask.blades < 3,
            propagates && s + 1 == rims.crossings.size());
    const StopPlaces places = stop_places(grid, planner.placement());
    Laying(nodes, planner.placement().frame(), light, places, cutting, reach, mesh).lay();
    // A broad ghost's fringes are drawn small, too: as their breadth allows, or twice as fine as
    // the ghost itself, which its allowance covers.
    const double least = scene.is_gray() ? least_px_per_w_gray : least_px_per_w;
    mesh.level = std::max(0, level - 1);
    while (mesh.level < level && mesh.px_per_w >= std::ldexp(least, mesh.level + 1)) ++mesh.level;
    mesh.rim_px = std::exp2(level) * (mesh.level < level ? coarse_rim_px : 1.0);
    return mesh;
}

}  // namespace ghostlight
