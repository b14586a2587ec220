#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "app/cli/options.h"
#include "core/flare/spectrum.h"

namespace ghostlight::cli {

/// What light: one wavelength, or a named spectrum.
struct SpectrumOptions {
    std::string wavelength, spectrum;
};
void add_spectrum(CLI::App& command, SpectrumOptions& options);
Spectrum spectrum_of(const SpectrumOptions& options);

/// Where first-order data are taken: the light's own wavelength, or d.
double reference_wavelength_nm(const Spectrum& spectrum);

}  // namespace ghostlight::cli
