#include "widgets/axis_marks.h"

#include <cmath>
#include <utility>

#include "core/optics/paraxial.h"

namespace ghostlight {

std::vector<AxisMark> axis_marks(const OpticalSystem& system,
                                 const std::vector<GhostPath>& ghosts) {
    using Kind = AxisMark::Kind;
    const FirstOrder order = first_order(system);
    const double last_mm = system.surfaces.back().vertex_z_mm;
    std::vector<AxisMark> marks;
    const auto add = [&](Kind kind, double z_mm, double half_height_mm, std::string label,
                         GhostPath path = {}) {
        if (std::isfinite(z_mm) && std::isfinite(half_height_mm)) {
            marks.push_back({kind, z_mm, half_height_mm, std::move(label), std::move(path)});
        }
    };
    add(Kind::focus, order.ffd_mm, 0.0, "F");
    add(Kind::focus, last_mm + order.bfd_mm, 0.0, "F′");
    add(Kind::principal, order.front_principal_z_mm, 0.0, "H");
    add(Kind::principal, last_mm + order.rear_principal_z_mm, 0.0, "H′");
    add(Kind::entrance_pupil, order.entrance_pupil_z_mm, std::abs(order.entrance_pupil_radius_mm),
        "EP");
    add(Kind::exit_pupil, last_mm + order.exit_pupil_z_mm, std::abs(order.exit_pupil_radius_mm),
        "XP");
    for (const GhostPath& path : ghosts) {
        bool exists = !path.is_direct();
        for (const std::size_t row : path.reflections) {
            exists = exists && row < turning_count(system);
        }
        if (exists) {
            const double from_sensor_mm = paraxial_ghost(system, path).focus_from_sensor_mm;
            add(Kind::ghost_focus, system.sensor_z_mm + from_sensor_mm, 0.0,
                name(path, system.surfaces.size()), path);
        }
    }
    return marks;
}

}  // namespace ghostlight
