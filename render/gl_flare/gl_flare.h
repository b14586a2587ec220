#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>

#include "core/flare/flare_image.h"
#include "core/flare/flare_scene.h"
#include "render/flare_renderer.h"
#include "render/gl_flare/flare_batch.h"
#include "render/gl_flare/gl_buffer.h"
#include "render/gl_flare/level_targets.h"
#include "render/gl_objects.h"

namespace ghostlight {

/// What an OpenGL context offers to GlFlare.
struct GlOffer {
    int version = 0;  ///< as epoxy counts: 43 is 4.3
    int vertex_storage_blocks = 0;
    int compute_storage_blocks = 0;
    std::int64_t storage_block_bytes = 0;
    std::string renderer;
};
/// Of the context that is current.
GlOffer gl_offer();
/// Throws Error saying why this context cannot draw flares, if it cannot.
void require_gl_flare(const GlOffer& offer);

/// What a picture on the graphics card was made of.
struct GlFlarePicture {
    PictureTexture texture;  ///< belongs to GlFlare; good until its next picture
    FlarePlan plan;
    FlareTimes times;  ///< raster_ms is all the graphics card's work where it was waited for
    std::size_t rays = 0, cells = 0;
};

/// Draws the ghost layer of a planned picture in OpenGL 4.3: rays are traced in compute shaders
/// from surfaces in a uniform block, sheets of cells are drawn additively in floats, each ghost at
/// the size that its plan chose. Made, used and destroyed with one context current. Throws Error
/// with the reason where it cannot: render_planned serves then.
class GlFlare {
   public:
    GlFlare();

    /// The picture as a texture (linear Rec.709 and irradiance, sensor orientation). The
    /// framebuffer and viewport that were bound are bound again afterwards. Nothing when stopped.
    std::optional<GlFlarePicture> draw_to_texture(const FlareScene& scene,
                                                  const FlareRequest& request,
                                                  std::stop_token stop = {});
    /// The same, read back. FlareImage::flux_mm2 is the plan's, from the probe.
    std::optional<FlareImage> render(const FlareScene& scene, const FlareRequest& request,
                                     std::stop_token stop = {});

   private:
    GlProgram trace_, place_, draw_, compose_;
    GlVertexArray sheets_array_, nothing_;
    GlBuffer lens_, aspheres_, bundles_, rays_, groups_, sheets_, nodes_, light_, skipped_,
        commands_, sheet_numbers_;
    std::size_t numbered_sheets_ = 0;
    LevelTargets picture_, highlight_;

    void trace(const FlareBatch& batch, const FlareDrawing& drawing, const OpticalSystem& system,
               float sensor_gap_mm);
    void place(const FlareBatch& batch, const FlareDrawing& drawing);
    void draw(const std::array<std::vector<DrawCommand>, picture_levels>& draws,
              const FlareDrawing& drawing, const LevelTargets& targets);
    void number_sheets(std::size_t count);
};

}  // namespace ghostlight
