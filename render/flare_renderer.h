#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/flare/flare_image.h"
#include "core/flare/tone_map.h"
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
    /// The irradiance instead of colours.
    double upload_irradiance(const FlareImage& image);
    const PictureTexture& texture() const { return texture_; }

   private:
    void upload_highlight(const FlareImage& image);

    GlTexture color_, highlight_;
    PictureTexture texture_;
};

/// How a picture is shown.
struct PictureLook {
    double exposure_ev = 0.0;
    std::array<float, 3> surround{0.0F, 0.0F, 0.0F};      ///< sRGB, around the picture
    std::array<float, 3> highlight{0.22F, 0.71F, 0.79F};  ///< sRGB
    bool show_highlight = true;
    ToneCurve tone = ToneCurve::soft;
    bool mark_clipping = false;                         ///< stripes where a channel is beyond white
    std::array<float, 3> clipping{1.0F, 0.48F, 0.35F};  ///< sRGB
    /// Irradiance in false colours, between these powers of ten, in place of all the above but
    /// the highlight. The texture then holds the irradiance.
    struct Decades {
        float low = -6.0F, high = 0.0F;
        bool operator==(const Decades&) const = default;
    };
    std::optional<Decades> false_color = {};
    /// Only the part of the viewport right of this share of its width; the rest is left as it is.
    double from_share = 0.0;
    bool operator==(const PictureLook&) const = default;
};
/// sRGB of a place of the picture, without highlight and stripes, as the shader has it.
std::array<float, 3> shown_color(const PictureLook& look, std::array<float, 3> linear,
                                 float irradiance);

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
    const GlProgram& program(bool exact, bool highlight, bool false_color);

    std::array<std::optional<GlProgram>, 8> programs_;
    GlVertexArray vertices_;
};

}  // namespace ghostlight
