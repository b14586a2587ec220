#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/optics/spectral_table.h"

namespace ghostlight {

/// The same index at every wavelength.
struct ConstantIndex {
    double n = 1.0;
    bool operator==(const ConstantIndex&) const = default;
};

/// A glass known only by its index at d and its Abbe number:
/// n(λ) = nd + B(1/λ² − 1/λd²), which returns nd and Vd exactly.
struct ModelGlass {
    double nd = 1.5168;
    double vd = 64.17;
    bool operator==(const ModelGlass&) const = default;
};

/// A closed form of refractiveindex.info, by its number there (λ in µm):
/// 1: n² = 1 + c0 + Σ c(2i−1) λ²/(λ² − c(2i)²);  2: the same with c(2i) not squared (Sellmeier);
/// 3: n² = c0 + Σ c(2i−1) λ^c(2i);  4: n² = c0 + c1 λ^c2/(λ² − c3^c4) + c5 λ^c6/(λ² − c7^c8)
/// + Σ c(2i−1) λ^c(2i) from c9;  5: n = c0 + Σ c(2i−1) λ^c(2i) (Cauchy);
/// 6: n = 1 + c0 + Σ c(2i−1)/(c(2i) − λ⁻²) (gases);
/// 7: n = c0 + c1 L + c2 L² + c3 λ² + c4 λ⁴ + c5 λ⁶, L = 1/(λ² − 0.028) (Herzberger);
/// 8: (n² − 1)/(n² + 2) = c0 + c1 λ²/(λ² − c2) + c3 λ²;
/// 9: n² = c0 + c1/(λ² − c2) + c3 (λ − c4)/((λ − c4)² + c5).
struct FormulaGlass {
    int formula = 2;
    std::vector<double> coefficients;
    double min_nm = 0.0;  ///< valid range; 0 and infinity where the source states none
    double max_nm = 0.0;
    bool operator==(const FormulaGlass&) const = default;
};

/// A glass that a file names and nobody knows: it has no index until somebody says which it is.
struct UnknownGlass {
    std::string why;  ///< "not in the catalogues SCHOTT, OHARA, and the file gives no nd"
    bool operator==(const UnknownGlass&) const = default;
};

/// A closed form of an AGF catalogue, by its number there (λ in µm, a0… in the order of `CD`):
/// 1 Schott: n² = a0 + a1 λ² + a2 λ⁻² + a3 λ⁻⁴ + a4 λ⁻⁶ + a5 λ⁻⁸;
/// 2, 6, 11 Sellmeier 1, 3, 5: n² = 1 + Σ K λ²/(λ² − L) of three, four, five pairs K L;
/// 3 Herzberger: n = a0 + a1 L + a2 L² + a3 λ² + a4 λ⁴ + a5 λ⁶, L = 1/(λ² − 0.028);
/// 4 Sellmeier 2: n² = 1 + a0 + a1 λ²/(λ² − a2²) + a3/(λ² − a4²);
/// 5 Conrady: n = a0 + a1/λ + a2/λ^3.5;
/// 7 Handbook 1: n² = a0 + a1/(λ² − a2) − a3 λ²;  8 Handbook 2: n² = a0 + a1 λ²/(λ² − a2) − a3 λ²;
/// 9 Sellmeier 4: n² = a0 + a1 λ²/(λ² − a2) + a3 λ²/(λ² − a4);
/// 10 Extended: as 1, and a6 λ⁻¹⁰ + a7 λ⁻¹²;  12 Extended 2: as 1, and a6 λ⁴ + a7 λ⁶;
/// 13 Extended 3: n² = a0 + a1 λ² + a2 λ⁴ + a3 λ⁻² + … + a8 λ⁻¹².
struct AgfGlass {
    int formula = 2;
    std::vector<double> coefficients;
    double min_nm = 0.0;  ///< valid range; 0 where the source states none
    double max_nm = 0.0;
    bool operator==(const AgfGlass&) const = default;
};

/// An index measured at some wavelengths, and a smooth curve between them (`smooth_at`).
struct TabulatedGlass {
    SpectralTable index;
    /// Beyond the table: the end's value, as coating files mean it, who often give one wavelength.
    /// Otherwise there is no index there.
    bool held_beyond = false;
    bool operator==(const TabulatedGlass&) const = default;
};

using Dispersion =
    std::variant<ConstantIndex, ModelGlass, FormulaGlass, UnknownGlass, AgfGlass, TabulatedGlass>;

/// What is left of light of one wavelength after some glass, surfaces aside.
struct InternalTransmittance {
    double wavelength_nm = 0.0;
    double share = 1.0;
    double thickness_mm = 0.0;
    bool operator==(const InternalTransmittance&) const = default;
};

/// What fills the space after a surface. `name` is the catalogue's, or empty.
struct Medium {
    std::string name;
    Dispersion dispersion = ConstantIndex{};
    /// By rising wavelength and thickness, as a catalogue lists it; empty: lossless. Used where the
    /// lens asks for it (Prescription::internal_transmittance).
    std::vector<InternalTransmittance> transmittance = {};
    bool operator==(const Medium&) const = default;
};

/// Index at a wavelength in standard air. Throws Error naming the glass, the wavelength and the
/// range when the wavelength is outside the stated range or the formula has a pole there
/// (n² ≤ 1 for anything but a constant index).
double refractive_index(const Medium& medium, double wavelength_nm);

/// The wavelengths, shortest and longest, at which there is an index; 0 or infinity where its
/// source states no end, none for a glass that nobody knows.
std::optional<std::pair<double, double>> wavelength_range_nm(const Medium& medium);

/// (nd − 1)/(nF − nC); infinity without dispersion.
double abbe_number(const Medium& medium);

/// The medium's absorption per mm, −ln τ: linear between the listed wavelengths, and the nearest
/// one counts beyond them. 0 without a table.
double absorption_per_mm(const Medium& medium, double wavelength_nm);

/// The share that is left after `length_mm`, by the Beer–Lambert law. 1 without a table.
double internal_transmittance(const Medium& medium, double wavelength_nm, double length_mm);

/// Air by this project's convention: n = 1 at every wavelength.
bool is_air(const Medium& medium);

/// For people: the name, "air", or the index at d: "n 1.6910".
std::string describe(const Medium& medium);

/// Magnesium fluoride, ordinary ray (Dodge 1984, as on refractiveindex.info): the default layer.
Medium magnesium_fluoride();

/// A set of named glasses; the first entry of a name wins.
struct GlassCatalog {
    std::vector<Medium> glasses;
    /// Case-insensitive look-up; null when there is none.
    const Medium* find(std::string_view name) const;
};

}  // namespace ghostlight
