#include "widgets/ghost_colors.h"

#include <array>

namespace ghostlight {

QColor ghost_color(const GhostPath& path) {
    // Paul Tol's "light" qualitative scheme, safe for colour-blind readers, without its orange,
    // which has another meaning here. Ordered so that neighbours differ.
    static const std::array<QColor, 8> cycle = {QColor(0x77, 0xaa, 0xdd), QColor(0xee, 0xdd, 0x88),
                                                QColor(0x44, 0xbb, 0x99), QColor(0xff, 0xaa, 0xbb),
                                                QColor(0x99, 0xdd, 0xff), QColor(0xaa, 0xaa, 0x00),
                                                QColor(0xdd, 0xdd, 0xdd), QColor(0xbb, 0xcc, 0x33)};
    if (path.is_direct()) {
        return cycle[6];
    }
    // The place of the pair in the enumeration 2-1, 3-1, 3-2, 4-1, …: no two neighbours alike.
    std::size_t place = 0;
    for (std::size_t k = 0; k + 1 < path.reflections.size(); k += 2) {
        const std::size_t i = path.reflections[k];
        const std::size_t j = path.reflections[k + 1];
        place += i * (i > 0 ? i - 1 : 0) / 2 + j;
    }
    return cycle[place % cycle.size()];
}

}  // namespace ghostlight
