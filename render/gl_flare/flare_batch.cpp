#include "render/gl_flare/flare_batch.h"

#include <algorithm>
#include <string>

#include "core/error.h"

namespace ghostlight {
namespace {

/// Nodes of a batch of several ghosts: 64 MiB of them.
constexpr std::size_t most_nodes = std::size_t{1} << 20;
/// Two triangles, each as itself and as a spot: ghost.vert.glsl.
constexpr int cell_vertices = 12;

[[noreturn]] void refuse(const char* what, std::size_t found, std::size_t most) {
    throw Error(
        {.problem = std::string("the lens is too large for the graphics card's path: ") + what,
         .file = {},
         .where = {},
         .found = std::to_string(found),
         .expected = "at most " + std::to_string(most)});
}

void add_groups(std::size_t record, std::size_t items, std::vector<GroupRecord>& groups) {
    for (std::size_t first = 0; first < items; first += group_threads)
        groups.push_back({static_cast<std::uint32_t>(record), static_cast<std::uint32_t>(first)});
}

/// Lays the records of one ghost.
class Packer {
   public:
    Packer(const FlareScene& scene, const FlareDrawing& drawing, const LensBlock& lens)
        : scene_(scene), drawing_(drawing), lens_(lens) {}

    static std::size_t nodes_of(const PlannedGhost& ghost) {
        const auto side = static_cast<std::size_t>(ghost.cells) + 1;
        return side * side * static_cast<std::size_t>(ghost.bands);
    }

    void add(const GhostDrawing& ghost, bool highlighted, FlareBatch& batch) const {
        const PlannedGhost& planned = ghost.planned;
        const std::size_t geometries = planned.bands > 1 ? scene_.geometry.size() : 1;
        const int half_side = planned.cells / 2 + 1;
        const double du = (planned.box.u1_mm - planned.box.u0_mm) / planned.cells;
        const double dv = (planned.box.v1_mm - planned.box.v0_mm) / planned.cells;
        SheetRecord sheet{};
        for (std::size_t g = 0; g < geometries; ++g)
            sheet.rays[g] = add_bundle(planned.path, {0.0, planned.box.v0_mm, du, dv}, half_side,
                                       planned.cells + 1, geometries == 1 ? scene_.main : g, batch);
        sheet.rays[3] = static_cast<std::int32_t>(geometries);
        sheet.grid = {planned.cells, 0, ghost.light_cells, 0};
        sheet.more = {geometries > 1 ? static_cast<std::int32_t>(scene_.main) : 0,
                      stop_crossings(planned.path), planned.cells / 2,
                      ghost.singular.empty() ? -1 : skip(ghost, batch)};
        sheet.shares[3] = static_cast<float>(du * dv / drawing_.frame.pixel_area_mm2());
        const int light_nodes = (ghost.light_cells / 2 + 1) * (ghost.light_cells + 1);
        const auto first_light = static_cast<std::int32_t>(batch.light.size());
        const std::size_t first = batch.sheets.size();
        for (int band = 0; band < planned.bands; ++band) {
            if (geometries > 1) {
                const auto shares =
                    scene_.interpolation(ghost.band_nm[static_cast<std::size_t>(band)]);
                for (std::size_t g = 0; g < geometries; ++g)
                    sheet.shares[g] = static_cast<float>(shares[g]);
            }
            sheet.grid[3] = first_light + band * light_nodes;
            add_sheet(sheet, batch);
        }
        add_light(ghost.light, batch);
        draw(planned.level, planned.cells, first, highlighted, batch);
        if (!ghost.singular.empty()) add_singular(ghost, du, dv, highlighted, batch);
    }

   private:
    const FlareScene& scene_;
    const FlareDrawing& drawing_;
    const LensBlock& lens_;

    int stop_crossings(const GhostPath& path) const {
        const OpticalSystem& system = scene_.system();
        return static_cast<int>(
            std::ranges::count_if(events(path, system.surfaces.size()),
                                  [&](const PathEvent& e) { return e.surface == system.stop; }));
    }

    static void add_light(const std::vector<float>& light, FlareBatch& batch) {
        for (std::size_t k = 0; k < light.size(); k += 4)
            batch.light.push_back({light[k], light[k + 1], light[k + 2], light[k + 3]});
    }

    static void add_sheet(SheetRecord sheet, FlareBatch& batch) {
        const auto nodes = static_cast<std::size_t>((sheet.grid[0] + 1) * (sheet.grid[0] + 1));
        sheet.grid[1] = static_cast<std::int32_t>(batch.nodes);
        add_groups(batch.sheets.size(), nodes, batch.sheet_groups);
        batch.sheets.push_back(sheet);
        batch.nodes += nodes;
        batch.cells += static_cast<std::size_t>(sheet.grid[0] * sheet.grid[0]);
    }

    /// All sheets from `first` on, of so many cells across.
    static void draw(int level, int cells, std::size_t first, bool highlighted, FlareBatch& batch) {
        const DrawCommand command{static_cast<std::uint32_t>(cell_vertices * cells * cells),
                                  static_cast<std::uint32_t>(batch.sheets.size() - first), 0,
                                  static_cast<std::uint32_t>(first)};
        batch.draws[static_cast<std::size_t>(level)].push_back(command);
        if (highlighted) batch.highlighted[static_cast<std::size_t>(level)].push_back(command);
    }

    /// Marks singular cells and their mirror images; returns the first bit.
    static std::int32_t skip(const GhostDrawing& ghost, FlareBatch& batch) {
        const int cells = ghost.planned.cells;
        const std::size_t first = batch.skipped.size();
        batch.skipped.resize(first + static_cast<std::size_t>((cells * cells + 31) / 32), 0U);
        auto mark = [&](int cell) {
            batch.skipped[first + static_cast<std::size_t>(cell / 32)] |= 1U << (cell % 32);
        };
        for (const int cell : ghost.singular) {
            mark(cell);
            mark(cell / cells * cells + cells - 1 - cell % cells);
        }
        return static_cast<std::int32_t>(32 * first);
    }

    void add_singular(const GhostDrawing& ghost, double du, double dv, bool highlighted,
                      FlareBatch& batch) const {
        const PlannedGhost& planned = ghost.planned;
        const int across = ghost.singular_across, side = across + 1;
        const auto first_light = static_cast<std::int32_t>(batch.light.size());
        const std::size_t first = batch.sheets.size();
        for (std::size_t n = 0; n < ghost.singular.size(); ++n) {
            const int i = ghost.singular[n] % planned.cells, j = ghost.singular[n] / planned.cells;
            SheetRecord sheet{};
            sheet.rays = {add_bundle(planned.path,
                                     {planned.box.u0_mm + du * i, planned.box.v0_mm + dv * j,
                                      du / across, dv / across},
                                     side, side, scene_.main, batch),
                          0, 0, 1};
            sheet.grid = {across, 0, across,
                          first_light + static_cast<std::int32_t>(n) * side * side};
            sheet.more = {0, stop_crossings(planned.path), 0, -1};
            sheet.shares[3] =
                static_cast<float>(du * dv / (across * across) / drawing_.frame.pixel_area_mm2());
            for (const float mirrored : {0.0F, 1.0F}) {
                sheet.shares[1] = mirrored;
                add_sheet(sheet, batch);
            }
        }
        add_light(ghost.singular_light, batch);
        draw(planned.level, across, first, highlighted, batch);
    }

    /// A rectangle of rays: u and v of the first and the steps, mm. Returns its first ray.
    std::int32_t add_bundle(const GhostPath& path, const std::array<double, 4>& box, int columns,
                            int rows, std::size_t geometry, FlareBatch& batch) const {
        const auto count = static_cast<std::size_t>(columns * rows);
        const auto first = static_cast<std::int32_t>(batch.rays);
        BundleRecord bundle{};
        for (std::size_t k = 0; k < box.size(); ++k) bundle.box[k] = static_cast<float>(box[k]);
        bundle.grid = {columns, first, static_cast<std::int32_t>(count),
                       lens_.first_entry[geometry]};
        const auto& turns = path.reflections;
        if (turns.size() > 2) refuse("reflections of one ghost", turns.size(), 2);
        const OpticalSystem& system = scene_.system();
        auto turn = [&](std::size_t k) {
            return k < turns.size() ? static_cast<std::int32_t>(turns[k]) : -1;
        };
        bundle.path = {turn(0), turn(1), static_cast<std::int32_t>(system.stop),
                       static_cast<std::int32_t>(system.surfaces.size())};
        add_groups(batch.bundles.size(), count, batch.bundle_groups);
        batch.bundles.push_back(bundle);
        batch.rays += count;
        return first;
    }
};

}  // namespace

LensBlock lens_block(const FlareScene& scene) {
    LensBlock block;
    const std::size_t count = turning_count(scene.system());
    if (2 * count * scene.geometry.size() > block_entries)
        refuse("surfaces at each geometry wavelength", count * scene.geometry.size(),
               block_entries / 2);
    std::vector<float> terms;
    std::vector<int> first_terms;
    for (std::size_t k = 0; k < count; ++k) {
        first_terms.push_back(static_cast<int>(terms.size()));
        for (const double a : surface_at(scene.system(), k).aspheric)
            terms.push_back(static_cast<float>(a));
    }
    if (terms.size() > 4 * block_entries) refuse("aspheric terms", terms.size(), 4 * block_entries);
    terms.resize((terms.size() + 3) / 4 * 4);
    for (std::size_t k = 0; k < terms.size(); k += 4)
        block.aspheric_terms.push_back({terms[k], terms[k + 1], terms[k + 2], terms[k + 3]});
    for (const OpticalSystem& system : scene.geometry) {
        block.first_entry.push_back(static_cast<std::int32_t>(block.surfaces.size()));
        double z = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
            const SurfaceAt& s = surface_at(system, k);
            block.surfaces.push_back({static_cast<float>(s.curvature_per_mm),
                                      static_cast<float>(s.conic),
                                      static_cast<float>(1.0 / s.semi_diameter_mm),
                                      static_cast<float>(z - s.vertex_z_mm)});
            block.surfaces.push_back({static_cast<float>(s.n_before), static_cast<float>(s.n_after),
                                      static_cast<float>(first_terms[k]),
                                      static_cast<float>(s.aspheric.size())});
            z = s.vertex_z_mm;
        }
        block.sensor_gap_mm =
            static_cast<float>(system.surfaces.back().vertex_z_mm - system.sensor_z_mm);
    }
    block.surfaces.resize(block_entries);
    block.aspheric_terms.resize(block_entries);
    return block;
}

std::vector<FlareBatch> flare_batches(const FlareScene& scene, const FlareDrawing& drawing,
                                      const LensBlock& lens,
                                      const std::vector<GhostPath>& highlighted) {
    const Packer packer(scene, drawing, lens);
    std::vector<FlareBatch> batches;
    for (const GhostDrawing& ghost : drawing.ghosts) {
        if (batches.empty() ||
            (batches.back().nodes > 0 &&
             batches.back().nodes + Packer::nodes_of(ghost.planned) > most_nodes))
            batches.emplace_back();
        packer.add(ghost, std::ranges::find(highlighted, ghost.planned.path) != highlighted.end(),
                   batches.back());
    }
    return batches;
}

}  // namespace ghostlight
