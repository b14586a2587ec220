#include "core/fit/fit_setup.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"
#include "core/ghosts/ghost_path.h"
#include "core/units.h"

namespace ghostlight {
namespace {

/// Names of the ghosts of a comma list, as GhostPath's name() has them. Throws Error.
std::vector<std::string> ghosts_in(std::string_view text, const OpticalSystem& system) {
    std::vector<std::string> names;
    while (!text.empty()) {
        const std::size_t comma = text.find(',');
        std::string_view word = text.substr(0, comma);
        while (word.starts_with(' ')) word.remove_prefix(1);
        while (word.ends_with(' ')) word.remove_suffix(1);
        names.push_back(name(parse_ghost(word, system), system.surfaces.size()));
        if (comma == std::string_view::npos) break;
        text.remove_prefix(comma + 1);
    }
    return names;
}

/// " --option value", one value for all photographs or one each; nothing where they are all usual.
template <class Value>
std::string photo_option(const FitSetup& setup, std::string_view option, char separator,
                         const Value& value) {
    const std::string usual = value(FitPhotoSetup());
    std::vector<std::string> values;
    for (const FitPhotoSetup& each : setup.photos) values.push_back(value(each));
    const auto is_usual = [&](const std::string& each) { return each == usual; };
    if (std::ranges::all_of(values, is_usual)) return {};
    if (std::ranges::all_of(values, [&](const auto& each) { return each == values.front(); }))
        values.resize(1);
    return fmt::format(" {} \"{}\"", option, fmt::join(values, std::string_view(&separator, 1)));
}

}  // namespace

FitLoss parse_loss(std::string_view text) {
    for (const FitLoss each : {FitLoss::none, FitLoss::huber, FitLoss::cauchy, FitLoss::tukey})
        if (name(each) == text) return each;
    throw Error({.problem = "the loss is not known",
                 .file = {},
                 .where = {},
                 .found = std::string(text),
                 .expected = "none, huber, cauchy or tukey"});
}

std::vector<std::string> ghosts_left_out(const std::string& left_out, const std::string& only,
                                         const Prescription& lens) {
    if (left_out.empty() && only.empty()) return {};
    const OpticalSystem system = compile(lens, d_line_nm);
    std::vector<std::string> names = ghosts_in(left_out, system);
    if (only.empty()) return names;
    const std::vector<std::string> used = ghosts_in(only, system);
    for (const GhostPath& path : two_reflection_ghosts(system)) {
        const std::string each = name(path, system.surfaces.size());
        if (std::ranges::find(used, each) == used.end() &&
            std::ranges::find(names, each) == names.end())
            names.push_back(each);
    }
    return names;
}

std::vector<std::size_t> profiled_in(const std::string& text, const std::vector<FitParameter>& vary,
                                     const Prescription& lens) {
    std::vector<std::size_t> numbers;
    if (text.empty()) return numbers;
    for (const FitParameter& each : parse_vary(text, lens)) {
        const auto at = std::ranges::find_if(vary, [&](const FitParameter& p) {
            return p.kind == each.kind && p.rows == each.rows && p.layer == each.layer;
        });
        if (at == vary.end())
            throw Error({.problem = "a profile is wanted of a number that is not varied",
                         .file = {},
                         .where = {},
                         .found = vary_item(each),
                         .expected = "numbers among those that are varied"});
        numbers.push_back(static_cast<std::size_t>(at - vary.begin()));
    }
    return numbers;
}

std::string fit_command(const FitSetup& setup, const std::string& lens) {
    const FitSetup usual;
    auto text_if = [](const auto& value) { return value ? text_of(*value) : std::string(); };
    auto number_if = [](const auto& value) { return value ? fmt::format("{}", *value) : ""; };
    std::vector<std::string> files;
    for (const FitPhotoSetup& each : setup.photos) files.push_back(each.file);
    std::string text = fmt::format("fit {} --photo {}{}", lens, fmt::join(files, ","),
                                   setup.merge ? " --merge" : "");
    auto add = [&](const char* option, char separator, const auto& value) {
        text += photo_option(setup, option, separator, value);
    };
    add("--light", ';', [](const FitPhotoSetup& p) { return p.light; });
    add("--photo-mask", ',', [](const FitPhotoSetup& p) { return p.mask_file; });
    add("--mask-region", ';', [](const FitPhotoSetup& p) { return text_of(p.masked); });
    add("--crop", ';', [&](const FitPhotoSetup& p) { return text_if(p.crop); });
    add("--photo-width", ';', [&](const FitPhotoSetup& p) { return number_if(p.width_mm); });
    add("--principal", ';', [&](const FitPhotoSetup& p) { return text_if(p.axis); });
    add("--rotation", ';',
        [](const FitPhotoSetup& p) { return fmt::format("{}", p.rotation_deg); });
    add("--photo-noise", ';', [&](const FitPhotoSetup& p) { return text_if(p.noise); });
    add("--saturation", ';', [&](const FitPhotoSetup& p) { return number_if(p.saturation); });
    text += fmt::format(" --vary {} --spectrum \"{}\"", setup.vary, setup.spectrum);
    if (!setup.left_out.empty()) text += " --leave-out " + setup.left_out;
    if (!setup.only.empty()) text += " --use-ghosts " + setup.only;
    if (!setup.kinds.empty()) text += " --kinds " + setup.kinds;
    if (!setup.kind_rows.empty()) text += " --kind-rows " + setup.kind_rows;
    if (!setup.profiled.empty()) text += " --profile " + setup.profiled;
    if (setup.bootstrap > 0) text += fmt::format(" --bootstrap {}", setup.bootstrap);
    if (setup.loss != usual.loss) text += " --loss " + name(setup.loss);
    if (setup.loss_scale != usual.loss_scale)
        text += fmt::format(" --loss-scale {}", setup.loss_scale);
    return text + fmt::format(" --seed {}", setup.seed);
}

FitRequest fit_request(const FitSetup& setup, const Prescription& lens) {
    FitRequest request;
    request.spectrum = parse_spectrum(setup.spectrum);
    request.vary = parse_vary(setup.vary, lens);
    request.loss = setup.loss;
    request.loss_scale = setup.loss_scale;
    request.across = setup.across;
    request.starts = setup.starts;
    request.left_out = ghosts_left_out(setup.left_out, setup.only, lens);
    request.profiled = profiled_in(setup.profiled, request.vary, lens);
    request.bootstrap = setup.bootstrap;
    request.suggestions = static_cast<std::size_t>(setup.suggestions);
    request.seed = setup.seed;
    return request;
}

}  // namespace ghostlight
