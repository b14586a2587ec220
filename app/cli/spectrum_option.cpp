#include "app/cli/spectrum_option.h"

#include "core/units.h"

namespace ghostlight::cli {

void add_spectrum(CLI::App& command, SpectrumOptions& options) {
    CLI::Option* wavelength = add_text(command, "--wavelength", options.wavelength, "NM",
                                       "light of one wavelength, nm; default 587.5618");
    add_text(command, "--spectrum", options.spectrum, "NAME",
             "light of a spectrum: D65, A, E, or a black body such as \"5500 K\"")
        ->excludes(wavelength);
}

Spectrum spectrum_of(const SpectrumOptions& options) {
    if (!options.wavelength.empty())
        return Monochromatic{wavelength_value("--wavelength", options.wavelength)};
    if (!options.spectrum.empty())
        return read_option("--spectrum", [&] { return parse_spectrum(options.spectrum); });
    return Monochromatic{};
}

double reference_wavelength_nm(const Spectrum& spectrum) {
    const auto* line = std::get_if<Monochromatic>(&spectrum);
    return line ? line->wavelength_nm : d_line_nm;
}

}  // namespace ghostlight::cli
