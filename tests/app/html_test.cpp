// The report is one file that needs nothing else.

#include <regex>

#include "tests/app/program.h"

namespace ghostlight::test {
namespace {

class CommandLineHtml : public InTemporaryFolder {};

TEST_F(CommandLineHtml, StandsAloneAndHoldsWhatItNames) {
    const std::string file = (folder / "report.html").string();
    const Csv csv = cli_csv(
        {"ghosts", tessar(), "--field", "4", "--top", "3", "--tolerance", "0.1", "--html", file});
    const std::string html = read_file(folder / "report.html");
    EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
    EXPECT_TRUE(html.ends_with("</html>\n"));
    for (const char* word :
         {"<h2>Flare</h2>", "<h2>Layout</h2>", "<h2>Ghosts</h2>", "<h2>By surface</h2>",
          "<h2>Reflectances</h2>", "<h2>Prescription</h2>", "data:image/png;base64,iVBORw0KGgo",
          "--field 4", "ghostlight-cli ghosts", "program: ghostlight-cli "})
        EXPECT_NE(html.find(word), std::string::npos) << word;
    // Every ghost of the table is on the page.
    for (std::size_t r = 0; r < csv.rows.size(); ++r)
        EXPECT_NE(html.find(">" + csv.text(r, "ghost") + "<"), std::string::npos)
            << csv.text(r, "ghost");
    // Nothing is fetched: no address but the SVG's name, no script, no link.
    std::string without = std::regex_replace(html, std::regex("http://www.w3.org/2000/svg"), "");
    for (const char* word : {"http:", "https:", "<script", "<link", "url(", "@import"})
        EXPECT_EQ(without.find(word), std::string::npos) << word;
    EXPECT_EQ(html.find(">nan<"), std::string::npos);
    // As many elements are closed as are opened.
    const auto count = [&](const std::string& word) {
        std::size_t n = 0;
        for (std::size_t at = 0; (at = html.find(word, at)) != std::string::npos; ++at) ++n;
        return n;
    };
    for (const char* tag : {"table", "svg", "tr", "td", "div"})
        EXPECT_EQ(count(std::string("<") + tag + ">") + count(std::string("<") + tag + " "),
                  count(std::string("</") + tag + ">"))
            << tag;
}

TEST_F(CommandLineHtml, IsOfOneState) {
    const Outcome outcome =
        cli({"ghosts", tessar(), "--field", "0,5", "--html", (folder / "report.html").string()});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("--html"), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "report.html"));
}

}  // namespace
}  // namespace ghostlight::test
