#include "app/cli/method_option.h"

#include <array>

#include "app/cli/options.h"

namespace ghostlight::cli {
namespace {

constexpr std::array methods = {FlareMethod::planned, FlareMethod::uniform, FlareMethod::paraxial,
                                FlareMethod::reference};

}  // namespace

std::string_view method_name(FlareMethod method) {
    switch (method) {
        case FlareMethod::planned:
            return "planned";
        case FlareMethod::uniform:
            return "uniform";
        case FlareMethod::paraxial:
            return "paraxial";
        case FlareMethod::reference:
            return "reference";
    }
    return {};
}

void add_method(CLI::App& command, MethodOptions& options) {
    add_text(command, "--method", options.method, "NAME",
             "planned: the least work for --tolerance; uniform: a grid for every ghost, as\nin "
             "Hullin et al. 2011; paraxial: to first order; reference: refined until two "
             "samplings\nagree within --tolerance, to compare with")
        ->capture_default_str();
    add_text(
        command, "--tolerance", options.tolerance, "X",
        "planned, reference: L1 error of the ghosts' irradiance on the sensor over their\nlight")
        ->capture_default_str();
    add_text(command, "--grid", options.grid, "N",
             "uniform: cells across every ghost's pupil, 2 to 1024; default: by each ghost's bend");
    add_text(command, "--culled", options.culled, "SHARE",
             "uniform: the weakest ghosts that are not drawn, a share of their number");
    add_text(command, "--coating-model", options.coating_model, "NAME",
             "exact, or hullin-2011 (planned, paraxial): that paper's formula, for comparison")
        ->capture_default_str();
}

void set_method(const MethodOptions& options, FlareRequest& request) {
    bool known = false;
    for (const FlareMethod method : methods)
        if (method_name(method) == options.method) {
            request.method = method;
            known = true;
        }
    if (!known)
        throw bad_value("--method", options.method, "planned, uniform, paraxial or reference");
    request.tolerance = number_value("--tolerance", options.tolerance, "a share from 1e-4 to 0.5",
                                     [](double share) { return share >= 1e-4 && share <= 0.5; });
    if (!options.grid.empty())
        request.grid = static_cast<int>(
            integer_value("--grid", options.grid, "a whole number from 2 to 1024", 2, 1024));
    if (!options.culled.empty())
        request.culled = number_value("--culled", options.culled, "a share from 0 to 1",
                                      [](double share) { return share >= 0.0 && share <= 1.0; });
    if (options.coating_model == "hullin-2011")
        request.coating_model = CoatingModel::hullin_2011;
    else if (options.coating_model != "exact")
        throw bad_value("--coating-model", options.coating_model, "exact or hullin-2011");
    const bool formula_fits =
        request.method == FlareMethod::planned || request.method == FlareMethod::paraxial;
    if (request.coating_model == CoatingModel::hullin_2011 && !formula_fits)
        throw Error("--coating-model: hullin-2011 goes with --method planned or paraxial");
}

}  // namespace ghostlight::cli
