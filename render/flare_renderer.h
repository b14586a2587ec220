#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/flare/flare_image.h"
#include "render/gl_objects.h"
#include "render/picture_frame.h"

namespace ghostlight {

/// A picture on the graphics card, whoever made it: linear Rec.709 in sensor orientation (t grows
/// with y, s with x), and optionally the share of the highlighted ghosts in one channel.
struct PictureTexture {
    unsigned color = 0;
    unsigned highlight = 0;  ///< 0 = none
    int width_px = 0, height_px = 0;
    float highlight_floor = 0.0F;  ///< below this there is no highlighted ghost
    float highlight_mean = 1.0F;   ///< of the places above
};

/// The floor and the mean of a highlight, as PictureTexture has them.
struct HighlightScale {
    float floor = 0.0F, mean = 1.0F;
};
HighlightScale highlight_scale(const std::vector<float>& highlight);
/// How strongly the highlight's colour covers a place, 0 to 1; the shader has the same.
inline float highlight_tint(float own, const HighlightScale& scale) {
    return own > scale.floor ? 0.12F + 0.45F * own / (own + scale.mean) : 0.0F;
}

/// Uploads pictures made in memory.
class PictureUpload {
   public:
    /// Returns the time it took, ms. Throws Error.
    double upload(const FlareImage& image);
    const PictureTexture& texture() const { return texture_; }

   private:
    GlTexture color_, highlight_;
    PictureTexture texture_;
};

/// How a picture is shown.
struct PictureLook {
    double exposure_ev = 0.0;
    std::array<float, 3> surround{0.0F, 0.0F, 0.0F};      ///< sRGB, around the picture
    std::array<float, 3> highlight{0.22F, 0.71F, 0.79F};  ///< sRGB
    bool show_highlight = true;
};

/// Draws a float picture tone-mapped, upright and letter-boxed. Made with a current OpenGL 3.2
/// context, used and destroyed with it current. Throws Error instead of failing silently.
class FlareRenderer {
   public:
    FlareRenderer();

    /// Clears the framebuffer that is bound, viewport_width × viewport_height, to the surround, and
    /// draws the picture (if its colour texture is not 0) into the frame.
    void draw(const PictureTexture& picture, const PictureFrame& frame, const PictureLook& look,
              int viewport_width_px, int viewport_height_px);

   private:
    /// One program per way of drawing, made when first needed.
    const GlProgram& program(bool exact, bool highlight);

    std::array<std::optional<GlProgram>, 4> programs_;
    GlVertexArray vertices_;
};

}  // namespace ghostlight
