// Tone-maps the picture; with HIGHLIGHT, tints and outlines where the highlighted ghosts are; with
// EXACT, shows pixels as squares. Compiled apart, since a software rasteriser runs every branch.
uniform sampler2D color_map;
uniform float scale;  // 2^exposure
uniform int tone_curve;
uniform int mark_clipping;
uniform vec3 clipping_color;  // sRGB
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

#ifdef FALSE_COLOR
uniform vec2 decades;          // the scale's ends, log10 of irradiance
uniform vec3 false_colors[9];  // sRGB, evenly

vec3 shown_color(vec4 value) {
    float place = value.r > 0.0
        ? clamp((log(value.r) / log(10.0) - decades.x) / (decades.y - decades.x), 0.0, 1.0) : 0.0;
    float at = place * 8.0;
    int k = min(int(at), 7);
    return mix(false_colors[k], false_colors[k + 1], at - float(k));
}
#else
vec3 shown_color(vec4 value) {
    vec3 mapped = tone_mapped_by(value.rgb, scale, tone_curve);
    float largest = max(value.r, max(value.g, value.b)) * scale;
    bool striped = mod(gl_FragCoord.x + gl_FragCoord.y, 8.0) < 4.0;
    return mark_clipping != 0 && largest > 1.0 && striped ? clipping_color : mapped;
}
#endif

void main() {
    vec3 mapped = shown_color(fetched(color_map, sensor));
#ifdef HIGHLIGHT
    // By the ghosts' own scale, so that a faint one can be found among brighter ones.
    float own = fetched(highlight_map, sensor).r;
    float tint = own > highlight_floor ? 0.12 + 0.45 * own / (own + highlight_mean) : 0.0;
    mapped = mix(mapped, highlight_color, max(tint, 0.9 * outline(own)));
#endif
    shown = vec4(mapped, 1.0);
}
