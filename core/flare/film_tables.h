#pragma once

#include <cstddef>
#include <vector>

#include "core/ghosts/bundle.h"
#include "core/optics/optical_system.h"

namespace ghostlight {

/// How films are computed.
enum class CoatingModel {
    exact,        ///< the characteristic matrix, all transmissions, polarisation carried
    hullin_2011,  ///< the formula of that paper's supplement at the reflections alone
};

/// Mean reflectance and transmittance of s and p at every surface of a lens, from both sides, at
/// several wavelengths, over the cosine of incidence: linear between nodes, which for the films of
/// lenses is good to 1e-3 of R but within a node of the onset of total reflection. A ray's weights
/// at all wavelengths then cost one look-up at each surface instead of one film a wavelength.
/// With `main`, the lens that rays are traced in, the cosines are those of its wavelength, and n
/// sin θ is taken to be the same at all: that keeps the onset of total reflection in its place, and
/// is exact behind plane surfaces.
class FilmTables {
   public:
    /// `systems`: the lens at each wavelength, in one order.
    FilmTables(const std::vector<OpticalSystem>& systems, unsigned threads,
               CoatingModel model = CoatingModel::exact, const OpticalSystem* main = nullptr);

    /// Wavelengths, more than one padded; those that were given come first.
    std::size_t stride() const { return stride_; }

    /// Weights of every ray of a bundle that kept its cosines, `stride()` values a ray. What glass
    /// absorbs is taken off where the bundle has its lengths.
    void weights(const TracePath<float>& path, const Bundle<float>& rays,
                 std::vector<float>& weights) const;

    /// What polarisation multiplies those weights by where all planes of incidence are one: s and p
    /// go through by themselves, each half of the light. Values like weights'.
    void polarisation(const TracePath<float>& path, const Bundle<float>& rays,
                      std::vector<float>& factors) const;

    /// The largest reflectance of a surface for light that meets it at this cosine or more
    /// steeply to it, of either polarisation, over the wavelengths. From the tables' own nodes.
    double most_reflected(std::size_t surface, bool forward, double least_cosine) const;

   private:
    std::size_t stride_ = 0, surfaces_ = 0;
    std::vector<float> values_;
    std::vector<float> s_shares_;           ///< of s over the mean, laid out like values_
    std::vector<float> most_;               ///< by surface, side and node
    std::vector<float> absorption_per_mm_;  ///< by surface: before and after it; else empty
    std::vector<bool> invisible_;           ///< by surface: at no wavelength anything there

    void keep_absorption(const std::vector<OpticalSystem>& systems);
    void absorb(const TracePath<float>& path, const Bundle<float>& rays,
                std::vector<float>& weights) const;
    std::size_t table(std::size_t surface, bool forward, bool reflects) const;
    std::vector<const float*> tables_of(const TracePath<float>& path,
                                        const std::vector<float>& values) const;
};

}  // namespace ghostlight
