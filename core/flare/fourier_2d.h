#pragma once

#include <complex>
#include <stop_token>
#include <vector>

namespace ghostlight {

/// Replaces a square field by its discrete Fourier transform, Σ f exp(∓2πi(jx + ky)/across), not
/// scaled; the inverse is the one with +. `across` a power of two. By Eigen's FFT module, lines
/// shared among threads. False when stopped.
bool transform_2d(std::vector<std::complex<float>>& field, int across, bool inverse,
                  unsigned threads, const std::stop_token& stop = {});

}  // namespace ghostlight
