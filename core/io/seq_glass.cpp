#include "core/io/seq_glass.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/io/import_notes.h"
#include "core/io/imported_glass.h"
#include "core/io/json_value.h"
#include "core/io/text_lines.h"
#include "core/units.h"

namespace ghostlight {
namespace {

bool is_usable_index(double n) { return n >= 1.0 && n <= 10.0; }

std::vector<double> numbers_of(const SeqCommand& command, std::size_t from) {
    std::vector<double> all;
    for (std::size_t i = from; i < command.words.size(); ++i)
        if (const auto value = parse_number(command.words[i].text)) all.push_back(*value);
    return all;
}

}  // namespace

Dispersion fitted_dispersion(const std::vector<double>& wavelengths_nm,
                             const std::vector<double>& indices, double* largest_error) {
    const auto count = static_cast<Eigen::Index>(std::min(wavelengths_nm.size(), indices.size()));
    *largest_error = 0.0;
    const bool is_constant =
        std::ranges::all_of(indices, [&](double n) { return n == indices.front(); });
    if (count == 1 || is_constant) return ConstantIndex{indices.front()};
    constexpr Eigen::Index most_terms = 3;
    const Eigen::Index terms = std::min(count, most_terms);
    Eigen::MatrixXd matrix(count, terms);
    Eigen::VectorXd wanted(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        for (Eigen::Index k = 0; k < terms; ++k)
            matrix(i, k) = std::pow(um_from_nm(wavelengths_nm[at]), -2.0 * static_cast<double>(k));
        wanted(i) = indices[at];
    }
    const Eigen::VectorXd fitted = matrix.colPivHouseholderQr().solve(wanted);
    *largest_error = (matrix * fitted - wanted).cwiseAbs().maxCoeff();
    FormulaGlass glass{5, {fitted(0)}, 0.0, 0.0};
    for (Eigen::Index k = 1; k < terms; ++k) {
        glass.coefficients.push_back(fitted(k));
        glass.coefficients.push_back(-2.0 * static_cast<double>(k));
    }
    return glass;
}

void PrivateGlasses::add(const SeqCommand& command, Notes& notes) {
    constexpr std::size_t most = 10000;
    if (command.name == "PWL") {
        wavelengths_nm_ = numbers_of(command, 0);
        return;
    }
    const bool laurent_first = command.name == "LAU";
    if (command.words.empty() || glasses_.size() >= most) return;
    const std::string name =
        laurent_first || command.name.starts_with('\'') ? command.words.front().text : command.name;
    const std::size_t from = laurent_first || command.name.starts_with('\'') ? 1 : 0;
    const bool laurent = laurent_first || (command.words.size() > from &&
                                           is_same_name(command.words[from].text, "LAU"));
    const std::vector<double> numbers = numbers_of(command, from);
    Medium medium{clipped(name, 60), {}};
    if (laurent && !numbers.empty()) {
        // n² = A0 + A1 λ² + A2 λ⁻² + A3 λ⁻⁴ + …, λ in µm.
        FormulaGlass glass{3, {numbers.front()}, 0.0, 0.0};
        for (std::size_t i = 1; i < std::min<std::size_t>(numbers.size(), 6); ++i) {
            glass.coefficients.push_back(numbers[i]);
            glass.coefficients.push_back(i == 1 ? 2.0 : -2.0 * (static_cast<double>(i) - 1.0));
        }
        medium.dispersion = glass;
        note_read(notes, command.where,
                  fmt::format("private glass {}: Laurent coefficients", in_quotes(name)));
    } else if (!laurent && !numbers.empty() && numbers.size() == wavelengths_nm_.size() &&
               std::ranges::all_of(numbers, is_usable_index) &&
               std::ranges::all_of(wavelengths_nm_, [](double nm) { return nm > 50.0; })) {
        double error = 0.0;
        medium.dispersion = fitted_dispersion(wavelengths_nm_, numbers, &error);
        // 1e-5 moves the focus of a 50 mm lens by a micrometre.
        constexpr double harmless = 1e-5;
        note_converted(
            notes, command.where,
            fmt::format("private glass {}: {} indices from {} to {} nm, by a Cauchy "
                        "formula that gives them within {:.1e}",
                        in_quotes(name), numbers.size(), std::ranges::min(wavelengths_nm_),
                        std::ranges::max(wavelengths_nm_), error),
            error > harmless);
    } else {
        const std::string why = "its private definition is not understood";
        note_to_mend(notes, command.where,
                     fmt::format("private glass {}: {}", in_quotes(name), why),
                     "give a glass of the catalogue, or nd and Vd");
        medium.dispersion = UnknownGlass{why};
    }
    glasses_.insert_or_assign(upper_case(name), std::move(medium));
}

const Medium* PrivateGlasses::find(std::string_view name) const {
    const auto found = glasses_.find(upper_case(name));
    return found == glasses_.end() ? nullptr : &found->second;
}

Medium seq_glass(std::string_view name, const PrivateGlasses& known, const std::string& file,
                 const std::string& where, Notes& notes) {
    const std::string capitals = upper_case(name);
    if (capitals == "AIR" || capitals.empty()) return {};
    if (capitals == "REFL" || capitals == "REFLECT")
        Place{file, where}.refuse("a mirror: lenses with mirrors cannot be traced here",
                                  in_quotes(name), "refracting surfaces");
    if (const Medium* own = known.find(name)) return *own;
    if (const std::size_t colon = name.find(':'); colon != name.npos) {
        const auto nd = parse_number(name.substr(0, colon));
        const auto vd = parse_number(name.substr(colon + 1));
        if (nd && is_usable_index(*nd)) {
            note_read(notes, where, fmt::format("glass by nd and Vd, {}", name));
            return numbered_glass({}, *nd, vd, where, notes);
        }
    }
    if (const auto code = coded_glass(name)) {
        note_converted(
            notes, where,
            fmt::format("glass code {}: a model glass of nd {} and Vd {}", in_quotes(name),
                        format_number(code->nd), format_number(code->vd)));
        return {std::string(name), ModelGlass{code->nd, code->vd}};
    }
    if (const auto index = parse_number(name); index && is_usable_index(*index))
        return numbered_glass({}, *index, std::nullopt, where, notes);
    // NAME_CATALOG; a name of its own may have an underscore too.
    const std::size_t underscore = name.rfind('_');
    NamedGlass named{std::string(clipped(name.substr(0, underscore), 60)), {}, {}, {}, where};
    if (underscore != name.npos) named.catalogs.push_back(clipped(name.substr(underscore + 1), 60));
    return resolve_glass(named, notes);
}

}  // namespace ghostlight
