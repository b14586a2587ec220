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
    ActionText{"file.open", "&Open…", "Ctrl+O", "Open a lens file"},
    ActionText{"file.gallery", "&Gallery of Bundled Lenses…", "Ctrl+Shift+O",
               "Choose a bundled lens by its layout and its flare"},
    ActionText{"file.save", "&Save", "Ctrl+S", "Save the lens in its file"},
    ActionText{"file.save_as", "Save &As…", "Ctrl+Shift+S", "Save the lens in another file"},
    ActionText{"file.export_lens", "Export &Lens…", "",
               "Write the lens for another program; what its format cannot hold is reported"},
    ActionText{"file.export_ghost", "Export &Unfolded Ghost…", "",
               "The light's way along the chosen ghost as a lens of its own, a .zmx with mirrors"},
    ActionText{"file.glass_folders", "&Glass Folders…", "",
               "Folders with catalogues of glasses besides the bundled ones"},
    ActionText{"file.export_table", "Export Ghost &Table as CSV…", "Ctrl+E",
               "Every column and every digit"},
    ActionText{"file.export_exr", "Export &Flare as EXR…", "Ctrl+Shift+E",
               "Linear irradiance, 32-bit float, upright"},
    ActionText{"file.export_png", "Export Flare as &PNG…", "", "As shown, at the exposure in use"},
    ActionText{"file.quit", "&Quit", "Ctrl+Q", "Close the window"},
    ActionText{"edit.undo", "&Undo", "Ctrl+Z", "Take back the last change"},
    ActionText{"edit.redo", "&Redo", "Ctrl+Shift+Z", "Do it again"},
    ActionText{"edit.mend_glass", "Mend Unknown &Glass…", "Ctrl+G",
               "Go to the first glass that nobody knows, and choose one"},
    ActionText{"edit.insert", "&Insert Surface", "Ctrl+I",
               "A plane in the middle of the gap after the chosen surface"},
    ActionText{"edit.delete", "&Delete Surface", "Ctrl+Del", "Take the chosen surface out"},
    ActionText{"edit.move_up", "Move Surface &Up", "Alt+Up", "Swap with the surface before"},
    ActionText{"edit.move_down", "Move Surface Do&wn", "Alt+Down", "Swap with the surface after"},
    ActionText{"edit.make_stop", "Make It the &Stop", "", "The chosen surface becomes the stop"},
    ActionText{"edit.copy_cells", "&Copy Cells", "",
               "The chosen cells, for a spreadsheet (Ctrl+C)"},
    ActionText{"edit.paste_cells", "&Paste Cells", "",
               "Cells from a spreadsheet, from the chosen cell on (Ctrl+V)"},
    ActionText{"edit.vary", "Mark as &Variable", "Ctrl+M",
               "Let a fit vary the numbers in the chosen cells, or no longer"},
    ActionText{"edit.auto_size", "A&utomatic Semi-Diameter", "",
               "Let the direct beam size the chosen surfaces"},
    ActionText{"edit.own_thickness", "&Own Thickness in This Configuration", "",
               "The chosen surface's thickness differs in this configuration, or is as listed"},
    ActionText{"edit.scale", "Sca&le Lens…", "",
               "Every length times a factor, or to a focal length"},
    ActionText{"edit.reverse", "&Reverse Lens", "", "Turn the lens end for end"},
    ActionText{"edit.absorption", "Glasses A&bsorb", "",
               "Internal transmittance by the glasses' catalogues; else glass is lossless", true},
    ActionText{"ghosts.copy", "&Copy Ghosts", "", "The chosen rows with every digit, for a sheet"},
    ActionText{"ghosts.clear", "Clear &Selection", "Esc", "Select no ghost"},
    ActionText{"ghosts.all", "Show &All", "", "List every ghost", true},
    ActionText{"ghosts.above_3", "Show Those Above 1/1000 of the Strongest", "",
               "Leave weak ghosts out of the list", true},
    ActionText{"ghosts.above_2", "Show Those Above 1/100 of the Strongest", "",
               "Leave weak ghosts out of the list", true},
    ActionText{"ghosts.filter", "&Filter…", "Ctrl+F", "Name the ghosts to list, in words"},
    ActionText{"ghosts.as_table", "As &Table", "", "One row for each ghost", true},
    ActionText{"ghosts.as_matrix", "As &Matrix", "",
               "Surfaces by surfaces, coloured by the flux of the ghost of each pair", true},
    ActionText{"ghosts.as_surfaces", "By &Surface", "",
               "What each surface feeds: which should get the better coating first", true},
    ActionText{"compare.pin", "&Pin as A", "Ctrl+Shift+A",
               "Keep the lens as it is now, to compare what you edit from here on with it"},
    ActionText{"compare.restore", "&Take A Back", "",
               "The lens becomes the pinned one again; one step that can be undone"},
    ActionText{"compare.unpin", "&Unpin A", "", "End the comparison"},
    ActionText{"compare.split", "&Split the Flare", "",
               "A on the left of a divider that you drag, B on its right", true},
    ActionText{"compare.blink", "&Blink the Flare", "Ctrl+B", "A and B in turn, each for a moment",
               true},
    ActionText{"flare.false_color", "&False Colour", "Ctrl+L",
               "Irradiance in colours, logarithmic, with a scale", true},
    ActionText{"flare.clipping", "&Clipping Warning", "Ctrl+K",
               "Mark what is brighter than the screen can show", true},
    ActionText{"flare.full_screen", "F&ull Screen", "F11", "The flare alone, on all of the screen",
               true},
    ActionText{"tone.soft", "&Soft Shoulder", "", "Linear up to 0.8, then bent towards white",
               true},
    ActionText{"tone.linear", "&Linear", "", "Linear, cut off at white", true},
    ActionText{"tone.log", "Lo&garithmic", "", "Eight stops below white, evenly", true},
    ActionText{"layout.fields", "&Several Fields", "",
               "Direct rays on axis, at 0.7 of the field and at its edge", true},
    ActionText{"layout.marks", "&Pupils and Foci", "",
               "Entrance and exit pupil, focal and principal points, foci of chosen ghosts", true},
    ActionText{"layout.stopped", "Stopped &Rays", "",
               "Rays of ghosts that do not arrive, up to where they are stopped", true},
    ActionText{"layout.measure", "&Measure", "Ctrl+Shift+M",
               "Drag in the layout to measure a distance", true},
    ActionText{"layout.export", "Export La&yout…", "", "As SVG, PDF or PNG"},
    ActionText{"sweep.run", "Run the S&weep", "",
               "One number of the lens or the light through its range: flares and curves"},
    ActionText{"check.show", "C&heck the Lens", "", "What is suspicious in it"},
    ActionText{"report.copy", "&Copy Report", "", "The report's lines as text"},
    ActionText{"report.all", "Show &All Lines", "", "Everything that was read", true},
    ActionText{"report.matters", "Show What &Matters", "",
               "Only what changes ghosts or has to be mended", true},
    ActionText{"first_order.copy", "&Copy First-Order Data", "", "With every digit, for a sheet"},
    ActionText{"view.fit", "&Fit Layout", "Ctrl+0", "The whole lens in the layout"},
    ActionText{"view.expose", "Auto &Exposure", "Ctrl+Shift+0",
               "Expose for all but the brightest half per cent"},
    ActionText{"view.aspheres", "&Conics and Aspheres", "",
               "Show these columns also where the lens has none", true},
    ActionText{"view.comments", "&Comments", "", "Show the surfaces' comments", true},
    ActionText{"view.curvatures", "C&urvatures Instead of Radii", "",
               "Show and take 1/R in 1/mm in the first column", true},
    ActionText{"view.light_theme", "&Light Theme", "", "Dark letters on a light ground", true},
    ActionText{"engine.automatic", "&Automatic", "",
               "Draw flares with whichever was faster in a trial", true},
    ActionText{"engine.cpu", "&CPU", "", "Draw flares on the processor's cores", true},
    ActionText{"engine.opengl", "&OpenGL", "",
               "Draw flares on the graphics card, as long as it can", true},
    ActionText{"view.next_panel", "&Next Panel", "F6", "The keyboard goes to the next panel"},
    ActionText{"view.previous_panel", "&Previous Panel", "Shift+F6",
               "The keyboard goes to the panel before"},
    ActionText{"view.larger_text", "&Larger Text", "Ctrl++", "All letters a tenth larger"},
    ActionText{"view.smaller_text", "&Smaller Text", "Ctrl+-", "All letters a tenth smaller"},
    ActionText{"view.safe_colors", "Colours for All &Eyes", "",
               "Colours that colour-blind eyes tell apart", true},
    ActionText{"view.reset", "&Restore Panels", "", "All panels where they were at first"},
    ActionText{"help.guide", "&Help on This Panel", "F1",
               "The user guide's page on the panel in use"},
    ActionText{"help.commands", "&Find a Command…", "Ctrl+Shift+P",
               "Search everything that this window can do, and do it"},
    ActionText{"help.shortcuts", "&Keyboard Shortcuts", "Ctrl+F1", "Every key, on one page"},
    ActionText{"help.tour", "&Tour", "", "Three things to begin with"},
    ActionText{"help.about", "&About Ghostlight", "", "Version and licence"},
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
