#include "widgets/layout_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/optics/glass.h"
#include "core/units.h"

namespace ghostlight {

namespace {

constexpr int outline_points = 65;
constexpr int flat_samples = 16;
constexpr double untold_index = 1.55;  // of glass whose index is not known at this wavelength

std::vector<double> vertices_z(const Prescription& lens, const OpticalSystem* system) {
    std::vector<double> z;
    double at = 0.0;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
        z.push_back(system != nullptr ? system->surfaces[row].vertex_z_mm : at);
        at += lens.surfaces[row].thickness_mm;
    }
    return z;
}

double sensor_z(const Prescription& lens, const OpticalSystem* system) {
    if (system != nullptr) {
        return system->sensor_z_mm;
    }
    double z = 0.0;
    for (const Surface& surface : lens.surfaces) {
        z += surface.thickness_mm;
    }
    return z;
}

/// Heights from −h to h, closer together towards the rim, where a deep surface turns away.
std::vector<double> heights(double h) {
    std::vector<double> y;
    for (int i = 0; i < outline_points; ++i) {
        const double t = 2.0 * i / (outline_points - 1) - 1.0;
        y.push_back(h * std::sin(t * std::numbers::pi / 2.0));
    }
    return y;
}

/// One face of an element up to the element's own height: the surface, then the edge.
class Face {
   public:
    Face(const Surface& surface, double vertex_z, double z_end, double h_end, bool flat)
        : surface_(surface), vertex_z_(vertex_z), z_end_(z_end), h_end_(h_end), flat_(flat) {}

    double rim_mm() const { return surface_.semi_diameter_mm; }
    double z(double y) const {
        const double rim = rim_mm();
        const double height = std::abs(y);
        const double z_rim = vertex_z_ + sag_mm(surface_, rim);
        if (height <= rim) {
            return vertex_z_ + sag_mm(surface_, y);
        }
        if (flat_ || h_end_ <= rim) {
            return z_rim;
        }
        return z_rim + (z_end_ - z_rim) * (height - rim) / (h_end_ - rim);
    }

   private:
    const Surface& surface_;
    double vertex_z_, z_end_, h_end_;
    bool flat_;
};

GlassElement element_between(const Prescription& lens, const std::vector<double>& z,
                             std::size_t front_row, std::size_t back_row) {
    const Surface& front = lens.surfaces[front_row];
    const Surface& back = lens.surfaces[back_row];
    const double h_front = front.semi_diameter_mm;
    const double h_back = back.semi_diameter_mm;
    const double h = std::max(h_front, h_back);
    const double z_front_rim = z[front_row] + sag_mm(front, h_front);
    const double z_back_rim = z[back_row] + sag_mm(back, h_back);

    // The smaller face goes on as a flat ring to the larger one's rim, as lenses are ground,
    // unless the ring would come out of the other face: then a bevel joins the two rims.
    bool flat = true;
    for (int i = 0; i <= flat_samples; ++i) {
        const double y = std::lerp(std::min(h_front, h_back), h, double(i) / flat_samples);
        flat = flat && (h_front < h_back ? z_front_rim < z[back_row] + sag_mm(back, y)
                                         : z_back_rim > z[front_row] + sag_mm(front, y));
    }
    const Face front_face(front, z[front_row], z_back_rim, h, flat);
    const Face back_face(back, z[back_row], z_front_rim, h, flat);

    GlassElement element;
    element.front_row = front_row;
    element.back_row = back_row;
    std::vector<double> ys = heights(h);
    for (const double rim : {h_front, h_back}) {
        ys.push_back(rim);
        ys.push_back(-rim);
    }
    std::ranges::sort(ys);
    ys.erase(std::unique(ys.begin(), ys.end()), ys.end());
    for (const double y : ys) {
        element.slices.push_back({y, front_face.z(y), back_face.z(y)});
    }
    for (const GlassElement::Slice& slice : element.slices) {
        element.outline.emplace_back(slice.z_front, slice.y);
    }
    for (auto slice = element.slices.rbegin(); slice != element.slices.rend(); ++slice) {
        element.outline.emplace_back(slice->z_back, slice->y);
    }
    std::erase_if(element.slices,
                  [](const GlassElement::Slice& s) { return s.z_back < s.z_front; });
    return element;
}

bool is_drawable(const Surface& surface) {
    const double sag = sag_mm(surface, surface.semi_diameter_mm);
    return std::isfinite(sag) && std::isfinite(surface.thickness_mm) &&
           surface.semi_diameter_mm > 0.0 && std::isfinite(surface.semi_diameter_mm);
}

double index_or_default(const Medium& medium, const OpticalSystem* system, std::size_t row) {
    if (system != nullptr) {
        return system->surfaces[row].n_after;
    }
    try {
        return refractive_index(medium, d_line_nm);
    } catch (const Error&) {
        return untold_index;
    }
}

SensorLine sensor_line(const Prescription& lens, const OpticalSystem* system,
                       const LightDirection& light) {
    const double half_width = lens.sensor.width_mm / 2.0;
    const double half_height = lens.sensor.height_mm / 2.0;
    const double azimuth = rad_from_deg(light.azimuth_deg);
    const double along_x = std::abs(std::cos(azimuth));
    const double along_y = std::abs(std::sin(azimuth));
    const double diagonal = std::hypot(half_width, half_height);
    SensorLine sensor;
    sensor.z_mm = sensor_z(lens, system);
    sensor.half_diagonal_mm = diagonal;
    sensor.half_length_mm = std::min(
        {diagonal, half_width / std::max(along_x, 1e-9), half_height / std::max(along_y, 1e-9)});
    return sensor;
}

/// Largest of the two glass surfaces on either side of a row.
double tallest_beside(const Prescription& lens, std::size_t row) {
    const std::size_t first = row > 2 ? row - 2 : 0;
    const std::size_t last = std::min(row + 2, lens.surfaces.size() - 1);
    double tallest = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
        if (is_drawable(lens.surfaces[i])) {
            tallest = std::max(tallest, lens.surfaces[i].semi_diameter_mm);
        }
    }
    return tallest;
}

}  // namespace

LensDrawing lens_drawing(const Prescription& lens, const OpticalSystem* system,
                         const LightDirection& light) {
    LensDrawing drawing;
    const std::vector<double> z = vertices_z(lens, system);
    const std::size_t rows = lens.surfaces.size();
    drawing.sensor = sensor_line(lens, system, light);
    double tallest = 1.0;

    for (std::size_t row = 0; row < rows; ++row) {
        const Surface& surface = lens.surfaces[row];
        SurfaceOutline outline;
        outline.row = row;
        outline.is_stop = row == lens.stop.surface;
        outline.refracts = surface.medium_after != medium_before(lens, row);
        if (is_drawable(surface)) {
            for (const double y : heights(surface.semi_diameter_mm)) {
                outline.points.emplace_back(z[row] + sag_mm(surface, y), y);
            }
            tallest = std::max(tallest, surface.semi_diameter_mm);
        }
        drawing.surfaces.push_back(std::move(outline));
    }

    // A stop inside glass, or any other surface that separates nothing, does not divide an element.
    for (std::size_t row = 0; row < rows; ++row) {
        const Surface& surface = lens.surfaces[row];
        if (is_air(surface.medium_after) || !drawing.surfaces[row].refracts) {
            continue;
        }
        std::size_t back = row + 1;
        while (back < rows && !drawing.surfaces[back].refracts) {
            ++back;
        }
        if (back < rows && is_drawable(surface) && is_drawable(lens.surfaces[back])) {
            GlassElement element = element_between(lens, z, row, back);
            element.n = index_or_default(surface.medium_after, system, row);
            drawing.elements.push_back(std::move(element));
        }
    }

    drawing.stop.row = lens.stop.surface;
    if (lens.stop.surface < rows) {
        const double listed = lens.surfaces[lens.stop.surface].semi_diameter_mm;
        drawing.stop.z_mm = z[lens.stop.surface];
        drawing.stop.opening_mm =
            system != nullptr ? system->stop_mask.semi_diameter_mm
                              : std::min(listed, lens.stop.semi_diameter_mm.value_or(listed));
        drawing.stop.outer_mm =
            std::max(1.25 * listed, 1.15 * tallest_beside(lens, lens.stop.surface));
    }

    const double length = std::max(drawing.sensor.z_mm, 1.0);
    drawing.lead_in_mm = std::max(0.22 * length, 0.5 * tallest);
    const double half = std::max({tallest, drawing.stop.outer_mm, drawing.sensor.half_length_mm});
    drawing.box = {-drawing.lead_in_mm, drawing.sensor.z_mm, -half, half};
    for (const SurfaceOutline& outline : drawing.surfaces) {
        for (const DrawingPoint& point : outline.points) {
            drawing.box.z_min = std::min(drawing.box.z_min, point.x);
            drawing.box.z_max = std::max(drawing.box.z_max, point.x);
        }
    }
    return drawing;
}

}  // namespace ghostlight
