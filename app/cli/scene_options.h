#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/cli/spectrum_option.h"
#include "core/flare/scene.h"

namespace ghostlight::cli {

/// Lights, layers and artistic changes of a picture. Those not given are the lens file's own with
/// --scene, else plain.
struct SceneOptions {
    LightOptions light{.field = "0"};
    SpectrumOptions spectrum;
    std::string size;
    std::vector<std::string> lights, gains, styles;
    std::string layers, backdrop, folded, kernel, scatter, exaggerate, jitter, seed;
    bool stored = false;
};
void add_scene(CLI::App& command, SceneOptions& options);

/// Throws Error naming the option that does not do.
Scene scene_of(const SceneOptions& options, const LoadedLens& loaded);

/// A light: "DEG[,AZIMUTH][,spectrum=NAME][,size=SIZE][,ev=STOPS][,name=TEXT]". `like` gives what
/// is left out.
Light parse_light(std::string_view option, std::string_view text, const Light& like);

}  // namespace ghostlight::cli
