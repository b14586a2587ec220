#include "core/fit/fit_setup.h"

#include <algorithm>
#include <array>

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
        names.push_back(name(parse_ghost(text.substr(0, comma), system), system.surfaces.size()));
        if (comma == std::string_view::npos) break;
        text.remove_prefix(comma + 1);
    }
    return names;
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

FitRequest fit_request(const FitSetup& setup, const Prescription& lens) {
    FitRequest request;
    request.spectrum = parse_spectrum(setup.spectrum);
    request.vary = parse_vary(setup.vary, lens);
    request.loss = setup.loss;
    request.loss_scale = setup.loss_scale;
    request.across = setup.across;
    request.starts = setup.starts;
    request.left_out = ghosts_left_out(setup.left_out, setup.only, lens);
    request.suggestions = static_cast<std::size_t>(setup.suggestions);
    request.seed = setup.seed;
    return request;
}

}  // namespace ghostlight
