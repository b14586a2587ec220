#pragma once

#include <filesystem>

// Where tests find things. In one source, so that no other one's compilation depends on the
// folder of the checkout: compiler caches serve all checkouts.

namespace ghostlight {

/// tests/data
std::filesystem::path test_data_folder();
/// lenses
std::filesystem::path lens_folder();
/// The built ghostlight-cli.
std::filesystem::path cli_program();
/// The built ghostlight, where there is one.
std::filesystem::path gui_program();

}  // namespace ghostlight
