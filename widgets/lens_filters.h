#pragma once

#include <QString>

#include <filesystem>

namespace ghostlight {

// The filters of file dialogs, from the list of formats.

/// "All lens files (*.json *.zmx …);;Zemax (*.zmx);;…;;All files (*)".
QString lens_open_filter();

/// Those that can be written.
QString lens_export_filter();

/// The extension of our own format.
bool has_own_extension(const std::filesystem::path& file);

}  // namespace ghostlight
