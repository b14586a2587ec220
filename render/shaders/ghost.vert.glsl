// Triangles of all sheets of a batch. A triangle that covers pixels is drawn as it is; one below a
// pixel or thinner than one, or beside failing rays, as a spot with the same flux, centre and
// spread, since whether it meets a pixel's centre would be chance. In between it is drawn as both,
// each with a share of its light: spots spread into what is beside them, and where they began at
// once their last row would be dark and the triangles about it bright.
struct Sheet {
    ivec4 grid, rays;  // see place.comp.glsl
    vec4 shares;
    ivec4 more;
};
struct Node {
    vec4 at, stop01, stop2, light;
};
layout(std430, binding = 3) readonly buffer Sheets { Sheet sheets[]; };
layout(std430, binding = 4) readonly buffer Nodes { Node nodes[]; };
layout(std430, binding = 6) readonly buffer Skipped { uint skipped[]; };  // a bit a cell

layout(location = 0) in uint sheet_index;  // one an instance
uniform vec4 target;                       // scale and margin of the level; its size in pixels

out vec4 light;    // of the picture
out vec4 stop01;   // where the light crosses the stop
out vec4 stop2;    // the third crossing; clearance and margin
out vec2 spread;   // within a spot, in standard deviations; 0 in a triangle
flat out int crossings;

// A mesh of bands of spectrum and of cells hides no variance below this: a spot smaller than a
// pixel would flicker with where it lies between pixels' centres. px^2.
const float least_variance = 0.25;
// From where on a triangle is drawn as one too, and as nothing else; of a cell that is drawn on a
// grid of its own the whole cell counts, since its triangles are parts of one smooth sheet.
const vec2 areas = vec2(0.125, 1.0);    // px^2
const vec2 breadths = vec2(0.25, 1.0);  // px
const float own_grid = 4.0;            // cells across such a grid
const float reach = 3.3;          // of a spot, in standard deviations: 0.15 % of it is beyond
const float beyond = 1.0015;
const float most_rescaled = 4.0;  // by its flux; else the triangle's light is even

void drop() { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); }

float clearance(vec4 at, vec4 s01, vec4 s2) {
    float least = min(at.z, at.w);
    if (crossings > 0) least = min(least, stop_margin(s01.xy));
    if (crossings > 1) least = min(least, stop_margin(s01.zw));
    if (crossings > 2) least = min(least, stop_margin(s2.xy));
    return least;
}

// Whether one thing stops all three corners and more than as much again beyond them.
bool is_stopped(vec3 c) {
    float most = max(c.x, max(c.y, c.z)), least = min(c.x, min(c.y, c.z));
    return most + (most - least) < 0.0;
}

void main() {
    light = vec4(0);
    stop01 = vec4(0);
    stop2 = vec4(0, 0, 1, 1);
    spread = vec2(0);
    Sheet sheet = sheets[sheet_index];
    crossings = sheet.more.y;
    int cells = sheet.grid.x, side = cells + 1;
    int cell = gl_VertexID / 12, half_of = (gl_VertexID / 6) % 2, own = gl_VertexID % 3;
    bool as_spot = (gl_VertexID / 3) % 2 == 1;
    int bit = sheet.more.w + cell;
    if (sheet.more.w >= 0 && (skipped[bit / 32] >> (bit % 32) & 1u) == 1u) {
        drop();
        return;
    }
    int i = cell % cells, j = cell / cells;
    int a = sheet.grid.y + j * side + i;
    // Diagonals mirror about the middle, so that a symmetric ghost is drawn symmetrically.
    ivec3 index = 2 * i >= cells ? (half_of == 0 ? ivec3(a, a + 1, a + side + 1)
                                                 : ivec3(a + side + 1, a + side, a))
                                 : (half_of == 0 ? ivec3(a, a + 1, a + side)
                                                 : ivec3(a + side + 1, a + side, a + 1));
    Node n[3] = Node[3](nodes[index.x], nodes[index.y], nodes[index.z]);

    bvec3 valid = bvec3(n[0].at.z >= 0.0, n[1].at.z >= 0.0, n[2].at.z >= 0.0);
    float count = dot(vec3(valid), vec3(1));
    if (count == 0.0 || is_stopped(vec3(n[0].at.w, n[1].at.w, n[2].at.w)) ||
        (crossings > 0 && is_stopped(vec3(stop_margin(n[0].stop01.xy), stop_margin(n[1].stop01.xy),
                                          stop_margin(n[2].stop01.xy)))) ||
        (crossings > 1 && is_stopped(vec3(stop_margin(n[0].stop01.zw), stop_margin(n[1].stop01.zw),
                                          stop_margin(n[2].stop01.zw)))) ||
        (crossings > 2 && is_stopped(vec3(stop_margin(n[0].stop2.xy), stop_margin(n[1].stop2.xy),
                                          stop_margin(n[2].stop2.xy))))) {
        drop();
        return;
    }
    // A failed ray's place means nothing: it takes the mean of the others'.
    vec2 place[3];
    vec2 mean_place = vec2(0);
    for (int s = 0; s < 3; ++s) {
        place[s] = n[s].at.xy * target.x + target.y;
        if (valid[s]) mean_place += place[s] / count;
    }
    for (int s = 0; s < 3; ++s)
        if (!valid[s]) place[s] = mean_place;
    vec2 low = min(place[0], min(place[1], place[2])), high = max(place[0], max(place[1], place[2]));
    if (any(lessThan(high, vec2(-4))) || any(greaterThan(low, target.zw + 4.0))) {
        drop();
        return;
    }

    vec2 ab = place[1] - place[0], ac = place[2] - place[0], bc = place[2] - place[1];
    float area = 0.5 * abs(ab.x * ac.y - ab.y * ac.x);
    float longest = sqrt(max(dot(ab, ab), max(dot(ac, ac), dot(bc, bc))));
    float enlarged = sheet.more.z == 0 ? own_grid : 1.0;
    float share = count < 3.0 ? 0.0
                              : smoothstep(areas.x, areas.y, area * enlarged * enlarged) *
                                    smoothstep(breadths.x, breadths.y,
                                               2.0 * area * enlarged / max(longest, 1e-20));
    if (as_spot) share = 1.0 - share;
    if (share <= 0.0) {
        drop();
        return;
    }
    // Light times area on the level's pixels.
    float entrance = 0.5 * sheet.shares.w * target.x * target.x * share;
    if (!as_spot) {
        vec4 even = entrance / area * (n[0].light + n[1].light + n[2].light) / 3.0;
        vec4 middle = (n[0].light * n[0].stop2.z + n[1].light * n[1].stop2.z +
                       n[2].light * n[2].stop2.z) / 3.0;
        bool fits = middle.a * most_rescaled > even.a && middle.a < most_rescaled * even.a;
        light = fits ? n[own].light * n[own].stop2.z * (even.a / middle.a) : even;
        stop01 = n[own].stop01;
        stop2 = vec4(n[own].stop2.xy, n[own].at.w, n[own].at.z);
        gl_Position = vec4(place[own] / target.zw * 2.0 - 1.0, 0.0, 1.0);
        return;
    }

    // What of it passes: by the middles of its sixteenths.
    vec4 flux = vec4(0);
    for (int s = 0; s < 16; ++s) {
        int row = s < 7 ? 0 : s < 12 ? 1 : s < 15 ? 2 : 3;
        int column = s - (row == 0 ? 0 : row == 1 ? 7 : row == 2 ? 12 : 15);
        float up = column % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
        vec2 q = (vec2(column / 2, row) + up) / 4.0;
        vec3 w = vec3(1.0 - q.x - q.y, q);
        vec4 at = w.x * n[0].at + w.y * n[1].at + w.z * n[2].at;
        vec4 s01 = w.x * n[0].stop01 + w.y * n[1].stop01 + w.z * n[2].stop01;
        vec4 s2 = w.x * n[0].stop2 + w.y * n[1].stop2 + w.z * n[2].stop2;
        if (clearance(at, s01, s2) >= 0.0)
            flux += w.x * n[0].light + w.y * n[1].light + w.z * n[2].light;
    }
    flux *= entrance / 16.0;
    if (flux == vec4(0)) {
        drop();
        return;
    }
    vec2 centre = (place[0] + place[1] + place[2]) / 3.0;
    float xx = least_variance, yy = least_variance, xy = 0.0;
    for (int s = 0; s < 3; ++s) {
        vec2 off = place[s] - centre;
        xx += off.x * off.x / 12.0;
        yy += off.y * off.y / 12.0;
        xy += off.x * off.y / 12.0;
    }
    float root_x = sqrt(xx), lean = xy / root_x, root_y = sqrt(yy - lean * lean);
    spread = reach * (own == 0 ? vec2(0.0, 2.0)
                               : own == 1 ? vec2(-1.7320508, -1.0) : vec2(1.7320508, -1.0));
    vec2 corner = centre + vec2(root_x * spread.x, lean * spread.x + root_y * spread.y);
    light = flux * beyond / (6.2831853 * root_x * root_y);
    crossings = 0;
    gl_Position = vec4(corner / target.zw * 2.0 - 1.0, 0.0, 1.0);
}
