#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/io/table.h"

namespace ghostlight {

/// The style sheet of all pages: quiet, and fit for print.
extern const std::string_view html_style;

/// For pictures inside of a page.
std::string base64(std::string_view bytes);

struct HtmlColumn {
    std::string column;  ///< the table's
    std::string title;   ///< with its unit
    double scale = 1.0;  ///< 100 where a share is shown in percent
};

/// Some of a table's columns, numbers to four digits.
std::string html_table(const Table& table, const std::vector<HtmlColumn>& columns);

}  // namespace ghostlight
