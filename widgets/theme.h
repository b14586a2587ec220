#pragma once

class QApplication;

namespace ghostlight {

enum class Theme { dark, light };

/// Colours, font and the look of plain controls for the whole program. Widgets that paint
/// themselves read current_palette() and are told by a palette-change event.
void apply_theme(QApplication& application, Theme theme);

}  // namespace ghostlight
