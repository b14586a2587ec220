#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/ghosts/bundle.h"

namespace ghostlight {

/// An interval that grows with what is added to it.
struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void widen(double share) {
        const double by = share * (high - low);
        low -= by;
        high += by;
    }
    /// Distance of the range from zero.
    double distance() const { return std::max({0.0, low, -high}); }
};

/// What a search for a pupil spends.
struct SearchEffort {
    std::uint32_t first_level_cells;
    int blind_levels;            ///< cells of failing corners are kept that long
    std::size_t enough_passing;  ///< nodes that pass: the region is resolved
    std::size_t most_cells;
    bool only_beside_valid = false;  ///< but for the first level, cells of failing corners go
};

/// Whether a ray through the cell between four rays may pass, if the map does not bend by more
/// than a share of its change across the cell. A cell whose corners all fail is kept on the first
/// levels only. `level`: how often the cells have been halved.
template <class T>
bool may_pass(const Bundle<T>& rays, const std::array<std::size_t, 4>& corners, int level,
              double stop_radius_mm, const SearchEffort& effort);

/// Rays that pass, the stop taken as round.
template <class T>
std::size_t passing_rays(const Bundle<T>& rays, double stop_radius_mm);

}  // namespace ghostlight
