#pragma once

#include <memory>
#include <vector>

#include "widgets/layout_scene.h"
#include "widgets/ray_fan.h"

class vtkRenderer;

namespace ghostlight {

struct Palette;

/// Turns a drawing and its rays into VTK actors. Everything is opaque, and its place in depth says
/// what covers what: that is crisper and faster than blending, and nothing depends on an order.
class LayoutActors {
   public:
    LayoutActors();
    ~LayoutActors();
    void add_to(vtkRenderer* renderer);

    void show_lens(const LensDrawing& drawing, const Palette& colors);
    void show_rays(const std::vector<RayFan>& fans, const Palette& colors);
    /// The dash-dotted axis keeps its look at every zoom, so it is redrawn for each.
    void show_axis(double z_from_mm, double z_to_mm, double mm_per_px, const Palette& colors);
    /// Line widths follow the display's scale.
    void set_pixel_ratio(double pixel_ratio);

   private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace ghostlight
