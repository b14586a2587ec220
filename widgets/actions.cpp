#include "widgets/actions.h"

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
    ActionText{"edit.absorption", "Glasses A&bsorb", "",
               "Internal transmittance by the glasses' catalogues; else glass is lossless", true},
    ActionText{"ghosts.copy", "&Copy Ghosts", "", "The chosen rows with every digit, for a sheet"},
    ActionText{"ghosts.clear", "Clear &Selection", "Esc", "Select no ghost"},
    ActionText{"ghosts.all", "Show &All", "", "List every ghost", true},
    ActionText{"ghosts.above_3", "Show Those Above 1/1000 of the Strongest", "",
               "Leave weak ghosts out of the list", true},
    ActionText{"ghosts.above_2", "Show Those Above 1/100 of the Strongest", "",
               "Leave weak ghosts out of the list", true},
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
        auto* action = new QAction(QString::fromUtf8(text.text), this);
        action->setObjectName(text.id);
        action->setShortcut(QKeySequence(QString::fromUtf8(text.keys)));
        const QString tip = QString::fromUtf8(text.tip);
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
