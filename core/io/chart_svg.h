#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ghostlight {

/// Text as XML holds it: & < > " escaped.
std::string xml_text(std::string_view text);

/// A curve of a chart; NaN breaks it.
struct ChartCurve {
    std::string name;
    std::string color;  ///< "#rrggbb"
    std::vector<double> x, y;
};

struct Chart {
    std::string x_title, y_title;  ///< with their units
    std::vector<ChartCurve> curves;
    bool y_from_zero = true;
};

/// The chart as one SVG element that needs nothing else, its legend beside it.
std::string chart_svg(const Chart& chart);

/// Colours that stay apart for most people's eyes, in turn.
std::string chart_color(std::size_t index);

}  // namespace ghostlight
