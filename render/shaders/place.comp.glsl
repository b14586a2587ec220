#version 430
// From rays of half grids at the geometry wavelengths to nodes of full grids in the picture, a
// sheet for each band of a ghost's spectrum: the twin of GhostPlanner::place and at_wavelength.
layout(local_size_x = 64) in;

struct Ray {
    vec4 at, stop01, stop2;  // see trace.comp.glsl
};
struct Sheet {
    ivec4 grid;   // cells across, first node, cells of the light's grid, its first node
    ivec4 rays;   // first ray at each geometry wavelength; how many of them there are
    vec4 shares;  // of these in the sheet's positions; cell area over a pixel's
    // Which one is the main wavelength, and crossings of the stop; the column of nodes that the first
    // column of rays is for, those before being mirror images of those behind; the first bit of
    // cells that are skipped, or -1. A sheet with no column mirrored and 1 in shares.y is a mirror
    // image as a whole.
    ivec4 more;
};
struct Node {
    vec4 at;      // in full-size pixels; margin; 1 - r_rel
    vec4 stop01;  // crossings of the stop, mm
    vec4 stop2;   // the third; entrance area over picture area
    vec4 light;
};
layout(std430, binding = 1) readonly buffer Rays { Ray rays[]; };
layout(std430, binding = 2) readonly buffer Groups { uvec2 groups[]; };
layout(std430, binding = 3) readonly buffer Sheets { Sheet sheets[]; };
layout(std430, binding = 4) writeonly buffer Nodes { Node nodes[]; };
layout(std430, binding = 5) readonly buffer Light { vec4 lights[]; };

uniform vec2 turn;           // cosine and sine of the azimuth, over the pixel's pitch
uniform vec2 corner;         // of the picture, px
uniform float most_stop_mm;  // that a curvature may move a crossing of the stop

Sheet sheet;

Ray ray_at(int i, int j) {
    int middle = sheet.more.z, across = sheet.grid.x - middle + 1;
    int k = j * across + abs(i - middle);
    Ray main_ray = rays[sheet.rays[sheet.more.x] + k];
    if (sheet.rays.w > 1) {
        // Where a colour fails nothing can be interpolated: the main one stands for it.
        Ray mixed = Ray(vec4(0), vec4(0), vec4(0));
        bool valid = true;
        for (int g = 0; g < sheet.rays.w; ++g) {
            Ray one = rays[sheet.rays[g] + k];
            valid = valid && one.at.z >= 0.0;
            mixed.at += sheet.shares[g] * one.at;
            mixed.stop01 += sheet.shares[g] * one.stop01;
            mixed.stop2 += sheet.shares[g] * one.stop2;
        }
        if (valid) {
            mixed.at.z = main_ray.at.z;
            main_ray = mixed;
        }
    }
    if (i < middle || (middle == 0 && sheet.shares.y == 1.0)) {
        main_ray.at.x = -main_ray.at.x;
        main_ray.stop01.xz = -main_ray.stop01.xz;
        main_ray.stop2.x = -main_ray.stop2.x;
    }
    return main_ray;
}

vec2 pixel_of(Ray ray) {
    return vec2(turn.x * ray.at.x - turn.y * ray.at.y, turn.y * ray.at.x + turn.x * ray.at.y) +
           corner;
}

float cross_of(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// Over a cell a function with second differences D lies above its linear interpolation by -D/12.
void straighten(ivec2 at, ivec2 step, inout Ray own) {
    Ray low = ray_at(at.x - step.x, at.y - step.y), middle = ray_at(at.x, at.y),
        high = ray_at(at.x + step.x, at.y + step.y);
    own.at.w -= clamp((low.at.w - 2.0 * middle.at.w + high.at.w) / 12.0, -0.05, 0.05);
    own.stop01 -= clamp((low.stop01 - 2.0 * middle.stop01 + high.stop01) / 12.0, -most_stop_mm,
                        most_stop_mm);
    own.stop2 -= clamp((low.stop2 - 2.0 * middle.stop2 + high.stop2) / 12.0, -most_stop_mm,
                       most_stop_mm);
}

void main() {
    uvec2 group = groups[gl_WorkGroupID.x];
    sheet = sheets[group.x];
    int k = int(group.y + gl_LocalInvocationID.x);
    int cells = sheet.grid.x, side = cells + 1;
    if (k >= side * side) return;
    int i = k % side, j = k / side;
    Ray ray = ray_at(i, j);

    // Both areas summed over the cells about the node.
    vec2 around[9];
    bool valid[9];
    for (int n = 0; n < 9; ++n) {
        int a = i + n % 3 - 1, b = j + n / 3 - 1;
        bool exists = a >= 0 && b >= 0 && a <= cells && b <= cells;
        Ray other = ray_at(exists ? a : i, exists ? b : j);
        around[n] = pixel_of(other);
        valid[n] = exists && other.at.z >= 0.0;
    }
    float area = 0.0, count = 0.0;
    for (int n = 0; n < 4; ++n) {
        int a = n % 2 + 3 * (n / 2);
        if (!(valid[a] && valid[a + 1] && valid[a + 3] && valid[a + 4])) continue;
        vec2 across = around[a + 1] - around[a + 3];
        area += 0.5 * (abs(cross_of(around[a] - around[a + 3], across)) +
                       abs(cross_of(around[a + 4] - around[a + 3], across)));
        count += 1.0;
    }
    vec2 at = pixel_of(ray);
    straighten(ivec2(clamp(i, 1, cells - 1), j), ivec2(1, 0), ray);
    straighten(ivec2(i, clamp(j, 1, cells - 1)), ivec2(0, 1), ray);

    // Light from its own grid.
    int from = sheet.grid.z, middle = sheet.more.z > 0 ? from / 2 : 0, half_side = from - middle + 1;
    float y = float(j * from) / float(cells);
    float x = abs(float(i * from) / float(cells) - float(middle));
    int i0 = min(int(x), half_side - 2), j0 = min(int(y), from - 1);
    int first = sheet.grid.w + j0 * half_side + i0;
    vec4 light = mix(mix(lights[first], lights[first + 1], x - float(i0)),
                     mix(lights[first + half_side], lights[first + half_side + 1], x - float(i0)),
                     y - float(j0));

    nodes[sheet.grid.y + k] =
        Node(vec4(at, ray.at.z, 1.0 - ray.at.w), ray.stop01,
             vec4(ray.stop2.xy, area > 0.0 ? sheet.shares.w * count / area : 0.0, 0.0), light);
}
