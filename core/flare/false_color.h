#pragma once

#include <array>
#include <cstddef>

namespace ghostlight {

/// Nine even steps of matplotlib's "inferno" (S. van der Walt and N. Smith, CC0), sRGB: its
/// lightness rises evenly, also for colour-blind readers and in print.
inline constexpr std::size_t false_color_steps = 9;
inline constexpr std::array<std::array<float, 3>, false_color_steps> false_colors = {{
    {0.0F / 255, 0.0F / 255, 4.0F / 255},
    {31.0F / 255, 12.0F / 255, 72.0F / 255},
    {85.0F / 255, 15.0F / 255, 109.0F / 255},
    {136.0F / 255, 34.0F / 255, 106.0F / 255},
    {186.0F / 255, 54.0F / 255, 85.0F / 255},
    {227.0F / 255, 89.0F / 255, 51.0F / 255},
    {249.0F / 255, 140.0F / 255, 10.0F / 255},
    {249.0F / 255, 201.0F / 255, 50.0F / 255},
    {252.0F / 255, 255.0F / 255, 164.0F / 255},
}};

/// sRGB of a place between 0 and 1, linear between the steps; beyond them the ends.
std::array<float, 3> false_color(float place);

/// Where a value lies between 10^low and 10^high: 0 to 1 in its logarithm.
float log_place(float value, float low_decade, float high_decade);

}  // namespace ghostlight
