#include "core/io/chart_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ghostlight {
namespace {

// Pixels of the drawing.
constexpr double left = 64.0, top = 14.0, plot_width = 520.0, plot_height = 260.0;
constexpr double legend_gap = 24.0, legend_width = 330.0, line_height = 17.0;

struct Axis {
    double low = 0.0, high = 1.0, step = 1.0;
};

/// A range that ends on round numbers, some five steps of 1, 2 or 5 × 10^k.
Axis axis_over(double low, double high) {
    if (!(high > low)) high = low + 1.0;
    const double rough = (high - low) / 5.0;
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    const double share = rough / decade;
    const double step = decade * (share <= 1.0   ? 1.0
                                  : share <= 2.0 ? 2.0
                                  : share <= 5.0 ? 5.0
                                                 : 10.0);
    return {step * std::floor(low / step + 1e-9), step * std::ceil(high / step - 1e-9), step};
}

}  // namespace

std::string xml_text(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

std::string chart_color(std::size_t index) {
    // Okabe and Ito (2008), without their yellow, which paper swallows.
    constexpr std::array colors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                   "#e69f00", "#56b4e9", "#000000"};
    return colors[index % colors.size()];
}

std::string chart_svg(const Chart& chart) {
    double x0 = std::numeric_limits<double>::infinity(), x1 = -x0, y0 = x0, y1 = -x0;
    for (const ChartCurve& curve : chart.curves)
        for (std::size_t i = 0; i < curve.x.size(); ++i) {
            if (!std::isfinite(curve.y[i])) continue;
            x0 = std::min(x0, curve.x[i]);
            x1 = std::max(x1, curve.x[i]);
            y0 = std::min(y0, curve.y[i]);
            y1 = std::max(y1, curve.y[i]);
        }
    if (x0 > x1) return {};
    const Axis x{x0, x1 > x0 ? x1 : x0 + 1.0, axis_over(x0, x1).step};
    const Axis y = axis_over(chart.y_from_zero ? std::min(0.0, y0) : y0, y1);
    auto px = [&](double value) { return left + plot_width * (value - x.low) / (x.high - x.low); };
    auto py = [&](double value) {
        return top + plot_height * (1.0 - (value - y.low) / (y.high - y.low));
    };
    const double height =
        std::max(top + plot_height + 44.0,
                 top + line_height * static_cast<double>(chart.curves.size()) + 10.0);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
        "font-family=\"sans-serif\" font-size=\"12\" fill=\"#333\">\n",
        left + plot_width + legend_gap + legend_width, height);
    for (double value = y.low; value <= y.high + 1e-9 * y.step; value += y.step)
        svg += fmt::format(
            "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ddd\"/>"
            "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:.6g}</text>\n",
            left, left + plot_width, py(value), py(value), left - 6.0, py(value) + 4.0,
            std::abs(value) < 1e-9 * y.step ? 0.0 : value);
    for (double value = x.step * std::ceil(x.low / x.step - 1e-9); value <= x.high + 1e-9 * x.step;
         value += x.step)
        svg += fmt::format(
            "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"#eee\"/>"
            "<text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\">{4:.6g}</text>\n",
            px(value), top, top + plot_height, top + plot_height + 16.0, value);
    svg += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n"
        "<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        left + 0.5 * plot_width, top + plot_height + 36.0, xml_text(chart.x_title),
        top + 0.5 * plot_height, xml_text(chart.y_title));
    for (std::size_t k = 0; k < chart.curves.size(); ++k) {
        const ChartCurve& curve = chart.curves[k];
        std::string path;
        bool drawing = false;
        for (std::size_t i = 0; i < curve.x.size(); ++i) {
            const bool there = std::isfinite(curve.y[i]);
            if (there)
                path += fmt::format("{}{:.2f} {:.2f}", drawing ? "L" : "M", px(curve.x[i]),
                                    py(curve.y[i]));
            drawing = there;
        }
        // After seven colours the lines are dashed.
        const char* dash = k < 7    ? ""
                           : k < 14 ? " stroke-dasharray=\"6 3\""
                                    : " stroke-dasharray=\"2 3\"";
        const double at = top + line_height * (static_cast<double>(k) + 0.5);
        const double begin = left + plot_width + legend_gap;
        svg += fmt::format(
            "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"{}/>\n"
            "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
            "stroke-width=\"2\"{}/><text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
            path, curve.color, dash, begin, begin + 22.0, at, at, curve.color, dash, begin + 28.0,
            at + 4.0, xml_text(curve.name));
    }
    svg += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
        "stroke=\"#888\"/>\n</svg>\n",
        left, top, plot_width, plot_height);
    return svg;
}

}  // namespace ghostlight
