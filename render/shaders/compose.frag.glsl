#version 430
// Brings a coarser level up by linear interpolation: the twin of add_coarser_rows().
uniform sampler2D coarser;
uniform vec2 margins;  // of the finer and the coarser level, px
layout(location = 0) out vec4 added;

void main() {
    vec2 at = 0.5 * (gl_FragCoord.xy - margins.x) + margins.y;
    added = texture(coarser, at / vec2(textureSize(coarser, 0)));
}
