#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <vector>

#include "core/optics/optical_system.h"
#include "core/optics/prescription.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// A point of the drawing, mm: first z along the axis, then y. No GL, Qt or VTK here.
using DrawingPoint = glm::dvec2;
using Polyline = std::vector<DrawingPoint>;

/// The meridional section of one surface, from its lower rim to its upper one.
struct SurfaceOutline {
    std::size_t row = 0;  ///< from 0
    Polyline points;
    bool refracts = true;  ///< false: the same medium on both sides
    bool is_stop = false;
};

/// The glass between two neighbouring surfaces.
struct GlassElement {
    std::size_t front_row = 0, back_row = 0;
    double n = 1.5;
    Polyline outline;  ///< once round; the first point is not repeated
    /// The same area as slices across: at height y the glass lies between two z. Surfaces that
    /// cross inside their rims leave out the slices in which there is no glass.
    struct Slice {
        double y, z_front, z_back;
    };
    std::vector<Slice> slices;
};

struct StopBars {
    std::size_t row = 0;
    double z_mm = 0.0;
    double opening_mm = 0.0;  ///< from the axis to the edge at the working f-number
    double outer_mm = 0.0;
};

struct SensorLine {
    double z_mm = 0.0;
    double half_length_mm = 12.0;    ///< in the plane of the drawing
    double half_diagonal_mm = 21.6;  ///< the image circle's radius that the sensor needs
};

struct DrawingBox {
    double z_min = 0.0, z_max = 1.0, y_min = -1.0, y_max = 1.0;
};

/// The lens without rays.
struct LensDrawing {
    std::vector<SurfaceOutline> surfaces;  ///< by row
    std::vector<GlassElement> elements;
    StopBars stop;
    SensorLine sensor;
    double lead_in_mm = 10.0;  ///< how far before the first vertex the rays begin
    DrawingBox box;            ///< lens, sensor, and the rays' first stretch
};

/// `system` is the compiled lens, or null if it could not be compiled: then the listed stop and
/// the listed distances are drawn, all glass in one tint. Elements of a row that has no finite
/// curve are left out.
LensDrawing lens_drawing(const Prescription& lens, const OpticalSystem* system,
                         const LightDirection& light);

}  // namespace ghostlight
