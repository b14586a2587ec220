#pragma once

#include <cstddef>

#include "core/ghosts/cells.h"

namespace ghostlight {

/// A triangle's part where all clearances are ≥ 0: corner k is Σ share·node. On the scalar S, so
/// that ceres::Jet gives how the corners move with what the clearances depend on.
template <class S>
struct ClippedTriangle {
    struct Corner {
        S share[3];
    };
    Corner corners[Piece::max_corners];
    int count = 0;
    bool whole = true;
};

/// `at(k, s)` is clearance k at the triangle's node s; clearances are linear between.
template <class S, class At>
ClippedTriangle<S> clip_shares(std::size_t clearances, const At& at) {
    using Corner = typename ClippedTriangle<S>::Corner;
    ClippedTriangle<S> triangle;
    const S one(1.0), zero(0.0);
    triangle.corners[0] = {{one, zero, zero}};
    triangle.corners[1] = {{zero, one, zero}};
    triangle.corners[2] = {{zero, zero, one}};
    int count = 3;
    for (std::size_t clearance = 0; clearance < clearances; ++clearance) {
        const S f[3] = {at(clearance, 0), at(clearance, 1), at(clearance, 2)};
        if (f[0] >= zero && f[1] >= zero && f[2] >= zero) continue;
        triangle.whole = false;
        if (f[0] < zero && f[1] < zero && f[2] < zero) return triangle;
        if (count + 6 > Piece::max_corners) break;
        auto value = [&](const Corner& c) {
            return S(c.share[0] * f[0] + c.share[1] * f[1] + c.share[2] * f[2]);
        };
        Corner kept[Piece::max_corners];
        int kept_count = 0;
        for (int k = 0; k < count; ++k) {
            const Corner& a = triangle.corners[k];
            const Corner& b = triangle.corners[(k + 1) % count];
            const S va = value(a), vb = value(b);
            if (va >= zero) kept[kept_count++] = a;
            if ((va >= zero) != (vb >= zero)) {
                const S t = va / (va - vb);
                Corner& cut = kept[kept_count++];
                for (int s = 0; s < 3; ++s)
                    cut.share[s] = a.share[s] + t * (b.share[s] - a.share[s]);
            }
        }
        count = kept_count;
        if (count < 3) return triangle;
        for (int k = 0; k < count; ++k) triangle.corners[k] = kept[k];
    }
    triangle.count = count;
    return triangle;
}

}  // namespace ghostlight
