#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

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
/// 6: n = 1 + c0 + Σ c(2i−1)/(c(2i) − λ⁻²) (gases).
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

using Dispersion = std::variant<ConstantIndex, ModelGlass, FormulaGlass, UnknownGlass>;

/// What fills the space after a surface. `name` is the catalogue's, or empty.
struct Medium {
    std::string name;
    Dispersion dispersion = ConstantIndex{};
    bool operator==(const Medium&) const = default;
};

/// Index at a wavelength in standard air. Throws Error naming the glass, the wavelength and the
/// range when the wavelength is outside the stated range or the formula has a pole there
/// (n² ≤ 1 for anything but a constant index).
double refractive_index(const Medium& medium, double wavelength_nm);

/// (nd − 1)/(nF − nC); infinity without dispersion.
double abbe_number(const Medium& medium);

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
