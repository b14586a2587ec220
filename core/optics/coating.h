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

/// A layer of a stack. `extinction` is k of n + ik (k ≥ 0 absorbs), the same at every wavelength.
struct Layer {
    Medium medium;
    double thickness_nm = 0.0;
    double extinction = 0.0;
    bool operator==(const Layer&) const = default;
};

/// Any layers, ordered from the incoming side (towards the sensor).
struct LayerStack {
    std::vector<Layer> layers;
    bool operator==(const LayerStack&) const = default;
};

using Coating = std::variant<Uncoated, QuarterWave, LayerStack>;

/// One layer at one wavelength.
struct FilmLayer {
    double n = 1.0;
    double k = 0.0;
    double thickness_nm = 0.0;
    bool operator==(const FilmLayer&) const = default;
};

/// An interface at one wavelength, seen from the side of n_in. Layers of zero thickness are gone
/// and those of a neighbour's index are merged into it, so that equal media mean no reflection.
struct Film {
    double n_in = 1.0;
    std::vector<FilmLayer> layers;
    double n_out = 1.0;
    double wavelength_nm = 587.5618;
    bool operator==(const Film&) const = default;
};

/// The film of a coating between two media at a wavelength, seen from the incoming side.
/// Throws Error for a non-physical layer (n ≤ 0, k < 0, thickness < 0).
Film film_at(const Coating& coating, const Medium& before, const Medium& after,
             double wavelength_nm);

/// The same interface seen from the other side: layers in reverse order.
Film reversed(const Film& film);

/// True when nothing is there that could reflect.
bool is_invisible(const Film& film);

/// True when a layer absorbs.
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

/// For people: "MgF2 λ/4 550", "3 layers", "none".
std::string describe(const Coating& coating);

}  // namespace ghostlight
