// The twin of core/flare/tone_map.cpp; tests/render/flare_renderer_test.cpp holds them together.

vec3 srgb_encoded(vec3 linear) {
    vec3 low = 12.92 * linear;
    vec3 high = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThanEqual(linear, vec3(0.0031308)));
}

vec3 shouldered(vec3 linear) {
    const float knee = 0.8;
    float brightest = max(linear.r, max(linear.g, linear.b));
    if (brightest <= knee) {
        return linear;
    }
    float room = 1.0 - knee;
    float compressed = knee + room * (1.0 - exp(-(brightest - knee) / room));
    return linear * (compressed / brightest);
}

vec3 tone_mapped(vec3 linear, float scale) {
    return srgb_encoded(shouldered(max(linear * scale, 0.0)));
}
