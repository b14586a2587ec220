#version 430
// Adds another level of the picture by linear interpolation: the twin of add_coarser_rows().
uniform sampler2D other;
uniform vec3 other_from_own;  // scale, and the margins of this level and the other, px
layout(location = 0) out vec4 added;

void main() {
    vec2 at = other_from_own.x * (gl_FragCoord.xy - other_from_own.y) + other_from_own.z;
    added = texture(other, at / vec2(textureSize(other, 0)));
}
