#include "widgets/theme.h"

#include <QApplication>
#include <QFont>
#include <QFontDatabase>
#include <QPalette>
#include <QProxyStyle>
#include <QStyleFactory>

#include "widgets/palette.h"

namespace ghostlight {

namespace {

/// At 96 dpi; a point size would follow a display's odd physical resolution.

QColor mixed(const QColor& a, const QColor& b, double share_of_b) {
    const auto channel = [&](int from, int to) { return qRound(from + (to - from) * share_of_b); };
    return {channel(a.red(), b.red()), channel(a.green(), b.green()), channel(a.blue(), b.blue())};
}

QPalette qt_palette(const Palette& colors) {
    QPalette palette;
    palette.setColor(QPalette::Window, colors.ground);
    palette.setColor(QPalette::WindowText, colors.text);
    palette.setColor(QPalette::Base, colors.panel);
    palette.setColor(QPalette::AlternateBase, colors.panel);
    palette.setColor(QPalette::Text, colors.text);
    palette.setColor(QPalette::PlaceholderText, colors.dim);
    palette.setColor(QPalette::Button, colors.panel);
    palette.setColor(QPalette::ButtonText, colors.text);
    palette.setColor(QPalette::BrightText, colors.red_orange);
    palette.setColor(QPalette::ToolTipBase, colors.ground);
    palette.setColor(QPalette::ToolTipText, colors.text);
    palette.setColor(QPalette::Highlight, mixed(colors.panel, colors.teal, 0.25));
    palette.setColor(QPalette::HighlightedText, colors.text);
    palette.setColor(QPalette::Link, colors.teal);
    palette.setColor(QPalette::Light, colors.line);
    palette.setColor(QPalette::Midlight, colors.line);
    palette.setColor(QPalette::Mid, colors.line);
    palette.setColor(QPalette::Dark, colors.ground);
    palette.setColor(QPalette::Shadow, colors.ground);
    for (const auto role :
         {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::HighlightedText}) {
        palette.setColor(QPalette::Disabled, role, mixed(colors.dim, colors.panel, 0.35));
    }
    return palette;
}

QString style_sheet(const Palette& colors) {
    QString sheet = QStringLiteral(R"(
QMainWindow::separator { background: @line; width: 1px; height: 1px; }
QMainWindow::separator:hover { background: @teal; }
QMenuBar { background: @ground; border-bottom: 1px solid @line; padding: 2px 4px; }
QMenuBar::item { padding: 4px 8px; border-radius: 4px; background: transparent; }
QMenuBar::item:selected { background: @line; }
QMenu { background: @panel; border: 1px solid @line; padding: 4px 0; }
QMenu::item { padding: 5px 28px 5px 24px; }
QMenu::item:selected { background: @selection; }
QMenu::item:disabled { color: @faint; }
QMenu::separator { height: 1px; background: @line; margin: 4px 0; }
QToolTip { background: @ground; color: @text; border: 1px solid @line; padding: 4px 6px; }
QTableView, QTreeView { background: @panel; border: none; outline: none;
    gridline-color: transparent; show-decoration-selected: 1;
    selection-background-color: @selection; selection-color: @text; }
QHeaderView { background: @panel; border: none; }
QHeaderView::section { background: @panel; color: @dim; border: none;
    border-bottom: 1px solid @line; padding: 4px 6px; }
QHeaderView::section:first { padding-left: 12px; }
QHeaderView::up-arrow, QHeaderView::down-arrow { image: none; width: 0; height: 0; }
QAbstractScrollArea::corner { background: @panel; border: none; }
QTableCornerButton::section { background: @panel; border: none; }
QScrollBar:vertical { background: transparent; width: 10px; margin: 0; }
QScrollBar:horizontal { background: transparent; height: 10px; margin: 0; }
QScrollBar::handle { background: @line; border-radius: 3px; margin: 2px; min-height: 24px;
    min-width: 24px; }
QScrollBar::handle:hover { background: @faint; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QAbstractItemView QLineEdit { background: @ground; color: @text; border: 1px solid @teal;
    padding: 0 6px; selection-background-color: @selection; }
QAbstractItemView QLineEdit[refused="true"] { border: 1px solid @warning; }
QComboBox QAbstractItemView, QCompleter QAbstractItemView, QListView { background: @panel;
    border: 1px solid @line; outline: none; selection-background-color: @selection; }
QPushButton { background: @panel; border: 1px solid @line; border-radius: 4px;
    padding: 5px 14px; }
QPushButton:hover { border-color: @dim; }
QPushButton:default, QPushButton:focus { border-color: @teal; }
QPushButton:disabled { color: @faint; }
#scene_bar { background: @ground; border: none; border-bottom: 1px solid @line; }
QFrame[field="true"] { background: @panel; border: 1px solid @line; border-radius: 4px; }
QFrame[field="true"]:hover { border-color: @faint; }
QFrame[field="true"][focused="true"] { border-color: @teal; }
QFrame[field="true"][refused="true"] { border-color: @warning; }
QFrame[field="true"] QLabel, QFrame[field="true"] QLineEdit, QFrame[field="true"] QComboBox,
    #scene_bar QLabel { background: transparent; border: none; padding: 0; }
QFrame[field="true"] QLineEdit { selection-background-color: @selection; }
QFrame[field="true"] QComboBox::drop-down { width: 0; border: none; }
#light_panel QFrame[field="true"] { background: @ground; }
#layers_strip { background: @ground; border-top: 1px solid @line; }
#light_list { background: @panel; border: none; border-bottom: 1px solid @line; }
#light_list::item { padding: 4px 8px; }
#light_list::item:selected { background: @selection; color: @text; }
QToolButton[quiet="true"] { background: transparent; border: 1px solid transparent;
    border-radius: 4px; padding: 2px 6px; color: @dim; }
QToolButton[quiet="true"]:hover { border-color: @line; color: @text; }
QToolButton[quiet="true"]:checked { background: @selection; color: @text; }
QToolButton[quiet="true"]:disabled { color: @faint; }
#status_line { background: @ground; border-top: 1px solid @line; }
#refusal { background: @ground; color: @warning; border: 1px solid @warning;
    border-radius: 4px; padding: 6px 8px; }
#banner { background: @ground; border: 1px solid @warning; border-radius: 4px; }
#tour { background: @ground; border: 1px solid @teal; border-radius: 4px; }
#command_palette { background: @line; }
#command_palette QLineEdit { background: @ground; border: none; }
#command_palette QListWidget { border: none; border-top: 1px solid @line; }
#gallery QListWidget { border: none; background: @ground; }
#gallery QListWidget::item { border: 1px solid transparent; border-radius: 4px; padding: 4px; }
#gallery QListWidget::item:hover { border-color: @faint; }
#gallery QListWidget::item:selected { border-color: @teal; background: @selection; color: @text; }
#help QTextBrowser { background: @panel; selection-background-color: @selection; }
)");
    const std::pair<const char*, QColor> roles[] = {
        {"@ground", colors.ground},
        {"@panel", colors.panel},
        {"@line", colors.line},
        {"@text", colors.text},
        {"@dim", colors.dim},
        {"@teal", colors.teal},
        {"@warning", colors.red_orange},
        {"@selection", mixed(colors.panel, colors.teal, 0.25)},
        {"@faint", mixed(colors.dim, colors.panel, 0.35)},
    };
    for (const auto& [role, color] : roles) {
        sheet.replace(QLatin1String(role), color.name());
    }
    return sheet;
}

/// The platform-neutral style, with the letters of keys underlined only while Alt is held.
class QuietStyle : public QProxyStyle {
   public:
    QuietStyle() : QProxyStyle(QStyleFactory::create("Fusion")) {}
    int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                  QStyleHintReturn* data) const override {
        return hint == SH_UnderlineShortcut ? 0
                                            : QProxyStyle::styleHint(hint, option, widget, data);
    }
};

QFont interface_font(double scale) {
    QFont font = QFontDatabase::systemFont(QFontDatabase::GeneralFont);
    if (QFontDatabase::families().contains("Inter")) {
        font.setFamily("Inter");
    }
    font.setPixelSize(qRound(usual_text_px * scale));
    return font;
}

struct Applied {
    Theme theme = Theme::dark;
    Look look;
};
Applied& applied() {
    static Applied last;
    return last;
}

}  // namespace

Theme current_theme() { return applied().theme; }

const Look& current_look() { return applied().look; }

void apply_theme(QApplication& application, Theme theme, const Look& look) {
    applied() = {theme, look};
    const Palette usual = theme == Theme::dark ? dark_palette() : light_palette();
    current_palette() = look.safe_colors ? safe_palette(usual) : usual;
    QApplication::setStyle(new QuietStyle);
    QApplication::setFont(interface_font(look.text_scale));
    QApplication::setPalette(qt_palette(current_palette()));
    application.setStyleSheet(style_sheet(current_palette()));
}

}  // namespace ghostlight
