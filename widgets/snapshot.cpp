#include "widgets/snapshot.h"

#include <QDeadlineTimer>
#include <QEventLoop>
#include <QPixmap>
#include <QTimer>

#include "core/error.h"
#include "core/io/image_file.h"
#include "core/io/lens_file.h"
#include "core/io/table_file.h"
#include "widgets/main_window.h"
#include "widgets/models/ghost_table_model.h"
#include "widgets/panels/banner.h"
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

void write_snapshot(MainWindow& window, const std::filesystem::path& folder) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) {
        throw Error({"cannot make the folder: " + failure.message(), folder.string(), {}, {}, {}});
    }
    if (!wait_until_settled(window, timeout_ms)) {
        throw Error("the views were not ready in " + std::to_string(timeout_ms / 1000) + " s");
    }
    run_events(drawing_ms);
    const auto table = window.ghost_panel().model().table();
    if (!table || window.ghost_panel().model().is_stale() || !window.picture()) {
        throw Error(window.banner().text().isEmpty() ? std::string("there is nothing to show")
                                                     : window.banner().text().toStdString());
    }
    write_file_safely(folder / "ghosts.csv", ghost_table_csv(*table));
    write_exr(*window.picture()->image, folder / "flare.exr");
    const auto picture = folder / "workbench.png";
    if (!window.grab().save(QString::fromStdString(picture.string()))) {
        throw Error({"cannot write the picture", picture.string(), {}, {}, {}});
    }
}

}  // namespace ghostlight
