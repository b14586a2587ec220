#pragma once

#include <vector>

#include "core/interval.h"
#include "core/optics/coating.h"

namespace ghostlight {

/// Upper bounds of an interface's reflectance, whatever the polarisation, over ranges of the cosine
/// of incidence. Proven by affine forms of the characteristic matrix over slices of the cosine; 1
/// where a layer absorbs, and in slices that hold the onset of total reflection, in the film or
/// beyond it.
class ReflectanceBound {
   public:
    explicit ReflectanceBound(const Film& film);
    /// Of max(R_s, R_p).
    double over(const Interval& cos_incidence) const;

   private:
    std::vector<double> slices_;  ///< equal shares of [0, 1]
};

}  // namespace ghostlight
