// Light of a triangle where it passes, with the share of the pixel that lies inside each edge by
// the edge's distance; or of a spot.
in vec4 light;
in vec4 stop01;
in vec4 stop2;
in vec2 spread;
flat in int crossings;
layout(location = 0) out vec4 added;

float inside(float clearance) {
    float slope = length(vec2(dFdx(clearance), dFdy(clearance)));
    return clamp(0.5 + clearance / max(slope, 1e-20), 0.0, 1.0);
}

void main() {
    float share = inside(stop2.z) * inside(stop2.w);
    if (crossings > 0) share *= inside(stop_margin(stop01.xy));
    if (crossings > 1) share *= inside(stop_margin(stop01.zw));
    if (crossings > 2) share *= inside(stop_margin(stop2.xy));
    if (share <= 0.0) discard;
    added = light * (share * exp(-0.5 * dot(spread, spread)));
}
