#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/fit/fit_parameters.h"
#include "core/fit/ghost_basis.h"

namespace ghostlight {

/// Weights of ghosts and their derivatives by the coatings: exact films with polarisation carried
/// along each basis' rays, whose cosines and frames no coating moves, so that no ray is traced.
/// Amplitudes of every interface are tabulated over the cosines that occur (cubic between them),
/// with derivatives by ceres::Jet (ghost_weight_tables.cpp); the chain of Jones matrices is
/// differentiated backwards.
class GhostWeights {
   public:
    /// `coatings`: parameters for which is_coating(). The bases and the scene must outlive this.
    GhostWeights(const FitScene& scene, const std::vector<const GhostBasis*>& bases,
                 const std::vector<FitParameter>& coatings, unsigned threads);

    /// Tables for the coatings' values, one each. False when stopped: some are still the old ones.
    bool update(const std::vector<double>& values, bool slopes, std::stop_token stop = {});

    /// A ghost's coefficients of the basis, nodes × pupil_terms × 3 (linear Rec.709), and their
    /// derivatives, P more values each: [(node, term, channel)][parameter].
    void coefficients(const GhostBasis& basis, std::vector<double>& values,
                      std::vector<double>* slopes) const;

   private:
    static constexpr int table_nodes = 21;  ///< cosines of a table
    /// Of one interface seen from one side.
    struct Table {
        double low = 1.0, high = 0.0;  ///< cosines
        std::vector<std::size_t> parameters;
        /// [reflected][wavelength][node]: re and im of s and p, then their derivatives.
        std::vector<double> values;
        std::size_t stride() const { return 4 * (1 + parameters.size()); }
    };
    const FitScene& scene_;
    std::vector<FitParameter> coatings_;
    unsigned threads_;
    std::vector<Table> tables_;  ///< by surface, backward and forward

    void fill(std::size_t which, const FittedLens& lens, const std::vector<double>& values,
              bool slopes);
};

/// One interface's film at a wavelength: of a lens's row, or of the sensor.
struct Interface {
    Film film;  ///< seen from the incoming side
    std::optional<double> uniform_reflectance;
};
Interface interface_at(const Prescription& lens, const OpticalSystem& system, std::size_t row,
                       double wavelength_nm);

}  // namespace ghostlight
