#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <string_view>

#include "core/flare/flare_image.h"

namespace ghostlight::cli {

/// How a picture is made.
struct MethodOptions {
    std::string method = "planned", tolerance = "0.005", grid, culled, coating_model = "exact";
};
void add_method(CLI::App& command, MethodOptions& options);
/// Throws Error naming the option that does not do.
void set_method(const MethodOptions& options, FlareRequest& request);

/// "planned", "uniform", "paraxial" or "reference".
std::string_view method_name(FlareMethod method);

}  // namespace ghostlight::cli
