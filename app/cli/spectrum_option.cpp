#include "app/cli/spectrum_option.h"

#include "core/io/spectrum_csv.h"
#include "core/units.h"

namespace ghostlight::cli {

void add_spectrum(CLI::App& command, SpectrumOptions& options) {
    CLI::Option* wavelength = add_text(command, "--wavelength", options.wavelength, "NM",
                                       "light of one wavelength, nm; default 587.5618");
    add_text(command, "--spectrum", options.spectrum, "NAME",
             "light of a spectrum: D65, A, E, LED-B3, sodium, a black body such\n"
             "as \"5500 K\", or a table FILE.csv of wavelength, power")
        ->excludes(wavelength);
}

Spectrum spectrum_of(const SpectrumOptions& options) {
    if (!options.wavelength.empty())
        return Monochromatic{wavelength_value("--wavelength", options.wavelength)};
    if (!options.spectrum.empty())
        return read_option("--spectrum", [&] { return spectrum_by_name(options.spectrum); });
    return Monochromatic{};
}

double reference_wavelength_nm(const Spectrum& spectrum) {
    return line_nm(spectrum).value_or(d_line_nm);
}

}  // namespace ghostlight::cli
