// Tone-maps the picture; tints and outlines where the highlighted ghosts are.
uniform sampler2D color_map;
uniform sampler2D highlight_map;
uniform float scale;             // 2^exposure
uniform bool exact;              // pixels as squares, for a picture much enlarged
uniform bool show_highlight;
uniform float highlight_floor;
uniform vec3 highlight_color;    // sRGB
uniform vec2 outline_step;       // one screen pixel, in texture coordinates
in vec2 sensor;
out vec4 shown;

vec4 fetched(sampler2D map, vec2 at) {
    if (!exact) {
        return texture(map, at);
    }
    ivec2 size = textureSize(map, 0);
    return texelFetch(map, clamp(ivec2(at * vec2(size)), ivec2(0), size - 1), 0);
}

float highlighted(vec2 at) { return texture(highlight_map, at).r; }

// How much the edge of a highlighted ghost runs through here: where it begins, or jumps.
float outline() {
    float here = max(highlighted(sensor), highlight_floor);
    float edge = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 direction = i == 0 ? vec2(1, 0) : i == 1 ? vec2(-1, 0) : i == 2 ? vec2(0, 1) : vec2(0, -1);
        float there = max(highlighted(sensor + direction * outline_step), highlight_floor);
        edge = max(edge, here > there ? 1.0 - there / here : 0.0);
    }
    return smoothstep(0.35, 0.75, edge);
}

void main() {
    vec3 linear = fetched(color_map, sensor).rgb;
    if (!show_highlight) {
        shown = vec4(tone_mapped(linear, scale), 1.0);
        return;
    }
    // The highlighted ghosts' own light, in the highlight's colour instead of its own.
    float own = fetched(highlight_map, sensor).r;
    vec3 tint = highlight_color / dot(highlight_color, vec3(0.2126, 0.7152, 0.0722));
    vec3 tinted = max(linear + 0.85 * own * (tint - 1.0), 0.0);
    vec3 mapped = tone_mapped(tinted, scale);
    float inside = own > highlight_floor ? 0.10 : 0.0;
    mapped = mix(mapped, highlight_color, max(inside, 0.9 * outline()));
    shown = vec4(mapped, 1.0);
}
