#include "core/flare/color_misplacement.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/flare/color_mesh.h"
#include "core/flare/color_raster.h"
#include "core/flare/flare_scene.h"
#include "core/flare/ghost_measures.h"

namespace ghostlight {
namespace {

constexpr int window_px = 40;  ///< of the small pictures, each way
/// An even spectrum leaves half of its range in error, which is this much of the mean distance of
/// the outer geometry wavelengths.
constexpr double even_spectrum = 0.5 / outer_geometry_node;
/// Of the sum over ghosts, what is left in their picture: colours come apart in all directions, and
/// what one ghost puts in the wrong place another takes away. Calibrated on the bundled lenses.
constexpr double left_in_sum = 0.35;

/// Part of the frame, in its pixels.
struct Window {
    double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;

    void hold(const MeshNodes& nodes) {
        for (std::size_t k = 0; k < nodes.column.size(); ++k) {
            if (!is_within(nodes, k, near_rim)) continue;
            const auto x = static_cast<double>(nodes.column[k]);
            const auto y = static_cast<double>(nodes.row[k]);
            left = std::min(left, x);
            right = std::max(right, x);
            bottom = std::min(bottom, y);
            top = std::max(top, y);
        }
    }
    /// Within the frame, and at least a pixel across.
    void clip(const PixelFrame& frame) {
        left = std::clamp(left, 0.0, frame.width_px - 1.0);
        bottom = std::clamp(bottom, 0.0, frame.height_px - 1.0);
        right = std::clamp(right, left + 1.0, static_cast<double>(frame.width_px));
        top = std::clamp(top, bottom + 1.0, static_cast<double>(frame.height_px));
    }
};

std::vector<float> picture(MeshNodes nodes, const std::vector<float>& weights,
                           const Window& window) {
    const double across = window_px / (window.right - window.left);
    const double along = window_px / (window.top - window.bottom);
    for (float& x : nodes.column)
        x = static_cast<float>((static_cast<double>(x) - window.left) * across);
    for (float& y : nodes.row)
        y = static_cast<float>((static_cast<double>(y) - window.bottom) * along);
    nodes.weights = weights;
    const PixelFrame small{window_px, window_px, 1.0, 0.0, 0.0};
    ColorMesh<gray_channels> mesh;
    add_grid(nodes, small, mesh);
    std::vector<float> pixels(static_cast<std::size_t>(window_px * window_px), 0.0F);
    std::vector<std::uint32_t> all(mesh.edges.size());
    std::iota(all.begin(), all.end(), 0U);
    ColorBand<gray_channels> band({window_px, window_px, 1.0, 0}, 0, window_px);
    band.add(mesh.edges, all, mesh.reaches_past_right);
    for (const auto& point : mesh.points) band.add(point);
    band.resolve(pixels);
    return pixels;
}

}  // namespace

double picture_distance(const MeshNodes& first, const MeshNodes& second, const PixelFrame& frame) {
    Window window;
    window.hold(first);
    window.hold(second);
    if (!(window.left < window.right)) return 0.0;
    window.clip(frame);
    const std::vector<float> a = picture(first, first.weights, window);
    const std::vector<float> b = picture(second, first.weights, window);
    double light = 0.0, distance = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        light += static_cast<double>(a[k]);
        distance += std::abs(static_cast<double>(a[k] - b[k]));
    }
    constexpr double most = 2.0;  // all of it elsewhere
    return light > 0.0 ? std::min(most, distance / light) : 0.0;
}

double ColorMisplacement::error(int bands) const {
    const double step_px = shift_px / outer_geometry_node / bands;
    const double seen = shift_px > 0.0 ? step_px / (step_px + 1.0) : 1.0;
    return left_in_sum * even_spectrum * distance / bands * seen;
}

int ColorMisplacement::bands_for(double error_allowed, int most) const {
    int bands = 1;
    while (bands < most && error(bands) > error_allowed) ++bands;
    return bands;
}

}  // namespace ghostlight
