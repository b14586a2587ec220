// Filling pixels: the CPU's raster on one thread against OpenGL (llvmpipe on machines without a
// graphics card, with all its threads), the same sheets at full size into RGBA32F.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include "core/elapsed.h"
#include "core/flare/draw_picture.h"
#include "core/flare/node_placement.h"
#include "core/flare/planned_flare.h"
#include "core/io/lens_file.h"
#include "render/gl_flare/gl_flare.h"
#include "render/gl_objects.h"
#include "render/offscreen.h"
#include "tests/bench/bench_support.h"

namespace ghostlight::bench {
namespace {

constexpr int cells = 32;
constexpr int repetitions = 5;

/// A ghost's grid with its light in every channel.
std::vector<MeshNodes> sheets_of(const FlareScene& scene, const LightDirection& light,
                                 const PixelFrame& frame) {
    FlareRequest request;
    request.light = light;
    const FlareImage image = render_planned(scene, request).value();
    const NodePlacement placement(scene.system(), light, frame);
    const BeamFrame beam = beam_frame({light.field_deg, 90.0});
    std::vector<MeshNodes> sheets;
    for (const PlannedGhost& ghost : image.plan.ghosts) {
        if (ghost.fate != GhostFate::drawn) continue;
        MirrorGrid grid;
        grid.box = ghost.box;
        grid.cells = cells;
        trace_mirrored(trace_path<float>(scene.system(), ghost.path), beam, Weights::polarised,
                       grid);
        MeshNodes nodes = placement.place(grid);
        for (int j = 0; j <= cells; ++j)
            for (int i = 0; i <= cells; ++i)
                nodes.weights.insert(nodes.weights.end(), 4, grid.half.weight[grid.of_node(i, j)]);
        sheets.push_back(std::move(nodes));
    }
    return sheets;
}

struct Vertex {
    float x, y, light;
};

/// Two triangles for every cell that passes whole, with its flux over its area.
std::vector<Vertex> triangles_of(const std::vector<MeshNodes>& sheets, const PixelFrame& frame) {
    std::vector<Vertex> vertices;
    for (const MeshNodes& nodes : sheets) {
        const int side = nodes.cells + 1;
        auto passes = [&](std::size_t k) {
            return nodes.margin[k] >= 0.0F &&
                   std::ranges::all_of(nodes.clearances,
                                       [&](const auto& clearance) { return clearance[k] >= 0.0F; });
        };
        for (int j = 0; j < nodes.cells; ++j)
            for (int i = 0; i < nodes.cells; ++i) {
                const auto a = static_cast<std::size_t>(j * side + i), b = a + 1,
                           c = a + static_cast<std::size_t>(side), d = c + 1;
                if (!(passes(a) && passes(b) && passes(c) && passes(d))) continue;
                for (const std::size_t k : {a, b, d, d, c, a})
                    vertices.push_back(
                        {2.0F * nodes.column[k] / static_cast<float>(frame.width_px) - 1.0F,
                         2.0F * nodes.row[k] / static_cast<float>(frame.height_px) - 1.0F,
                         nodes.weights[4 * k]});
            }
    }
    return vertices;
}

constexpr const char* vertex_source = R"(#version 330
layout(location = 0) in vec3 at;
out float light;
void main() { light = at.z; gl_Position = vec4(at.xy, 0.0, 1.0); })";
constexpr const char* fragment_source = R"(#version 330
in float light;
out vec4 color;
void main() { color = vec4(light); })";

class GlRaster {
   public:
    GlRaster(const std::vector<Vertex>& vertices, const PixelFrame& frame)
        : program_(vertex_source, fragment_source), count_(static_cast<int>(vertices.size())) {
        array_.create();
        glBindVertexArray(array_.name());
        glGenBuffers(1, &buffer_);
        glBindBuffer(GL_ARRAY_BUFFER, buffer_);
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)),
                     vertices.data(), GL_STATIC_DRAW);
        glEnableVertexAttribArray(0);
        glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), nullptr);
        texture_.upload(frame.width_px, frame.height_px, 4, nullptr);
        glGenFramebuffers(1, &framebuffer_);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(),
                               0);
        glViewport(0, 0, frame.width_px, frame.height_px);
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        check_gl("raster bench");
    }
    ~GlRaster() {
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteBuffers(1, &buffer_);
    }
    GlRaster(const GlRaster&) = delete;
    GlRaster& operator=(const GlRaster&) = delete;

    void draw() const {
        glClear(GL_COLOR_BUFFER_BIT);
        glUseProgram(program_.name());
        glDrawArrays(GL_TRIANGLES, 0, count_);
        glFinish();
    }

   private:
    GlProgram program_;
    GlVertexArray array_;
    GlTexture texture_;
    unsigned buffer_ = 0, framebuffer_ = 0;
    int count_;
};

/// Processor time of all of the program's threads: other programs change it least.
double cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Least {
    double cpu_ms = std::numeric_limits<double>::infinity(), wall_ms = cpu_ms;
};
template <class Work>
Least least_of(Work work) {
    Least least;
    for (int k = 0; k < repetitions; ++k) {
        const double before = cpu_ms();
        const auto began = Clock::now();
        work();
        least.wall_ms = std::min(least.wall_ms, ms_since(began));
        least.cpu_ms = std::min(least.cpu_ms, cpu_ms() - before);
    }
    return least;
}

void compare(const char* file) {
    Prescription lens = lens_named(file);
    lens.sensor.height_mm = lens.sensor.width_mm * 720.0 / 1280.0;
    const FlareScene scene = flare_scene(lens, Monochromatic{});
    const PixelFrame frame = pixel_frame(lens.sensor.width_mm, lens.sensor.height_mm, 1280);
    const std::vector<MeshNodes> sheets = sheets_of(scene, {middle_field_deg(lens), 90.0}, frame);
    std::vector<DrawnGhost<color_channels>> ghosts(sheets.size());
    const Least mesh = least_of([&] {
        for (std::size_t g = 0; g < sheets.size(); ++g) {
            ghosts[g].mesh.clear();
            add_grid(sheets[g], frame, ghosts[g].mesh);
        }
    });
    double area_px2 = 0.0;
    for (const auto& ghost : ghosts) area_px2 += ghost.mesh.area_px2;
    FlareImage image = empty_image(scene.system(), frame);
    const Least cpu = least_of([&] { draw_picture<color_channels>(ghosts, frame, 1, {}, image); });
    const GlRaster gl(triangles_of(sheets, frame), frame);
    gl.draw();  // drivers finish their shaders in it
    const Least card = least_of([&] { gl.draw(); });
    fmt::print("{:<28}{:>8}{:>12.1f}{:>12.1f}{:>12.1f}{:>12.1f}{:>12.1f}{:>10.1f}\n",
               std::string(file).substr(0, 27), sheets.size(), 1e-6 * area_px2, mesh.cpu_ms,
               cpu.cpu_ms, card.cpu_ms, card.wall_ms, card.cpu_ms / (mesh.cpu_ms + cpu.cpu_ms));
}

}  // namespace
}  // namespace ghostlight::bench

int main() {
    using namespace ghostlight;
    const OffscreenContext context;
    fmt::print("1280 x 720, grids of {} cells, all at full size; OpenGL: {}\n", bench::cells,
               gl_offer().renderer);
    fmt::print("{:<28}{:>8}{:>12}{:>12}{:>12}{:>12}{:>12}{:>10}\n", "lens", "ghosts", "Mpx inside",
               "mesh, ms", "raster, ms", "GL cpu, ms", "GL wall, ms", "GL / CPU");
    for (const char* file : {"tessar_brendel_100_f2.8.json", "double_gauss_tronnier_100_f2.json",
                             "nikon_zoom_80_200_f2.8.json", "canon_zoom_70_200_f2.8.json"})
        bench::compare(file);
    return 0;
}
