#include "tests/support/test_paths.h"

namespace ghostlight {

std::filesystem::path test_data_folder() { return GHOSTLIGHT_TEST_DATA_DIR; }
std::filesystem::path lens_folder() { return GHOSTLIGHT_LENS_DIR; }
std::filesystem::path cli_program() { return GHOSTLIGHT_CLI_PATH; }
std::filesystem::path gui_program() { return GHOSTLIGHT_GUI_PATH; }

}  // namespace ghostlight
