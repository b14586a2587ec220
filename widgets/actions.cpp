#include "widgets/actions.h"

#include <QCoreApplication>
#include <QMenu>
#include <QMenuBar>
#include <QWidget>

#include <array>
#include <utility>

namespace ghostlight {

namespace {

constexpr std::array texts = {
    ActionText{"file.open", QT_TRANSLATE_NOOP("Actions", "&Open…"), "Ctrl+O",
               QT_TRANSLATE_NOOP("Actions", "Open a lens file")},
    ActionText{"file.gallery", QT_TRANSLATE_NOOP("Actions", "&Gallery of Bundled Lenses…"),
               "Ctrl+Shift+O",
               QT_TRANSLATE_NOOP("Actions", "Choose a bundled lens by its layout and its flare")},
    ActionText{"file.save", QT_TRANSLATE_NOOP("Actions", "&Save"), "Ctrl+S",
               QT_TRANSLATE_NOOP("Actions", "Save the lens in its file")},
    ActionText{"file.save_as", QT_TRANSLATE_NOOP("Actions", "Save &As…"), "Ctrl+Shift+S",
               QT_TRANSLATE_NOOP("Actions", "Save the lens in another file")},
    ActionText{"file.export_lens", QT_TRANSLATE_NOOP("Actions", "Export &Lens…"), "",
               QT_TRANSLATE_NOOP(
                   "Actions",
                   "Write the lens for another program; what its format cannot hold is reported")},
    ActionText{
        "file.export_ghost", QT_TRANSLATE_NOOP("Actions", "Export &Unfolded Ghost…"), "",
        QT_TRANSLATE_NOOP(
            "Actions",
            "The light's way along the chosen ghost as a lens of its own, a .zmx with mirrors")},
    ActionText{"file.glass_folders", QT_TRANSLATE_NOOP("Actions", "&Glass Folders…"), "",
               QT_TRANSLATE_NOOP("Actions",
                                 "Folders with catalogues of glasses besides the bundled ones")},
    ActionText{"file.export_table", QT_TRANSLATE_NOOP("Actions", "Export Ghost &Table as CSV…"),
               "Ctrl+E", QT_TRANSLATE_NOOP("Actions", "Every column and every digit")},
    ActionText{"file.export_exr", QT_TRANSLATE_NOOP("Actions", "Export &Flare as EXR…"),
               "Ctrl+Shift+E",
               QT_TRANSLATE_NOOP("Actions", "Linear irradiance, 32-bit float, upright")},
    ActionText{"file.export_png", QT_TRANSLATE_NOOP("Actions", "Export Flare as &PNG…"), "",
               QT_TRANSLATE_NOOP("Actions", "As shown, at the exposure in use")},
    ActionText{"file.quit", QT_TRANSLATE_NOOP("Actions", "&Quit"), "Ctrl+Q",
               QT_TRANSLATE_NOOP("Actions", "Close the window")},
    ActionText{"edit.undo", QT_TRANSLATE_NOOP("Actions", "&Undo"), "Ctrl+Z",
               QT_TRANSLATE_NOOP("Actions", "Take back the last change")},
    ActionText{"edit.redo", QT_TRANSLATE_NOOP("Actions", "&Redo"), "Ctrl+Shift+Z",
               QT_TRANSLATE_NOOP("Actions", "Do it again")},
    ActionText{
        "edit.mend_glass", QT_TRANSLATE_NOOP("Actions", "Mend Unknown &Glass…"), "Ctrl+G",
        QT_TRANSLATE_NOOP("Actions", "Go to the first glass that nobody knows, and choose one")},
    ActionText{
        "edit.insert", QT_TRANSLATE_NOOP("Actions", "&Insert Surface"), "Ctrl+I",
        QT_TRANSLATE_NOOP("Actions", "A plane in the middle of the gap after the chosen surface")},
    ActionText{"edit.delete", QT_TRANSLATE_NOOP("Actions", "&Delete Surface"), "Ctrl+Del",
               QT_TRANSLATE_NOOP("Actions", "Take the chosen surface out")},
    ActionText{"edit.move_up", QT_TRANSLATE_NOOP("Actions", "Move Surface &Up"), "Alt+Up",
               QT_TRANSLATE_NOOP("Actions", "Swap with the surface before")},
    ActionText{"edit.move_down", QT_TRANSLATE_NOOP("Actions", "Move Surface Do&wn"), "Alt+Down",
               QT_TRANSLATE_NOOP("Actions", "Swap with the surface after")},
    ActionText{"edit.make_stop", QT_TRANSLATE_NOOP("Actions", "Make It the &Stop"), "",
               QT_TRANSLATE_NOOP("Actions", "The chosen surface becomes the stop")},
    ActionText{"edit.copy_cells", QT_TRANSLATE_NOOP("Actions", "&Copy Cells"), "",
               QT_TRANSLATE_NOOP("Actions", "The chosen cells, for a spreadsheet (Ctrl+C)")},
    ActionText{
        "edit.paste_cells", QT_TRANSLATE_NOOP("Actions", "&Paste Cells"), "",
        QT_TRANSLATE_NOOP("Actions", "Cells from a spreadsheet, from the chosen cell on (Ctrl+V)")},
    ActionText{"edit.vary", QT_TRANSLATE_NOOP("Actions", "Mark as &Variable"), "Ctrl+M",
               QT_TRANSLATE_NOOP("Actions",
                                 "Let a fit vary the numbers in the chosen cells, or no longer")},
    ActionText{"edit.auto_size", QT_TRANSLATE_NOOP("Actions", "A&utomatic Semi-Diameter"), "",
               QT_TRANSLATE_NOOP("Actions", "Let the direct beam size the chosen surfaces")},
    ActionText{
        "edit.own_thickness", QT_TRANSLATE_NOOP("Actions", "&Own Thickness in This Configuration"),
        "",
        QT_TRANSLATE_NOOP(
            "Actions",
            "The chosen surface's thickness differs in this configuration, or is as listed")},
    ActionText{"edit.scale", QT_TRANSLATE_NOOP("Actions", "Sca&le Lens…"), "",
               QT_TRANSLATE_NOOP("Actions", "Every length times a factor, or to a focal length")},
    ActionText{"edit.reverse", QT_TRANSLATE_NOOP("Actions", "&Reverse Lens"), "",
               QT_TRANSLATE_NOOP("Actions", "Turn the lens end for end")},
    ActionText{
        "edit.absorption", QT_TRANSLATE_NOOP("Actions", "Glasses A&bsorb"), "",
        QT_TRANSLATE_NOOP(
            "Actions", "Internal transmittance by the glasses' catalogues; else glass is lossless"),
        true},
    ActionText{"ghosts.copy", QT_TRANSLATE_NOOP("Actions", "&Copy Ghosts"), "",
               QT_TRANSLATE_NOOP("Actions", "The chosen rows with every digit, for a sheet")},
    ActionText{"ghosts.clear", QT_TRANSLATE_NOOP("Actions", "Clear &Selection"), "Esc",
               QT_TRANSLATE_NOOP("Actions", "Select no ghost")},
    ActionText{"ghosts.all", QT_TRANSLATE_NOOP("Actions", "Show &All"), "",
               QT_TRANSLATE_NOOP("Actions", "List every ghost"), true},
    ActionText{"ghosts.above_3",
               QT_TRANSLATE_NOOP("Actions", "Show Those Above 1/1000 of the Strongest"), "",
               QT_TRANSLATE_NOOP("Actions", "Leave weak ghosts out of the list"), true},
    ActionText{"ghosts.above_2",
               QT_TRANSLATE_NOOP("Actions", "Show Those Above 1/100 of the Strongest"), "",
               QT_TRANSLATE_NOOP("Actions", "Leave weak ghosts out of the list"), true},
    ActionText{"ghosts.filter", QT_TRANSLATE_NOOP("Actions", "&Filter…"), "Ctrl+F",
               QT_TRANSLATE_NOOP("Actions", "Name the ghosts to list, in words")},
    ActionText{"ghosts.as_table", QT_TRANSLATE_NOOP("Actions", "As &Table"), "",
               QT_TRANSLATE_NOOP("Actions", "One row for each ghost"), true},
    ActionText{
        "ghosts.as_matrix", QT_TRANSLATE_NOOP("Actions", "As &Matrix"), "",
        QT_TRANSLATE_NOOP("Actions",
                          "Surfaces by surfaces, coloured by the flux of the ghost of each pair"),
        true},
    ActionText{"ghosts.as_surfaces", QT_TRANSLATE_NOOP("Actions", "By &Surface"), "",
               QT_TRANSLATE_NOOP(
                   "Actions", "What each surface feeds: which should get the better coating first"),
               true},
    ActionText{"compare.pin", QT_TRANSLATE_NOOP("Actions", "&Pin as A"), "Ctrl+Shift+A",
               QT_TRANSLATE_NOOP(
                   "Actions",
                   "Keep the lens as it is now, to compare what you edit from here on with it")},
    ActionText{
        "compare.restore", QT_TRANSLATE_NOOP("Actions", "&Take A Back"), "",
        QT_TRANSLATE_NOOP("Actions",
                          "The lens becomes the pinned one again; one step that can be undone")},
    ActionText{"compare.unpin", QT_TRANSLATE_NOOP("Actions", "&Unpin A"), "",
               QT_TRANSLATE_NOOP("Actions", "End the comparison")},
    ActionText{
        "compare.split", QT_TRANSLATE_NOOP("Actions", "&Split the Flare"), "",
        QT_TRANSLATE_NOOP("Actions", "A on the left of a divider that you drag, B on its right"),
        true},
    ActionText{"compare.blink", QT_TRANSLATE_NOOP("Actions", "&Blink the Flare"), "Ctrl+B",
               QT_TRANSLATE_NOOP("Actions", "A and B in turn, each for a moment"), true},
    ActionText{"flare.false_color", QT_TRANSLATE_NOOP("Actions", "&False Colour"), "Ctrl+L",
               QT_TRANSLATE_NOOP("Actions", "Irradiance in colours, logarithmic, with a scale"),
               true},
    ActionText{"flare.clipping", QT_TRANSLATE_NOOP("Actions", "&Clipping Warning"), "Ctrl+K",
               QT_TRANSLATE_NOOP("Actions", "Mark what is brighter than the screen can show"),
               true},
    ActionText{"flare.full_screen", QT_TRANSLATE_NOOP("Actions", "F&ull Screen"), "F11",
               QT_TRANSLATE_NOOP("Actions", "The flare alone, on all of the screen"), true},
    ActionText{"tone.soft", QT_TRANSLATE_NOOP("Actions", "&Soft Shoulder"), "",
               QT_TRANSLATE_NOOP("Actions", "Linear up to 0.8, then bent towards white"), true},
    ActionText{"tone.linear", QT_TRANSLATE_NOOP("Actions", "&Linear"), "",
               QT_TRANSLATE_NOOP("Actions", "Linear, cut off at white"), true},
    ActionText{"tone.log", QT_TRANSLATE_NOOP("Actions", "Lo&garithmic"), "",
               QT_TRANSLATE_NOOP("Actions", "Eight stops below white, evenly"), true},
    ActionText{
        "layout.fields", QT_TRANSLATE_NOOP("Actions", "&Several Fields"), "",
        QT_TRANSLATE_NOOP("Actions", "Direct rays on axis, at 0.7 of the field and at its edge"),
        true},
    ActionText{"layout.marks", QT_TRANSLATE_NOOP("Actions", "&Pupils and Foci"), "",
               QT_TRANSLATE_NOOP(
                   "Actions",
                   "Entrance and exit pupil, focal and principal points, foci of chosen ghosts"),
               true},
    ActionText{"layout.stopped", QT_TRANSLATE_NOOP("Actions", "Stopped &Rays"), "",
               QT_TRANSLATE_NOOP("Actions",
                                 "Rays of ghosts that do not arrive, up to where they are stopped"),
               true},
    ActionText{"layout.measure", QT_TRANSLATE_NOOP("Actions", "&Measure"), "Ctrl+Shift+M",
               QT_TRANSLATE_NOOP("Actions", "Drag in the layout to measure a distance"), true},
    ActionText{"layout.export", QT_TRANSLATE_NOOP("Actions", "Export La&yout…"), "",
               QT_TRANSLATE_NOOP("Actions", "As SVG, PDF or PNG")},
    ActionText{
        "sweep.run", QT_TRANSLATE_NOOP("Actions", "Run the S&weep"), "",
        QT_TRANSLATE_NOOP(
            "Actions", "One number of the lens or the light through its range: flares and curves")},
    ActionText{"check.show", QT_TRANSLATE_NOOP("Actions", "C&heck the Lens"), "",
               QT_TRANSLATE_NOOP("Actions", "What is suspicious in it")},
    ActionText{"report.copy", QT_TRANSLATE_NOOP("Actions", "&Copy Report"), "",
               QT_TRANSLATE_NOOP("Actions", "The report's lines as text")},
    ActionText{"report.all", QT_TRANSLATE_NOOP("Actions", "Show &All Lines"), "",
               QT_TRANSLATE_NOOP("Actions", "Everything that was read"), true},
    ActionText{"report.matters", QT_TRANSLATE_NOOP("Actions", "Show What &Matters"), "",
               QT_TRANSLATE_NOOP("Actions", "Only what changes ghosts or has to be mended"), true},
    ActionText{"first_order.copy", QT_TRANSLATE_NOOP("Actions", "&Copy First-Order Data"), "",
               QT_TRANSLATE_NOOP("Actions", "With every digit, for a sheet")},
    ActionText{"view.fit", QT_TRANSLATE_NOOP("Actions", "&Fit Layout"), "Ctrl+0",
               QT_TRANSLATE_NOOP("Actions", "The whole lens in the layout")},
    ActionText{"view.expose", QT_TRANSLATE_NOOP("Actions", "Auto &Exposure"), "Ctrl+Shift+0",
               QT_TRANSLATE_NOOP("Actions", "Expose for all but the brightest half per cent")},
    ActionText{"view.aspheres", QT_TRANSLATE_NOOP("Actions", "&Conics and Aspheres"), "",
               QT_TRANSLATE_NOOP("Actions", "Show these columns also where the lens has none"),
               true},
    ActionText{"view.comments", QT_TRANSLATE_NOOP("Actions", "&Comments"), "",
               QT_TRANSLATE_NOOP("Actions", "Show the surfaces' comments"), true},
    ActionText{"view.curvatures", QT_TRANSLATE_NOOP("Actions", "C&urvatures Instead of Radii"), "",
               QT_TRANSLATE_NOOP("Actions", "Show and take 1/R in 1/mm in the first column"), true},
    ActionText{"view.light_theme", QT_TRANSLATE_NOOP("Actions", "&Light Theme"), "",
               QT_TRANSLATE_NOOP("Actions", "Dark letters on a light ground"), true},
    ActionText{"engine.automatic", QT_TRANSLATE_NOOP("Actions", "&Automatic"), "",
               QT_TRANSLATE_NOOP("Actions", "Draw flares with whichever was faster in a trial"),
               true},
    ActionText{"engine.cpu", QT_TRANSLATE_NOOP("Actions", "&CPU"), "",
               QT_TRANSLATE_NOOP("Actions", "Draw flares on the processor's cores"), true},
    ActionText{"engine.opengl", QT_TRANSLATE_NOOP("Actions", "&OpenGL"), "",
               QT_TRANSLATE_NOOP("Actions", "Draw flares on the graphics card, as long as it can"),
               true},
    ActionText{"view.next_panel", QT_TRANSLATE_NOOP("Actions", "&Next Panel"), "F6",
               QT_TRANSLATE_NOOP("Actions", "The keyboard goes to the next panel")},
    ActionText{"view.previous_panel", QT_TRANSLATE_NOOP("Actions", "&Previous Panel"), "Shift+F6",
               QT_TRANSLATE_NOOP("Actions", "The keyboard goes to the panel before")},
    ActionText{"view.larger_text", QT_TRANSLATE_NOOP("Actions", "&Larger Text"), "Ctrl++",
               QT_TRANSLATE_NOOP("Actions", "All letters a tenth larger")},
    ActionText{"view.smaller_text", QT_TRANSLATE_NOOP("Actions", "&Smaller Text"), "Ctrl+-",
               QT_TRANSLATE_NOOP("Actions", "All letters a tenth smaller")},
    ActionText{"view.safe_colors", QT_TRANSLATE_NOOP("Actions", "Colours for All &Eyes"), "",
               QT_TRANSLATE_NOOP("Actions", "Colours that colour-blind eyes tell apart"), true},
    ActionText{"view.reset", QT_TRANSLATE_NOOP("Actions", "&Restore Panels"), "",
               QT_TRANSLATE_NOOP("Actions", "All panels where they were at first")},
    ActionText{"help.guide", QT_TRANSLATE_NOOP("Actions", "&Help on This Panel"), "F1",
               QT_TRANSLATE_NOOP("Actions", "The user guide's page on the panel in use")},
    ActionText{
        "help.commands", QT_TRANSLATE_NOOP("Actions", "&Find a Command…"), "Ctrl+Shift+P",
        QT_TRANSLATE_NOOP("Actions", "Search everything that this window can do, and do it")},
    ActionText{"help.shortcuts", QT_TRANSLATE_NOOP("Actions", "&Keyboard Shortcuts"), "Ctrl+F1",
               QT_TRANSLATE_NOOP("Actions", "Every key, on one page")},
    ActionText{"help.tour", QT_TRANSLATE_NOOP("Actions", "&Tour"), "",
               QT_TRANSLATE_NOOP("Actions", "Three things to begin with")},
    ActionText{"help.about", QT_TRANSLATE_NOOP("Actions", "&About Ghostlight"), "",
               QT_TRANSLATE_NOOP("Actions", "Version and licence")},
};

}  // namespace

std::span<const ActionText> action_texts() { return texts; }

Actions::Actions(QWidget* window) : QObject(window) {
    for (const ActionText& text : texts) {
        auto* action = new QAction(QCoreApplication::translate("Actions", text.text), this);
        action->setObjectName(text.id);
        action->setShortcut(QKeySequence(QString::fromUtf8(text.keys)));
        const QString tip = QCoreApplication::translate("Actions", text.tip);
        const QString keys = action->shortcut().toString(QKeySequence::NativeText);
        action->setStatusTip(tip);
        action->setToolTip(keys.isEmpty() ? tip : QStringLiteral("%1 (%2)").arg(tip, keys));
        action->setCheckable(text.checkable);
        window->addAction(action);  // keys work even while no menu shows the action
        actions_.insert(text.id, action);
    }
}

QAction& Actions::operator[](const QString& id) const {
    QAction* action = actions_.value(id);
    Q_ASSERT_X(action != nullptr, "Actions", qPrintable("no action " + id));
    return *action;
}

void Actions::on(const QString& id, std::function<void()> run) {
    connect(&(*this)[id], &QAction::triggered, this, [run = std::move(run)] { run(); });
}

void Actions::fill(QMenu& menu, const QStringList& ids) const {
    for (const QString& id : ids) {
        if (id == "-") {
            menu.addSeparator();
        } else {
            menu.addAction(&(*this)[id]);
        }
    }
}

QMenu* Actions::add_menu(QMenuBar& bar, const QString& title, const QStringList& ids) const {
    QMenu* menu = bar.addMenu(title);
    fill(*menu, ids);
    return menu;
}

}  // namespace ghostlight
