#pragma once

#include <vector>

namespace ghostlight {

/// Pixels per degree of vision of who looks at the pictures: a screen 0.7 m wide with 3840 pixels,
/// from 0.7 m, as FLIP's authors take it.
inline constexpr double usual_pixels_per_degree = 67.0;

/// What somebody who flips between two pictures sees of their difference, 0 to 1 at every pixel:
/// FLIP (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, Proc. ACM Comput.
/// Graph. Interact. Tech. 3(2), 2020). Pictures are 3 floats a pixel, linear Rec.709, clamped to
/// 0 … 1 here; `width_px` pixels a row.
std::vector<float> ldr_flip(const std::vector<float>& picture, const std::vector<float>& truth,
                            int width_px, double pixels_per_degree = usual_pixels_per_degree);

/// The same of pictures of any range: the worst at each pixel over the exposures that bring the
/// truth's brightest to median luminance to 0.85 on a film-like curve; its mean over the pixels
/// (Andersson, Nilsson, Shirley and Akenine-Möller, Eurographics 2021, short papers). Of the
/// median only pixels with light count, and exposures span 16 stops at most: a flare's
/// surroundings are black. 0 where the truth is black altogether. The same for any number of
/// threads (0: all cores).
double hdr_flip(const std::vector<float>& picture, const std::vector<float>& truth, int width_px,
                unsigned threads = 0, double pixels_per_degree = usual_pixels_per_degree);

}  // namespace ghostlight
