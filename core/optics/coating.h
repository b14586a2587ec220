#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/optics/glass.h"

namespace ghostlight {

/// A bare interface.
struct Uncoated {
    bool operator==(const Uncoated&) const = default;
};

/// The layer whose index is sqrt(n0 n2): no reflection at the centre wavelength, normal incidence.
struct IdealIndex {
    bool operator==(const IdealIndex&) const = default;
};

/// One layer of optical thickness λ0/4 at its centre wavelength, times a factor (1 = nominal):
/// d = factor · λ0 / (4 n1(λ0)).
struct QuarterWave {
    double center_nm = 550.0;
    std::variant<IdealIndex, Medium> layer = magnesium_fluoride();
    double thickness_factor = 1.0;
    bool operator==(const QuarterWave&) const = default;
};

/// A layer of a stack.
struct Layer {
    Medium medium;
    double thickness_nm = 0.0;
    double extinction = 0.0;  ///< k of n + ik (k ≥ 0 absorbs), the same at every wavelength
    /// k at each wavelength instead, where there are entries: linear between them (`linear_at`).
    SpectralTable extinction_table = {};
    bool operator==(const Layer&) const = default;
};

/// Any layers. A stack that a library holds goes by its name there.
struct LayerStack {
    std::vector<Layer> layers;
    /// Ordered from the air instead of from the incoming side: the first layer is the last that
    /// light meets where it goes from glass to air. As libraries list them.
    bool from_air = false;
    std::string name = {};
    bool operator==(const LayerStack&) const = default;
};

/// Shares of the light at one angle and wavelength, for s and for p.
struct MeasuredShares {
    double r_s = 0.0, r_p = 0.0, t_s = 1.0, t_p = 1.0;
    bool operator==(const MeasuredShares&) const = default;
};

/// What somebody measured or computed elsewhere: shares against wavelength and angle. They are
/// linear in wavelength and in the angle's cosine, and the nearest entry counts beyond the table.
/// The angle is the one in the medium of the lower index (the air), from whichever side the light
/// comes: seen from the other side, the interface has the same shares at the refracted angle,
/// which is exact for lossless coatings and for every T. Beyond the critical angle everything is
/// reflected. The phases, which a table does not have, are the bare interface's.
struct MeasuredReflectance {
    std::vector<double> wavelengths_nm;  ///< rising, at least one
    std::vector<double> angles_deg;      ///< rising, at least one, from 0 to 90
    std::vector<MeasuredShares> shares;  ///< wavelength by wavelength, angles running faster
    std::string name = {};
    bool operator==(const MeasuredReflectance&) const = default;
};

/// The same shares at every wavelength, angle and polarisation; what is missing to 1 is absorbed.
struct ConstantReflectance {
    double reflectance = 0.0;
    double transmittance = 1.0;
    bool operator==(const ConstantReflectance&) const = default;
};

using Coating =
    std::variant<Uncoated, QuarterWave, LayerStack, MeasuredReflectance, ConstantReflectance>;

/// One layer at one wavelength.
struct FilmLayer {
    double n = 1.0;
    double k = 0.0;
    double thickness_nm = 0.0;
    bool operator==(const FilmLayer&) const = default;
};

/// What a measured interface does at one angle.
struct FilmAngle {
    double cos_thin = 1.0;  ///< cosine of the angle in the medium of the lower index
    MeasuredShares shares;
    bool operator==(const FilmAngle&) const = default;
};

/// An interface at one wavelength, seen from the side of n_in. Layers of zero thickness are gone
/// and those of a neighbour's index are merged into it, so that equal media mean no reflection.
struct Film {
    double n_in = 1.0;
    std::vector<FilmLayer> layers;
    double n_out = 1.0;
    double wavelength_nm = 587.5618;
    /// By falling cosine, of an interface whose shares are given; then it has no layers.
    std::vector<FilmAngle> angles = {};
    bool operator==(const Film&) const = default;
};

/// The film of a coating between two media at a wavelength, seen from the incoming side.
/// Throws Error for a non-physical layer (n ≤ 0, k < 0, thickness < 0) or table (R + T > 1, …).
Film film_at(const Coating& coating, const Medium& before, const Medium& after,
             double wavelength_nm);

/// The same interface seen from the other side: layers in reverse order.
Film reversed(const Film& film);

/// True when nothing is there that could reflect.
bool is_invisible(const Film& film);

/// True when layers or given shares absorb.
bool is_absorbing(const Film& film);

/// Intensity coefficients of an interface; each R + T = 1 without absorption.
struct Reflectances {
    double r_s = 0.0, r_p = 0.0, t_s = 1.0, t_p = 1.0;
    double r() const { return 0.5 * (r_s + r_p); }
    double t() const { return 0.5 * (t_s + t_p); }
};

/// Exact at every angle from normal to grazing incidence and beyond total reflection.
/// `cos_incidence` is |d·N̂| in the medium n_in, from 0 to 1.
Reflectances reflectances(const Film& film, double cos_incidence);

/// Reads a stack written as "1.0 | 1.38:96.4 | 1.5": media and layers from the incoming side,
/// layers as index[,k]:thickness in nm. Throws Error naming the part that is wrong.
Film parse_stack(std::string_view text, double wavelength_nm);

/// For people: "MgF2 λ/4 550", "3 layers", "none", "R 0.5 %", the name that a library gives.
std::string describe(const Coating& coating);

}  // namespace ghostlight
