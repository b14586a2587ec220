// Tone-maps the picture; with HIGHLIGHT, tints and outlines where the highlighted ghosts are; with
// EXACT, shows pixels as squares. Compiled apart, since a software rasteriser runs every branch.
uniform sampler2D color_map;
uniform float scale;  // 2^exposure
in vec2 sensor;
out vec4 shown;

vec4 fetched(sampler2D map, vec2 at) {
#ifdef EXACT
    ivec2 size = textureSize(map, 0);
    return texelFetch(map, clamp(ivec2(at * vec2(size)), ivec2(0), size - 1), 0);
#else
    return texture(map, at);
#endif
}

#ifdef HIGHLIGHT
uniform sampler2D highlight_map;
uniform float highlight_floor;  // below this there is no highlighted ghost
uniform float highlight_mean;   // of the places above
uniform vec3 highlight_color;   // sRGB
uniform vec2 outline_step;      // one screen pixel, in texture coordinates

float neighbor(vec2 step) {
    return max(texture(highlight_map, sensor + step * outline_step).r, highlight_floor);
}

// How much the edge of a highlighted ghost runs through here: where it begins, or jumps.
float outline(float own) {
    float least = min(min(neighbor(vec2(1, 0)), neighbor(vec2(-1, 0))),
                      min(neighbor(vec2(0, 1)), neighbor(vec2(0, -1))));
    return smoothstep(0.35, 0.75, 1.0 - least / max(own, highlight_floor));
}
#endif

void main() {
    vec3 linear = fetched(color_map, sensor).rgb;
#ifdef HIGHLIGHT
    // By the ghosts' own scale, so that a faint one can be found among brighter ones.
    float own = fetched(highlight_map, sensor).r;
    float tint = own > highlight_floor ? 0.12 + 0.45 * own / (own + highlight_mean) : 0.0;
    vec3 mapped = mix(tone_mapped(linear, scale), highlight_color, max(tint, 0.9 * outline(own)));
#else
    vec3 mapped = tone_mapped(linear, scale);
#endif
    shown = vec4(mapped, 1.0);
}
