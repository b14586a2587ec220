#version 430
// Traces the rays of many bundles: the twin of core/optics/trace_steps.h and
// core/ghosts/bundle_kernel.cpp without weights; tests/render/gl_flare_test.cpp holds them together.
layout(local_size_x = 64) in;

// Two entries a surface: (curvature, conic, 1 / clear radius, z of the one before minus its own)
// and (index before, index after, first aspheric term, count of terms).
layout(std140, binding = 0) uniform Lens { vec4 surface[1024]; };
layout(std140, binding = 1) uniform Aspheres { vec4 term[1024]; };

struct Bundle {
    vec4 box;    // u and v of the first ray, and the steps between rays, mm
    ivec4 grid;  // rays a row, first ray, rays, first entry of the lens
    ivec4 path;  // the two surfaces that reflect, the stop, count of surfaces but the sensor
};
struct Ray {
    vec4 at;      // x, y on the sensor in mm; margin, negative where the ray fails; r_rel
    vec4 stop01;  // where it crosses the stop, mm
    vec4 stop2;
};
layout(std430, binding = 0) readonly buffer Bundles { Bundle bundles[]; };
layout(std430, binding = 1) writeonly buffer Rays { Ray rays[]; };
// Of each group of threads: its bundle, and its first ray within it.
layout(std430, binding = 2) readonly buffer Groups { uvec2 groups[]; };

uniform vec3 direction, e1, e2;  // of the beam
uniform float sensor_gap;        // last vertex z minus the sensor's, mm
uniform vec2 sensor_half;        // of its width and height, mm: it clips light that it reflects

float margin;
vec3 p, d;

// The least margin so far, or where the ray first failed.
void narrow(float next) { margin = margin < 0.0 ? margin : min(margin, next); }

// Sag, its slope over r^2, and 1 - (1+k) c^2 r^2.
vec3 sag_of(vec4 shape, int first, int count, float r2) {
    float domain = 1.0 - (1.0 + shape.y) * shape.x * shape.x * r2;
    float root = sqrt(max(domain, 0.0));
    float sag = shape.x * r2 / (1.0 + root);
    float slope = shape.x / (2.0 * max(root, 1e-6));
    float power = r2;
    for (int i = 0; i < count; ++i) {
        float a = term[(first + i) / 4][(first + i) % 4];
        slope += float(i + 2) * a * power;
        power *= r2;
        sag += a * power;
    }
    return vec3(sag, slope, domain);
}

void main() {
    uvec2 group = groups[gl_WorkGroupID.x];
    Bundle bundle = bundles[group.x];
    int k = int(group.y + gl_LocalInvocationID.x);
    if (k >= bundle.grid.z) return;
    float u = bundle.box.x + bundle.box.z * float(k % bundle.grid.x);
    float v = bundle.box.y + bundle.box.w * float(k / bundle.grid.x);

    Ray ray = Ray(vec4(0), vec4(0), vec4(0));
    p = u * e1 + v * e2;
    d = direction;
    margin = 1.0;
    float r2_rel = 0.0, sense = 1.0;
    int crossing = 0, turns = 0;
    int step = 1;
    for (int s = 0; s < bundle.path.w || (turns < 2 && s == bundle.path[turns]); s += step) {
        vec4 shape = surface[bundle.grid.w + 2 * s], media = surface[bundle.grid.w + 2 * s + 1];
        bool forward = step > 0;
        sense = forward ? 1.0 : -1.0;
        p.z += forward ? shape.w : -surface[bundle.grid.w + 2 * s + 2].w;
        narrow(sense * d.z);

        // From the foot of the perpendicular, so that floats keep their digits.
        vec3 foot = p - dot(p, d) * d;
        float c = shape.x, k1 = 1.0 + shape.y;
        float f = c * (foot.x * foot.x + foot.y * foot.y + k1 * foot.z * foot.z) - 2.0 * foot.z;
        float g = d.z - c * (foot.x * d.x + foot.y * d.y + k1 * foot.z * d.z);
        float miss = g * g - c * (1.0 + shape.y * d.z * d.z) * f;
        p = foot + f / (g + sense * sqrt(max(miss, 0.0))) * d;
        float hemisphere = 1.0 - k1 * c * p.z;
        vec3 normal = vec3(-c * p.x, -c * p.y, hemisphere);

        int count = int(media.w);
        if (count > 0) {
            int first = int(media.z);
            float clear = 1.0 / shape.z;
            vec3 sag = sag_of(shape, first, count, dot(p.xy, p.xy));
            for (int i = 0; i < 5; ++i) {
                float rate = d.z - 2.0 * sag.y * dot(p.xy, d.xy);
                if (abs(rate) < 1e-6) rate = 1.0;
                p += clamp((sag.x - p.z) / rate, -clear, clear) * d;
                sag = sag_of(shape, first, count, dot(p.xy, p.xy));
            }
            // What has not converged to a few roundings has no meeting.
            miss = abs(p.z - sag.x) <= 4e-5 * clear ? sag.z : -1.0;
            hemisphere = sag.z;
            normal = vec3(-2.0 * sag.y * p.xy, 1.0);
        }
        narrow(min(miss, hemisphere));
        normal = normalize(normal);
        if (dot(normal, d) < 0.0) normal = -normal;
        float cos1 = min(1.0, dot(normal, d));

        if (s == bundle.path.z) {
            if (crossing == 0) ray.stop01.xy = p.xy;
            if (crossing == 1) ray.stop01.zw = p.xy;
            if (crossing == 2) ray.stop2.xy = p.xy;
            ++crossing;
        } else if (s == bundle.path.w) {
            vec2 rel = p.xy / sensor_half;
            r2_rel = max(r2_rel, max(rel.x * rel.x, rel.y * rel.y));
        } else {
            r2_rel = max(r2_rel, dot(p.xy, p.xy) * shape.z * shape.z);
        }
        bool reflects = turns < 2 && s == bundle.path[turns];
        float eta = forward ? media.x / media.y : media.y / media.x;
        if (reflects) {
            d -= 2.0 * cos1 * normal;
            ++turns;
            step = -step;
        } else if (media.x != media.y) {
            float cos2_squared = 1.0 - eta * eta * (1.0 - cos1 * cos1);
            narrow(cos2_squared);
            d = eta * d + (sqrt(max(cos2_squared, 0.0)) - eta * cos1) * normal;
        }
        d *= 1.5 - 0.5 * dot(d, d);
    }
    narrow(d.z);
    vec2 landed = p.xy - (p.z + sensor_gap) / d.z * d.xy;
    float r_rel = sqrt(r2_rel);
    float check = landed.x + landed.y + r_rel;
    // What went wild must not reach any sum.
    if (isnan(check) || isinf(check)) {
        landed = vec2(0);
        margin = min(margin, -1e-3);
        r_rel = 2.0;
    }
    ray.at = vec4(landed, margin, r_rel);
    rays[bundle.grid.y + k] = ray;
}
