#include "core/flare/accuracy_trials.h"

#include <memory>

#include "core/flare/paraxial_flare.h"
#include "core/flare/planned_flare.h"
#include "core/flare/scene_flare.h"

namespace ghostlight {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

class Trials {
   public:
    Trials(const Prescription& lens, const AccuracyRequest& request, std::stop_token stop)
        : lens_(lens), request_(request), stop_(std::move(stop)) {}

    /// Cheapest first in each method, so that a budget cuts off the dearest.
    std::vector<std::vector<AccuracyTrial>> all() const {
        std::vector<std::vector<AccuracyTrial>> families;
        const bool gray = std::holds_alternative<Monochromatic>(request_.spectrum);
        families.push_back({planned("paraxial", "", none, FlareScene::usual_samples,
                                    [](FlareRequest& r) { r.method = FlareMethod::paraxial; })});
        auto& by_tolerance = families.emplace_back();
        for (const double tolerance : {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001})
            by_tolerance.push_back(planned("planned", "tolerance", tolerance,
                                           FlareScene::usual_samples,
                                           [=](FlareRequest& r) { r.tolerance = tolerance; }));
        for (const AccuracyEngine& engine : request_.engines) {
            auto& by_engine = families.emplace_back();
            for (const double tolerance : {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001})
                by_engine.push_back(drawn_by(engine, tolerance));
        }
        auto& by_quick = families.emplace_back();
        for (const double tolerance : {0.1, 0.05, 0.02})
            by_quick.push_back(planned("planned, quick search", "tolerance", tolerance,
                                       FlareScene::usual_samples, [=](FlareRequest& r) {
                                           r.tolerance = tolerance;
                                           r.search = ProbeSearch::quick;
                                       }));
        auto& by_grid = families.emplace_back();
        for (const int grid : {4, 8, 16, 32, 64, 128, 256, 512})
            by_grid.push_back(
                uniform("uniform", "grid", grid, [=](FlareRequest& r) { r.grid = grid; }));
        auto& by_share = families.emplace_back();
        for (const double share : {0.4, 0.2})
            by_share.push_back(
                uniform("uniform, weakest culled", "share", share, [=](FlareRequest& r) {
                    r.culled = share;
                    r.grid = usual_trial_grid;
                }));
        families.push_back(
            {planned("planned, hullin-2011 coating", "tolerance", usual_trial_tolerance,
                     FlareScene::usual_samples, [](FlareRequest& r) {
                         r.tolerance = usual_trial_tolerance;
                         r.coating_model = CoatingModel::hullin_2011;
                     })});
        auto& by_folded = families.emplace_back();
        for (const double share : {0.2, 0.05, 0.01}) by_folded.push_back(folded(share));
        if (request_.ablations) {
            auto without = [&](const char* name, bool PlanEconomies::*economy) {
                auto& family = families.emplace_back();
                for (const double tolerance : {0.05, 0.02, 0.01}) {
                    family.push_back(planned(name, "tolerance", tolerance,
                                             FlareScene::usual_samples, [=](FlareRequest& r) {
                                                 r.tolerance = tolerance;
                                                 r.economies.*economy = false;
                                             }));
                    family.back().is_ablation = true;
                }
            };
            without("planned, all at full size", &PlanEconomies::smaller_sizes);
            without("planned, nothing left out", &PlanEconomies::leaving_out);
            without("planned, light traced everywhere", &PlanEconomies::probed_light);
            without("planned, edges not split", &PlanEconomies::split_edges);
            without("planned, both halves traced", &PlanEconomies::half_beams);
            if (!gray) without("planned, colours apart", &PlanEconomies::merged_colors);
        }
        if (!gray) {
            auto &merged = families.emplace_back(), &separate = families.emplace_back();
            for (const int count : {3, 5, 7, 15, 31, 61}) {
                merged.push_back(
                    planned("planned, wavelengths", "wavelengths", count, count,
                            [](FlareRequest& r) { r.tolerance = usual_trial_tolerance; }));
                separate.push_back(
                    uniform("uniform, wavelengths", "wavelengths", count, [=](FlareRequest& r) {
                        r.spectral_samples = count;
                        r.grid = usual_trial_grid;
                    }));
            }
        }
        return families;
    }

   private:
    const Prescription& lens_;
    const AccuracyRequest& request_;
    std::stop_token stop_;

    FlareRequest base() const {
        FlareRequest request;
        request.light = request_.light;
        request.spectrum = request_.spectrum;
        request.width_px = request_.width_px;
        request.threads = request_.threads;
        return request;
    }

    template <class Set>
    AccuracyTrial planned(const char* method, const char* knob, double setting, int samples,
                          Set set) const {
        FlareRequest request = base();
        set(request);
        return {method, knob, setting, false, [&lens = lens_, stop = stop_, request, samples] {
                    auto scene = std::make_shared<FlareScene>(flare_scene(
                        lens, request.spectrum, samples, request.threads, request.coating_model));
                    return std::function([request, scene, stop] {
                        return request.method == FlareMethod::paraxial
                                   ? render_paraxial(*scene, request, stop)
                                   : render_planned(*scene, request, stop);
                    });
                }};
    }
    AccuracyTrial drawn_by(const AccuracyEngine& engine, double tolerance) const {
        FlareRequest request = base();
        request.tolerance = tolerance;
        return {"planned, " + engine.name, "tolerance", tolerance, false,
                [&lens = lens_, &draw = engine.draw, stop = stop_, request] {
                    auto scene = std::make_shared<FlareScene>(
                        flare_scene(lens, request.spectrum, FlareScene::usual_samples,
                                    request.threads, request.coating_model));
                    return std::function(
                        [&draw, request, scene, stop] { return draw(*scene, request, stop); });
                }};
    }
    /// The ghosts of the least irradiance as the veil's series.
    AccuracyTrial folded(double share) const {
        FlareRequest request = base();
        request.tolerance = usual_trial_tolerance;
        Scene scene;
        scene.lights = {Light{.name = {},
                              .direction = request.light,
                              .spectrum = request.spectrum,
                              .size = PointSize{},
                              .intensity_ev = 0.0,
                              .on = true}};
        scene.veil.folded_share = share;
        scene.layers.of(LayerKind::veil).on = true;
        return {"planned, faint ghosts folded", "share", share, false,
                [&lens = lens_, stop = stop_, request, scene] {
                    auto spectra = std::make_shared<CompiledSpectra>();
                    spectra->of(lens, request.spectrum);
                    return std::function(
                        [&lens, stop, request, scene, spectra]() -> std::optional<FlareImage> {
                            const PatternOf point = [](const LightSize&) { return LightPattern{}; };
                            const DrawGhosts draw = render_planned;
                            const SceneView view{lens, scene, *spectra, point, draw};
                            auto ghosts = ghosts_layer(view, request, stop);
                            const auto veil =
                                ghosts ? veil_layer(view, request, stop, &*ghosts) : std::nullopt;
                            if (!veil) return std::nullopt;
                            for (std::size_t i = 0; i < veil->irradiance.size(); ++i)
                                ghosts->irradiance[i] += veil->irradiance[i];
                            for (std::size_t i = 0; i < veil->rgb.size(); ++i)
                                ghosts->rgb[i] += veil->rgb[i];
                            return ghosts;
                        });
                }};
    }
    template <class Set>
    AccuracyTrial uniform(const char* method, const char* knob, double setting, Set set) const {
        FlareRequest request = base();
        request.method = FlareMethod::uniform;
        set(request);
        return {method, knob, setting, false, [&lens = lens_, stop = stop_, request] {
                    return std::function(
                        [&lens, stop, request] { return render_uniform(lens, request, stop); });
                }};
    }
};

}  // namespace

std::vector<std::vector<AccuracyTrial>> accuracy_trials(const Prescription& lens,
                                                        const AccuracyRequest& request,
                                                        std::stop_token stop) {
    return Trials(lens, request, std::move(stop)).all();
}

}  // namespace ghostlight
