#pragma once

#include <QColor>

#include <memory>
#include <vector>

#include "widgets/layout_scene.h"
#include "widgets/ray_fan.h"

class vtkRenderer;

namespace ghostlight {

struct Palette;

/// Low index blue-grey, high index green-grey, over the panel's ground.
QColor glass_tint(double n, const Palette& colors);
/// Whether several ghosts are drawn: then each has its own colour.
bool is_many(const std::vector<RayFan>& fans);
/// A stretch's colour: by leg alone for one ghost, by ghost and then by leg for many, by field for
/// direct rays.
QColor ray_color(const RayFan& fan, RayLeg leg, bool many, const Palette& colors);

/// Turns a drawing and its rays into VTK actors. Everything is opaque, and its place in depth says
/// what covers what: that is crisper and faster than blending, and nothing depends on an order.
class LayoutActors {
   public:
    LayoutActors();
    ~LayoutActors();
    void add_to(vtkRenderer* renderer);

    void show_lens(const LensDrawing& drawing, const Palette& colors);
    /// `walk`: the share of each ray's way that is shown.
    void show_rays(const std::vector<RayFan>& fans, const Palette& colors, double walk = 1.0);
    /// The dash-dotted axis keeps its look at every zoom, so it is redrawn for each.
    void show_axis(double z_from_mm, double z_to_mm, double mm_per_px, const Palette& colors);
    /// Line widths follow the display's scale.
    void set_pixel_ratio(double pixel_ratio);

   private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace ghostlight
