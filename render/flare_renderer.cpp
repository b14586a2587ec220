#include "render/flare_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/flare/false_color.h"
#include "render_shaders.h"

namespace ghostlight {

namespace {

constexpr int least_gl_version = 32;            // as epoxy counts: 3.2
constexpr double exact_px_per_texel = 3.0;      // from here on pixels are shown as squares
constexpr float highlight_floor_share = 1e-4F;  // of the brightest: raster rounding is below

void require_size(const std::vector<float>& data, const FlareImage& image, std::size_t channels,
                  const char* what) {
    const auto wanted = static_cast<std::size_t>(std::max(image.width_px, 0)) *
                        static_cast<std::size_t>(std::max(image.height_px, 0)) * channels;
    if (data.size() != wanted) {
        throw Error({.problem = "the picture's data do not match its size",
                     .file = {},
                     .where = what,
                     .found = std::to_string(data.size()) + " values",
                     .expected = std::to_string(wanted)});
    }
}

}  // namespace

HighlightScale highlight_scale(const std::vector<float>& highlight) {
    HighlightScale scale{1e-30F, 1.0F};
    if (highlight.empty()) {
        return scale;
    }
    scale.floor = std::max(highlight_floor_share * *std::ranges::max_element(highlight), 1e-30F);
    double sum = 0.0;
    std::size_t lit = 0;
    for (const float own : highlight) {
        if (own > scale.floor) {
            sum += static_cast<double>(own);
            ++lit;
        }
    }
    scale.mean = lit > 0 ? static_cast<float>(sum / static_cast<double>(lit)) : 1.0F;
    return scale;
}

double PictureUpload::upload(const FlareImage& image) {
    const auto begin = std::chrono::steady_clock::now();
    require_size(image.rgb, image, 3, "rgb");
    color_.upload(image.width_px, image.height_px, 3, image.rgb.data());
    texture_ = {color_.name(), 0, image.width_px, image.height_px, 0.0F, 1.0F};
    upload_highlight(image);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    return took.count();
}

double PictureUpload::upload_irradiance(const FlareImage& image) {
    const auto begin = std::chrono::steady_clock::now();
    require_size(image.irradiance, image, 1, "irradiance");
    color_.upload(image.width_px, image.height_px, 1, image.irradiance.data());
    texture_ = {color_.name(), 0, image.width_px, image.height_px, 0.0F, 1.0F};
    upload_highlight(image);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    return took.count();
}

void PictureUpload::upload_highlight(const FlareImage& image) {
    if (image.highlight.empty()) {
        return;
    }
    require_size(image.highlight, image, 1, "highlight");
    highlight_.upload(image.width_px, image.height_px, 1, image.highlight.data());
    texture_.highlight = highlight_.name();
    const HighlightScale scale = highlight_scale(image.highlight);
    texture_.highlight_floor = scale.floor;
    texture_.highlight_mean = scale.mean;
}

std::array<float, 3> shown_color(const PictureLook& look, std::array<float, 3> linear,
                                 float irradiance) {
    return look.false_color
               ? false_color(log_place(irradiance, look.false_color->low, look.false_color->high))
               : tone_mapped(linear, look.exposure_ev, look.tone);
}

FlareRenderer::FlareRenderer() {
    if (epoxy_gl_version() < least_gl_version) {
        throw Error({.problem = "OpenGL is too old",
                     .file = {},
                     .where = {},
                     .found = std::to_string(epoxy_gl_version() / 10) + "." +
                              std::to_string(epoxy_gl_version() % 10),
                     .expected = "3.2 or newer"});
    }
    while (glGetError() != GL_NO_ERROR) {  // another's
    }
    program(false, false, false);
    vertices_.create();
    check_gl("preparing the flare view");
}

const GlProgram& FlareRenderer::program(bool exact, bool highlight, bool in_false_color) {
    std::optional<GlProgram>& made =
        programs_[(exact ? 1U : 0U) + (highlight ? 2U : 0U) + (in_false_color ? 4U : 0U)];
    if (!made) {
        std::string fragment = "#version 150\n";
        fragment += exact ? "#define EXACT\n" : "";
        fragment += highlight ? "#define HIGHLIGHT\n" : "";
        fragment += in_false_color ? "#define FALSE_COLOR\n" : "";
        fragment += shaders::picture_fragment;
        made.emplace(shaders::picture_vertex, fragment);
    }
    return *made;
}

void FlareRenderer::draw(const PictureTexture& picture, const PictureFrame& frame,
                         const PictureLook& look, int viewport_width_px, int viewport_height_px) {
    while (glGetError() != GL_NO_ERROR) {
    }
    // Every state this depends on is set: Qt's painter and VTK leave their own behind.
    glViewport(0, 0, viewport_width_px, viewport_height_px);
    for (const GLenum off :
         {GL_BLEND, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_CULL_FACE}) {
        glDisable(off);
    }
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    const int left_px = static_cast<int>(std::lround(look.from_share * viewport_width_px));
    if (left_px > 0) {
        glEnable(GL_SCISSOR_TEST);
        glScissor(left_px, 0, std::max(0, viewport_width_px - left_px), viewport_height_px);
    }
    glClearColor(look.surround[0], look.surround[1], look.surround[2], 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    if (picture.color == 0) {
        glDisable(GL_SCISSOR_TEST);
        check_gl("clearing the flare view");
        return;
    }

    const double width = viewport_width_px, height = viewport_height_px;
    const auto clip_x = [&](double px) { return static_cast<float>(2.0 * px / width - 1.0); };
    const auto clip_y = [&](double px) { return static_cast<float>(1.0 - 2.0 * px / height); };
    const bool highlight = look.show_highlight && picture.highlight != 0;
    const double px_per_texel = frame.width_px / std::max(picture.width_px, 1);
    const GlProgram& program_used =
        program(px_per_texel >= exact_px_per_texel, highlight, look.false_color.has_value());
    const auto uniform = [&](const char* name) { return program_used.uniform(name); };

    glUseProgram(program_used.name());
    glUniform4f(uniform("rectangle"), clip_x(frame.left_px), clip_y(frame.top_px + frame.height_px),
                clip_x(frame.left_px + frame.width_px), clip_y(frame.top_px));
    glUniform1f(uniform("scale"), static_cast<float>(std::exp2(look.exposure_ev)));
    glUniform1f(uniform("highlight_floor"), picture.highlight_floor);
    glUniform1f(uniform("highlight_mean"), picture.highlight_mean);
    glUniform3f(uniform("highlight_color"), look.highlight[0], look.highlight[1],
                look.highlight[2]);
    glUniform2f(uniform("outline_step"), static_cast<float>(1.0 / frame.width_px),
                static_cast<float>(1.0 / frame.height_px));
    glUniform1i(uniform("tone_curve"), static_cast<int>(look.tone));
    glUniform1i(uniform("mark_clipping"), look.mark_clipping ? 1 : 0);
    glUniform3f(uniform("clipping_color"), look.clipping[0], look.clipping[1], look.clipping[2]);
    if (look.false_color) {
        glUniform2f(uniform("decades"), look.false_color->low, look.false_color->high);
        glUniform3fv(uniform("false_colors"), static_cast<GLsizei>(false_color_steps),
                     false_colors.front().data());
    }
    glUniform1i(uniform("color_map"), 0);
    glUniform1i(uniform("highlight_map"), 1);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, highlight ? picture.highlight : picture.color);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, picture.color);
    glBindVertexArray(vertices_.name());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glBindVertexArray(0);
    glUseProgram(0);
    glDisable(GL_SCISSOR_TEST);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, 0);
    check_gl("drawing the flare");
}

}  // namespace ghostlight
