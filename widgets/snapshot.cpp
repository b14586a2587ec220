#include "widgets/snapshot.h"

#include <QAbstractScrollArea>
#include <QDeadlineTimer>
#include <QDockWidget>
#include <QEventLoop>
#include <QHeaderView>
#include <QPixmap>
#include <QScrollBar>
#include <QTableView>
#include <QTimer>

#include <algorithm>

#include "core/error.h"
#include "core/io/image_file.h"
#include "core/io/lens_file.h"
#include "core/io/table_file.h"
#include "widgets/lens_thumbnails.h"
#include "widgets/main_window.h"
#include "widgets/models/ghost_table_model.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/flare_panel.h"
#include "widgets/panels/ghost_panel.h"

namespace ghostlight {

namespace {

constexpr int timeout_ms = 300'000;
/// For the last drawing to reach the screen.
constexpr int drawing_ms = 300;

void run_events(int for_ms) {
    QEventLoop loop;
    QTimer::singleShot(for_ms, &loop, &QEventLoop::quit);
    loop.exec();
}

void write_picture(QWidget& of, const std::filesystem::path& file) {
    if (!of.grab().save(QString::fromStdString(file.string()))) {
        throw Error({"cannot write the picture", file.string(), {}, {}, {}});
    }
}

/// How much higher a panel would have to be for all of it to be seen, in px.
int hidden_height_px(const QWidget& panel) {
    const auto* area = panel.findChild<QAbstractScrollArea*>();
    const auto* table = qobject_cast<const QTableView*>(area);
    return table  ? table->verticalHeader()->length() - table->viewport()->height()
           : area ? area->verticalScrollBar()->maximum()
                  : 0;
}

/// The panels that share a place, where only one is seen, or all there are: each whole, as
/// panel_NAME.png.
void write_panels(MainWindow& window, const std::filesystem::path& folder, SnapshotPanels which) {
    constexpr int highest_px = 2000, panel_timeout_ms = 20000;
    constexpr int least_px = 380;  // about what opening one at the bottom gives it
    const QByteArray places = window.saveState();
    const bool every = which == SnapshotPanels::every;
    if (every) {
        write_picture(window.flare_panel(), folder / "panel_flare.png");
    }
    QList<QDockWidget*> wanted_docks;
    for (QDockWidget* dock : window.findChildren<QDockWidget*>()) {
        if (every || (!dock->isHidden() && !window.tabifiedDockWidgets(dock).isEmpty())) {
            wanted_docks << dock;
        }
    }
    for (QDockWidget* dock : wanted_docks) {
        dock->show();
        dock->raise();
        run_events(drawing_ms);
        wait_until_settled(window, panel_timeout_ms);  // some work only while they are seen
        const QSize size = dock->size().expandedTo({0, least_px});
        dock->setFloating(true);
        dock->resize(size);
        run_events(drawing_ms);
        const int wanted = size.height() + std::max(0, hidden_height_px(*dock));
        dock->resize(size.width(), std::min(wanted, highest_px));
        run_events(drawing_ms);
        write_picture(*dock, folder / ("panel_" + dock->objectName().toStdString() + ".png"));
        dock->setFloating(false);
    }
    window.restoreState(places);
}

/// The windows that come by an action, as window_NAME.png.
void write_windows(MainWindow& window, const std::filesystem::path& folder) {
    constexpr std::pair<const char*, const char*> windows[] = {{"help.guide", "help"},
                                                               {"help.commands", "command_palette"},
                                                               {"file.gallery", "gallery"},
                                                               {"help.tour", "tour"}};
    for (const auto& [action, name] : windows) {
        window.actions()[action].trigger();
        auto* shown = window.findChild<QWidget*>(name);
        if (shown == nullptr) {
            throw Error(std::string("no window ") + name);
        }
        if (auto* thumbnails = shown->findChild<LensThumbnails*>()) {
            QEventLoop until_drawn;
            QObject::connect(thumbnails, &LensThumbnails::finished, &until_drawn,
                             &QEventLoop::quit);
            QTimer::singleShot(timeout_ms, &until_drawn, &QEventLoop::quit);
            until_drawn.exec();
        }
        run_events(drawing_ms);
        const bool is_inside = !shown->isWindow();
        write_picture(is_inside ? window : *shown,
                      folder / (std::string("window_") + name + ".png"));
        shown->close();
        run_events(drawing_ms);
    }
}

}  // namespace

bool wait_until_settled(MainWindow& window, int limit_ms) {
    const QDeadlineTimer deadline(limit_ms);
    while (!window.is_settled()) {
        if (deadline.hasExpired()) {
            return false;
        }
        run_events(10);
    }
    return true;
}

void write_snapshot(MainWindow& window, const std::filesystem::path& folder,
                    SnapshotPanels panels) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) {
        throw Error({"cannot make the folder: " + failure.message(), folder.string(), {}, {}, {}});
    }
    if (!wait_until_settled(window, timeout_ms)) {
        throw Error("the views were not ready in " + std::to_string(timeout_ms / 1000) + " s");
    }
    run_events(drawing_ms);
    write_picture(window, folder / "workbench.png");
    write_panels(window, folder, panels);
    if (panels == SnapshotPanels::every) {
        write_windows(window, folder);
    }
    const auto table = window.ghost_panel().model().table();
    if (!table || window.ghost_panel().model().is_stale() || !window.picture()) {
        throw Error(window.banner().text().isEmpty() ? std::string("there is nothing to show")
                                                     : window.banner().text().toStdString());
    }
    write_file_safely(folder / "ghosts.csv", ghost_table_csv(*table));
    write_exr(*window.picture()->image, folder / "flare.exr");
}

}  // namespace ghostlight
