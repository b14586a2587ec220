#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/flare/flare_plan.h"

namespace ghostlight {

/// What stands for a ghost in the veil, with its flux, centroid and second moments.
enum class VeilKernel {
    gaussian,
    ellipse  ///< uniform, semi-axes of two standard deviations
};

/// Many broad spots as one two-dimensional Fourier series, so that a pixel costs the same whatever
/// their number. Period T in x and y, ω = 2π/T, orders 0 to N each way. A Gaussian's coefficient is
/// κ_nm Φ/T² exp(−½ kᵀΣk) with k = (nω, ±mω) and κ = 1, 2, 4 for none, one, both of n, m > 0; a
/// uniform ellipse has 2 J₁(q)/q with q = 2 √(kᵀΣk) (Bracewell, The Fourier Transform and Its
/// Applications, 3rd ed., ch. 13) in its place, tapered by Lanczos' factors, since it rings.
/// Flux is kept over the period.
class VeilSeries {
   public:
    VeilSeries(double period_mm, int orders);
    void add(const GhostSpot& ghost, VeilKernel kernel);

    double period_mm() const { return period_mm_; }
    int orders() const { return orders_; }
    /// Irradiance / E0 at a point of the sensor: linear Rec.709, irradiance.
    std::array<double, 4> at(double x_mm, double y_mm) const;
    /// The same at the points (x, y) of a grid, row by row, 4 a point: two products of matrices.
    std::vector<float> grid(std::span<const double> x_mm, std::span<const double> y_mm,
                            unsigned threads = 1) const;

   private:
    double period_mm_;
    int orders_;
    /// Of cos·cos, cos·sin, sin·cos and sin·sin in x and y, 4 channels each: [n][m][which][c].
    std::vector<double> coefficients_;
};

/// Period and orders for a set of ghosts: no repeat reaches the sensor, and what the orders leave
/// out of a Gaussian is below 1e-4 of its peak. Orders end at `most_orders`.
struct VeilSize {
    double period_mm = 0.0;
    int orders = 0;
};
inline constexpr int most_veil_orders = 96;
VeilSize veil_size(std::span<const GhostSpot> ghosts, double sensor_width_mm,
                   double sensor_height_mm);

/// Whether a ghost's kernel reaches the sensor at all.
bool reaches_sensor(const GhostSpot& ghost, double sensor_width_mm, double sensor_height_mm);

}  // namespace ghostlight
