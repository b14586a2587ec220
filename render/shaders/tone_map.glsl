// The twin of core/flare/tone_map.cpp; tests/render/flare_renderer_test.cpp holds them together.
const float tone_shoulder = 0.8;

vec3 srgb_encoded(vec3 linear) {
    vec3 low = 12.92 * linear;
    vec3 high = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThanEqual(linear, vec3(0.0031308)));
}

vec3 tone_mapped(vec3 linear, float scale) {
    const float rest = 1.0 - tone_shoulder;
    vec3 scaled = clamp(linear * scale, 0.0, 1e30);
    float largest = max(scaled.r, max(scaled.g, scaled.b));
    float mapped = min(largest, tone_shoulder) +
                   rest * (1.0 - exp(-max(largest - tone_shoulder, 0.0) / rest));
    return srgb_encoded(scaled * (mapped / max(largest, 1e-30)));
}

vec3 srgb_decoded(vec3 encoded) {
    return mix(pow((encoded + 0.055) / 1.055, vec3(2.4)), encoded / 12.92,
               lessThanEqual(encoded, vec3(0.04045)));
}

const float tone_stops = 8.0;

// 0: the above, 1: linear, 2: logarithmic.
vec3 tone_mapped_by(vec3 linear, float scale, int curve) {
    if (curve == 0) return tone_mapped(linear, scale);
    vec3 scaled = clamp(linear * scale, 0.0, 1e30);
    float largest = max(max(scaled.r, max(scaled.g, scaled.b)), 1e-30);
    float mapped = curve == 1
        ? min(largest, 1.0)
        : srgb_decoded(vec3(clamp(1.0 + log2(largest) / tone_stops, 0.0, 1.0))).r;
    return srgb_encoded(scaled * (mapped / largest));
}
