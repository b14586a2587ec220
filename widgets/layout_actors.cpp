#include "widgets/layout_actors.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <QColor>

#include <algorithm>
#include <cmath>

#include "widgets/ghost_colors.h"
#include "widgets/palette.h"

namespace ghostlight {

namespace {

/// Depth of each layer, towards the viewer, in the camera's own unit.
enum Layer { glass_layer, axis_layer, direct_layer, outline_layer, ghost_layer, hard_layer };

QColor mixed(const QColor& a, const QColor& b, double share_of_b) {
    const auto channel = [&](int from, int to) {
        return int(std::lround(from + (to - from) * share_of_b));
    };
    return {channel(a.red(), b.red()), channel(a.green(), b.green()), channel(a.blue(), b.blue())};
}

/// Points with a colour each, and lines or triangles over them, of one line width.
class Shape {
   public:
    explicit Shape(double width_px) : width_px_(width_px) {
        colors_->SetNumberOfComponents(3);
        data_->SetPoints(points_);
        data_->GetPointData()->SetScalars(colors_);
        mapper_->SetInputData(data_);
        actor_->SetMapper(mapper_);
        actor_->GetProperty()->LightingOff();
        actor_->PickableOff();
        set_pixel_ratio(1.0);
    }
    vtkActor* actor() { return actor_; }
    void set_pixel_ratio(double ratio) {
        actor_->GetProperty()->SetLineWidth(static_cast<float>(width_px_ * ratio));
    }
    void begin() {
        points_->Reset();
        colors_->Reset();
        lines_->Reset();
        triangles_->Reset();
    }
    vtkIdType add_point(DrawingPoint point, Layer layer, const QColor& color) {
        const unsigned char rgb[] = {static_cast<unsigned char>(color.red()),
                                     static_cast<unsigned char>(color.green()),
                                     static_cast<unsigned char>(color.blue())};
        colors_->InsertNextTypedTuple(rgb);
        return points_->InsertNextPoint(point.x, point.y, static_cast<double>(layer));
    }
    void add_line(const Polyline& line, Layer layer, const QColor& color, bool closed = false) {
        if (line.size() < 2) {
            return;
        }
        const auto count = static_cast<vtkIdType>(line.size());
        lines_->InsertNextCell(static_cast<int>(count + (closed ? 1 : 0)));
        vtkIdType first = 0;
        for (vtkIdType i = 0; i < count; ++i) {
            const vtkIdType id = add_point(line[static_cast<std::size_t>(i)], layer, color);
            first = i == 0 ? id : first;
            lines_->InsertCellPoint(id);
        }
        if (closed) {
            lines_->InsertCellPoint(first);
        }
    }
    void add_triangle(vtkIdType a, vtkIdType b, vtkIdType c) {
        const vtkIdType corners[] = {a, b, c};
        triangles_->InsertNextCell(3, corners);
    }
    void end() {
        data_->SetLines(lines_);
        data_->SetPolys(triangles_);
        points_->Modified();
        colors_->Modified();
        data_->Modified();
        actor_->SetVisibility(points_->GetNumberOfPoints() > 0);
    }

   private:
    double width_px_;
    vtkNew<vtkPoints> points_;
    vtkNew<vtkUnsignedCharArray> colors_;
    vtkNew<vtkCellArray> lines_, triangles_;
    vtkNew<vtkPolyData> data_;
    vtkNew<vtkPolyDataMapper> mapper_;
    vtkNew<vtkActor> actor_;
};

void add_glass(Shape& shape, const GlassElement& element, const QColor& color) {
    vtkIdType before_front = 0, before_back = 0;
    double before_y = 0.0;
    bool started = false;
    for (const GlassElement::Slice& slice : element.slices) {
        const vtkIdType front = shape.add_point({slice.z_front, slice.y}, glass_layer, color);
        const vtkIdType back = shape.add_point({slice.z_back, slice.y}, glass_layer, color);
        if (started && slice.y > before_y) {
            shape.add_triangle(before_front, before_back, back);
            shape.add_triangle(before_front, back, front);
        }
        before_front = front;
        before_back = back;
        before_y = slice.y;
        started = true;
    }
}

}  // namespace

QColor glass_tint(double n, const Palette& colors) {
    const double share = std::clamp((n - 1.45) / 0.45, 0.0, 1.0);
    const QColor tint = mixed(QColor(0x6f, 0x86, 0xc4), QColor(0x55, 0xb0, 0x9c), share);
    return mixed(colors.panel, tint, 0.30);
}

bool is_many(const std::vector<RayFan>& fans) {
    return std::ranges::count_if(fans, [](const RayFan& fan) { return !fan.path.is_direct(); }) > 1;
}

QColor ray_color(const RayFan& fan, RayLeg leg, bool many, const Palette& colors) {
    if (leg == RayLeg::lost) {
        return mixed(colors.panel, colors.dim, 0.45);
    }
    if (leg == RayLeg::direct) {
        // On axis the plainest; fields towards the edge in colours of their own.
        const QColor field = fan.field == 1 ? QColor(0x6f, 0xa6, 0xc6) : QColor(0xb0, 0x8f, 0xc8);
        return fan.field == 0 ? mixed(colors.panel, colors.dim, 0.62)
                              : mixed(colors.panel, field, 0.75);
    }
    if (many) {  // faint on the way in, full between, in the middle on the way out
        const double strength = leg == RayLeg::in ? 0.45 : leg == RayLeg::between ? 1.0 : 0.75;
        return mixed(colors.panel, ghost_color(fan.path), strength);
    }
    return leg == RayLeg::in        ? colors.amber
           : leg == RayLeg::between ? colors.red_orange
                                    : colors.teal;
}

struct LayoutActors::Parts {
    Shape glass{1.0}, axis{1.0}, direct{1.0}, outlines{1.2}, ghosts{1.5}, hard{2.4};
    std::vector<Shape*> all() { return {&glass, &axis, &direct, &outlines, &ghosts, &hard}; }
};

LayoutActors::LayoutActors() : parts_(std::make_unique<Parts>()) {
    for (Shape* shape : parts_->all()) {
        shape->end();
    }
}

LayoutActors::~LayoutActors() = default;

void LayoutActors::add_to(vtkRenderer* renderer) {
    for (Shape* shape : parts_->all()) {
        renderer->AddActor(shape->actor());
    }
}

void LayoutActors::set_pixel_ratio(double pixel_ratio) {
    for (Shape* shape : parts_->all()) {
        shape->set_pixel_ratio(pixel_ratio);
    }
}

void LayoutActors::show_lens(const LensDrawing& drawing, const Palette& colors) {
    Shape& glass = parts_->glass;
    Shape& outlines = parts_->outlines;
    Shape& hard = parts_->hard;
    for (Shape* shape : {&glass, &outlines, &hard}) {
        shape->begin();
    }
    const QColor edge =
        mixed(mixed(colors.panel, colors.text, 0.55), QColor(0x6f, 0xa6, 0xc6), 0.35);
    for (const GlassElement& element : drawing.elements) {
        add_glass(glass, element, glass_tint(element.n, colors));
        outlines.add_line(element.outline, outline_layer, edge, true);
    }
    for (const SurfaceOutline& surface : drawing.surfaces) {
        if (!surface.refracts && !surface.is_stop) {
            outlines.add_line(surface.points, outline_layer, colors.line);
        }
    }
    if (drawing.stop.outer_mm > 0.0) {
        for (const double side : {-1.0, 1.0}) {
            hard.add_line({{drawing.stop.z_mm, side * drawing.stop.opening_mm},
                           {drawing.stop.z_mm, side * drawing.stop.outer_mm}},
                          hard_layer, colors.text);
        }
    }
    if (!drawing.surfaces.empty()) {  // no lens, no sensor
        const SensorLine& sensor = drawing.sensor;
        outlines.add_line(
            {{sensor.z_mm, -sensor.half_diagonal_mm}, {sensor.z_mm, sensor.half_diagonal_mm}},
            outline_layer, mixed(colors.panel, colors.dim, 0.6));
        hard.add_line({{sensor.z_mm, -sensor.half_length_mm}, {sensor.z_mm, sensor.half_length_mm}},
                      hard_layer, colors.text);
    }
    for (Shape* shape : {&glass, &outlines, &hard}) {
        shape->end();
    }
}

void LayoutActors::show_rays(const std::vector<RayFan>& fans, const Palette& colors, double walk) {
    Shape& direct = parts_->direct;
    Shape& ghosts = parts_->ghosts;
    direct.begin();
    ghosts.begin();
    const bool many = is_many(fans);
    for (const RayFan& fan : fans) {
        for (const RayStretch& stretch : walked(fan.stretches, walk)) {
            const bool thin = stretch.leg == RayLeg::direct || stretch.leg == RayLeg::lost;
            (thin ? direct : ghosts)
                .add_line(stretch.points, thin ? direct_layer : ghost_layer,
                          ray_color(fan, stretch.leg, many, colors));
        }
    }
    direct.end();
    ghosts.end();
}

void LayoutActors::show_axis(double z_from_mm, double z_to_mm, double mm_per_px,
                             const Palette& colors) {
    const double dash = 10.0 * mm_per_px, gap = 4.0 * mm_per_px, dot = 1.5 * mm_per_px;
    const QColor color = mixed(colors.panel, colors.dim, 0.55);
    Shape& axis = parts_->axis;
    axis.begin();
    double z = z_from_mm;
    bool long_one = true;
    while (z < z_to_mm) {
        const double end = z + (long_one ? dash : dot);
        axis.add_line({{z, 0.0}, {std::min(end, z_to_mm), 0.0}}, axis_layer, color);
        z = end + gap;
        long_one = !long_one;
    }
    axis.end();
}

}  // namespace ghostlight
