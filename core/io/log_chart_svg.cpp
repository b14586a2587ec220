#include "core/io/log_chart_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/chart_svg.h"

namespace ghostlight {
namespace {

// Pixels of the drawing.
constexpr double left = 70.0, top = 34.0, plot_width = 560.0, plot_height = 360.0;
constexpr double legend_gap = 22.0, legend_width = 250.0, line_height = 19.0;

bool is_shown(const LogMark& mark) {
    return mark.x > 0.0 && mark.y > 0.0 && std::isfinite(mark.x) && std::isfinite(mark.y);
}

/// A range in decades with room at both ends.
struct LogAxis {
    double low = 0.0, high = 1.0;  ///< log10
    void add(double value) {
        low = std::min(low, std::log10(value));
        high = std::max(high, std::log10(value));
    }
    static LogAxis empty() {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return {infinity, -infinity};
    }
    void settle() {
        if (!(high >= low)) *this = {};
        const double room = std::max(0.08 * (high - low), 0.15);
        low -= room;
        high += room;
    }
    double share(double value) const { return (std::log10(value) - low) / (high - low); }
};

/// 1, 2 and 5 in every decade, or the decades alone where there are many.
std::vector<double> ticks_of(const LogAxis& axis) {
    std::vector<double> ticks;
    const bool dense = axis.high - axis.low < 2.6;
    for (int decade = static_cast<int>(std::floor(axis.low));
         decade <= static_cast<int>(std::ceil(axis.high)); ++decade)
        for (const double digit : {1.0, 2.0, 5.0}) {
            if (digit != 1.0 && !dense) continue;
            const double value = digit * std::pow(10.0, decade);
            const double at = std::log10(value);
            if (at >= axis.low && at <= axis.high) ticks.push_back(value);
        }
    return ticks;
}

}  // namespace

std::string log_chart_svg(const LogChart& chart) {
    LogAxis x = LogAxis::empty(), y = LogAxis::empty();
    bool any_ring = false, any_hollow = false;
    for (const LogSeries& series : chart.series)
        for (const LogMark& mark : series.marks) {
            if (!is_shown(mark)) continue;
            x.add(mark.x);
            y.add(mark.y);
            any_ring = any_ring || mark.ringed;
            any_hollow = any_hollow || mark.hollow;
        }
    x.settle();
    if (chart.band_y && *chart.band_y > 0.0) y.add(*chart.band_y);
    y.settle();
    auto px = [&](double value) { return left + plot_width * x.share(value); };
    auto py = [&](double value) { return top + plot_height * (1.0 - y.share(value)); };
    const double width = left + plot_width + legend_gap + legend_width;
    const double height = top + plot_height + 52.0;
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "width=\"{0:.0f}\" height=\"{1:.0f}\" font-family=\"system-ui,Helvetica,Arial,sans-serif\" "
        "font-size=\"12\" fill=\"#222\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
        "<text x=\"{2:.0f}\" y=\"20\" font-size=\"14\" font-weight=\"600\">{3}</text>\n",
        width, height, left, xml_text(chart.title));
    if (chart.band_y && *chart.band_y > 0.0) {
        const double at = std::clamp(py(*chart.band_y), top, top + plot_height);
        svg += fmt::format(
            "<rect x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" fill=\"#e4e4e4\"/>\n"
            "<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"#666\" font-size=\"11\">{}</text>\n",
            left, at, plot_width, top + plot_height - at, left + 6.0, top + plot_height - 6.0,
            xml_text(chart.band_name));
    }
    for (const double value : ticks_of(x))
        svg += fmt::format(
            "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#ddd\"/>"
            "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:.6g}</text>\n",
            px(value), top, top + plot_height, top + plot_height + 17.0, value);
    for (const double value : ticks_of(y))
        svg += fmt::format(
            "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#ddd\"/>"
            "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:.6g}</text>\n",
            left, left + plot_width, py(value), left - 7.0, py(value) + 4.0, value);
    svg += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n"
        "<text transform=\"translate(16 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        left + 0.5 * plot_width, top + plot_height + 40.0, xml_text(chart.x_title),
        top + 0.5 * plot_height, xml_text(chart.y_title));
    if (chart.diagonal) {
        const double low = std::pow(10.0, std::max(x.low, y.low));
        const double high = std::pow(10.0, std::min(x.high, y.high));
        if (low < high)
            svg += fmt::format(
                "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#222\" "
                "stroke-dasharray=\"5 4\"/>\n",
                px(low), py(low), px(high), py(high));
    }
    double legend_y = top + 0.5 * line_height;
    const double legend_x = left + plot_width + legend_gap;
    auto legend = [&](const std::string& mark, const std::string& words) {
        svg += fmt::format("{}<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", mark, legend_x + 26.0,
                           legend_y + 4.0, xml_text(words));
        legend_y += line_height;
    };
    for (const LogSeries& series : chart.series) {
        std::string path, marks;
        for (const LogMark& mark : series.marks) {
            if (!is_shown(mark)) continue;
            path +=
                fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px(mark.x), py(mark.y));
            if (mark.ringed)
                marks += fmt::format(
                    "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"8\" fill=\"none\" stroke=\"#222\"/>\n",
                    px(mark.x), py(mark.y));
            marks += fmt::format(
                "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" fill=\"{}\" stroke=\"{}\" "
                "stroke-width=\"1.6\"/>",
                px(mark.x), py(mark.y), mark.hollow ? "#fff" : series.color, series.color);
            if (!mark.label.empty())
                marks += fmt::format(
                    "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"10.5\" fill=\"#444\">{}</text>",
                    px(mark.x) + 8.0, py(mark.y) - 6.0, xml_text(mark.label));
            marks += "\n";
        }
        if (path.empty()) continue;
        if (series.joined)
            svg +=
                fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\"/>\n",
                            path, series.color);
        svg += marks;
        legend(fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" fill=\"{}\"/>",
                           legend_x + 10.0, legend_y, series.color),
               series.name);
    }
    if (any_ring && !chart.ring_name.empty())
        legend(fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"8\" fill=\"none\" "
                           "stroke=\"#222\"/>",
                           legend_x + 10.0, legend_y),
               chart.ring_name);
    if (any_hollow && !chart.hollow_name.empty())
        legend(fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" fill=\"#fff\" "
                           "stroke=\"#666\" stroke-width=\"1.6\"/>",
                           legend_x + 10.0, legend_y),
               chart.hollow_name);
    if (chart.diagonal)
        legend(fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" "
                           "stroke=\"#222\" stroke-dasharray=\"5 4\"/>",
                           legend_x, legend_x + 20.0, legend_y, legend_y),
               "as promised");
    svg += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n"
        "</svg>\n",
        left, top, plot_width, plot_height);
    return svg;
}

}  // namespace ghostlight
