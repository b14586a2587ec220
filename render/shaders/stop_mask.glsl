// The twin of stop_margin() of core/optics/trace.cpp: positive inside the stop, over its
// semi-diameter, and linear along the radius of a round one. Of a polygon the edge that is nearest.
uniform vec4 stop_mask;  // semi-diameter in mm, blades, rotation, curvature of the blades

float stop_margin(vec2 at) {
    float a = stop_mask.x;
    if (stop_mask.y < 3.0) return 1.0 - length(at) / a;
    float half_angle = 3.14159265358979 / stop_mask.y;
    float turned = atan(at.y, at.x) - stop_mask.z;
    float middle = stop_mask.z + half_angle * (2.0 * floor(turned / (2.0 * half_angle)) + 1.0);
    vec2 normal = vec2(cos(middle), sin(middle));
    if (stop_mask.w <= 0.0) return cos(half_angle) - dot(at, normal) / a;
    float radius = a / stop_mask.w;
    float chord = a * sin(half_angle);
    float back = sqrt(radius * radius - chord * chord) - a * cos(half_angle);
    return (radius - length(at + back * normal)) / a;
}
