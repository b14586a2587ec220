#pragma once

class QApplication;

namespace ghostlight {

enum class Theme { dark, light };

/// Taste besides the theme.
struct Look {
    double text_scale = 1.0;   ///< of all letters
    bool safe_colors = false;  ///< safe_palette()
    bool operator==(const Look&) const = default;
};
inline constexpr double least_text_scale = 0.7, most_text_scale = 2.0;
inline constexpr int usual_text_px = 13;  ///< height of the font at a scale of 1

/// Colours, font and the look of plain controls for the whole program. Widgets that paint
/// themselves read current_palette() and are told by a palette-change event.
void apply_theme(QApplication& application, Theme theme, const Look& look = {});
/// As last applied, which may be another than the one that is kept.
Theme current_theme();
const Look& current_look();

}  // namespace ghostlight
