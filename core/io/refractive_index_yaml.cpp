#include "core/io/refractive_index_yaml.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/io/read_text.h"
#include "core/io/same_name.h"
#include "core/io/word_lines.h"
#include "core/optics/dispersion_formula.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr std::size_t largest_text = std::size_t{4} << 20;  // the database's largest has 1 MiB
constexpr int deepest = 16;                                 // its files nest three levels

struct Source {
    std::string file;

    [[noreturn]] void refuse(const YAML::Mark& mark, std::string problem,
                             std::string expected) const {
        const bool known = mark.line >= 0;
        throw Error({.problem = std::move(problem),
                     .file = file,
                     .where = known ? fmt::format("line {}", mark.line + 1) : std::string(),
                     .found = {},
                     .expected = std::move(expected)});
    }
};

/// Looks at the events alone, before anything is built: what would unfold or nest is refused.
class Guard : public YAML::EventHandler {
   public:
    explicit Guard(const Source& source) : source_(source) {}

    void OnDocumentStart(const YAML::Mark&) override {}
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
    void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
        source_.refuse(mark, "the file has an alias", "plain values, as the database has them");
    }
    void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  const std::string&) override {}
    void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                         YAML::EmitterStyle::value) override {
        enter(mark);
    }
    void OnSequenceEnd() override { --depth_; }
    void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                    YAML::EmitterStyle::value) override {
        enter(mark);
    }
    void OnMapEnd() override { --depth_; }

   private:
    void enter(const YAML::Mark& mark) {
        if (++depth_ > deepest)
            source_.refuse(mark, "the file nests too deeply",
                           fmt::format("at most {} levels", deepest));
    }
    const Source& source_;
    int depth_ = 0;
};

/// The numbers of a field of the entry.
std::vector<double> numbers_of(const Source& source, const YAML::Node& entry,
                               const YAML::Node& node, std::string_view what) {
    if (!node || !node.IsScalar())
        source.refuse(node ? node.Mark() : entry.Mark(), fmt::format("no {}", what),
                      "numbers separated by blanks");
    std::vector<double> numbers;
    WordLines lines(node.Scalar());
    for (WordLine line; lines.next(line);)
        for (const std::string_view word : line.words) {
            const auto number = parse_number(word);
            if (!number)
                source.refuse(node.Mark(),
                              fmt::format("{}: '{}' is not a number", what, word.substr(0, 40)),
                              "numbers separated by blanks");
            numbers.push_back(*number);
        }
    return numbers;
}

FormulaGlass formula_of(const Source& source, const YAML::Node& entry, int number) {
    FormulaGlass glass;
    glass.formula = number;
    glass.coefficients = numbers_of(source, entry, entry["coefficients"], "coefficients");
    if (glass.coefficients.empty())
        source.refuse(entry.Mark(), "the formula has no coefficients", "at least one");
    constexpr std::size_t most = 64;  // the database's longest has 19
    // What is missing at the end is 0.
    while (!fits_formula(number, glass.coefficients.size()) && glass.coefficients.size() < most)
        glass.coefficients.push_back(0.0);
    if (!fits_formula(number, glass.coefficients.size()))
        source.refuse(entry.Mark(), "too many coefficients",
                      fmt::format("those of formula {}", number));
    // Older files say "range".
    const YAML::Node range = entry["wavelength_range"] ? entry["wavelength_range"] : entry["range"];
    if (range) {
        const auto ends = numbers_of(source, entry, range, "wavelength_range");
        if (ends.size() != 2 || !(ends[0] >= 0.0) || !(ends[1] > ends[0]))
            source.refuse(range.Mark(), "not a range of wavelengths", "shortest longest, in µm");
        glass.min_nm = nm_from_um(ends[0]);
        glass.max_nm = nm_from_um(ends[1]);
    }
    return glass;
}

/// The columns after the wavelength, each as a table by rising wavelength. A wavelength that is
/// there twice counts once.
std::vector<SpectralTable> tables_of(const Source& source, const YAML::Node& entry,
                                     std::size_t columns, Notes& notes) {
    const YAML::Node data = entry["data"];
    if (!data || !data.IsScalar())
        source.refuse(entry.Mark(), "the table has no data",
                      "lines of wavelength in µm and values");
    std::vector<std::vector<double>> rows;
    WordLines lines(data.Scalar());
    for (WordLine line; lines.next(line);) {
        std::vector<double> row;
        for (const std::string_view word : line.words)
            if (const auto number = parse_number(word)) row.push_back(*number);
        const auto file_line = data.Mark().line + 1 + static_cast<int>(line.number);
        if (row.size() != columns + 1 || row.size() != line.words.size() || !(row[0] > 0.0))
            throw Error({.problem = "not a row of the table",
                         .file = source.file,
                         .where = fmt::format("line {}", file_line),
                         .found = std::string(line.text.substr(0, 60)),
                         .expected = fmt::format("wavelength in µm and {} value{}", columns,
                                                 columns == 1 ? "" : "s")});
        rows.push_back(std::move(row));
    }
    if (rows.empty()) source.refuse(data.Mark(), "the table is empty", "at least one line");
    std::ranges::stable_sort(rows, {}, [](const auto& row) { return row.front(); });
    const auto again = std::ranges::unique(rows, {}, [](const auto& row) { return row.front(); });
    if (!again.empty()) {
        notes.push_back(
            {Note::Severity::warning,
             fmt::format("line {}", data.Mark().line + 1),
             fmt::format("{} wavelengths are in the table twice; the first counts", again.size()),
             Note::Fate::left_out,
             true,
             {}});
        rows.erase(again.begin(), again.end());
    }
    std::vector<SpectralTable> tables(columns);
    for (const auto& row : rows)
        for (std::size_t c = 0; c < columns; ++c)
            tables[c].push_back({nm_from_um(row[0]), row[c + 1]});
    return tables;
}

void take_entry(const Source& source, const YAML::Node& entry, CataloguedGlass& glass,
                bool& has_index, Notes& notes) {
    constexpr std::string_view types = "formula 1 to 9, tabulated n, tabulated nk or tabulated k";
    if (!entry.IsMap() || !entry["type"] || !entry["type"].IsScalar())
        source.refuse(entry.Mark(), "an entry of DATA without a type", std::string(types));
    const std::string type = entry["type"].Scalar();
    auto set_index = [&](Dispersion dispersion) {
        if (has_index)
            source.refuse(entry.Mark(), "more than one index in DATA", "one formula or table of n");
        has_index = true;
        glass.medium.dispersion = std::move(dispersion);
    };
    if (type.starts_with("formula ")) {
        const auto number = parse_number(std::string_view(type).substr(8));
        if (!number || *number != std::floor(*number) || *number < 1.0 || *number > last_formula)
            source.refuse(entry["type"].Mark(), fmt::format("type '{}' is not known", type),
                          std::string(types));
        set_index(formula_of(source, entry, static_cast<int>(*number)));
    } else if (type == "tabulated n") {
        set_index(TabulatedGlass{tables_of(source, entry, 1, notes)[0]});
    } else if (type == "tabulated nk") {
        auto tables = tables_of(source, entry, 2, notes);
        set_index(TabulatedGlass{std::move(tables[0])});
        glass.extinction = std::move(tables[1]);
    } else if (type == "tabulated k") {
        glass.extinction = tables_of(source, entry, 1, notes)[0];
    } else {
        source.refuse(entry["type"].Mark(), fmt::format("type '{}' is not known", type),
                      std::string(types));
    }
}

/// τ over 10 mm from k: exp(−4π k d/λ).
void add_transmittance(CataloguedGlass& glass) {
    constexpr double thickness_mm = 10.0;
    for (const SpectralValue& at : glass.extinction)
        if (at.value >= 0.0)
            glass.medium.transmittance.push_back(
                {at.wavelength_nm,
                 std::exp(-4.0 * std::numbers::pi * at.value * thickness_mm /
                          mm_from_nm(at.wavelength_nm)),
                 thickness_mm});
}

GlassFile material(const Source& source, const std::string& text,
                   const std::filesystem::path& file) {
    std::istringstream stream(text);
    Guard guard(source);
    YAML::Parser(stream).HandleNextDocument(guard);
    const YAML::Node root = YAML::Load(text);
    const YAML::Node data = root.IsMap() ? root["DATA"] : YAML::Node(YAML::NodeType::Undefined);
    if (!data || !data.IsSequence() || data.size() == 0)
        source.refuse(root.Mark(), "this is no material of refractiveindex.info",
                      "a mapping with a list DATA");
    GlassFile result;
    result.file = file;
    result.name = upper_case(file.parent_path().filename().string());
    CataloguedGlass glass;
    glass.medium.name = file.stem().string();
    glass.catalog = result.name;
    glass.where = fmt::format("line {}", data.Mark().line + 1);
    if (const YAML::Node comments = root["COMMENTS"]; comments && comments.IsScalar())
        glass.comment = comments.Scalar().substr(0, comments.Scalar().find('\n'));
    if (const YAML::Node properties = root["PROPERTIES"]; properties && properties.IsMap()) {
        auto listed = [&](const char* key) {
            const YAML::Node value = properties[key];
            return value && value.IsScalar() ? parse_number(value.Scalar()) : std::nullopt;
        };
        glass.listed_nd = listed("nd");
        glass.listed_vd = listed("Vd");
    }
    bool has_index = false;
    for (const YAML::Node& entry : data) take_entry(source, entry, glass, has_index, result.notes);
    if (!has_index)
        source.refuse(data.Mark(), "the material has no index, only k",
                      "a formula or a table of n");
    add_transmittance(glass);
    complete_glass(glass);
    if (glass.nd && glass.listed_nd && std::abs(*glass.nd - *glass.listed_nd) > index_agreement)
        result.notes.push_back(index_disagreement(glass));
    result.glasses.push_back(std::move(glass));
    return result;
}

}  // namespace

GlassFile material_from_yaml(std::string_view text, const std::filesystem::path& file) {
    const Source source{file.string()};
    if (text.size() > largest_text)
        source.refuse(YAML::Mark::null_mark(), "the file is too large", "at most 4 MiB");
    try {
        return material(source, std::string(text), file);
    } catch (const YAML::Exception& error) {
        source.refuse(error.mark, "not valid YAML: " + error.msg, {});
    }
}

GlassFile read_material_yaml(const std::filesystem::path& file) {
    return material_from_yaml(utf8_text(read_text(file)), file);
}

}  // namespace ghostlight
