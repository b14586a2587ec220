#pragma once

#include <vector>

namespace ghostlight {

/// A value at a wavelength.
struct SpectralValue {
    double wavelength_nm = 0.0;
    double value = 0.0;
    bool operator==(const SpectralValue&) const = default;
};

/// Values by rising wavelength, as somebody measured them.
using SpectralTable = std::vector<SpectralValue>;

/// Linear between the entries; beyond the first and the last, that entry's value. The table has at
/// least one entry.
double linear_at(const SpectralTable& table, double wavelength_nm);

/// For an index: a monotone cubic in 1/λ² through every entry (Fritsch & Butland, SIAM J. Sci.
/// Stat. Comput. 5 (1984) 300), which turns into n = A + B/λ² for two entries and neither
/// overshoots nor rings between them. Beyond the ends, the end's value. At least one entry.
double smooth_at(const SpectralTable& table, double wavelength_nm);

/// True when there is an entry and every wavelength is above 0 and above the one before.
bool has_rising_wavelengths(const SpectralTable& table);

}  // namespace ghostlight
