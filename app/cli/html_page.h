#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/io/table.h"

namespace ghostlight::cli {

// Parts of a self-contained HTML page.

/// From the document's type to the opened body: title and style.
std::string html_head(std::string_view title);

struct HtmlColumn {
    std::string column;  ///< the table's
    std::string title;   ///< with its unit
    double scale = 1.0;  ///< 100 where a share is shown in percent
};
/// The columns of a table, four digits a number.
std::string html_table(const Table& table, const std::vector<HtmlColumn>& columns);

}  // namespace ghostlight::cli
