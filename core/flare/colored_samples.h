#pragma once

#include <vector>

#include "core/flare/spectrum.h"

namespace ghostlight {

/// Nodes for integrals over a spectrum, and what each gives to a colour.
struct ColoredSamples {
    std::vector<SpectralSample> samples;
    std::vector<Rgb> colors;  ///< as sample_colors() has them
};

/// At the wavelengths of sample(), with weights and colours that hold the structure of the light's
/// power and of the colour-matching functions: both are integrated with what is cubic between the
/// nodes, so that only what a lens does with the light has to be smooth. A light of lines has
/// these.
ColoredSamples colored_samples(const Spectrum& spectrum, int count);

}  // namespace ghostlight
