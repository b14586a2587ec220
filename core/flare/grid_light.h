#pragma once

#include <vector>

#include "core/flare/spectrum.h"
#include "core/ghosts/mirror_grid.h"

namespace ghostlight {

/// Where a wavelength lies among the samples of a spectrum: 0 at the longest, 1 at the shortest,
/// linear in 1/λ², in which lateral colour is nearly linear.
class ColorAxis {
   public:
    explicit ColorAxis(const std::vector<SpectralSample>& samples);
    double at(double wavelength_nm) const;
    double wavelength_nm(double at) const;

   private:
    double low_, span_;
};

/// What a band takes of a sample at `t` of the axis: hats about the bands' middles, whose sum is 1.
double band_weight(double t, int band, int bands);

/// Failed rays of a half grid take the mean of their valid neighbours, so that rims are not dark.
/// `values`: `channels` a ray.
void fill_failed(const MirrorGrid& grid, int channels, std::vector<float>& values);

/// Makes the mean of a cell's corners the mean over the cell, to fourth order: the second
/// differences tell how far the one is above the other.
void correct_means(const MirrorGrid& grid, int channels, std::vector<float>& values);

/// Values of a half grid at the nodes of a full grid of cells × cells over the same box,
/// bilinearly; 1 or 4 channels.
void interpolate(const MirrorGrid& from, const std::vector<float>& values, int channels, int cells,
                 std::vector<float>& nodes);

/// Values of a half grid of from_cells × from_cells, `channels` a ray, at the rays of the half grid
/// of cells × cells over the same box: by cubics through four nodes each way, to fourth order where
/// the values are smooth.
std::vector<float> interpolate_smooth(int from_cells, const std::vector<float>& values,
                                      int channels, int cells);

}  // namespace ghostlight
