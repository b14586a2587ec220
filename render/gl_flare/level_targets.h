#pragma once

#include <array>

#include "core/flare/picture_levels.h"
#include "render/gl_flare/gl_buffer.h"
#include "render/gl_objects.h"

namespace ghostlight {

/// A picture at full size and at halved sizes on the graphics card, see
/// core/flare/picture_levels.h.
class LevelTargets {
   public:
    /// Black pictures for a frame. Throws Error.
    void begin(const PixelFrame& frame);
    /// Where a level is drawn.
    RasterSize drawn_size(int level) const;
    /// Draws go to this level from now on, and add.
    void bind(int level) const;
    /// Adds the levels up, from the coarsest of those that were drawn to.
    void compose(const GlProgram& program, const GlVertexArray& vertices, int coarsest) const;
    const GlFloatTarget& full() const { return levels_[0]; }

   private:
    PixelFrame frame_;
    GlFloatTarget fine_;
    std::array<GlFloatTarget, picture_levels> levels_;
};

}  // namespace ghostlight
