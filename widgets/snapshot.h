#pragma once

#include <filesystem>

namespace ghostlight {

class MainWindow;

enum class SnapshotPanels { tabbed, every };

/// Waits until the window shows its lens, and writes workbench.png, the panels that share a place,
/// or every one, as panel_NAME.png, ghosts.csv and flare.exr into a folder. Throws Error when
/// something fails; of a lens that cannot be traced the pictures are written before.
void write_snapshot(MainWindow& window, const std::filesystem::path& folder,
                    SnapshotPanels panels = SnapshotPanels::tabbed);

/// Runs the event loop until the window's views are up to date; false after a time-out.
bool wait_until_settled(MainWindow& window, int timeout_ms);

}  // namespace ghostlight
