// What helps people find their way in the window: help, commands, tour, gallery, the keyboard's way
// from panel to panel, and how large and in which colours it all is.

#include <QApplication>
#include <QDockWidget>
#include <QLineEdit>
#include <QMenuBar>

#include <algorithm>

#include "core/io/lens_file.h"
#include "widgets/command_palette.h"
#include "widgets/file_actions.h"
#include "widgets/file_watch.h"
#include "widgets/flare_view.h"
#include "widgets/gl_view.h"
#include "widgets/help_pages.h"
#include "widgets/help_window.h"
#include "widgets/lens_gallery.h"
#include "widgets/lens_thumbnails.h"
#include "widgets/main_window.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/flare_panel.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/prescription_panel.h"
#include "widgets/panels/scene_bar.h"
#include "widgets/settings.h"
#include "widgets/theme.h"
#include "widgets/tour.h"

namespace ghostlight {

namespace {

constexpr const char* first_lens = "tessar_brendel_100_f2.8.json";
constexpr double text_step = 0.1;

HelpWindow& help_window(QWidget& window) {
    auto* help = window.findChild<HelpWindow*>();
    return help != nullptr ? *help : *new HelpWindow(&window);
}

/// The part of a panel that the keyboard goes to.
QWidget* first_field(QWidget& panel) {
    if (panel.focusPolicy() != Qt::NoFocus) {
        return &panel;
    }
    const auto children = panel.findChildren<QWidget*>();
    const auto found = std::ranges::find_if(children, [&panel](const QWidget* child) {
        return child->focusPolicy() != Qt::NoFocus && child->isVisibleTo(&panel) &&
               child->isEnabled();
    });
    return found == children.end() ? &panel : *found;
}

/// In the order in which they came: that of their parent's children changes whenever one is raised.
QList<QDockWidget*> docks_in_turn(QWidget& window) {
    constexpr const char* turn = "turn";
    QList<QDockWidget*> docks = window.findChildren<QDockWidget*>();
    int next = 0;
    for (const QDockWidget* dock : docks) {
        next = std::max(next, dock->property(turn).toInt() + 1);
    }
    for (QDockWidget* dock : docks) {
        if (!dock->property(turn).isValid()) {
            dock->setProperty(turn, next++);
        }
    }
    std::ranges::sort(docks, {}, [](const QDockWidget* d) { return d->property(turn).toInt(); });
    return docks;
}

bool holds_focus(const QWidget& panel) {
    const QWidget* focus = QApplication::focusWidget();
    return focus != nullptr && (focus == &panel || panel.isAncestorOf(focus));
}

}  // namespace

void MainWindow::connect_guidance() {
    new FileWatch(document_, *banner_, this);
    docks_in_turn(*this);
    actions_.on("file.gallery", [this] { show_gallery(); });
    actions_.on("help.guide", [this] { show_guide(); });
    actions_.on("help.commands", [this] { show_commands(); });
    actions_.on("help.shortcuts",
                [this] { help_window(*this).show_page(tr("Keyboard"), shortcuts_page(*this)); });
    actions_.on("help.about", [this] {
        help_window(*this).show_page(tr("About Ghostlight"), about_page(gl_support()));
    });
    actions_.on("view.next_panel", [this] { go_to_panel(1); });
    actions_.on("view.previous_panel", [this] { go_to_panel(-1); });
    connect_looks();

    auto* tour = new Tour(
        {{flare_, tr("The light"),
          tr("Drag in the picture to move the light; the ring shows where it is. The flare, the "
             "rays and the table follow. The wheel changes the exposure.")},
         {ghosts_, tr("The table"),
          tr("Each row is one ghost: light reflected at two surfaces. Click one, and its rays "
             "appear in the layout and its light in the picture.")},
         {prescription_, tr("The coating"),
          tr("Double-click a coating in the prescription and type another, such as “none” or "
             "“MgF2 λ/4 550”: the ghosts of that surface change at once. Ctrl+Z takes it back.")}},
        this);
    connect(tour, &Tour::step_begins, this, [](QWidget* target) {
        if (auto* dock = qobject_cast<QDockWidget*>(target->parentWidget())) {
            dock->show();
            dock->raise();
        }
    });
    connect(tour, &Tour::ended, this, [] { settings::set_tour_seen(); });
    actions_.on("help.tour", [tour] { tour->begin(); });

    if (!gl_support().is_usable && settings::is_news(gl_support().reason)) {
        banner_->show_text("opengl",
                           tr("The processor draws everything: %1. Nothing is missing, but "
                              "pictures are slower.")
                               .arg(gl_support().reason));
    }
}

void MainWindow::connect_looks() {
    const auto change = [this](const Look& look) {
        if (remembers_) {
            settings::set_look(look);
        }
        apply_theme(*qApp, current_theme(), look);
    };
    const auto scale_by = [change](double step) {
        Look look = current_look();
        look.text_scale = std::clamp(look.text_scale + step, least_text_scale, most_text_scale);
        change(look);
    };
    actions_.on("view.larger_text", [scale_by] { scale_by(text_step); });
    actions_.on("view.smaller_text", [scale_by] { scale_by(-text_step); });
    QAction& safe = actions_["view.safe_colors"];
    safe.setChecked(current_look().safe_colors);
    actions_.on("view.safe_colors", [this, change, &safe] {
        Look look = current_look();
        look.safe_colors = safe.isChecked();
        change(look);
        scene_update_.start();
    });
}

void MainWindow::welcome() {
    if (!remembers_ || !settings::tour_is_due()) {
        return;
    }
    try {
        if (document_.is_empty()) {
            open(data_directory() / first_lens);
        }
        actions_["help.tour"].trigger();
    } catch (const Error&) {
        // Nothing is bundled here: the empty window says what to do.
    }
}

void MainWindow::show_guide() {
    QString title;
    for (const QDockWidget* dock : findChildren<QDockWidget*>()) {
        if (holds_focus(*dock)) {
            title = guide_title(dock->objectName());
        }
    }
    if (holds_focus(*flare_)) {
        title = QStringLiteral("Flare");
    } else if (holds_focus(*scene_bar_)) {
        title = QStringLiteral("Scene");
    }
    if (!help_window(*this).show_guide(title)) {
        banner_->show_text("guide",
                           tr("The user guide, docs/user-guide.md, is not installed here."));
    }
}

void MainWindow::show_commands() {
    auto* commands = new CommandPalette(all_commands(*menuBar(), this->QWidget::actions()), this);
    commands->show();
    commands->line().setFocus();
}

void MainWindow::show_gallery() {
    try {
        auto* gallery = new LensGallery(
            bundled_lenses(), remembers_ ? LensThumbnails::default_cache() : QString(), this);
        connect(gallery, &LensGallery::chosen, this,
                [this](const std::filesystem::path& file) { open(file); });
        gallery->show();
    } catch (const Error& error) {
        banner_->show_text("file", QString::fromUtf8(error.what()));
    }
}

void MainWindow::go_to_panel(int step) {
    QList<QWidget*> panels{scene_bar_, flare_};
    for (QDockWidget* dock : docks_in_turn(*this)) {
        if (!dock->isHidden() && dock->widget() != nullptr) {
            panels << dock->widget();
        }
    }
    const auto now = std::ranges::find_if(panels, [](const QWidget* p) { return holds_focus(*p); });
    const auto count = static_cast<int>(panels.size());
    const int from = now == panels.end() ? -1 : static_cast<int>(now - panels.begin());
    const int to = from < 0 ? (step > 0 ? 0 : count - 1) : (from + step + count) % count;
    QWidget& panel = *panels[to];
    if (auto* dock = qobject_cast<QDockWidget*>(panel.parentWidget())) {
        dock->raise();  // it may be behind a tab
    }
    first_field(panel)->setFocus(Qt::TabFocusReason);
}

}  // namespace ghostlight
