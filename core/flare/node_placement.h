#pragma once

#include <cstddef>

#include "core/flare/color_mesh.h"
#include "core/flare/ghost_mesh.h"
#include "core/ghosts/mirror_grid.h"
#include "core/optics/optical_system.h"
#include "core/optics/trace.h"

namespace ghostlight {

/// Takes grids traced with the field in the y–z plane to where they land on the picture: turned by
/// the light's azimuth, in pixels, with the clearances of every edge that clips them.
class NodePlacement {
   public:
    /// The frame must outlive this.
    NodePlacement(const OpticalSystem& system, const LightDirection& light,
                  const PixelFrame& frame);

    MeshNodes place(const MirrorGrid& grid) const;
    /// A square of `cells` × `cells` whose rays lie row by row from `first` on; `mirror` is −1 for
    /// its mirror image.
    MeshNodes place(const Bundle<float>& rays, std::size_t first, int cells, double cell_area_mm2,
                    float mirror) const;

    const PixelFrame& frame() const { return frame_; }
    /// The stop, turned against the light's azimuth.
    const StopMask& stop_mask() const { return stop_mask_; }
    double cos_azimuth() const { return cos_azimuth_; }
    double sin_azimuth() const { return sin_azimuth_; }

   private:
    const PixelFrame& frame_;
    StopMask stop_mask_;
    double cos_azimuth_, sin_azimuth_;

    template <class RayOf>
    MeshNodes place(const Bundle<float>& rays, int cells, double cell_area_mm2, RayOf ray_of) const;
};

}  // namespace ghostlight
