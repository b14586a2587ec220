#pragma once

#include <algorithm>
#include <cmath>

namespace ghostlight {

/// Calls visit(x, y, parts) for `parts` points along the longest diagonal of a piece that is too
/// thin to have an irradiance, at most a quarter of a pixel apart: each takes 1/parts of its flux.
/// `Corner` has x and y, in pixels.
template <class Corner, class Visit>
void for_each_spot(const Corner* corners, int count, Visit visit) {
    int from = 0, to = 1;
    double longest = -1.0;
    for (int a = 0; a < count; ++a)
        for (int b = a + 1; b < count; ++b) {
            const double length =
                std::hypot(corners[b].x - corners[a].x, corners[b].y - corners[a].y);
            if (length > longest) {
                longest = length;
                from = a;
                to = b;
            }
        }
    const int parts = std::clamp(static_cast<int>(std::ceil(4.0 * longest)), 1, 1 << 16);
    for (int k = 0; k < parts; ++k) {
        const double t = (k + 0.5) / parts;
        visit(std::lerp(corners[from].x, corners[to].x, t),
              std::lerp(corners[from].y, corners[to].y, t), parts);
    }
}

}  // namespace ghostlight
