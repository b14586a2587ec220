#include "core/io/html_page.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/chart_svg.h"

namespace ghostlight {

const std::string_view html_style = R"(
:root{color-scheme:light}
body{font:14px/1.5 system-ui,"Segoe UI",Helvetica,Arial,sans-serif;color:#222;max-width:1180px;margin:28px auto;padding:0 24px}
h1{font-size:24px;margin:0}h2{font-size:17px;margin:34px 0 8px;border-bottom:1px solid #ccc;padding-bottom:4px}
p{margin:6px 0;max-width:80em}.lead{color:#555}
table{border-collapse:collapse;font-size:12.5px;font-variant-numeric:tabular-nums}
th{text-align:right;font-weight:600;border-bottom:1.5px solid #666;padding:3px 7px;vertical-align:bottom}
td{text-align:right;padding:2px 7px;border-bottom:1px solid #eee;white-space:nowrap}th.t,td.t{text-align:left}
tr.total td{border-top:1.5px solid #666;font-weight:600}
.key{display:grid;grid-template-columns:repeat(auto-fit,minmax(330px,1fr));gap:0 28px}
.key div{display:flex;justify-content:space-between;border-bottom:1px solid #eee;padding:2px 0}
.key span:first-child{color:#555}.scroll{overflow-x:auto}
.swatch{display:inline-block;width:1.1em;height:1.1em;border:1px solid #999;vertical-align:-2px;margin-right:5px}
.dot{display:inline-block;width:.8em;height:.8em;border-radius:50%;margin:0 4px 0 12px}
svg,img{max-width:100%;height:auto}img{background:#000;display:block}
pre{background:#f4f4f4;padding:9px 12px;white-space:pre-wrap;word-break:break-all}
@media print{body{margin:0;font-size:10px}h2{break-after:avoid}table,svg,img{break-inside:avoid}}
)";

std::string base64(std::string_view bytes) {
    constexpr std::string_view letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
        };
        const unsigned word = (byte(0) << 16) | (byte(1) << 8) | byte(2);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? letters[(word >> (18 - 6 * k)) & 63U] : '=';
    }
    return text;
}

namespace {

/// A table's cell for people: four digits are what a designer compares.
std::string shown_text(const Cell& cell) {
    if (const auto* number = std::get_if<double>(&cell))
        return std::abs(*number) < 1e-12 ? "0" : fmt::format("{:.4g}", *number);
    return readable_text(cell);
}

}  // namespace

std::string html_table(const Table& table, const std::vector<HtmlColumn>& columns) {
    std::vector<std::string> names;
    std::string html = "<div class=\"scroll\"><table><thead><tr>";
    for (const HtmlColumn& column : columns) names.push_back(column.column);
    const Table chosen = select_columns(table, names);
    std::vector<bool> words(columns.size(), false);
    for (const auto& row : chosen.rows)
        for (std::size_t c = 0; c < row.size(); ++c)
            words[c] = words[c] || std::holds_alternative<std::string>(row[c]);
    for (std::size_t c = 0; c < columns.size(); ++c)
        html += fmt::format("<th{}>{}</th>", words[c] ? " class=\"t\"" : "", columns[c].title);
    html += "</tr></thead><tbody>\n";
    for (const auto& row : chosen.rows) {
        const auto* first = row.empty() ? nullptr : std::get_if<std::string>(&row.front());
        html += first && *first == "all" ? "<tr class=\"total\">" : "<tr>";
        for (std::size_t c = 0; c < row.size(); ++c) {
            Cell cell = row[c];
            if (auto* number = std::get_if<double>(&cell)) *number *= columns[c].scale;
            std::string text = xml_text(shown_text(cell));
            if (columns[c].column == "srgb" && text.starts_with('#'))
                text =
                    fmt::format("<span class=\"swatch\" style=\"background:{0}\"></span>{0}", text);
            html += fmt::format("<td{}>{}</td>", words[c] ? " class=\"t\"" : "", text);
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

}  // namespace ghostlight
