#include "render/gl_flare/gl_flare.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "render_shaders.h"

namespace ghostlight {
namespace {

using Clock = std::chrono::steady_clock;
double ms_since(Clock::time_point began) {
    return std::chrono::duration<double, std::milli>(Clock::now() - began).count();
}

constexpr int least_gl_version = 43;  // compute shaders, storage blocks, indirect draws
constexpr int vertex_blocks = 3, compute_blocks = 5;
/// The finest grid of a ghost in the most bands takes 97 MiB of nodes.
constexpr std::int64_t least_block_bytes = std::int64_t{1} << 27;
/// A crossing of the stop may be moved so far by the curvature of its map, over the stop's
/// semi-diameter: beyond this a second difference is a kink.
constexpr double most_straightened = 0.05;

enum StorageBlock : unsigned {
    bundles_at,
    rays_at,
    groups_at,
    sheets_at,
    nodes_at,
    light_at,
    skipped_at
};

/// What others have bound, put back at the end.
class KeptTarget {
   public:
    KeptTarget() {
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
        glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
        glGetIntegerv(GL_VIEWPORT, viewport_);
    }
    ~KeptTarget() {
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_));
        glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_));
        glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    }
    KeptTarget(const KeptTarget&) = delete;
    KeptTarget& operator=(const KeptTarget&) = delete;

   private:
    GLint draw_ = 0, read_ = 0, viewport_[4] = {};
};

void set_vec3(const GlProgram& program, const char* name, const glm::dvec3& v) {
    glUniform3f(program.uniform(name), static_cast<float>(v.x), static_cast<float>(v.y),
                static_cast<float>(v.z));
}

void dispatch(std::size_t groups) {
    if (groups > 0) glDispatchCompute(static_cast<GLuint>(groups), 1, 1);
}

/// The plan traces half of each beam, turned into the y–z plane, about which the rectangle of a
/// sensor that reflects has to be symmetric (render_flare() takes the method `uniform` then).
void require_planned(const FlareScene& scene, const FlareRequest& request) {
    if (scene.system().stop_mask.picture)
        throw Error({.problem = "an image in the stop is not drawn in OpenGL",
                     .file = {},
                     .where = "stop.image",
                     .found = {},
                     .expected = "a stop of blades"});
    if (!scene.system().sensor_face ||
        std::abs(std::fmod(request.light.azimuth_deg, 180.0)) == 90.0)
        return;
    throw Error({.problem = "a sensor that reflects is not drawn in OpenGL for light beside the "
                            "vertical plane",
                 .file = {},
                 .where = "azimuth",
                 .found = std::to_string(request.light.azimuth_deg),
                 .expected = "90 or -90"});
}

std::string version_name(int version) {
    return std::to_string(version / 10) + "." + std::to_string(version % 10);
}

}  // namespace

GlOffer gl_offer() {
    GlOffer offer;
    offer.version = epoxy_gl_version();
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    offer.renderer = renderer != nullptr ? renderer : "";
    if (offer.version >= least_gl_version) {
        glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &offer.vertex_storage_blocks);
        glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &offer.compute_storage_blocks);
        GLint64 bytes = 0;
        glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
        offer.storage_block_bytes = bytes;
    }
    return offer;
}

void require_gl_flare(const GlOffer& offer) {
    if (offer.version == 0) throw Error("no OpenGL context is current");
    if (offer.version < least_gl_version)
        throw Error({.problem = "OpenGL is too old to draw flares",
                     .file = {},
                     .where = offer.renderer,
                     .found = version_name(offer.version),
                     .expected = version_name(least_gl_version) + " or newer"});
    if (offer.vertex_storage_blocks < vertex_blocks)
        throw Error({.problem = "OpenGL cannot read traced rays where it draws",
                     .file = {},
                     .where = offer.renderer,
                     .found = std::to_string(offer.vertex_storage_blocks) +
                              " storage blocks in vertex shaders",
                     .expected = std::to_string(vertex_blocks)});
    if (offer.compute_storage_blocks < compute_blocks)
        throw Error({.problem = "OpenGL has too few storage blocks to trace",
                     .file = {},
                     .where = offer.renderer,
                     .found = std::to_string(offer.compute_storage_blocks),
                     .expected = std::to_string(compute_blocks)});
    if (offer.storage_block_bytes < least_block_bytes)
        throw Error({.problem = "OpenGL's storage blocks are too small for a ghost's rays",
                     .file = {},
                     .where = offer.renderer,
                     .found = std::to_string(offer.storage_block_bytes) + " bytes",
                     .expected = std::to_string(least_block_bytes)});
}

GlFlare::GlFlare() {
    require_gl_flare(gl_offer());
    while (glGetError() != GL_NO_ERROR) {  // another's
    }
    trace_ = GlProgram(shaders::trace_compute);
    place_ = GlProgram(shaders::place_compute);
    draw_ = GlProgram(shaders::ghost_vertex, shaders::ghost_fragment);
    compose_ = GlProgram(shaders::screen_vertex, shaders::compose_fragment);
    sheets_array_.create();
    nothing_.create();
    check_gl("preparing the flare engine");
}

void GlFlare::number_sheets(std::size_t count) {
    if (count <= numbered_sheets_) return;
    numbered_sheets_ = 2 * count;
    std::vector<std::uint32_t> numbers(numbered_sheets_);
    std::iota(numbers.begin(), numbers.end(), 0U);
    sheet_numbers_.upload(numbers);
    glBindVertexArray(sheets_array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, sheet_numbers_.name());
    glVertexAttribIPointer(0, 1, GL_UNSIGNED_INT, 0, nullptr);
    glVertexAttribDivisor(0, 1);
    glEnableVertexAttribArray(0);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void GlFlare::trace(const FlareBatch& batch, const FlareDrawing& drawing,
                    const OpticalSystem& system, float sensor_gap_mm) {
    bundles_.upload(batch.bundles);
    groups_.upload(batch.bundle_groups);
    rays_.reserve(batch.rays * ray_bytes);
    lens_.bind_uniform(0);
    aspheres_.bind_uniform(1);
    bundles_.bind_storage(bundles_at);
    rays_.bind_storage(rays_at);
    groups_.bind_storage(groups_at);
    glUseProgram(trace_.name());
    set_vec3(trace_, "direction", drawing.beam.direction);
    set_vec3(trace_, "e1", drawing.beam.e1);
    set_vec3(trace_, "e2", drawing.beam.e2);
    glUniform1f(trace_.uniform("sensor_gap"), sensor_gap_mm);
    glUniform2f(trace_.uniform("sensor_half"), static_cast<float>(0.5 * system.sensor_width_mm),
                static_cast<float>(0.5 * system.sensor_height_mm));
    dispatch(batch.bundle_groups.size());
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void GlFlare::place(const FlareBatch& batch, const FlareDrawing& drawing) {
    sheets_.upload(batch.sheets);
    groups_.upload(batch.sheet_groups);
    light_.upload(batch.light);
    skipped_.upload(batch.skipped);
    nodes_.reserve(batch.nodes * node_bytes);
    rays_.bind_storage(rays_at);
    groups_.bind_storage(groups_at);
    sheets_.bind_storage(sheets_at);
    nodes_.bind_storage(nodes_at);
    light_.bind_storage(light_at);
    glUseProgram(place_.name());
    const PixelFrame& frame = drawing.frame;
    const double pitch = frame.pitch_mm;
    glUniform2f(place_.uniform("turn"), static_cast<float>(drawing.cos_azimuth / pitch),
                static_cast<float>(drawing.sin_azimuth / pitch));
    glUniform2f(place_.uniform("corner"), static_cast<float>(-frame.left_mm / pitch),
                static_cast<float>(-frame.bottom_mm / pitch));
    glUniform1f(place_.uniform("most_stop_mm"),
                static_cast<float>(most_straightened * drawing.stop_mask.semi_diameter_mm));
    dispatch(batch.sheet_groups.size());
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void GlFlare::draw(const std::array<std::vector<DrawCommand>, picture_levels>& draws,
                   const FlareDrawing& drawing, const LevelTargets& targets) {
    std::vector<DrawCommand> all;
    for (const auto& level : draws) all.insert(all.end(), level.begin(), level.end());
    if (all.empty()) return;
    commands_.upload(all);
    sheets_.bind_storage(sheets_at);
    nodes_.bind_storage(nodes_at);
    skipped_.bind_storage(skipped_at);
    glUseProgram(draw_.name());
    const StopMask& mask = drawing.stop_mask;
    glUniform4f(draw_.uniform("stop_mask"), static_cast<float>(mask.semi_diameter_mm),
                static_cast<float>(mask.blades), static_cast<float>(mask.rotation_rad),
                static_cast<float>(mask.blade_curvature));
    glBindVertexArray(sheets_array_.name());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.name());
    std::size_t first = 0;
    for (int level = 0; level < picture_levels; ++level) {
        const auto& own = draws[static_cast<std::size_t>(level)];
        if (own.empty()) continue;
        const RasterSize size = targets.drawn_size(level);
        targets.bind(level);
        glUniform4f(draw_.uniform("target"), static_cast<float>(size.scale),
                    static_cast<float>(size.margin_px), static_cast<float>(size.width_px),
                    static_cast<float>(size.height_px));
        glMultiDrawArraysIndirect(GL_TRIANGLES,
                                  reinterpret_cast<const void*>(first * sizeof(DrawCommand)),
                                  static_cast<GLsizei>(own.size()), 0);
        first += own.size();
    }
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    glBindVertexArray(0);
}

std::optional<GlFlarePicture> GlFlare::draw_to_texture(const FlareScene& scene,
                                                       const FlareRequest& request,
                                                       std::stop_token stop) {
    const auto began = Clock::now();
    require_planned(scene, request);
    const auto drawing = plan_drawing(scene, request, stop);
    if (!drawing) return std::nullopt;
    GlFlarePicture picture;
    picture.plan = drawing->plan;
    picture.times.bounds_ms = drawing->planning_ms;
    const LensBlock lens = lens_block(scene);
    const auto batches = flare_batches(scene, *drawing, lens, request.highlighted);

    while (glGetError() != GL_NO_ERROR) {  // another's
    }
    const KeptTarget kept;
    for (const GLenum off : {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_CULL_FACE})
        glDisable(off);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    lens_.upload(lens.surfaces);
    aspheres_.upload(lens.aspheric_terms);
    picture_.begin(drawing->frame);
    const bool highlights = !request.highlighted.empty();
    if (highlights) highlight_.begin(drawing->frame);
    int coarsest = 0;
    for (const FlareBatch& batch : batches) {
        if (stop.stop_requested()) break;
        number_sheets(batch.sheets.size());
        trace(batch, *drawing, scene.system(), lens.sensor_gap_mm);
        place(batch, *drawing);
        draw(batch.draws, *drawing, picture_);
        if (highlights) draw(batch.highlighted, *drawing, highlight_);
        for (int level = 0; level < picture_levels; ++level)
            if (!batch.draws[static_cast<std::size_t>(level)].empty())
                coarsest = std::max(coarsest, level);
        picture.rays += batch.rays;
        picture.cells += batch.cells;
    }
    picture_.compose(compose_, nothing_, coarsest);
    if (highlights) highlight_.compose(compose_, nothing_, coarsest);
    glDisable(GL_BLEND);
    glBindVertexArray(0);
    glUseProgram(0);
    check_gl("drawing the flare");
    if (stop.stop_requested()) return std::nullopt;
    picture.texture.color = picture_.full().texture();
    picture.texture.width_px = drawing->frame.width_px;
    picture.texture.height_px = drawing->frame.height_px;
    if (highlights) {
        const std::vector<float> values = highlight_.full().read();
        std::vector<float> share(values.size() / 4);
        for (std::size_t i = 0; i < share.size(); ++i) share[i] = values[4 * i + 3];
        const HighlightScale scale = highlight_scale(share);
        picture.texture.highlight = highlight_.full().texture();
        picture.texture.highlight_floor = scale.floor;
        picture.texture.highlight_mean = scale.mean;
        // Its readers look for the irradiance in the first channel.
        glBindTexture(GL_TEXTURE_2D, picture.texture.highlight);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_R, GL_ALPHA);
        glBindTexture(GL_TEXTURE_2D, 0);
    }
    picture.times.total_ms = ms_since(began);
    picture.times.raster_ms = picture.times.total_ms - picture.times.bounds_ms;
    return picture;
}

std::optional<FlareImage> GlFlare::render(const FlareScene& scene, const FlareRequest& request,
                                          std::stop_token stop) {
    const auto began = Clock::now();
    auto picture = draw_to_texture(scene, request, std::move(stop));
    if (!picture) return std::nullopt;
    const KeptTarget kept;
    FlareImage image;
    image.width_px = picture->texture.width_px;
    image.height_px = picture->texture.height_px;
    image.sensor_width_mm = scene.system().sensor_width_mm;
    image.sensor_height_mm = scene.system().sensor_height_mm;
    const std::vector<float> values = picture_.full().read();
    const std::size_t count = values.size() / 4;
    image.rgb.resize(3 * count);
    image.irradiance.resize(count);
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        std::copy_n(&values[4 * i], 3, &image.rgb[3 * i]);
        image.irradiance[i] = values[4 * i + 3];
        sum += static_cast<double>(image.irradiance[i]);
    }
    if (picture->texture.highlight != 0) {
        const std::vector<float> own = highlight_.full().read();
        image.highlight.resize(count);
        for (std::size_t i = 0; i < count; ++i) image.highlight[i] = own[4 * i + 3];
    }
    const double pitch = image.sensor_width_mm / image.width_px;
    image.flux_on_sensor_mm2 = sum * pitch * pitch;
    image.flux_mm2 = picture->plan.flux_mm2;
    image.ghosts = scene.ghosts.size();
    image.rays = picture->rays;
    image.cells = picture->cells;
    image.times = picture->times;
    image.times.total_ms = ms_since(began);
    image.times.raster_ms = image.times.total_ms - image.times.bounds_ms;
    image.plan = std::move(picture->plan);
    return image;
}

}  // namespace ghostlight
