#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/flare/flare_drawing.h"
#include "core/flare/picture_levels.h"

// What the shaders of the flare read, laid out as they declare it (std140, std430).

namespace ghostlight {

using Float4 = std::array<float, 4>;
using Int4 = std::array<std::int32_t, 4>;

/// Uniform blocks of the size that every OpenGL guarantees: 16 KiB.
inline constexpr std::size_t block_entries = 1024;

/// A lens at every geometry wavelength: two entries a surface, see trace.comp.glsl.
struct LensBlock {
    std::vector<Float4> surfaces, aspheric_terms;
    std::vector<std::int32_t> first_entry;  ///< by geometry wavelength
    float sensor_gap_mm = 0.0F;             ///< last vertex z minus the sensor's
};
/// Throws Error when the lens does not fit.
LensBlock lens_block(const FlareScene& scene);

struct BundleRecord {
    Float4 box;
    Int4 grid, path;
};
struct SheetRecord {
    Int4 grid, rays;
    Float4 shares;
    Int4 more;
};
/// Of each group of threads: its record, and the first item within it.
using GroupRecord = std::array<std::uint32_t, 2>;
/// Arguments of glMultiDrawArraysIndirect.
struct DrawCommand {
    std::uint32_t vertices, instances, first_vertex, first_instance;
};
inline constexpr std::size_t group_threads = 64;
inline constexpr std::size_t ray_bytes = 48, node_bytes = 64;

/// Ghosts that are traced, placed and drawn together.
struct FlareBatch {
    std::vector<BundleRecord> bundles;
    std::vector<SheetRecord> sheets;
    std::vector<GroupRecord> bundle_groups, sheet_groups;
    std::vector<Float4> light;
    std::vector<std::uint32_t> skipped;  ///< a bit a cell of those sheets that leave cells out
    std::array<std::vector<DrawCommand>, picture_levels> draws, highlighted;
    std::size_t rays = 0, nodes = 0, cells = 0;
};

/// Packs ghosts into batches of a bounded number of nodes. Throws Error for paths of more than two
/// reflections.
std::vector<FlareBatch> flare_batches(const FlareScene& scene, const FlareDrawing& drawing,
                                      const LensBlock& lens,
                                      const std::vector<GhostPath>& highlighted);

}  // namespace ghostlight
