#pragma once

namespace ghostlight {

/// The reflectance of a single layer as the supplement of Hullin et al. 2011 computes it
/// (FresnelAR), for comparison only: it squares one direction's transmission where the product of
/// both belongs, multiplies p by a cosine where it needs a division, takes the incident medium's
/// index for the layer's in the phase, and drops all later beams. At normal incidence, where the
/// formula is 0/0, its limit is taken; beyond total reflection, where it is no number, it is 1.
/// Thickness and wavelength in nm.
double hullin_2011_reflectance(double cos_incidence, double wavelength_nm, double thickness_nm,
                               double n0, double n1, double n2);

}  // namespace ghostlight
