#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stop_token>
#include <unordered_map>
#include <vector>

#include "core/flare/ghost_mesh.h"
#include "core/ghosts/bundle.h"
#include "core/ghosts/cells.h"
#include "core/ghosts/pupil.h"

namespace ghostlight {

/// A rectangle on the sensor plane, mm; empty until a point is put in.
struct SensorBox {
    double x0_mm = std::numeric_limits<double>::infinity(), x1_mm = -x0_mm;
    double y0_mm = std::numeric_limits<double>::infinity(), y1_mm = -y0_mm;
    bool empty() const { return x0_mm > x1_mm; }
    void add(double x_mm, double y_mm);
    void add(const SensorBox& other);
};

/// Integrals over a path's bundle at one wavelength, or sums of them over a spectrum. Positions,
/// reflectances and angles are weighted by flux: divide by `flux`.
struct FluxSums {
    double flux = 0.0;       ///< mm²
    double on_sensor = 0.0;  ///< mm² of it inside the sensor's rectangle
    double x = 0.0, y = 0.0, r2 = 0.0;
    std::array<double, max_reflections> reflectance{};
    std::array<double, max_reflections> incidence_rad{};
    double area_mm2 = 0.0;        ///< on the sensor plane, each of a folded ghost's sheets
    double pupil_area_mm2 = 0.0;  ///< of the beam's part that passes, across the beam
    // Not sums, but largest values: scaling leaves them.
    std::array<double, max_reflections> largest_incidence_rad{};
    SensorBox box;
    FluxSums& operator+=(const FluxSums& other);
};
FluxSums operator*(double scale, FluxSums sums);

/// A cell of an adaptive quadrature: its corners among the traced rays, its flux, and the change
/// of flux when its parent was split, shared among the parent's four children.
struct FluxCell {
    std::uint32_t i = 0, j = 0;  ///< at its own level
    int level = 0;
    int corner[4] = {0, 0, 0, 0};
    double flux_mm2 = 0.0, error_mm2 = 0.0;
};

/// One path at one wavelength, refined as far as it has been asked to.
struct PathFlux {
    FluxSums sums;
    double error_mm2 = 0.0;  ///< of the flux, the quadrature's own estimate
    std::size_t rays = 0;    ///< all that were traced, the search included
    Pupil pupil;
    RayField<double> field;
    std::unordered_map<std::uint64_t, int> node_at;  ///< lattice point → ray
    std::vector<FluxCell> cells;
};

/// A part of the beam that passes: its middle on the plane across the beam, and its area.
struct BeamPart {
    double u_mm = 0.0, v_mm = 0.0, area_mm2 = 0.0;
};

/// The flux of one path by adaptive quadrature over the pupil: weight and clearances are linear on
/// two triangles per cell, and the cells whose flux changes most when split are split further, so
/// that edges, the onset of total reflection and thin crescents get the rays. The polarisation
/// state is carried. The error is the sum of the cells' last changes, a bound in practice: the
/// rule is second order where it is smooth (three times the error left) and of order 3/2 at the
/// square-root edges (1.8 times).
class PathQuadrature {
   public:
    /// `system` must outlive this.
    PathQuadrature(const OpticalSystem& system, const GhostPath& path, const BeamFrame& frame);

    /// Finds the pupil and integrates on its cells and on their halves.
    PathFlux start() const;

    /// Splits cells until the error is below max(share × flux, floor), or rays run out; then works
    /// out the moments.
    void refine(PathFlux& flux, double share, double floor_mm2, std::stop_token stop) const;

    /// The parts of the beam that pass, as the cells stand.
    std::vector<BeamPart> parts(const PathFlux& flux) const;

    /// The path's irradiance for a raster, on a uniform grid, scaled to the flux found.
    GhostMesh mesh(PathFlux& flux, const PixelFrame& pixels, int cells, double gain) const;

   private:
    const OpticalSystem& system_;
    GhostPath ghost_;
    TracePath<double> path_;
    BeamFrame frame_;
    std::vector<double> inverse_eta2_;  ///< (n_out/n_in)² at each reflection

    void split(PathFlux& flux, double above_mm2) const;
    FluxSums sums_of(const PathFlux& flux) const;
    double incidence_rad(const PathFlux& flux, std::size_t reflection, std::size_t node) const;
    void trace_lattice(PathFlux& flux, const std::vector<std::uint64_t>& keys) const;
};

}  // namespace ghostlight
