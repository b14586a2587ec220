#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "core/optics/prescription.h"

namespace ghostlight::cli {

/// What overrides the stop's shape and what lies on it.
struct StopOptions {
    std::string blades, rotation, curvature, mask, dust, scratches, fingerprint, seed;
};
void add_stop(CLI::App& command, StopOptions& options, const std::string& group);

/// Writes what was given into a stop. Throws Error naming the option.
void override_stop_shape(Stop& stop, const StopOptions& options);

}  // namespace ghostlight::cli
