#include "render/gl_flare/level_targets.h"

#include <epoxy/gl.h>

namespace ghostlight {
namespace {

constexpr int fine_scale = 2;  // with linear filtering a look-up between four pixels averages them

void clear(GlFloatTarget& target, int width_px, int height_px) {
    target.resize(width_px, height_px);
    target.bind();
    glClear(GL_COLOR_BUFFER_BIT);
}

}  // namespace

void LevelTargets::begin(const PixelFrame& frame) {
    frame_ = frame;
    glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    clear(fine_, fine_scale * frame.width_px, fine_scale * frame.height_px);
    for (int l = 0; l < picture_levels; ++l) {
        const RasterSize size = level_size(frame, l);
        clear(levels_[static_cast<std::size_t>(l)], size.width_px, size.height_px);
    }
}

RasterSize LevelTargets::drawn_size(int level) const {
    if (level > 0) return level_size(frame_, level);
    return {fine_scale * frame_.width_px, fine_scale * frame_.height_px, fine_scale, 0};
}

void LevelTargets::bind(int level) const {
    (level == 0 ? fine_ : levels_[static_cast<std::size_t>(level)]).bind();
}

void LevelTargets::compose(const GlProgram& program, const GlVertexArray& vertices,
                           int coarsest) const {
    glUseProgram(program.name());
    glUniform1i(program.uniform("other"), 0);
    glActiveTexture(GL_TEXTURE0);
    glBindVertexArray(vertices.name());
    auto add = [&](const GlFloatTarget& other, float scale, int level, int other_margin_px) {
        levels_[static_cast<std::size_t>(level)].bind();
        glBindTexture(GL_TEXTURE_2D, other.texture());
        glUniform3f(program.uniform("other_from_own"), scale,
                    static_cast<float>(level_size(frame_, level).margin_px),
                    static_cast<float>(other_margin_px));
        glDrawArrays(GL_TRIANGLES, 0, 3);
    };
    for (int l = coarsest - 1; l >= 0; --l)
        add(levels_[static_cast<std::size_t>(l) + 1], 0.5F, l, level_size(frame_, l + 1).margin_px);
    add(fine_, fine_scale, 0, 0);
    glBindTexture(GL_TEXTURE_2D, 0);
}

}  // namespace ghostlight
