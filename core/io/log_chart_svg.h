#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ghostlight {

/// One measurement of a chart with logarithmic axes.
struct LogMark {
    double x = 0.0, y = 0.0;  ///< positive; others are not drawn
    std::string label;        ///< beside the mark; empty for none
    bool hollow = false;      ///< measured, but not to be relied on
    bool ringed = false;      ///< to be picked out
};
struct LogSeries {
    std::string name, color;  ///< "#rrggbb"
    std::vector<LogMark> marks;
    bool joined = true;  ///< by a line, in their order
};
struct LogChart {
    std::string title, x_title, y_title;  ///< with their units
    std::vector<LogSeries> series;
    /// Shaded from the bottom up to this y, with words.
    std::optional<double> band_y;
    std::string band_name;
    bool diagonal = false;               ///< the line y = x
    std::string ring_name, hollow_name;  ///< for the legend, where there are any
};

/// The chart as one SVG element that needs nothing else.
std::string log_chart_svg(const LogChart& chart);

}  // namespace ghostlight
