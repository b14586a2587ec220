#include "core/io/coating_dat.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/io/catalogued_glass.h"
#include "core/io/read_text.h"
#include "core/io/same_name.h"
#include "core/io/word_lines.h"
#include "core/units.h"

namespace ghostlight {
namespace {

constexpr int most_repeats = 1000;
constexpr std::size_t most_layers = 2000;
constexpr std::size_t most_definitions = 100'000;  // coating houses' files have some hundreds
constexpr std::size_t most_rows = 100'000;         // of a TABLE; measured ones have some thousands
constexpr std::size_t most_angles = 1000;
constexpr std::size_t most_values = 1'000'000;
constexpr std::size_t longest_excerpt = 60;

/// One row of a TABLE.
struct TableRow {
    double angle_deg, wavelength_nm;
    MeasuredShares shares;
};

/// The wavelengths and angles that a table has.
MeasuredReflectance axes_of(const std::vector<TableRow>& rows, std::string name) {
    MeasuredReflectance table;
    table.name = std::move(name);
    for (const TableRow& row : rows) {
        table.wavelengths_nm.push_back(row.wavelength_nm);
        table.angles_deg.push_back(row.angle_deg);
    }
    for (auto* axis : {&table.wavelengths_nm, &table.angles_deg}) {
        std::ranges::sort(*axis);
        const auto again = std::ranges::unique(*axis);
        axis->erase(again.begin(), again.end());
    }
    return table;
}

/// Each angle's wavelengths may differ: they are taken together, and each angle is interpolated.
void fill(MeasuredReflectance& table, std::vector<TableRow> rows) {
    std::ranges::stable_sort(rows, {}, &TableRow::wavelength_nm);
    table.shares.resize(table.wavelengths_nm.size() * table.angles_deg.size());
    constexpr std::array members{&MeasuredShares::r_s, &MeasuredShares::r_p, &MeasuredShares::t_s,
                                 &MeasuredShares::t_p};
    for (std::size_t a = 0; a < table.angles_deg.size(); ++a)
        for (const auto member : members) {
            SpectralTable curve;
            for (const TableRow& row : rows)
                if (row.angle_deg == table.angles_deg[a] &&
                    (curve.empty() || curve.back().wavelength_nm < row.wavelength_nm))
                    curve.push_back({row.wavelength_nm, row.shares.*member});
            for (std::size_t w = 0; w < table.wavelengths_nm.size(); ++w)
                table.shares[w * table.angles_deg.size() + a].*member =
                    linear_at(curve, table.wavelengths_nm[w]);
        }
}

class Reader {
   public:
    explicit Reader(const std::filesystem::path& file) { result_.file = file; }

    CoatingFile read(std::string_view text) {
        WordLines lines(text);
        for (WordLine line; lines.next(line);) take(line);
        finish();
        if (result_.materials.empty() && result_.coatings.empty() && result_.notes.empty())
            throw Error({.problem = "this is no coating file",
                         .file = result_.file.string(),
                         .where = {},
                         .found = "none of MATE, COAT, TABLE, IDEAL",
                         .expected = "definitions such as 'COAT AR'"});
        return std::move(result_);
    }

   private:
    enum class Section { none, material, layers, table, skipped };

    void take(const WordLine& line) {
        if (line.text.starts_with('!')) return;
        const std::string key = upper_case(line.words.front());
        if (key == "MATE") return begin(line, Section::material);
        if (key == "COAT") return begin(line, Section::layers);
        if (key == "TABLE") return begin(line, Section::table);
        if (key == "IDEAL" || key == "IDEAL2") return ideal(line, key == "IDEAL2");
        if (key == "TAPR" || key == "ENCRYPTED") {
            begin(line, Section::skipped);
            if (key == "ENCRYPTED")
                warn(line, fmt::format("{} is encrypted and cannot be read", name_), true);
            return;
        }
        switch (section_) {
            case Section::none:
                return warn(line, fmt::format("'{}' stands before any definition", shown(line)),
                            false);
            case Section::material:
                return material_row(line);
            case Section::layers:
                return layer(line);
            case Section::table:
                return table_row(line, key);
            case Section::skipped:
                return;
        }
    }

    void begin(const WordLine& line, Section section) {
        finish();
        if (++definitions_ > most_definitions)
            throw Error({.problem = "the file has too many definitions",
                         .file = result_.file.string(),
                         .where = line.where(),
                         .found = {},
                         .expected = fmt::format("at most {}", most_definitions)});
        section_ = section;
        usable_ = true;
        name_ = std::string(line.rest(1));
        where_ = line.where();
        if (name_.empty()) drop(line, "a definition without a name");
    }

    void finish() {
        const Section ended = std::exchange(section_, Section::none);
        CoatingMaterial material = std::exchange(material_, {});
        ListedLayers layers = std::exchange(layers_, {});
        std::vector<TableRow> rows = std::exchange(rows_, {});
        angle_deg_ = 0.0;
        if (!usable_) return;
        if (ended == Section::material) {
            if (material.n.empty())
                return note(where_, name_ + " has no index and is left out", true);
            material.name = name_;
            std::ranges::stable_sort(material.n, {}, &SpectralValue::wavelength_nm);
            std::ranges::stable_sort(material.k, {}, &SpectralValue::wavelength_nm);
            if (!has_rising_wavelengths(material.n))
                return note(where_, name_ + " has a wavelength twice and is left out", true);
            result_.materials.push_back(std::move(material));
        } else if (ended == Section::layers) {
            result_.coatings.push_back({name_, where_, std::move(layers)});
        } else if (ended == Section::table) {
            if (rows.empty()) return note(where_, name_ + " has no values and is left out", true);
            MeasuredReflectance table = axes_of(rows, name_);
            if (rows.size() > most_rows || table.angles_deg.size() > most_angles ||
                table.angles_deg.size() * table.wavelengths_nm.size() > most_values)
                return note(where_, name_ + " is too large and is left out", true);
            fill(table, std::move(rows));
            result_.coatings.push_back({name_, where_, Coating(std::move(table))});
        }
    }

    /// The line's numbers from a word on; empty when one of them is none.
    std::vector<double> numbers(const WordLine& line, std::size_t first) const {
        std::vector<double> values;
        for (std::size_t i = first; i < line.words.size(); ++i) {
            const auto value = parse_number(line.words[i]);
            if (!value) return {};
            values.push_back(*value);
        }
        return values;
    }

    void material_row(const WordLine& line) {
        const auto values = numbers(line, 0);
        if (values.size() < 2 || values.size() > 3 || !(values[0] > 0.0) || !(values[1] > 0.0))
            return drop(line, fmt::format("material {}: '{}' is not 'µm n k'", name_, shown(line)));
        const double nm = nm_from_um(values[0]);
        const double k = values.size() == 3 ? -values[2] : 0.0;
        if (k < 0.0)
            warn(line,
                 fmt::format("material {}: k {} would amplify by Zemax's sign; taken as "
                             "absorbing",
                             name_, values[2]),
                 true);
        material_.n.push_back({nm, values[1]});
        material_.k.push_back({nm, std::abs(k)});
    }

    void layer(const WordLine& line) {
        ListedLayer layer;
        layer.material = std::string(line.words.front());
        const auto thickness =
            line.words.size() > 1 ? parse_number(line.words[1]) : std::optional<double>();
        if (!thickness || !(*thickness >= 0.0))
            return drop(line, fmt::format("coating {}: '{}' is not 'material thickness'", name_,
                                          shown(line)));
        layer.thickness = *thickness;
        auto flag = [&](std::size_t word) {
            return word < line.words.size() ? parse_number(line.words[word]).value_or(-1.0) : 0.0;
        };
        layer.in_um = flag(2) != 0.0;
        const double repeats = flag(3);
        if (flag(2) < 0.0 || repeats < 0.0 || repeats > most_repeats ||
            repeats != std::floor(repeats))
            return drop(line,
                        fmt::format("coating {}: '{}': is_absolute and the loop index must be "
                                    "whole numbers, the loop at most {}",
                                    name_, shown(line), most_repeats));
        layer.repeats = static_cast<int>(repeats);
        if (line.words.size() > 4)
            warn(line,
                 fmt::format("coating {}: the taper {} is left out; the layer has its full "
                             "thickness everywhere",
                             name_, line.words[4]),
                 true);
        if (layers_.layers.size() >= most_layers)
            return drop(line, fmt::format("coating {}: more than {} layers", name_, most_layers));
        layers_.layers.push_back(std::move(layer));
    }

    void table_row(const WordLine& line, const std::string& key) {
        const auto values = numbers(line, 1);
        if (key == "ANGL") {
            if (values.size() != 1 || !(values[0] >= 0.0 && values[0] <= 90.0))
                return drop(line, fmt::format("table {}: '{}' is not an angle from 0 to 90", name_,
                                              shown(line)));
            angle_deg_ = values[0];
            return;
        }
        const bool usable = key == "WAVE" && values.size() >= 3 && values[0] > 0.0;
        if (!usable)
            return drop(line, fmt::format("table {}: '{}' is not 'WAVE µm Rs Rp Ts Tp'", name_,
                                          shown(line)));
        MeasuredShares shares{values[1], values[2], 1.0 - values[1], 1.0 - values[2]};
        if (values.size() >= 5) {
            shares.t_s = values[3];
            shares.t_p = values[4];
        }
        if (!is_physical(shares))
            return drop(line, fmt::format("table {}: '{}' is beyond R ≥ 0, T ≥ 0, R + T ≤ 1", name_,
                                          shown(line)));
        const bool has_phases =
            std::ranges::any_of(values.begin() + std::min<std::ptrdiff_t>(5, std::ssize(values)),
                                values.end(), [](double phase) { return phase != 0.0; });
        if (has_phases && where_ != phases_noted_) {
            phases_noted_ = where_;
            warn(line,
                 fmt::format("table {}: phases are left out, which matters to polarisation "
                             "alone",
                             name_),
                 false);
        }
        rows_.push_back({angle_deg_, nm_from_um(values[0]), shares});
    }

    void ideal(const WordLine& line, bool by_amplitudes) {
        begin(line, Section::none);
        if (line.words.size() < 3)
            return drop(line, fmt::format("'{}' is not complete", shown(line)));
        name_ = std::string(line.words[1]);
        const auto v = numbers(line, 2);
        Coating coating;
        if (by_amplitudes) {
            // Real and imaginary parts of r and t, of s and then of p.
            if (v.size() < 8)
                return drop(line, fmt::format("IDEAL2 {}: expected eight amplitudes", name_));
            auto square = [&](std::size_t i) { return v[i] * v[i] + v[i + 1] * v[i + 1]; };
            const MeasuredShares shares{square(0), square(4), square(2), square(6)};
            if (!is_physical(shares))
                return drop(line, fmt::format("IDEAL2 {}: R + T is above 1", name_));
            coating = MeasuredReflectance{{nm_from_um(0.55)}, {0.0}, {shares}, name_};
            warn(line,
                 fmt::format("IDEAL2 {}: phases are left out, which matters to polarisation "
                             "alone",
                             name_),
                 false);
        } else {
            const double t = v.empty() ? -1.0 : v[0];
            const double r = v.size() > 1 ? v[1] : 1.0 - t;
            if (!is_physical({r, r, t, t}))
                return drop(
                    line, fmt::format("'{}' is not 'IDEAL name T R' with T + R ≤ 1", shown(line)));
            coating = ConstantReflectance{r, t};
        }
        result_.coatings.push_back({name_, line.where(), std::move(coating)});
    }

    static bool is_physical(const MeasuredShares& s) {
        constexpr double most = 1.0 + 1e-6;  // as printed
        return s.r_s >= 0.0 && s.r_p >= 0.0 && s.t_s >= 0.0 && s.t_p >= 0.0 &&
               s.r_s + s.t_s <= most && s.r_p + s.t_p <= most;
    }

    /// The definition that the line belongs to is no good: said once.
    void drop(const WordLine& line, const std::string& why) {
        if (usable_) warn(line, why + "; the definition is left out", true);
        usable_ = false;
    }
    void warn(const WordLine& line, const std::string& text, bool matters) {
        note(line.where(), text, matters);
    }
    void note(const std::string& where, const std::string& text, bool matters) {
        add_note(result_.notes,
                 {Note::Severity::warning, where, text, Note::Fate::left_out, matters, {}});
    }
    static std::string shown(const WordLine& line) {
        return std::string(line.text.substr(0, longest_excerpt));
    }

    CoatingFile result_;
    Section section_ = Section::none;
    bool usable_ = true;
    std::string name_, where_, phases_noted_;
    CoatingMaterial material_;
    ListedLayers layers_;
    std::vector<TableRow> rows_;
    double angle_deg_ = 0.0;
    std::size_t definitions_ = 0;
};

}  // namespace

CoatingFile coating_file_from_text(std::string_view text, const std::filesystem::path& file) {
    return Reader(file).read(text);
}

CoatingFile read_coating_file(const std::filesystem::path& file) {
    return coating_file_from_text(utf8_text(read_text(file)), file);
}

}  // namespace ghostlight
