#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "core/error.h"
#include "core/ghosts/bundle.h"
#include "core/ghosts/path_stability.h"
#include "core/ghosts/pupil.h"
#include "core/optics/mend.h"
#include "core/optics/trace.h"
#include "core/units.h"
#include "tests/kits/random_lens.h"

namespace ghostlight {
namespace {

/// Roundings at each meeting, one of which the amplification stands for, with room.
constexpr double roundings = 400.0;
constexpr double unit = 0x1p-53;
/// A ray whose amplification is beyond this has no digits left to compare, over the lens's size.
constexpr double hopeless = 1e9;
constexpr double film_tolerance = 1e-11;  ///< of 1: some tens of layers, thick ones among them
constexpr double energy_tolerance = 1e-10, float_energy_tolerance = 2e-3;
constexpr double weight_tolerance = 1e-6;  ///< relative, where angles themselves have rounded

class Laws {
   public:
    Laws(const Prescription& lens, std::uint64_t number, LawCounts& counts, double strictness)
        : lens_(lens),
          dice_(number * 7919 + 13),
          counts_(counts),
          unit_(unit / strictness),
          system_(compile(lens, d_line_nm)) {}

    std::vector<Violation> check() {
        std::vector<GhostPath> paths = two_reflection_ghosts(system_);
        std::vector<GhostPath> chosen = {GhostPath{}};
        constexpr std::size_t most_paths = 6;
        for (std::size_t k = 0; k < most_paths && !paths.empty(); ++k)
            chosen.push_back(paths[static_cast<std::size_t>(
                dice_.integer(0, static_cast<int>(paths.size()) - 1))]);
        films();
        for (const GhostPath& path : chosen) {
            const double field_deg = dice_.chance(0.2)   ? 0.0
                                     : dice_.chance(0.2) ? dice_.between(80.0, 90.0)
                                                         : dice_.between(0.0, 40.0);
            const LightDirection light{field_deg, dice_.between(0.0, 360.0)};
            bundles(path, light);
            for (int k = 0; k < 4; ++k) one_ray(path, light);
        }
        return std::move(found_);
    }

   private:
    const Prescription& lens_;
    Dice dice_;
    LawCounts& counts_;
    double unit_;
    OpticalSystem system_;
    std::vector<Violation> found_;

    template <class... Args>
    void broken(const char* law, fmt::format_string<Args...> text, Args&&... args) {
        found_.push_back({law, fmt::format(text, std::forward<Args>(args)...)});
    }

    void films() {
        for (std::size_t row = 0; row < system_.surfaces.size(); ++row) {
            const Film& film = system_.surfaces[row].film;
            for (int k = 0; k < 6; ++k) {
                const double cosine = k == 0   ? 1.0
                                      : k == 1 ? dice_.magnitude(1e-9, 1e-2)
                                               : dice_.between(0.0, 1.0);
                const Reflectances r = reflectances(film, cosine);
                ++counts_.films;
                for (const auto& [rs, ts] : {std::pair{r.r_s, r.t_s}, std::pair{r.r_p, r.t_p}}) {
                    if (!std::isfinite(rs + ts) || rs < 0.0 || ts < -film_tolerance)
                        broken("R + T", "row {}: R {} T {} at cos {}", row + 1, rs, ts, cosine);
                    const double sum = rs + ts;
                    const bool fits = is_absorbing(film) ? sum <= 1.0 + film_tolerance
                                                         : std::abs(sum - 1.0) <= film_tolerance;
                    if (!fits)
                        broken("R + T", "row {}: R + T = 1 {:+.3g} at cos {}", row + 1, sum - 1.0,
                               cosine);
                }
                // From the other side, at the angle of refraction.
                const double eta = film.n_in / film.n_out;
                const double cos2 = 1.0 - eta * eta * (1.0 - cosine * cosine);
                if (cos2 <= 1e-6 || cosine <= 1e-3) continue;
                const Reflectances back = reflectances(reversed(film), std::sqrt(cos2));
                if (std::abs(back.t_s - r.t_s) > 1e-9 || std::abs(back.t_p - r.t_p) > 1e-9)
                    broken("T both ways", "row {}: {} and {} at cos {}", row + 1, r.t(), back.t(),
                           cosine);
            }
        }
    }

    template <class T>
    void bundle(const GhostPath& path, const LightDirection& light, double most_weight) {
        const BeamFrame frame = beam_frame(light);
        Bundle<T> rays;
        lay_grid(entrance_box(system_, frame), 11, rays);
        trace_bundle(trace_path<T>(system_, path), frame, Weights::polarised, rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ++counts_.finite;
            if (!std::isfinite(rays.x_mm[i] + rays.y_mm[i] + rays.weight[i] + rays.r_rel[i]) ||
                std::isnan(rays.margin[i]))
                broken("finite", "{} at {} deg: x {} y {} weight {} margin {}", name(path),
                       light.field_deg, rays.x_mm[i], rays.y_mm[i], rays.weight[i], rays.margin[i]);
            if (rays.margin[i] < T(0)) continue;
            ++counts_.energy;
            if (!(rays.weight[i] >= T(0)) ||
                static_cast<double>(rays.weight[i]) > 1.0 + most_weight)
                broken("energy", "{} at {} deg: weight 1 {:+.3g} in {} bytes", name(path),
                       light.field_deg, static_cast<double>(rays.weight[i]) - 1.0, sizeof(T));
        }
    }
    void bundles(const GhostPath& path, const LightDirection& light) {
        bundle<double>(path, light, energy_tolerance);
        bundle<float>(path, light, float_energy_tolerance);
    }

    /// One ray that gets through, and its tolerances.
    struct Sound {
        double u_mm = 0.0, v_mm = 0.0, tolerance_mm = 0.0;
        TracedRay ray;
    };
    std::optional<Sound> sound_ray(const GhostPath& path, const BeamFrame& frame) {
        const PupilBox box = entrance_box(system_, frame);
        Sound sound;
        sound.u_mm = std::lerp(box.u0_mm, box.u1_mm, dice_.between(0.0, 1.0));
        sound.v_mm = std::lerp(box.v0_mm, box.v1_mm, dice_.between(0.0, 1.0));
        sound.ray = trace_ray(system_, path, ray_of(frame, sound.u_mm, sound.v_mm));
        if (!sound.ray.status.reaches_sensor()) return std::nullopt;
        const RayCondition condition = ray_condition(system_, path, frame, sound.u_mm, sound.v_mm);
        if (!condition.valid) return std::nullopt;
        double size_mm = 0.0;
        for (const RayHit& hit : sound.ray.hits)
            size_mm = std::max({size_mm, std::abs(hit.point.x), std::abs(hit.point.y)});
        if (!(condition.amplification_mm < hopeless * (size_mm + 1e-3))) return std::nullopt;
        // An asphere is met to within a few ulp of its clear radius.
        double aspheric_mm = 0.0;
        for (const SurfaceAt& surface : system_.surfaces)
            if (!surface.aspheric.empty())
                aspheric_mm = std::max(aspheric_mm, surface.semi_diameter_mm);
        const double slope = std::hypot(condition.by_entrance[0], condition.by_entrance[3]);
        sound.tolerance_mm = roundings * unit_ * condition.amplification_mm +
                             1e-12 * aspheric_mm * (1.0 + slope) * (aspheric_mm > 0.0 ? 1e3 : 0.0);
        return sound;
    }
    static Ray ray_of(const BeamFrame& frame, double u_mm, double v_mm) {
        return {u_mm * frame.e1 + v_mm * frame.e2, frame.direction};
    }
    bool has_aspheres() const {
        return std::ranges::any_of(system_.surfaces,
                                   [](const SurfaceAt& s) { return !s.aspheric.empty(); });
    }

    void one_ray(const GhostPath& path, const LightDirection& light) {
        const BeamFrame frame = beam_frame(light);
        const auto sound = sound_ray(path, frame);
        if (!sound) return;
        scaled_ray(path, frame, *sound);
        turned_ray(path, light, *sound);
        if (!has_aspheres()) {
            unfolded_ray(path, frame, *sound);
            reversed_ray(path, frame, *sound);
        }
    }

    void scaled_ray(const GhostPath& path, const BeamFrame& frame, const Sound& sound) {
        constexpr double factor = 1024.0;  // exact in binary
        OpticalSystem large;
        try {
            large = compile(scaled(lens_, factor), d_line_nm);
        } catch (const Error&) {
            return;  // a length beyond what a lens may have
        }
        const TracedRay ray =
            trace_ray(large, path, ray_of(frame, factor * sound.u_mm, factor * sound.v_mm));
        ++counts_.scaled;
        const double off_mm = std::hypot(ray.sensor_point.x / factor - sound.ray.sensor_point.x,
                                         ray.sensor_point.y / factor - sound.ray.sensor_point.y);
        if (!(off_mm <= sound.tolerance_mm))
            broken("scale", "{}: {} mm off, {} allowed", name(path), off_mm, sound.tolerance_mm);
        if (std::abs(ray.weight - sound.ray.weight) > weight_tolerance * sound.ray.weight + 1e-14)
            broken("scale", "{}: weight {} and {}", name(path), ray.weight, sound.ray.weight);
    }

    void turned_ray(const GhostPath& path, const LightDirection& light, const Sound& sound) {
        // With a rectangle or blades the light's fate turns, not its way.
        const double turn_deg = dice_.between(1.0, 359.0);
        const double c = std::cos(rad_from_deg(turn_deg)), s = std::sin(rad_from_deg(turn_deg));
        const glm::dvec3& at = sound.ray.sensor_point;
        auto compare = [&](const char* law, const LightDirection& other, double u_mm, double x_mm,
                           double y_mm) {
            const TracedRay ray =
                trace_ray(system_, path, ray_of(beam_frame(other), u_mm, sound.v_mm));
            const double off_mm = std::hypot(ray.sensor_point.x - x_mm, ray.sensor_point.y - y_mm);
            if (!(off_mm <= sound.tolerance_mm))
                broken(law, "{}: {} mm off, {} allowed", name(path), off_mm, sound.tolerance_mm);
            if (std::abs(ray.weight - sound.ray.weight) >
                weight_tolerance * sound.ray.weight + 1e-14)
                broken(law, "{}: weight {} and {}", name(path), ray.weight, sound.ray.weight);
        };
        ++counts_.turned;
        compare("rotation", {light.field_deg, light.azimuth_deg + turn_deg}, sound.u_mm,
                c * at.x - s * at.y, s * at.x + c * at.y);
        ++counts_.mirrored;
        compare("mirror", {light.field_deg, 180.0 - light.azimuth_deg}, -sound.u_mm, -at.x, at.y);
    }

    /// Back along the same way through the lens turned round.
    void reversed_ray(const GhostPath& path, const BeamFrame& frame, const Sound& sound) {
        if (std::ranges::find(path.reflections, system_.surfaces.size()) != path.reflections.end())
            return;
        OpticalSystem back = system_;
        const std::size_t count = back.surfaces.size();
        std::ranges::reverse(back.surfaces);
        for (SurfaceAt& surface : back.surfaces) {
            surface.curvature_per_mm = -surface.curvature_per_mm;
            for (double& a : surface.aspheric) a = -a;
            surface.vertex_z_mm = system_.sensor_z_mm - surface.vertex_z_mm;
            std::swap(surface.n_before, surface.n_after);
            surface.film = reversed(surface.film);
        }
        back.stop = count - 1 - system_.stop;
        back.sensor_z_mm = system_.sensor_z_mm;
        GhostPath way;
        for (std::size_t k = path.reflections.size(); k-- > 0;)
            way.reflections.push_back(count - 1 - path.reflections[k]);
        const glm::dvec3& d = sound.ray.direction;
        const glm::dvec3& p = sound.ray.sensor_point;
        BeamFrame beam;
        beam.direction = {-d.x, -d.y, d.z};
        const double across = std::hypot(d.x, d.y);
        beam.e1 =
            across > 0.0 ? glm::dvec3(-d.y / across, d.x / across, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
        beam.e2 = glm::cross(beam.direction, beam.e1);
        const glm::dvec3 from{p.x, p.y, 0.0};
        const double u_mm = glm::dot(from, beam.e1), v_mm = glm::dot(from, beam.e2);
        const RayCondition condition = ray_condition(back, way, beam, u_mm, v_mm);
        const TracedRay returned = trace_ray(back, way, {from, beam.direction});
        if (at_an_edge(sound)) return;
        ++counts_.reversed;
        if (!returned.status.reaches_sensor()) {
            broken("reversal", "{}: the way back is {}", name(path), to_string(returned.status));
            return;
        }
        const glm::dvec3 start = sound.u_mm * frame.e1 + sound.v_mm * frame.e2;
        const double t = -start.z / frame.direction.z;
        const double off_mm = std::hypot(returned.sensor_point.x - start.x - t * frame.direction.x,
                                         returned.sensor_point.y - start.y - t * frame.direction.y);
        double slope = 0.0;
        for (const double each : condition.by_entrance) slope = std::max(slope, std::abs(each));
        const double allowed_mm =
            roundings * unit_ * (condition.amplification_mm + slope * length_of(from)) +
            slope * sound.tolerance_mm;
        if (condition.amplification_mm < hopeless && !(off_mm <= allowed_mm))
            broken("reversal", "{}: {} mm off, {} allowed", name(path), off_mm, allowed_mm);
        if (condition.amplification_mm < hopeless &&
            std::abs(returned.weight_average - sound.ray.weight_average) >
                weight_tolerance * sound.ray.weight_average + 1e-14)
            broken("reversal", "{}: weight {} and back {}", name(path), sound.ray.weight_average,
                   returned.weight_average);
    }
    static double length_of(const glm::dvec3& p) { return std::hypot(p.x, p.y, p.z); }

    /// Where a derivative or a weight has no bound, rounding decides.
    static bool at_an_edge(const Sound& sound) {
        return std::ranges::any_of(sound.ray.hits, [](const RayHit& hit) {
            return hit.cos_incidence < 1e-2 || hit.intensity < 1e-9;
        });
    }

    /// The lens laid out along the light's way: after every mirror the drawing is turned over, so
    /// that the light always goes on towards +z. Conics by their quadratic equation, in long
    /// double.
    void unfolded_ray(const GhostPath& path, const BeamFrame& frame, const Sound& sound) {
        using Real = long double;
        struct Three {
            Real x, y, z;
        };
        const glm::dvec3 start = sound.u_mm * frame.e1 + sound.v_mm * frame.e2;
        Three p{start.x, start.y, start.z};
        Three d{frame.direction.x, frame.direction.y, frame.direction.z};
        const Real length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
        d = {d.x / length, d.y / length, d.z / length};
        Real vertex = 0.0L;
        bool forward = true;
        for (const PathEvent& event : events(path, system_.surfaces.size())) {
            const SurfaceAt& surface = surface_at(system_, event.surface);
            const Real side = forward ? 1.0L : -1.0L;
            p.z -= side * (static_cast<Real>(surface.vertex_z_mm) - vertex);
            vertex = surface.vertex_z_mm;
            const Real c = side * static_cast<Real>(surface.curvature_per_mm);
            const Real k1 = 1.0L + static_cast<Real>(surface.conic);
            // c (x² + y² + k1 z²) − 2 z = 0 along p + t d, the root next to the vertex.
            const Real a = c * (d.x * d.x + d.y * d.y + k1 * d.z * d.z);
            const Real b = c * (p.x * d.x + p.y * d.y + k1 * p.z * d.z) - d.z;
            const Real e = c * (p.x * p.x + p.y * p.y + k1 * p.z * p.z) - 2.0L * p.z;
            const Real root = b * b - a * e;
            if (!(root >= 0.0L)) return;  // the ray is at an edge: another law's business
            const Real t = e / (-b + std::sqrt(root));
            p = {p.x + t * d.x, p.y + t * d.y, p.z + t * d.z};
            Three n{-c * p.x, -c * p.y, 1.0L - k1 * c * p.z};
            const Real n_length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
            n = {n.x / n_length, n.y / n_length, n.z / n_length};
            const Real cos1 = d.x * n.x + d.y * n.y + d.z * n.z;
            if (event.reflects) {
                d = {d.x - 2.0L * cos1 * n.x, d.y - 2.0L * cos1 * n.y, d.z - 2.0L * cos1 * n.z};
                d.z = -d.z;
                p.z = -p.z;
                forward = !forward;
            } else {
                const Real before = forward ? surface.n_before : surface.n_after;
                const Real after = forward ? surface.n_after : surface.n_before;
                const Real eta = before / after;
                const Real cos2 = 1.0L - eta * eta * (1.0L - cos1 * cos1);
                if (!(cos2 >= 0.0L)) return;
                const Real g = std::copysign(std::sqrt(cos2), cos1) - eta * cos1;
                d = {eta * d.x + g * n.x, eta * d.y + g * n.y, eta * d.z + g * n.z};
            }
        }
        p.z -= static_cast<Real>(system_.sensor_z_mm) - vertex;
        const Real t = -p.z / d.z;
        const auto x = static_cast<double>(p.x + t * d.x), y = static_cast<double>(p.y + t * d.y);
        ++counts_.unfolded;
        const double off_mm =
            std::hypot(x - sound.ray.sensor_point.x, y - sound.ray.sensor_point.y);
        if (!(off_mm <= sound.tolerance_mm))
            broken("unfolded", "{}: {} mm off, {} allowed", name(path), off_mm, sound.tolerance_mm);
    }
};

}  // namespace

LawCounts& LawCounts::operator+=(const LawCounts& other) {
    finite += other.finite;
    energy += other.energy;
    films += other.films;
    reversed += other.reversed;
    scaled += other.scaled;
    turned += other.turned;
    mirrored += other.mirrored;
    unfolded += other.unfolded;
    return *this;
}

std::vector<Violation> broken_laws(const Prescription& lens, std::uint64_t number,
                                   LawCounts& counts, double strictness) {
    return Laws(lens, number, counts, strictness).check();
}

}  // namespace ghostlight
