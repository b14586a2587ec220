#pragma once

#include <QColor>

namespace ghostlight {

/// The workbench's colours, by role. Each has one meaning wherever it appears.
struct Palette {
    QColor ground;  ///< behind everything
    QColor panel;   ///< panels and drawings
    QColor line;    ///< separators, grids
    QColor text;
    QColor dim;         ///< secondary text, what is stale
    QColor amber;       ///< light and magnitude; a ghost's rays on their way in
    QColor teal;        ///< selection, what varies in a fit; a ghost's rays on their way out
    QColor red_orange;  ///< the path between the two reflections; warnings in words
};

inline Palette dark_palette() {
    return {QColor(0x1b, 0x1c, 0x1f), QColor(0x21, 0x23, 0x27), QColor(0x34, 0x37, 0x3d),
            QColor(0xd7, 0xda, 0xe0), QColor(0x8b, 0x91, 0x9b), QColor(0xf2, 0xa3, 0x3a),
            QColor(0x37, 0xb6, 0xc9), QColor(0xff, 0x7a, 0x59)};
}

inline Palette light_palette() {
    return {QColor(0xe9, 0xea, 0xec), QColor(0xf7, 0xf7, 0xf8), QColor(0xcf, 0xd2, 0xd7),
            QColor(0x1f, 0x21, 0x25), QColor(0x5d, 0x63, 0x6c), QColor(0xa8, 0x62, 0x00),
            QColor(0x0b, 0x78, 0x89), QColor(0xc4, 0x3d, 0x1c)};
}

/// The same grounds with roles that protanopes, deuteranopes and tritanopes tell apart too: yellow,
/// blue and vermilion on dark; on light, darker ones that letters can be written in.
inline Palette safe_palette(Palette usual) {
    const bool is_dark = usual.panel.lightness() < 128;
    usual.amber = is_dark ? QColor(0xf5, 0xd9, 0x4a) : QColor(0x88, 0x6a, 0x00);
    usual.teal = is_dark ? QColor(0x4a, 0xa3, 0xf0) : QColor(0x0a, 0x58, 0xca);
    usual.red_orange = is_dark ? QColor(0xe8, 0x68, 0x4a) : QColor(0xa3, 0x12, 0x3a);
    return usual;
}

/// The palette in use; widgets read it when they paint.
inline Palette& current_palette() {
    static Palette palette = dark_palette();
    return palette;
}

}  // namespace ghostlight
