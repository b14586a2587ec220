#pragma once

#include <CLI/CLI.hpp>

namespace ghostlight::cli {

// Each adds one command to the program. What the command prints, and the names in it that scripts
// rely on, are in docs/command-line.md.

void add_info(CLI::App& program);
void add_trace(CLI::App& program);
void add_coating(CLI::App& program);
void add_coatings(CLI::App& program);
void add_glasses(CLI::App& program);
void add_ghosts(CLI::App& program);
void add_render(CLI::App& program);
void add_starburst(CLI::App& program);
void add_synth(CLI::App& program);
void add_fit(CLI::App& program);
void add_fit_study(CLI::App& program);
void add_plan(CLI::App& program);
void add_veil(CLI::App& program);
void add_composite(CLI::App& program);
void add_accuracy(CLI::App& program);
void add_stability(CLI::App& program);
void add_lenses(CLI::App& program);
void add_convert(CLI::App& program);
void add_check(CLI::App& program);
void add_sweep(CLI::App& program);

}  // namespace ghostlight::cli
