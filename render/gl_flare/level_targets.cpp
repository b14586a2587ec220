#include "render/gl_flare/level_targets.h"

#include <epoxy/gl.h>

namespace ghostlight {

void LevelTargets::begin(const PixelFrame& frame) {
    frame_ = frame;
    glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    for (int l = 0; l < picture_levels; ++l) {
        const RasterSize size = level_size(frame, l);
        GlFloatTarget& target = levels_[static_cast<std::size_t>(l)];
        target.resize(size.width_px, size.height_px);
        target.bind();
        glClear(GL_COLOR_BUFFER_BIT);
    }
}

void LevelTargets::bind(int level) const { levels_[static_cast<std::size_t>(level)].bind(); }

void LevelTargets::compose(const GlProgram& program, const GlVertexArray& vertices,
                           int coarsest) const {
    glUseProgram(program.name());
    glUniform1i(program.uniform("coarser"), 0);
    glActiveTexture(GL_TEXTURE0);
    glBindVertexArray(vertices.name());
    for (int l = coarsest - 1; l >= 0; --l) {
        bind(l);
        glBindTexture(GL_TEXTURE_2D, level(l + 1).texture());
        glUniform2f(program.uniform("margins"), static_cast<float>(level_size(frame_, l).margin_px),
                    static_cast<float>(level_size(frame_, l + 1).margin_px));
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    glBindTexture(GL_TEXTURE_2D, 0);
}

}  // namespace ghostlight
